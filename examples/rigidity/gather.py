"""Extracts the data of the page: python3 gather.py ISOJAM RESULTS OUT [--keep DATA]

Writes OUT/records.json. For each replicate of the studies below RESULTS it has flags, cost, φ_J and the columns that
the page needs of every state. It also has quantiles of θ_ef from the contacts of every state, contacts by bands of
stiffness, and bins of forces and gaps. Numbers are rounded as in ../page/records.py. Missing studies are left out, and
incomplete ones count with the replicates that they have. With --keep, missing replicates, and missing columns of the
same states, are taken from DATA/records.json.
"""

import argparse
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

from records import contacts_of, found, records_of, replicate_of, rounded, write  # noqa: E402

STUDIES = ("rigidity-50", "rigidity-50-tetrahedra", "paper-100", "paper-100-tetrahedra", "rigidity-200",
           "rigidity-200-tetrahedra", "paper-400", "paper-400-tetrahedra", "rigidity-800")
# Column of a state: where it is in the record.
COLUMNS = {
    "phi": "phi", "E": "energy_per_particle", **{name: f"contacts/{name}" for name in ("Z", "Z_ff", "Z_ef", "C")},
    "omega_l": "modes/omega_l", "K": "moduli/K", "G": "moduli/G",
    "self_stress": "rigidity/classes/self_stress", "floppy_classes": "rigidity/classes/floppy",
    "floppy_normals": "rigidity/normals/floppy",
    "least_kept": "rigidity/classes/least_kept", "largest_dropped": "rigidity/classes/largest_dropped",
    "missing_s": "prestress/missing", "self_stress_s": "prestress/self_stress",
    "second": "prestress/modes/held_by_second", "prestress": "prestress/modes/held_by_prestress",
    "looked_at": "prestress/modes/looked_at", "unresolved": "prestress/modes/unresolved",
    "worst_sum": "prestress/modes/worst_sum", "prestress_lambda": "prestress/modes/prestress_lambda",
    "gaps": "gaps/within_distance", "weak": "gaps/weak_forces"}
# Lists of a state: where, then {column: (index, key)} of what the page needs of them.
LISTS = {
    "rigidity/scaled_cutoffs": {"floppy_half": (0, "floppy"), "self_stress_half": (0, "self_stress"),
                                "floppy_double": (1, "floppy"), "self_stress_double": (1, "self_stress")},
    "prestress/modes/prestress_by_threshold": {
        f"prestress_{t}": (i, "modes") for i, t in enumerate((1, 3, 10, 30, 100))},
    "prestress/modes/second_by_share": {"second_0.1": (1, "modes"), "second_0.01": (2, "modes")},
    "prestress/by_class": {f"{key}_{name}": (i, full) for i, name in enumerate(("ff", "ef", "l"))
                           for key, full in (("contacts", "contacts"), ("tilts", "stiff_tilts"))}}
THRESHOLDS = (1, 3, 10, 30, 100)
QUANTILES = (0.05, 0.1, 0.2, 0.3, 0.5)
CURVE = tuple((i + 0.5) / 40 for i in range(40))  # of the cumulative distributions that are drawn
DRAWN = (0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)  # at the states next to these
LOG_ANGLES = tuple(round(-8 + 0.2 * i, 1) for i in range(42))  # lower edges of bins, radians
FORCES, GAPS = ("face_face", "edge_face", "lower_order"), ("faces", "edges")


def quantile(ordered, share):
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else None


def median_or_none(values):
    return quantile(sorted(values), 0.5) if values else None


