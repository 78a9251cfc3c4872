"""Tables of the page and of tables.md."""

import collections
import math

import preparations
import verdict
from data import APART, SOLIDS, SOLIDS_64
from estimates import estimate_of
from text import counted, interval, number, significant, table

DISTANCES = (0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, None)
TILTS_AT = 0.001  # Δφ at which modes and tilts are compared: nearer to jamming, more of the softest modes are unresolved
MODES = "modes per particle with less than half from"
FITTED = {"face_face": "cut_ff", "edge_face": "cut_ef"}
COLUMNS = [f"Δφ = {d}" if d else "nearest" for d in DISTANCES]
EDGES = (0.0005, 0.001, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064, 0.128)  # of the ranges of local exponents
NEAR_JAMMING = 0.0015  # largest mean Δφ of states that show C at jamming
FAR = (0.008, 0.128)  # range of Δφ in which ω_l is compared with √G and √K


def drawn_size(data):
    """The larger of the paper's sizes with troughs for all solids, near jamming."""
    common = [n for n in (100, 400) if all(
        data.trough(s, n) and data.nearest_distance(s, n)["mean"] < NEAR_JAMMING for s in SOLIDS)]
    return max(common, default=100)


def by_size(data, columns, distances=DISTANCES):
    """Rows for each solid, size and column at some distances; rows without values are left out."""
    rows = []
    for solid in SOLIDS:
        for n in data.sizes(solid):
            for column, name in columns.items():
                cells = [data.at(solid, n, column, d) for d in distances]
                if any(cells):
                    rows.append([f"{solid} {n}", name, *map(counted, cells)])
    return table(["solid, N", "quantity", *COLUMNS[-len(distances):]], rows)


def with_range(data, solid, particles, column):
    """Estimate nearest jamming with half its range from half to twice the fitted cut-offs."""
    found = data.nearest(solid, particles, column)
    half, double = (data.nearest(solid, particles, f"{column}_{of}") for of in ("half", "double"))
    return {**found, "systematic": abs(double["mean"] - half["mean"]) / 2} if found and half and double else found


def main_table(data):
    size = drawn_size(data)
    return table([f"nearest jamming, N = {size}", *SOLIDS], [[name, *map(interval, found)] for name, found in (
        ("C by exponents", [verdict.mean(data, s, size, "C_x") for s in SOLIDS]),
        *((f"C by {how}", [data.constraints(s, size, how) for s in SOLIDS]) for how in ("trough", "fit")),
        ("m by exponents", [verdict.mean(data, s, size, "m_x") for s in SOLIDS]),
        ("m by trough", [data.nearest(s, size, "missing_trough") for s in SOLIDS]),
        ("m by fit", [with_range(data, s, size, "missing") for s in SOLIDS]),
        ("m by normals only", [data.nearest(s, size, "missing_normals") for s in SOLIDS]))])


def tilts_table(data):
    return table([f"Δφ = {TILTS_AT}", *SOLIDS], [
        [name, *(interval(data.at(s, 100, column, TILTS_AT)) for s in SOLIDS)] for name, column in (
            (f"{MODES} normals", "held_by_second_each"), (f"{MODES} normals and stiff tilts", "prestress_10_each"),
            ("modes per particle that cannot be distinguished from zero modes", "unresolved_each"),
            ("stiff tilts per face-face contact", "stiff_tilts_ff"),
            ("stiff tilts per edge-face contact", "stiff_tilts_ef"), ("stiff tilts per other contact", "stiff_tilts_l"))])


def density_text(density, particles):
    """A density per particle and decade. One contact of all particles per decade is the smallest that is measured."""
    return significant(density, 2) if density * particles > 1 else f"< {significant(1 / particles, 1)}"


def troughs(data):
    rows = []
    for solid in SOLIDS:
        for n in data.sizes(solid):
            for distance in (*sorted(data.trough_distances(solid, n), reverse=True), None):
                entry = data.trough(solid, n, distance)
                if not entry or entry["edge_face"]["verdict"] == "not_called":
                    continue
                cells = []
                for kind in ("face_face", "edge_face"):
                    found = entry[kind]
                    known, fitted = "cutoff" in found, data.at(solid, n, FITTED[kind], distance)
                    cells += [f"{number(math.log10(found['cutoff']), 1)} ({number(math.log10(found['low']), 1)} … "
                              f"{number(math.log10(found['high']), 1)})" if known else "undecided",
                              density_text(found["density"], n * entry["replicates"]) if known else "–",
                              number(math.log10(fitted["mean"]), 1) if fitted else "–"]
                rows.append([f"{solid} {n}", str(distance or "nearest"), str(entry["replicates"]), *cells])
    return table(["solid, N", "Δφ", "packings", "θ_ff: log10 of the cut-off (edges)", "density", "by fit",
                  "θ_ef: log10 of the cut-off (edges)", "density", "by fit"], rows)


def counts(data):
    return by_size(data, {"missing": "m", "redundant": "S/N", "missing_trough": "m, trough",
                          "redundant_trough": "S/N, trough"})


