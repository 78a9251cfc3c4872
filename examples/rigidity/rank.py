"""Blocks about missing rank: dependence on Δφ and N, and its limit at jamming."""

import functools
import math

from data import SOLIDS
from held import by_grid, slope_table
from limits import FORMS, limit_of_choices
from text import counted, interval, number, places_of, table

WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
AT = (0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)
HYPOSTATIC = ("octahedron", "icosahedron", "dodecahedron")
LARGE = 400  # the size that others are compared with
OTHERS = (50, 100, 200, 800)


def missing(data):
    return by_grid(data, {"missing": ""})


def missing_cutoffs(data):
    columns = {"missing_half": "cut-offs × ½", "missing": "cut-offs × 1", "missing_double": "cut-offs × 2"}
    return by_grid(data, columns, (100, 400), AT)


def missing_slopes(data):
    return slope_table(data, "exponent of m", "missing", HYPOSTATIC)


def redundant(data):
    return by_grid(data, {"self_stress_each": ""}, grid=(0.08, *AT))


def gaps_of_ranks(data):
    """Smallest singular value that counts, and its ratio to the largest that does not, over all states."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            found = sorted(gap for gaps in data.column(solid, particles, "gap") for gap in gaps or [] if gap)
            kept = [k for values in data.column(solid, particles, "least_kept") for k in values or [] if k]
            if found:
                rows.append([f"{solid} {particles}", str(len(found)), power_of_ten(min(kept)),
                             power_of_ten(found[len(found) // 2]), power_of_ten(found[0])])
    return table(["solid, N", "states", "smallest singular value that counts",
                  "its ratio to the largest that does not, median", "ratio, smallest"], rows)


def power_of_ten(x):
    return f"10^{number(math.log10(x), 1)}"


def not_negative(estimate):
    """False if a limit of m is significantly negative, which a missing rank cannot be."""
    return estimate["mean"] + estimate["half_width"] >= 0


@functools.cache
def missing_limit(data, solid, particles):
    """Limit of m = (6N − 3 − rank)/N as Δφ → 0: by functional form over the first window, and the central choice. Its
    systematic error is half the range over forms and windows; `cutoffs` is half the range from half to twice the
    cut-offs at the smallest Δφ."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "missing")]
    if not paths:
        return {}, None
    every, chosen = limit_of_choices(paths, WINDOWS, possible=not_negative)
    half, double = (data.nearest(solid, particles, f"missing_{of}") for of in ("half", "double"))
    if chosen and half and double:
        chosen = {**chosen, "cutoffs": abs(double["mean"] - half["mean"]) / 2}
    return {form: every[0, form] for form in FORMS}, chosen


def excess(data, solid, small, large, distance):
    """N(m_N − m_large) at a distance, with its 95 % confidence interval."""
    few, many = (data.at(solid, n, "missing", distance) for n in (small, large))
    if not few or not many or None in (few["half_width"], many["half_width"]) or few["n"] < 3:
        return None
    return {"mean": small * (few["mean"] - many["mean"]), "half_width": small * math.hypot(
        few["half_width"], many["half_width"]), "n": few["n"]}


def excess_counts(data):
    """(entries of finite_size, entries whose interval excludes 0, largest difference of m at N = 100 within the
    intervals)."""
    found = {(s, n, d): e for s in HYPOSTATIC for n in OTHERS for d in AT if (e := excess(data, s, n, LARGE, d))}
    most = max(((abs(e["mean"]) + e["half_width"]) / n for (_, n, _), e in found.items() if n == 100), default=0)
    return len(found), sum(abs(e["mean"]) > e["half_width"] for e in found.values()), most


def finite_size(data):
    """N(m_N − m_400) against Δφ: the part of N m that is not proportional to N."""
    rows = []
    for solid in HYPOSTATIC:
        for particles in OTHERS:
            cells = [counted(excess(data, solid, particles, LARGE, d)) for d in AT]
            if any(cell != "–" for cell in cells):
                rows.append([f"{solid} {particles}", *cells])
    return table([f"N(m_N − m_{LARGE}), Δφ =", "0.02", "0.01", "0.005", "0.0025", "0.001", "0.0005"], rows)


@functools.cache
def infinite(data, solid):
    """m(Δφ → 0, N → ∞): intercept of the limits against 1/N, weighted by the errors of fit and form, with its interval.
    The mean error from cut-offs, which the sizes share, is its systematic error."""
    limits = {n: missing_limit(data, solid, n)[1] for n in data.sizes(solid)}
    points = [(1 / n, e) for n, e in limits.items() if e and e["half_width"]]
    if len(points) < 3:
        return None
    repeat = [((x, e["mean"]), (e["half_width"] + e["systematic"]) ** -2) for x, e in points]
    total = sum(w for _, w in repeat)
    mean_x = sum(w * x for (x, _), w in repeat) / total
    mean_y = sum(w * y for (_, y), w in repeat) / total
    xx = sum(w * (x - mean_x) ** 2 for (x, _), w in repeat)
    slope = sum(w * (x - mean_x) * (y - mean_y) for (x, y), w in repeat) / xx
    cutoffs = [e["cutoffs"] for _, e in points if "cutoffs" in e]
    return {"mean": mean_y - slope * mean_x, "half_width": math.sqrt(1 / total + mean_x ** 2 / xx), "n": len(points),
            "slope": slope, "slope_half_width": math.sqrt(1 / xx),
            **({"systematic": sum(cutoffs) / len(cutoffs)} if cutoffs else {})}


def with_cutoffs(found):
    """± fit ± form ± cut-offs."""
    if not found:
        return "–"
    more = f" ± {number(found['cutoffs'], places_of(max(found['half_width'], found['systematic'])))}" \
        if "cutoffs" in found else ""
    return f"{interval(found)}{more} ({found['n']})"


def missing_limits(data):
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            forms, found = missing_limit(data, solid, particles)
            if not found:
                continue
            nearest = data.nearest(solid, particles, "C")
            rows.append([f"{solid} {particles}", " / ".join(interval(forms[form]) for form in FORMS),
                         with_cutoffs(found), counted(data.nearest_distance(solid, particles)),
                         interval(data.nearest(solid, particles, "self_stress_each")), interval(nearest),
                         number(12 - 4 / particles, 2)])
        at_infinity = infinite(data, solid)
        if at_infinity:
            rows.append([f"{solid}, N → ∞", "–", f"{interval(at_infinity)} ({at_infinity['n']} sizes)", *["–"] * 3,
                         "12"])
    return table(["solid, N", "m as Δφ → 0 for x = ½ / 1 / free", "m ± fit ± form ± cut-offs", "smallest Δφ",
                  "S/N at this Δφ", "C at this Δφ", "12 − 4/N"], rows)


BLOCKS = {f.__name__: f for f in (missing, missing_cutoffs, missing_slopes, redundant, gaps_of_ranks, finite_size,
                                  missing_limits)}