def columns_of(states):
    """Columns that at least one state has."""
    columns = {name: [found(state, place) for state in states] for name, place in COLUMNS.items()}
    for i, threshold in enumerate(THRESHOLDS):
        columns[f"C_s_{threshold}"] = [counts[i]["C"] if (counts := found(s, "prestress/thresholds")) else None
                                       for s in states]
    for share in ("normal", "tilt"):
        columns[f"{share}_share"] = [median_or_none(found(s, f"prestress/modes/{share}") or []) for s in states]
    for place, wanted in LISTS.items():
        lists = [found(state, place) or [] for state in states]
        for name, (i, key) in wanted.items():
            columns[name] = [entries[i].get(key) if len(entries) > i else None for entries in lists]
    return {name: values for name, values in columns.items() if any(value is not None for value in values)}


def bins_of(state):
    """For the nearest state, counts in bins of forces by class and of gaps, from the first occupied bin on: [logarithm
    of its lower edge, counts]; None if contacts are not classified."""
    gaps = state.get("gaps")
    if not gaps or not gaps["classes_told"]:
        return None
    made = {}
    for names, edges in ((FORCES, gaps["log10_force"]), (GAPS, gaps["log10_gap"])):
        for name in names:
            counts = gaps[name]["counts"]
            first = next((i for i, n in enumerate(counts) if n), len(counts))
            made[name] = [edges[first] if counts[first:] else None, counts[first:]]
    return made


# Halfway, in the logarithm of s, between the powers that neighbouring bands have: normals as Δφ^(−1), Δφ^(−5/3),
# Δφ^(−5), tilts as Δφ^0, Δφ^(−5/3).
NORMAL_BOUNDARIES, TILT_BOUNDARY = (4 / 3, 10 / 3), 5 / 6
POWERS = tuple(round(-0.5 + 0.125 * i, 3) for i in range(53))  # edges of bins of −ln s/ln Δφ


def bands_of(record):
    """For states with stiffnesses in the record: [Δφ, Z, Z_ef, Z_ff, C, [normals with s above Δφ^(−4/3) × ½, 1,
    2], above Δφ^(−10/3), [tilts above Δφ^(−5/6) × ½, 1, 2]]."""
    made = []
    for state in record["states"]:
        normal, distance = found(state, "prestress/s_normal"), state["delta_phi"]
        if not normal or distance <= 0:
            continue
        above = [[sum(s > factor * distance ** -power for s in some) for factor in (0.5, 1, 2)]
                 for some, power in ((normal, NORMAL_BOUNDARIES[0]), (normal, NORMAL_BOUNDARIES[1]),
                                     (state["prestress"]["s_tilt"], TILT_BOUNDARY))]
        made.append([distance, *(state["contacts"][key] for key in ("Z", "Z_ef", "Z_ff", "C")), *above])
    return made


def powers_of(stiffnesses, distance):
    """Numbers in bins of x, s = Δφ^(−x); those beyond the bins are left out."""
    counts = [0] * (len(POWERS) - 1)
    for s in stiffnesses:
        i = math.floor((-math.log(s) / math.log(distance) - POWERS[0]) / (POWERS[1] - POWERS[0])) if s > 0 else -1
        if 0 <= i < len(counts):
            counts[i] += 1
    return counts


def with_states(record):
    made = replicate_of(record)
    if record["status"] != "done":
        return made
    return {**made, "states": columns_of(record["states"]), "bins": bins_of(record["states"][-1]),
            "bands": bands_of(record)}


def angles_of(contacts):
    """Quantiles of θ_ef of every state, radians."""
    ordered = [sorted(state["theta_ef"]) for state in contacts]
    return {f"theta_{share}": [quantile(angles, share) for angles in ordered] for share in QUANTILES}, ordered


def bins_of_angles(contacts):
    """Counts of angles of the nearest state in the bins of bins_of(); 0 is in the first."""
    made = {}
    for name in ("theta_ef", "theta_ff"):
        counts = [0] * len(LOG_ANGLES)
        for angle in contacts[-1][name]:
            i = math.floor((math.log10(angle) - LOG_ANGLES[0]) / 0.2 + 1e-9) if angle > 0 else 0
            counts[min(max(i, 0), len(counts) - 1)] += 1
        made[name] = [LOG_ANGLES[0], counts]
    return made


