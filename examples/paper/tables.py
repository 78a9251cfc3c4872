"""Tables of the page and of tables.md."""

import functools
import math
import statistics

import verdict
from comparison import DICE, DICE_DENSITY, STABLE_FROM, drawn_size, figures_of, offset, region_two, uncertainty, within
from data import EMERGENCE, LARGE, NEGATIVE, SOLIDS
from estimates import NORMAL, difference_of, estimate_of, student
from limits import limit
from text import counted, interval, number, significant, signed, spread, table

SIZES = (100, 400)
DISTANCES = (0.04, 0.02, 0.01, 0.005, None)
Z_WINDOW = (0, 0.08)


def said(figure):
    """The paper's value as text."""
    if "digits" not in figure:
        return significant(figure["value"], 4)
    text = number(figure["value"], figure["digits"])
    return text + (f" ± {number(figure['error'], figure['digits'])}" if "error" in figure else "")


def paper_density(solid, particles):
    return next(f for f in figures_of("Table I") if (f["solid"], f["particles"]) == (solid, particles))


@functools.cache
def contacts_at_jamming(data, solid, particles):
    """Z_J of the fit Z = Z_J + b Δφ^x with free x."""
    return limit([list(zip(x, y)) for x, y in data.paths(solid, particles, "Z")], Z_WINDOW, None)


def agreement(data, solid, how):
    """C of 400 particles against 12: "above", "below", or "agrees", if they differ by at most the sum of the errors."""
    found = data.constraints(solid, 400, how)
    if not found:
        return "–"
    off = found["mean"] - 12
    if abs(off) <= found["half_width"] + found["systematic"]:
        return "agrees"
    return "above" if off > 0 else "below"


def summary(data):
    heads = [f"{name}, {verdict.place(data)}" for name in ("C by exponents", "m")]
    return table(["solid", "φ_J", "φ_J, paper", "Z_J", *heads], [
        [solid, interval(data.phi_j(solid, 400)), said(paper_density(solid, 400)),
         interval(contacts_at_jamming(data, solid, 400)),
         *(interval(verdict.limit(data, solid, column)) for column in ("C_x", "m_x"))] for solid in SOLIDS])


def needed_packings(data, figure):
    """Number of packings like ours for which the interval of a mean is that of the paper."""
    ours = data.phi_j(figure["solid"], figure["particles"])
    deviation = ours["half_width"] * ours["n"] ** 0.5 / student(ours["n"] - 1)
    return (NORMAL * deviation / figure["error"]) ** 2


def densities(data):
    rows = []
    for figure in figures_of("Table I"):
        solid, n = figure["solid"], figure["particles"]
        ours, off = data.phi_j(solid, n), offset(data, figure)
        dice = DICE_DENSITY[solid]
        rows.append([f"{solid} {n}", counted(ours), spread(ours), said(figure),
                     f"{signed(off[0], 4)} ({signed(off[1], 1)})" if off else "–", within(data, figure, ours),
                     significant(needed_packings(data, figure), 2) if ours and ours["n"] > 1 else "–",
                     f"{number(dice[0], 2)} ± {number(dice[1], 2)}"])
    return table(["solid, N", "φ_J", "single packing", "paper", "paper − ours (deviate)", "overlaps our",
                  "packings", "dice"], rows)


def sizes(data):
    rows = []
    for solid in SOLIDS:
        small, large = ([r["phi_j"] for r in data.kept(solid, n)] for n in SIZES)
        found = difference_of(small, large) if min(len(small), len(large)) > 1 else None
        rows.append([solid, f"{signed(found['mean'], 4)} ± {number(found['half_width'], 4)}" if found else "–",
                     signed(paper_density(solid, 400)["value"] - paper_density(solid, 100)["value"], 4)])
    return table(["φ_J(N = 400) − φ_J(N = 100)", "ours", "paper"], rows)


def constraints(data):
    rows = []
    for solid in SOLIDS:
        for n in data.sizes(solid):
            for how in ("trough", "fit"):
                cells = [data.constraints(solid, n, how, d) for d in DISTANCES]
                if any(cells):
                    rows.append([f"{solid} {n}", how, *map(counted, cells)])
    return table(["solid, N", "cut-off", *(f"Δφ = {d}" if d else "nearest" for d in DISTANCES)], rows)