def exponents(data):
    rows = []
    for solid in SOLIDS:
        for n in (100, 400):
            for column, name in (("E", "E"), ("K", "K"), ("G", "G"), ("omega_l", "⟨ω_l⟩"),
                                 ("omega_over_root_G", "⟨ω_l⟩/√G"), ("omega_over_root_K", "⟨ω_l⟩/√K")):
                cells = [e if e and e["n"] > 2 and e["half_width"] + e["systematic"] < 1 else None
                         for e in data.exponents(solid, n, column, EDGES)]
                if any(cells):
                    rows.append([f"{solid} {n}", name, *map(counted, cells)])
    return table(["solid, N", "quantity", *(f"{a} – {b}" for a, b in zip(EDGES, EDGES[1:]))], rows)


def waves(data):
    return by_size(data, {"wave": "⟨ω_l⟩ / longest transverse wave"})


def modes(data):
    return by_size(data, {"held_by_second_each": "normals < ½", "prestress_10_each": "normals and tilts (s > 10) < ½",
                          "prestress_3_each": "the same, s > 3", "prestress_30_each": "the same, s > 30",
                          "stiff_tilts_ff": "stiff tilts, face-face", "stiff_tilts_ef": "stiff tilts, edge-face",
                          "stiff_tilts_l": "stiff tilts, others"})


def other_solids(data):
    """Solids of the study of many solids, in its order."""
    return list(dict.fromkeys(r["solid"] for r in data.studies.get(SOLIDS_64, {"replicates": ()})["replicates"]))


def solids(data):
    rows, every = [], data.studies.get(SOLIDS_64, {"replicates": ()})["replicates"]
    crystals = collections.Counter(r["solid"] for r in every if "crystalline" in r["flags"])
    failed = collections.Counter(r["solid"] for r in every if r["status"] != "done")
    for solid in other_solids(data):
        kept = data.kept_of(SOLIDS_64, solid)
        cells = [data.nearest_of(SOLIDS_64, solid, name) for name in (
            "Z", "C", "C_s", "missing", "redundant", "stiff_tilts_ff", "stiff_tilts_ef", "stiff_tilts_l", "prestress_10_each")]
        rows.append([solid, *map(str, (len(kept), crystals[solid], failed[solid])), interval(estimate_of([r["phi_j"] for r in kept])), *map(interval, cells)])
    return table(["solid, N = 64", "packings", "crystals", "failed", "φ_J", "Z", "C by fit", "C_s", "m", "S/N", "stiff tilts, face-face",
                  "stiff tilts, edge-face", "stiff tilts, others", f"{MODES} normals and tilts"], rows)


def cost(data):
    rows, total = [], 0
    for name, study in data.studies.items():
        for solid in SOLIDS:
            some = [r for r in study["replicates"] if r["solid"] == solid]
            if some and name not in APART:
                seconds = sum(r["cpu"] for r in some)
                total += seconds
                rows.append([name, f"{solid} {some[0]['particles']}", str(len(some)), f"{seconds / 60:.1f}"])
    return table(["study", "solid, N", "replicates", "CPU time, minutes"], rows) + \
        f"\nAll together took {total / 60:.0f} CPU minutes.\n"


TABLES = (
    ("Constraints by exponents", "Means of the states nearest jamming as in Table 1 of the page.", verdict.by_size),
    ("Other preparations", """Means as in Table 1 of the page. Compression ends at the target energy. *Removed cohesion* acted
     with w = 1e-4 during a compression to 1e-9.""", preparations.every_table),
    ("Troughs in the densities of log θ", """Cut-offs and edges in radians, and the density at the cut-off per particle
     and decade. *Undecided* means that the density has no significant trough. *By fit* is log10 of the mean cut-off of the
     paper's fit, for comparison.""", troughs),
    ("Missing and redundant constraints", """m is the number of missing constraints per particle, (6N − 3 − rank)/N. S is
     the number of states of self-stress. Classes are by fit, unless the quantity names the trough.""", counts),
    ("Local exponents", """Mean slopes d ln y/d ln Δφ between neighbouring states in the range of Δφ at the head of the
     column. The systematic error is half the range over three fit windows of φ_J. Values with errors above 1 are left
     out.""", exponents),
    ("Softest modes and shear waves", "⟨ω_l⟩ divided by 2π/L √(G/ρφ), the frequency of the longest transverse wave.", waves),
    ("Normals, tilts and prestress", """Modes per particle in which the normals, or the normals and stiff tilts together,
     contribute less than half of the stiffness, and stiff tilts per contact. A tilt with the stiffness κ is stiff if s =
     κR/f > 10, with the radius of gyration R and the force f of the contact.""", modes),
    ("Other solids", f"""Sixteen solids, N = 64, Δφ = {TILTS_AT}. *Packings* is the number of packings in the means,
     without crystals and failures. C_s counts the normal and the stiff tilts of each contact.""", solids),
    ("Cost", "CPU times on one core of an Intel Xeon that also ran other work.", cost),
)
