"""Blocks about distributions of forces, gaps and angles, and the increase of Z with Δφ."""

import functools
import math
import statistics

from scipy.special import chdtri

from data import SOLIDS
from estimates import resamples, student
from gather import FORCES, GAPS
from held import by_grid
from limits import GRID as EXPONENTS
from limits import limit
from text import counted, number, significant, table

STEPS_OF_FORCE = tuple(round(-2.4 + 0.4 * i, 1) for i in range(7))  # log10 of f over its mean
WEAK = STEPS_OF_FORCE[:5]  # below 0.16 of the mean; at larger forces every distribution is curved
STEPS_OF_GAP = tuple(round(-4.4 + 0.4 * i, 1) for i in range(8))  # of gaps over V_p^(1/3)
STEPS_OF_ANGLE = tuple(round(-5.6 + 0.8 * i, 1) for i in range(8))  # log10 of radians
WINDOWS = ((0, 0.005), (0, 0.02), (0, 0.08))


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
    """d ln N(< x)/d ln x between steps, from pooled numbers, with 95 % confidence intervals from bootstrap samples of
    the replicates. None where fewer than ten values are below the step."""
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
    rows = [cumulative(r["bins"], names, steps) for r in data.counted(solid, particles)
            if set(names) <= set(r.get("bins") or {})]
    return exponents_of(rows, steps) if len(rows) > 3 else []


def distribution(data, groups, steps):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            for title, names in groups.items():
                found = exponents(data, solid, particles, names, steps)
                if any(found):
                    rows.append([f"{solid} {particles}", title, *(counted(e) for e in found)])
    return table(["solid, N", "values", *(f"{number(a, 1)} … {number(b, 1)}" for a, b in zip(steps, steps[1:]))], rows)


def weak_forces(data):
    return distribution(data, {"all": FORCES, "lower-order contacts": ("lower_order",)}, STEPS_OF_FORCE)


def small_gaps(data):
    return distribution(data, {"between faces": GAPS[:1], "between edges": GAPS[1:]}, STEPS_OF_GAP)


def common(data, solid, names, steps, particles=400):
    """One exponent for all steps, weighted by their intervals, with χ² of the steps and whether it is below its 95 %
    quantile. None with fewer than three steps."""
    found = [e for e in exponents(data, solid, particles, names, steps) if e and e["half_width"] > 0]
    if len(found) < 3:
        return None
    weights = [(1.96 / e["half_width"]) ** 2 for e in found]
    mean = sum(w * e["mean"] for w, e in zip(weights, found)) / sum(weights)
    chi = sum(w * (e["mean"] - mean) ** 2 for w, e in zip(weights, found))
    freedom = len(found) - 1
    return {"mean": mean, "half_width": 1.96 / math.sqrt(sum(weights)), "n": found[0]["n"],
            "one": chi <= chdtri(freedom, 0.05), "chi": chi / freedom}


def open_gaps(data, solid, particles=400):
    """Steps of gaps wider than Δφ, in V_p^(1/3). Smaller gaps depend on the overlaps, which move particles as far."""
    nearest = data.nearest_distance(solid, particles)
    return tuple(s for s in STEPS_OF_GAP if nearest and 10 ** s > nearest["mean"])


def straight(data, groups, steps_of):
    """(number of curves, number of curves that one exponent fits)."""
    found = [e for solid in SOLIDS for names in groups if (e := common(data, solid, names, steps_of(solid)))]
    return len(found), sum(e["one"] for e in found)


def power_laws(data):
    """Fit of one exponent to forces below 0.16 ⟨f⟩ and to gaps wider than Δφ."""
    rows = []
    groups = {"forces, all": (FORCES, lambda _: WEAK),
              "forces, lower-order contacts": (("lower_order",), lambda _: WEAK),
              "gaps between faces": (GAPS[:1], lambda solid: open_gaps(data, solid)),
              "gaps between edges": (GAPS[1:], lambda solid: open_gaps(data, solid))}
    for solid in SOLIDS:
        for title, (names, steps_of) in groups.items():
            found = common(data, solid, names, steps_of(solid))
            if found:
                rows.append([f"{solid} 400", title, counted(found), number(found["chi"], 2),
                             "yes" if found["one"] else "**no**"])
    return table(["solid, N", "values", "exponent", "χ² per degree of freedom", "one exponent fits"], rows)


def at_an_end(found):
    """True if the free exponent lies at an end of its range."""
    return found["exponent"] in (EXPONENTS[0], EXPONENTS[-1])


def excess_law(data, solid, particles):
    """(fits by window, x over the widest window with half the range over the windows that determine it)."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "Z")]
    found = [limit(paths, window, None) for window in WINDOWS]
    known = [e["exponent"] for e in found if e and not at_an_end(e) and e["exponent_half_width"] < 0.5]
    widest = found[-1]
    if not widest or at_an_end(widest):
        return found, None
    return found, {"mean": widest["exponent"], "half_width": widest["exponent_half_width"], "n": widest["n"],
                   "systematic": (max(known) - min(known)) / 2 if known else 0}


def contact_excess(data):
    """Z_J of Z = Z_J + b Δφ^x by window, and x."""
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            found, law = excess_law(data, solid, particles)
            if any(found):
                rows.append([f"{solid} {particles}", *(counted(e) if e and not at_an_end(e) else "–" for e in found),
                             counted(law) if law else "–"])
    return table(["solid, N", *(f"Z_J, Δφ < {significant(w[1], 1)}" for w in WINDOWS), "x, Δφ < 0.08"], rows)


def near_pairs(data):
    columns = {"gaps": "pairs with a gap < Δφ, per particle", "weak": "share of forces < ⟨f⟩/10"}
    return by_grid(data, columns, (100, 400))


def small_angles(data):
    return distribution(data, {"θ_ef": ("theta_ef",), "θ_ff": ("theta_ff",)}, STEPS_OF_ANGLE)


BLOCKS = {f.__name__: f for f in (weak_forces, small_gaps, power_laws, small_angles, contact_excess, near_pairs)}
