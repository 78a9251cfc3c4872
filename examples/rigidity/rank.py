"""Blocks about missing rank: how it falls with Δφ, by size, and what is left at jamming."""

import functools
import math

from data import SOLIDS
from estimates import estimate_of
from held import BINS, bins_falling, by_grid
from limits import limit_of_choices
from scaling import line
from text import counted, interval, number, signed, table

WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
AT = (0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)
HYPOSTATIC = ("octahedron", "icosahedron", "dodecahedron")


def missing(data):
    return by_grid(data, {"missing": ""})


def missing_slopes(data):
    rows = []
    for solid in HYPOSTATIC:
        for particles in data.sizes(solid):
            found = data.slopes(solid, particles, "missing", BINS)
            if any(e and e["n"] > 3 for e in found):
                rows.append([f"{solid} {particles}", *(counted(e) for e in reversed(found))])
    return table(["exponent", *bins_falling()], rows)


@functools.cache
def missing_limit(data, solid, particles):
    """Of m = (6N − 3 − rank)/N as Δφ → 0."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "missing")]
    return limit_of_choices(paths, WINDOWS)[1] if paths else None


def excess(data, solid, small, large, distance):
    """N(m_N − m_large) at a distance, with its 95 % interval: motions per packing that small ones miss beyond large."""
    few, many = (data.at(solid, n, "missing", distance) for n in (small, large))
    if not few or not many or None in (few["half_width"], many["half_width"]):
        return None
    return {"mean": small * (few["mean"] - many["mean"]), "half_width": small * math.hypot(
        few["half_width"], many["half_width"]), "n": few["n"]}


def excess_counts(data):
    """(entries of finite_size, those whose interval leaves 0 out)."""
    found = [e for solid in HYPOSTATIC for n in (50, 100, 200) for d in AT if (e := excess(data, solid, n, 400, d))]
    return len(found), sum(abs(e["mean"]) > e["half_width"] for e in found)


def finite_size(data):
    """N(m_N − m_400) against Δφ: what does not scale with the number of particles."""
    rows = []
    for solid in HYPOSTATIC:
        for particles in (50, 100, 200):
            cells = [counted(excess(data, solid, particles, 400, d)) for d in AT]
            if any(cell != "–" for cell in cells):
                rows.append([f"{solid} {particles}", *cells])
    return table(["N(m_N − m_400)", "Δφ = .02", ".01", ".005", ".0025", ".001", ".0005"], rows)


@functools.cache
def infinite(data, solid):
    """m(Δφ → 0, N → ∞): intercept of the limits against 1/N, weighted by their errors, with its interval."""
    points = [(1 / n, e) for n in data.sizes(solid) if (e := missing_limit(data, solid, n)) and e["half_width"]]
    if len(points) < 3:
        return None
    repeat = [((x, e["mean"]), (e["half_width"] + e["systematic"]) ** -2) for x, e in points]
    total = sum(w for _, w in repeat)
    mean_x = sum(w * x for (x, _), w in repeat) / total
    mean_y = sum(w * y for (_, y), w in repeat) / total
    xx = sum(w * (x - mean_x) ** 2 for (x, _), w in repeat)
    slope = sum(w * (x - mean_x) * (y - mean_y) for (x, y), w in repeat) / xx
    return {"mean": mean_y - slope * mean_x, "half_width": math.sqrt(1 / total + mean_x ** 2 / xx), "n": len(points),
            "slope": slope, "slope_half_width": math.sqrt(1 / xx)}


def missing_limits(data):
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            found, stress = missing_limit(data, solid, particles), data.nearest(solid, particles, "self_stress")
            if not found:
                continue
            target = 12 - 6 / particles - 2 * found["mean"] + 2 * stress["mean"] / particles
            rows.append([f"{solid} {particles}", counted(found), number(found["exponent"], 2), interval(stress),
                         number(target, 2), number(12 - 4 / particles, 2), signed(target - 12 + 4 / particles, 2)])
        at_infinity = infinite(data, solid)
        if at_infinity:
            sizes = f"({at_infinity['n']} sizes)"
            rows.append([f"{solid}, N → ∞", f"{interval(at_infinity)} {sizes}", *["–"] * 5])
    return table(["Δφ → 0", "m ± fit ± form", "free x", "states of self-stress", "C = 12 − 6/N − 2m + 2S/N", "12 − 4/N",
                  "difference"], rows)


def exponent_in_range(data, solid, particles, column, lower, upper):
    """One exponent over states in a range of Δφ, replicate by replicate."""
    made = []
    for x, y in data.paths(solid, particles, column):
        points = [(math.log(a), math.log(b)) for a, b in zip(x, y) if lower <= a < upper and b]
        made.append(line(*zip(*points))[1] if len(points) > 2 else None)
    return estimate_of(made)


BLOCKS = {f.__name__: f for f in (missing, missing_slopes, finite_size, missing_limits)}
