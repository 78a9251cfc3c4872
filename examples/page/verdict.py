"""Constraints by exponents in the states nearest jamming: C, missing constraints m and states of self-stress S, and the
verdict, with which README.md and two pages begin: python3 verdict.py DATA prints it."""

import statistics
import sys

from data import CONSTRAINTS, PLURALS, SOLIDS, Data
from estimates import estimate_of
from limits import extrapolated
from text import interval, number, significant, table

WITHIN = dict.fromkeys(SOLIDS, 3e-4) | {"tetrahedron": 1e-3}  # largest Δφ of the states that count
MEANT = ("C_x", "m_x", "m_supported")
FEW = 0.06  # no constraints are missing if m is surely below 1 % of the six motions of a particle


def packings(data, solid, particles, studies=CONSTRAINTS):
    """Last states of the packings that means use: {column: value}, with Δφ, φ_J and the preparation."""
    found = []
    for name in studies:
        for r in data.kept_of(name, solid):
            last = {column: values[-1] for column, values in r["states"].items()}
            distance = last["phi"] - r["phi_j"]
            if r["particles"] == particles and last.get("C_x") is not None and distance <= WITHIN[solid]:
                found.append({**last, "distance": distance, "phi_j": r["phi_j"], "preparation": r.get("preparation")})
    return found


def sizes(data, solid):
    return [n for n in sorted({r["particles"] for name in CONSTRAINTS for r in data.kept_of(name, solid)})
            if len(packings(data, solid, n)) > 2]


def every(data, solid):
    """The packings of all sizes."""
    return [p for n in sizes(data, solid) for p in packings(data, solid, n)]


def three_means(data, solid, particles, column):
    """Means with the central, the lowest and the highest boundaries of the classes."""
    found = packings(data, solid, particles)
    return [estimate_of([p.get(f"{column}{end}") for p in found]) for end in ("", "_low", "_high")]


def with_range(central, low, high):
    """An estimate with half of its range over the boundaries of the classes as the systematic error, and the ends of the 95 %
    confidence intervals over all boundaries."""
    if not low or not high:
        return central
    ends = (low["mean"] - (low["half_width"] or 0), high["mean"] + (high["half_width"] or 0))
    return {**central, "systematic": (high["mean"] - low["mean"]) / 2, **dict(zip(("least", "greatest"), ends))}


def mean(data, solid, particles, column):
    return with_range(*three_means(data, solid, particles, column))


def place(data):
    """N of the verdict: the limit, if the sizes differ by a factor of three, or the largest size with all solids."""
    common = set.intersection(*(set(sizes(data, s)) for s in SOLIDS))
    return "N → ∞" if max(common) > 3 * min(common) else f"N = {max(common)}"


def limit(data, solid, column, without=None):
    """Limit N → ∞: intercept of the means against 1/N, weighted by their intervals, or by their resolution if it is larger. If
    the sizes do not determine it, the mean at place(). A size can be left out."""
    if place(data) != "N → ∞":
        return mean(data, solid, int(place(data).split()[-1]), column)
    found = {n: three_means(data, solid, n, column) for n in sizes(data, solid) if n != without}
    return with_range(*(extrapolated([(1 / n, means[k]["mean"], max(means[k]["half_width"], 1 / n / means[k]["n"]))
                                      for n, means in found.items()]) for k in range(3)))


def call(data, solid, without=None):
    m = limit(data, solid, "m_x", without)
    return "missing" if m["least"] > 0 else "none" if m["greatest"] < FEW else "uncertain"


SENTENCES = {"missing": ("Constraints are missing in packings of {}.", "{}, at least {}"),
             "none": ("No constraints are missing in {}.", "{0}, at most {2}"), "uncertain": ("{} are uncertain.", "{}, from {} to {}")}


def verdict(data):
    """Sentences that name each solid, with the limit of m and its bounds."""
    made = []
    for key, (sentence, bounds) in SENTENCES.items():
        names = [f"{PLURALS[s]} ({bounds.format(*(number(m[name], 3) for name in ('mean', 'least', 'greatest')))})" for s in SOLIDS
                 if call(data, s) == key and (m := limit(data, s, "m_x"))]
        if names:
            text = sentence.format(" and ".join(filter(None, (", ".join(names[:-1]), names[-1]))))
            made.append(text[0].upper() + text[1:])
    before, bracket = " ".join(made).split("(", 1)
    return f"{before}(m = {bracket.replace(',', ' per particle,', 1)}"


def single_stress(data, solids=SOLIDS[1:]):
    """Number of packings with one state of self-stress, and of all packings."""
    found = [p["self_stress_x"] == 1 for s in solids for p in every(data, s)]
    return sum(found), len(found)


def bounds(estimate):
    return f"{number(estimate['least'], 3)} … {number(estimate['greatest'], 3)}"


def verdict_table(data):
    size = max(set.intersection(*(set(sizes(data, s)) for s in SOLIDS)))
    at_infinity = place(data) == "N → ∞"
    rows = [(f"{name}, {place(data)}", [interval(limit(data, s, column)) for s in SOLIDS]) for name, column in (("C", "C_x"), ("m", "m_x"))]
    rows += [(f"bounds of m, {place(data)}", [bounds(limit(data, s, "m_x")) for s in SOLIDS])]
    rows += [(f"bounds of m, N = {size}", [bounds(mean(data, s, size, "m_x")) for s in SOLIDS])] if at_infinity else []
    rows += [(f"m without underconstrained particles, N = {size}",
              [interval(mean(data, s, size, "m_supported")) for s in SOLIDS]),
             ("packings with S = 1", ["{} of {}".format(*single_stress(data, [s])) for s in SOLIDS]),
             ("Δφ, median", [significant(statistics.median(p["distance"] for p in every(data, s)), 2) for s in SOLIDS])]
    return table(["by exponents", *SOLIDS], [[name, *cells] for name, cells in rows])


def by_size(data):
    return table(["solid, N", "packings", "C", "m", "m without underconstrained particles", "12 − 4/N"],
                 [[f"{s} {n}", str(len(packings(data, s, n))), *(interval(mean(data, s, n, name)) for name in MEANT),
                   number(12 - 4 / n, 2)] for s in SOLIDS for n in sizes(data, s)])


if __name__ == "__main__":
    print(verdict(Data(*sys.argv[1:])))
