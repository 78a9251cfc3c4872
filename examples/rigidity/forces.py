"""Blocks about forces: the cone of one-sided ones, distributions of forces and gaps, contacts gained with Δφ."""

import functools
import math
import statistics

from data import SOLIDS
from estimates import estimate_of, resamples, student
from gather import FORCES, GAPS
from held import BINS, bins_falling, by_grid
from limits import limit
from text import counted, interval, number, significant, table

STEPS_OF_FORCE = tuple(round(-2.4 + 0.4 * i, 1) for i in range(7))  # log10 of f over its mean
WEAK = STEPS_OF_FORCE[:5]  # below .16 of the mean: further up any distribution bends
STEPS_OF_GAP = tuple(round(-4.4 + 0.4 * i, 1) for i in range(8))  # of gaps over V_p^(1/3)
WINDOWS = ((0, 0.005), (0, 0.02), (0, 0.08))


def cones(data):
    """Of states nearest jamming; and, of all states of which it is known, in how many the cone has the dimension of
    all self-stress by class."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            told, equal, outside, ends = 0, 0, 0, []
            for r in data.counted(solid, particles):
                s = r["states"]
                none = [None] * len(s["phi"])
                pairs = list(zip(s.get("dimension") or none, s.get("self_stress") or none))
                told += sum(None not in p for p in pairs)
                equal += sum(None not in p and p[0] == p[1] for p in pairs)
                outside += sum((n or 0) > 0 for n in s.get("outside") or none)
                ends.append(pairs[-1] if None not in pairs[-1] else None)
            ends = [e for e in ends if e]
            if not told:
                continue
            rows.append([f"{solid} {particles}", interval(data.nearest(solid, particles, "rows")), str(len(ends)),
                         *(interval(estimate_of([e[i] for e in ends])) for i in (0, 1)), f"{equal} of {told}",
                         str(outside), counted(data.nearest(solid, particles, "median_margin"))])
    return table(["nearest jamming", "constraints", "n", "dimension of the cone", "states of self-stress by class",
                  "equal, of all states told", "states with a force outside", "median margin"], rows)


def cone_total(data):
    told = equal = 0
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            for r in data.counted(solid, particles):
                pairs = [p for p in zip(r["states"].get("dimension") or [], r["states"].get("self_stress") or [])
                         if None not in p]
                told += len(pairs)
                equal += sum(a == b for a, b in pairs)
    return told, equal


def cumulative(bins, names, steps):
    """Numbers below each step, of one replicate."""
    made = [0] * len(steps)
    for name in names:
        first, counts = bins[name]
        for i, count in enumerate(counts):
            upper = first + 0.2 * (i + 1)
            for j, step in enumerate(steps):
                made[j] += count if upper <= step + 1e-6 else 0
    return made


def exponents_of(rows, steps, draws=100, seed=1):
    """d ln N(< x) / d ln x from step to step, of pooled numbers, with 95 % by samples of replicates with replacement.
    None where fewer than ten are below."""
    def of(chosen):
        sums = [sum(row[j] for row in chosen) for j in range(len(steps))]
        return [math.log(b / a) / ((steps[j + 1] - steps[j]) * math.log(10)) if a > 0 else None
                for j, (a, b) in enumerate(zip(sums, sums[1:]))]

    central = of(rows)
    sampled = [of([rows[i] for i in chosen]) for chosen in resamples(len(rows), draws, seed)]
    made = []
    for j, value in enumerate(central):
        spread = [s[j] for s in sampled if s[j] is not None]
        few = sum(row[j] for row in rows) < 10
        made.append(None if value is None or few or len(spread) < draws // 2 else {
            "mean": value, "half_width": student(len(rows) - 1) * statistics.stdev(spread), "n": len(rows)})
    return made


@functools.cache
def exponents(data, solid, particles, names, steps):
    rows = [cumulative(r["bins"], names, steps) for r in data.counted(solid, particles) if r.get("bins")]
    return exponents_of(rows, steps) if len(rows) > 3 else []


def distribution(data, groups, steps):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            for title, names in groups.items():
                found = exponents(data, solid, particles, names, steps)
                if any(found):
                    rows.append([f"{solid} {particles}", title, *(counted(e) for e in found)])
    return table(["nearest jamming", "", *(f"{number(a, 1)} – {number(b, 1)}" for a, b in zip(steps, steps[1:]))], rows)


def weak_forces(data):
    return distribution(data, {"all": FORCES, "neither ff nor ef": ("lower_order",)}, STEPS_OF_FORCE)


def small_gaps(data):
    return distribution(data, {"along faces": GAPS[:1], "along edges": GAPS[1:]}, STEPS_OF_GAP)


def common(data, solid, names, steps):
    """One exponent for all steps, with N = 400, weighted by their intervals; whether χ² allows it at 5 %. None of fewer
    than three steps."""
    found = [e for e in exponents(data, solid, 400, names, steps) if e and e["half_width"] > 0]
    if len(found) < 3:
        return None
    weights = [(1.96 / e["half_width"]) ** 2 for e in found]
    mean = sum(w * e["mean"] for w, e in zip(weights, found)) / sum(weights)
    chi = sum(w * (e["mean"] - mean) ** 2 for w, e in zip(weights, found))
    # 95 % point of χ², by Wilson and Hilferty.
    part = 2 / (9 * (len(found) - 1))
    allowed = chi <= (len(found) - 1) * (1 - part + 1.645 * math.sqrt(part)) ** 3
    return {"mean": mean, "half_width": 1.96 / math.sqrt(sum(weights)), "n": found[0]["n"], "one": allowed}


def straight(data, groups, steps):
    """(curves, those of them of which one exponent fits all steps)."""
    found = [e for solid in SOLIDS for names in groups if (e := common(data, solid, names, steps))]
    return len(found), sum(e["one"] for e in found)


def exponent_of(found):
    return interval({"mean": found["exponent"], "half_width": found["exponent_half_width"], "n": found["n"]}) \
        if found else "–"


def contact_excess(data):
    """Z_J and x of Z = Z_J + b Δφ^x by window."""
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "Z")]
            found = [limit(paths, window, None) for window in WINDOWS]
            if not any(found):
                continue
            cells = []
            for e in found:
                cells += [counted(e), exponent_of(e)]
            rows.append([f"{solid} {particles}", *cells])
    return table(["", *(cell for w in WINDOWS for cell in (f"Z_J, Δφ < {significant(w[1], 1)}", "x"))], rows)


def excess_exponent(data, solid, particles):
    """x over the widest window."""
    return exponent_of(limit([list(zip(x, y)) for x, y in data.paths(solid, particles, "Z")], WINDOWS[-1], None))


def near_pairs(data):
    return by_grid(data, {"gaps": "pairs with a gap < Δφ", "weak": "forces < ⟨f⟩/10"}, (100, 400))


def near_pair_slopes(data):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            found = data.slopes(solid, particles, "gaps", BINS)
            if any(found):
                rows.append([f"{solid} {particles}", *(counted(e) for e in reversed(found))])
    return table(["exponent of pairs with a gap < Δφ", *bins_falling()], rows)


BLOCKS = {f.__name__: f for f in (cones, weak_forces, small_gaps, contact_excess, near_pairs, near_pair_slopes)}