def angles(data):
    rows = []
    known = {k: v for study in data.main() for k, v in study.get("critical_angles", {}).items()}
    for solid in SOLIDS:
        here = [f for f in figures_of("Table II") if f["solid"] == solid]
        if solid in known:
            equal = all(abs(known[solid][f["column"]] - f["value"]) <= uncertainty(f) + 1e-9 for f in here)
            rows.append([solid, *(f"{known[solid][f['column']]:.2f} ({f['value']:.1f})" for f in here),
                         "yes" if equal else "**no**"])
    return table(["ours (paper's), degrees", "θ_ef, vertex-face", "θ_ef, edge-edge", "θ_ff, vertex-face",
                  "θ_ff, edge-edge", "θ_ff, edge-face", "equal to the last digit"], rows)


def compared(data, figure, distance):
    if figure["column"] == "C":
        return data.constraints(figure["solid"], figure["particles"], "fit", distance)
    return data.at(figure["solid"], figure["particles"], figure["column"], distance)


def table_iii(data):
    rows = []
    for place, cutoffs in (("Table III, column 1", "fitted"), ("Table III, column 2", "5°, 15° … 55°")):
        for figure in figures_of(place):
            ours = compared(data, figure, figure["delta_phi"])
            name = figure["column"].removesuffix("_fixed")
            rows.append([name, cutoffs, counted(ours), spread(ours), said(figure), within(data, figure, ours),
                         DICE[name]])
    return table(["quantity", "cut-offs", "ours", "single packing", "paper", "paper's value is in our", "dice"], rows)


def table_iv(data):
    rows = []
    names = {"l_max": "l_max/L, centres", "body_l_max": "l_max/L, vertices"}
    for figure in figures_of("Table IV"):
        solid, particles, column = figure["solid"], figure["particles"], figure["column"]
        ours = data.at(solid, particles, column, STABLE_FROM[solid])
        extents = [v for _, y in data.paths(solid, particles, column) for v in y if v is not None and column in names]
        rows.append([solid, names.get(column, column), counted(ours), counted(data.nearest(solid, particles, column)),
                     number(max(extents), 2) if extents else "–", said(figure), within(data, figure, ours)])
    return table(["solid", "quantity", "at the paper's Δφ", "nearest jamming", "largest of all states", "paper",
                  "paper's value is in our"], rows)


def high_modes(data):
    rows = []
    for solid in SOLIDS:
        for n in SIZES:
            columns = [data.nearest(solid, n, name) for name in ("members", "amplitude", "participating", "S")]
            rows.append([f"{solid} {n}", *map(counted, columns)])
    return table(["solid, N", "share of particles with a face-face contact", "their share of the squared amplitude",
                  "particles that take part in a mode", "mean cluster size S"], rows)


def minima(data):
    rows = []
    for solid in SOLIDS:
        for n in SIZES:
            kept = data.kept(solid, n)
            last = [{k: v[-1] for k, v in r["states"].items()} for r in kept]
            whole, backbone, every = data.minima(solid, n)
            negative = sum((s.get("negative") or 0) > 0 for s in last)
            rattlers = sum((s.get("near_rattlers") or 0) > 0 for s in last)
            states = [(z, m) for r in kept for z, m in zip(r["states"].get("zero", ()), r["states"].get("negative", ()))]
            rows.append([f"{solid} {n}", str(every), str(whole), str(backbone), str(negative), str(rattlers),
                         f"{sum(s == (3, 0) for s in states)} of {len(states)}"])
    return table(["solid, N", "nearest states", "minima, all particles", "minima, backbone only", "negative mode",
                  "with near-rattlers", "minima of all states, all particles"], rows)


def percent(estimate):
    return counted(estimate and {**estimate, "mean": 100 * estimate["mean"],
                                 "half_width": estimate["half_width"] and 100 * estimate["half_width"]})


def unstable(data):
    names = [f"unstable_{name}" for name in ("exact", "h8", "h6", "h4")]
    rows = []
    for solid in SOLIDS:
        for distance in (0.04, 0.01, None):
            cells = [data.at(solid, 100, name, distance) for name in names]
            if any(cells):
                rows.append([f"{solid} 100", str(distance or "nearest"), *map(percent, cells)])
        cells = [data.nearest_of(NEGATIVE, solid, name) for name in names]
        if any(cells):
            rows.append([f"{solid} 400", "0.01", *map(percent, cells)])
    return table(["solid, N", "Δφ", "analytic, %", "h = 10⁻⁸, %", "h = 10⁻⁶, %", "h = 10⁻⁴, %"], rows)