def next_to(states, distance):
    """The state nearest to the distance, if it is within a fifth of it."""
    best = min(range(len(states)), key=lambda i: abs(states[i]["delta_phi"] - distance))
    return best if abs(states[best]["delta_phi"] / distance - 1) < 0.2 else None


def study_of(isojam, directory):
    replicates, git, curves, powers = [], set(), {}, {}
    for name, record in records_of(directory):
        made = with_states(record)
        git.add(record["provenance"]["git"])
        if made["status"] == "done" and made["particles"] == 100 and (directory / "paths" / f"{name}.json").exists():
            contacts = contacts_of(isojam, directory, name)
            columns, angles = angles_of(contacts)
            made["states"] |= columns
            made["bins"] = {**(made["bins"] or {}), **bins_of_angles(contacts)}
            for distance in DRAWN:
                i = next_to(record["states"], distance)
                if i is not None and "crystalline" not in made["flags"]:
                    curves.setdefault(f"{made['solid']} {distance}", []).extend(
                        angle / record["states"][i]["delta_phi"] ** (5 / 3) for angle in angles[i])
            if "crystalline" not in made["flags"]:
                add_powers(powers, made["solid"], record["states"])
        replicates.append(made)
    drawn = {name: [quantile(sorted(some), share) for share in CURVE] for name, some in curves.items()}
    return {"git": sorted(git), "collapsed": drawn, "powers": powers, "replicates": replicates}


def add_powers(powers, solid, states):
    """Adds the stiffnesses of normals and of tilts to the bins, for the states whose records have them."""
    places = {"0.02": next_to(states, 0.02), "0.005": next_to(states, 0.005), "nearest": len(states) - 1}
    for place, i in places.items():
        if i is None or not found(states[i], "prestress/s_normal") or states[i]["delta_phi"] <= 0:
            continue
        for kind in ("s_normal", "s_tilt"):
            counts = powers_of(states[i]["prestress"][kind], states[i]["delta_phi"])
            so_far = powers.setdefault(f"{solid} {place} {kind}", [0] * len(counts))
            powers[f"{solid} {place} {kind}"] = [a + b for a, b in zip(so_far, counts)]


def place_of(replicate):
    return replicate["solid"], replicate["particles"], replicate["replicate"]


def with_columns(replicate, before):
    """A replicate, completed by the columns that it lacks and that `before` has for the same states."""
    if not before or {replicate["status"], before["status"]} != {"done"} or \
            replicate["states"]["phi"] != before["states"]["phi"]:
        return replicate
    return {**replicate, "states": before["states"] | replicate["states"],
            "bins": replicate.get("bins") or before.get("bins"), "bands": replicate.get("bands") or before.get("bands"),
            "stages": before["stages"] | replicate["stages"]}


def completed(studies, kept):
    """Studies, completed by the replicates and columns of `kept` that they lack; replicates are in order."""
    made = {}
    for name in STUDIES:
        here, before = studies.get(name), kept.get(name)
        if not here or not before:
            made[name] = here or before
            continue
        known = {place_of(r): r for r in before["replicates"]}
        ours = {place_of(r): with_columns(rounded(r), known.get(place_of(r))) for r in here["replicates"]}
        made[name] = {**here, "git": sorted({*here["git"], *before["git"]}),
                      "replicates": [r for _, r in sorted((known | ours).items())]}
    return {name: study for name, study in made.items() if study and study["replicates"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("isojam")
    parser.add_argument("results", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--keep", type=Path)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    studies = {name: study_of(arguments.isojam, arguments.results / name) for name in STUDIES
               if (arguments.results / name / "records").is_dir()}
    kept = json.loads((arguments.keep / "records.json").read_text(encoding="utf-8")) if arguments.keep else {}
    write(arguments.out / "records.json", completed(studies, kept))


if __name__ == "__main__":
    main()
