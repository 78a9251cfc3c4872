"""C, missing constraints m and states of self-stress S by exponents, in the states nearest jamming of CONSTRAINTS."""

import statistics

from data import CONSTRAINTS, SOLIDS
from estimates import estimate_of
from text import interval, number, significant, table

WITHIN = {"tetrahedron": 1e-3}  # largest Δφ of the states that count, if it is not 3e-4
MEANT = ("C_x", "m_x", "m_supported")


def packings(data, solid, particles):
    """Last states of the packings that means use: {column: value}, with Δφ."""
    found = []
    for name in CONSTRAINTS:
        for r in data.kept_of(name, solid):
            last = {column: values[-1] for column, values in r["states"].items()}
            distance = last["phi"] - r["phi_j"]
            if r["particles"] == particles and last.get("C_x") is not None and distance <= WITHIN.get(solid, 3e-4):
                found.append({**last, "distance": distance})
    return found


def sizes(data, solid):
    return [n for n in sorted({r["particles"] for name in CONSTRAINTS for r in data.kept_of(name, solid)})
            if len(packings(data, solid, n)) > 2]


def size(data):
    """The largest N with at least three packings of all solids."""
    return max(set.intersection(*(set(sizes(data, s)) for s in SOLIDS)))


def mean(data, solid, particles, column):
    """Estimate, with half of its range over the boundaries of the classes as the systematic error."""
    found = packings(data, solid, particles)
    low, high = ([p.get(f"{column}_{end}") for p in found] for end in ("low", "high"))
    systematic = None if None in low + high else abs(statistics.fmean(high) - statistics.fmean(low)) / 2
    return estimate_of([p.get(column) for p in found], systematic)


def single_stress(data, solid, particles):
    found = packings(data, solid, particles)
    return f"{sum(p['self_stress_x'] == 1 for p in found)} of {len(found)}"


def column(data, solid, particles):
    return [*(interval(mean(data, solid, particles, name)) for name in MEANT), single_stress(data, solid, particles),
            significant(statistics.median(p["distance"] for p in packings(data, solid, particles)), 2)]


NAMES = ("C", "m", "m without underconstrained particles", "packings with S = 1", "Δφ, median")


def verdict_table(data):
    n = size(data)
    columns = [column(data, s, n) for s in SOLIDS]
    return table([f"by exponents, N = {n}", *SOLIDS],
                 [[name, *cells] for name, cells in zip(NAMES, zip(*columns))] + [["12 − 4/N", *4 * [number(12 - 4 / n, 2)]]])


def by_size(data):
    return table(["solid, N", *NAMES, "12 − 4/N"], [[f"{s} {n}", *column(data, s, n), number(12 - 4 / n, 2)]
                                                   for s in SOLIDS for n in sizes(data, s)])


def misses(data, solid):
    """True if constraints are missing by more than both errors, for every N."""
    return all(m["mean"] > m["half_width"] + m["systematic"] for n in sizes(data, solid)
               if (m := mean(data, solid, n, "m_x")))