def region_two_ratios(data):
    """For each solid with known angles: its name, the end of region 2 in degrees, and the ratio of densities."""
    size, found = drawn_size(data), []
    known = {k: v for study in data.main() for k, v in study.get("critical_angles", {}).items()}
    for solid in SOLIDS:
        entry = data.trough(solid, size)
        if entry and solid in known and "theta_ff" in entry:
            critical = min(v for name, v in known[solid].items() if name.startswith("ff"))
            found.append((solid, critical, region_two(entry["theta_ff"], entry["width"], critical)))
    return found


def uniformity(data):
    rows = [[f"{solid} {drawn_size(data)}", f"1° … {number(critical, 1)}°", interval(ratio)]
            for solid, critical, ratio in region_two_ratios(data)]
    return table(["solid, N", "region 2", "density of the upper half / density of the lower half"], rows)


def emergence(data):
    """For each solid and Δφ: (solid, Δφ, packings, density of θ_ff in region 1 / in region 2, number of θ_ef near 0 / number of
    random contacts), both with the 95 % interval of Poisson noise."""
    found = []
    for solid, entries in data.studies.get(EMERGENCE, {}).get("emergence", {}).items():
        for e in entries:
            one = e["first"] * (e["end"] - 1) / e["second"]
            near = e["edge_face"] / (e["contacts"] * e["random_share"])
            found.append((solid, e["delta_phi"], e["packings"],
                          {"mean": one, "half_width": NORMAL * one / math.sqrt(max(1, e["first"])), "n": 1},
                          {"mean": near, "half_width": NORMAL * near / math.sqrt(max(1, e["edge_face"])), "n": 1}))
    return found


def emergence_table(data):
    rows = [[solid, str(distance), str(packings), interval(one), interval(near)]
            for solid, distance, packings, one, near in emergence(data)]
    return table(["solid, N = 100", "Δφ", "packings", "θ_ff: density below 1° / density in region 2",
                  "θ_ef near 0: number / number of random contacts"], rows)


def structure(data, solid, particles):
    """[(k, estimate of S(k))] for each shell of wave vectors. If there are fewer than three packings, the interval is that of
    an exponential distribution of |Σ exp(−ik·x)|², with all wave vectors independent."""
    found = []
    for study in data.studies.values():
        for shell in study.get("structure", {}).get(f"{solid} {particles}", ()):
            made = estimate_of(shell["S"])
            if made["n"] < 3:
                made["half_width"] = NORMAL * made["mean"] / math.sqrt(made["n"] * shell["vectors"])
            found.append((shell["k"], made))
    return found


def fluctuations(data):
    rows = []
    for solid in SOLIDS:
        for n in (400, 4000):
            shells = structure(data, solid, n)
            if shells:
                near = [min(shells, key=lambda shell, k=k: abs(shell[0] - k)) for k in (1, 1.5, 2)]
                rows.append([f"{solid} {n}", *(f"{counted(e)} at {number(k, 2)}" for k, e in (shells[0], *near))])
    return table(["solid, N", "S at the smallest k", "S at k ≈ 1", "S at k ≈ 1.5", "S at k ≈ 2"], rows)


def large(data):
    kept = data.kept_of(LARGE, "octahedron")
    if not kept:
        return "These data lack the packing.\n"
    r = kept[0]
    last = {name: values[-1] for name, values in r["states"].items()}
    n = r["particles"]
    rows = [["φ_J", number(r["phi_j"], 4)], ["Δφ of the state", significant(last["phi"] - r["phi_j"], 2)],
            ["residual", significant(last["residual"], 2)], ["Z", number(last["Z"], 3)],
            ["Z_ff, Z_ef by fit", f"{number(last['Z_ff'], 3)}, {number(last['Z_ef'], 3)}"],
            ["C by fit", number(last["C"], 3)],
            ["C by trough", number(last["C_trough"], 3) if last.get("C_trough") else "no trough"],
            ["rank, classes by fit", f"{6 * n - round(last['floppy'])} of 6N − 3 = {6 * n - 3}"],
            ["S/N, classes by fit", number(last["self_stress"] / n, 3)],
            ["CPU time, minutes", number(r["cpu"] / 60, 1)]]
    return table(["octahedra, N = 4000", "one packing"], rows)


def cost(data):
    rows, stages = [], {}
    studies = {name: study for name, study in data.studies.items() if name.startswith("paper-")}
    for name, study in studies.items():
        for solid in SOLIDS:
            some = [r for r in study["replicates"] if r["solid"] == solid]
            if some:
                seconds = [r["cpu"] for r in some]
                rows.append([name, solid, str(len(some)), str(sum(r["status"] != "done" for r in some)),
                             f"{statistics.median(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
            for r in some:
                for stage, time in r["stages"].items():
                    stages[stage] = stages.get(stage, 0) + time
    commits = sorted({commit for study in studies.values() for commit in study["git"]})
    total = sum(stages.values())
    return (table(["study", "solid", "replicates", "failed", "CPU time, median, s", "all, minutes"], rows) + "\n" +
            table(["stage", "share of the CPU time, %"], [[f"`{stage}`", number(100 * t / total, 1)] for stage, t in
                                                          sorted(stages.items(), key=lambda item: -item[1])]) +
            f"\nAll together took {total / 60:.0f} CPU minutes. The records were made by commit {', '.join(commits)}.\n")


TABLES = (
    ("Jamming density", """The deviate is the offset in standard deviations of a normal distribution with the same
     probability. It assumes that the paper's value is the φ_J of one packing like ours, with the paper's interval. The
     column after it states which of our intervals overlaps that of the paper. *Packings* is the number of packings like
     ours whose mean would have an interval as narrow as the paper's. The dice are rounded dice, whose densities the
     paper quotes.""", densities),
    ("Finite-size effect of the jamming density", "The interval is that of Welch's t.", sizes),
    ("C by two classifications", """The second error of C by trough is half the difference between C at both edges
     of the trough. That of C by fit is half its range from half to twice the fitted cut-offs.""",
     constraints),
    ("Table II of the paper: critical angles", "Our values are computed from closed forms.", angles),
    ("Table III of the paper: tetrahedra, N = 100, Δφ = 0.04", """The paper's value is in our confidence interval if
     it is between our mean ± the sum of both errors, within half a unit of its last digit. The dice and their
     errors are those of Jaoshvili et al., Phys. Rev. Lett. 104, 185501 (2010).""", table_iii),
    ("Table IV of the paper: clusters", """Clusters of face-face contacts, N = 400. We compare at the smallest
     Δφ of stable packings that we infer from the caption of the paper's Figure 3: 0.04 for tetrahedra, 0.02 for
     octahedra, 0.01 for the others. The extent l_max of a cluster is measured between centres or between vertices. The paper
     does not state which. "Largest of all states" is the largest extent over all packings and all Δφ.""", table_iv),
    ("High-frequency modes", """Squared amplitude of the fifty highest modes on particles that have a face-face contact,
     in the states nearest jamming. The number of particles that take part is N times the mean participation ratio. If it
     is below S, a mode can be on one cluster of face-face contacts.""", high_modes),
    ("Minima", """A state is a minimum if it has three zero modes and no negative mode. If softest modes cannot be
     distinguished from zero in double precision, or if there are near-rattlers, the backbone is examined instead.""",
     minima),
    ("Negative modes by central differences", """Share of negative modes of the analytic dynamical matrix, and of
     matrices from central differences of forces with the step h (V_p^(1/3)). The paper's stability analysis used central
     differences. With N = 400 and Δφ = 0.01, it found 5.3 % of
     unstable modes in tetrahedra. In octahedra it found less than 1.2 %.""", unstable),
    ("Is region 2 of c(θ_ff) uniform?", """The paper states that θ_ff is uniform between 1° and the smallest
     critical angle. Both halves of this range would then have the same density. Angles are those of the states
     nearest jamming. The interval of the ratio is that of Poisson noise.""", uniformity),
    ("Order in which regions emerge", """The paper states that region 1 of c(θ_ff), the angles below 1°, emerges only after
     c(θ_ef) is hyper-random, that is, larger than for random contacts at small angles. Packings were compressed to E/N =
     5·10⁻⁴ (`emergence.json`). Region 1 exists if the first ratio is above 1. c(θ_ef) is hyper-random if the second ratio
     is above 1. *Near 0* are the angles that 10 % of random contacts have. Intervals are those of Poisson noise.""",
     emergence_table),
    ("Density fluctuations", """Structure factor S(k) = |Σ exp(−ik·x)|²/N of the centres x of the particles, k in
     V_p^(−1/3), in the states nearest jamming. In a hyperuniform packing, S tends to 0 for k → 0. The interval for the
     packing with N = 4000 is that of an exponential distribution.

![Structure factors](structure.svg)
**Figure 5** ([PDF](structure.pdf)). S(k) of (a) packings with N = 400, and of (b) octahedra with N = 400 and N = 4000.
Error bars are 95 % confidence intervals.""", fluctuations),
    ("A large packing", "One packing of 4000 octahedra, `n4000.json`.", large),
    ("Cost", "CPU times on one core of an Intel Xeon that also ran other work.", cost),
)
