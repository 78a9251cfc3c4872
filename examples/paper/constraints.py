"""Blocks about the number of constraints: what cut-offs choose, and C as Δφ → 0."""

import functools
import math

from data import SIZES, SOLIDS
from estimates import estimate_of
from limits import FORMS, limit_of_choices
from network import FACTORS
from scaling import at
from text import counted, interval, number, significant, signed, table
from verdicts import OUTSIDE, UNDECIDED

LIMIT_WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
HALF_TO_TWICE = slice(1, 4)  # of network.FACTORS
UNKNOWN = 1.0  # errors of C that say nothing about 12


@functools.cache
def cutoff_range(data, solid, particles, distance=None):
    """(C by factor, Z_ff by fits and by gaps where both are, half the range of C from half to twice the cut-offs):
    estimates at a distance from jamming, or nearest it."""
    by_factor, fitted, gaps, half = [], [], [], []
    for r, x in zip(data.counted(solid, particles), data.distances(solid, particles)):
        entries = r.get("network", {}).get("by_cutoffs")
        if not entries:
            continue

        def value(values, distances=x):
            return values[-1] if distance is None else at(distances, values, distance)

        found = [value([c[i] for c, _ in entries]) for i in range(len(FACTORS))]
        by_factor.append(found)
        both = value([gap for _, gap in entries]), value(r["states"]["Z_ff"])
        if None not in both:
            gaps.append(both[0])
            fitted.append(both[1])
        near = [c for c in found[HALF_TO_TWICE] if c is not None]
        half.append((max(near) - min(near)) / 2 if len(near) == 3 else None)
    return ([estimate_of([c[i] for c in by_factor]) for i in range(len(FACTORS))], estimate_of(fitted),
            estimate_of(gaps), estimate_of(half))


def cutoffs(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            for distance in (0.01, None):
                by_factor, fitted, gap, half = cutoff_range(data, solid, particles, distance)
                if not by_factor[2]:
                    continue
                where = "nearest" if distance is None else number(distance, 2)
                rows.append([f"{solid} {particles}", where, *(interval(c) for c in by_factor),
                             f"± {number(half['mean'], 2)}" if half else "–", counted(fitted), counted(gap)])
    if not rows:
        return "Not in these records.\n"
    return table(["", "Δφ", *(f"C, cut-offs × {significant(f, 1) if f != 10 else '10'}" for f in FACTORS),
                  "half the range, ×½ to ×2", "Z_ff by fits", "Z_ff by gaps"], rows)


@functools.cache
def limit_of(data, solid, particles):
    """C as Δφ → 0: by window and form, and with the cut-off's range nearest jamming added to what these choose."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "C")]
    every, chosen = limit_of_choices(paths, LIMIT_WINDOWS)
    half = cutoff_range(data, solid, particles)[3]
    return every, chosen, half["mean"] if half else None


def with_cutoffs(data, solid, particles, column, distance=None):
    """Z_ff or C with what the choice of cut-offs leaves as systematic error: of C half the range from half to twice the
    fitted ones, of Z_ff half of what fits and gaps differ by."""
    estimate = data.nearest(solid, particles, column) if distance is None else \
        data.at(solid, particles, column, distance)
    _, fitted, gaps, half = cutoff_range(data, solid, particles, distance)
    if not estimate or column not in ("Z_ff", "C") or not half or not gaps:
        return estimate
    return {**estimate, "systematic": half["mean"] if column == "C" else 0.5 * abs(fitted["mean"] - gaps["mean"])}


def measured(data, figure):
    """Our estimate of a figure of the paper, with the error of cut-offs where it has one."""
    if figure["column"] in ("Z_ff", "C"):
        return with_cutoffs(data, figure["solid"], figure["particles"], figure["column"], figure.get("delta_phi"))
    return data.of(figure)


def isostatic(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            every, chosen, half = limit_of(data, solid, particles)
            target = 12 - 4 / particles
            if not chosen:
                continue
            errors = (chosen["half_width"], chosen["systematic"], half or 0)
            away = chosen["mean"] - target
            forms = " / ".join(interval(every[0, form]) if every[0, form] else "–" for form in FORMS)
            lies = UNDECIDED if sum(errors) > UNKNOWN else "within" if abs(away) <= sum(errors) else OUTSIDE
            rows.append([f"{solid} {particles}", str(chosen["n"]), counted(data.nearest(solid, particles, "C")), forms,
                         number(chosen["exponent"], 2), interval(chosen), f"± {number(half, 2)}" if half else "–",
                         number(target, 2), signed(away, 2), f"± {number(sum(errors), 2)}",
                         f"± {number(math.hypot(*errors), 2)}", lies])
    return table(["", "n", "C nearest jamming", "limit by x = ½ / 1 / free, Δφ < .01", "free x", "limit ± fit ± choice",
                  "cut-offs", "target", "limit − target", "errors, summed", "in quadrature", "by the sum"], rows)


def half_value(data, solid, particles, of="C"):
    """What cut-offs leave of C nearest jamming, or of the number of constraints C·N/2."""
    found = cutoff_range(data, solid, int(particles))[3]
    if not found:
        return "–"
    return number(found["mean"], 2) if of == "C" else number(found["mean"] * int(particles) / 2, 0)


def cut_value(data, solid, particles, where, factor):
    by_factor = cutoff_range(data, solid, int(particles), None if where == "nearest" else float(where))[0]
    return counted(by_factor[FACTORS.index(float(factor))])


def beyond(data, solid, particles):
    """By how much more than its errors' sum a limit of C is off its target."""
    _, chosen, half = limit_of(data, solid, int(particles))
    if not chosen:
        return "–"
    errors = chosen["half_width"] + chosen["systematic"] + (half or 0)
    return number(abs(chosen["mean"] - 12 + 4 / int(particles)) - errors, 2)


BLOCKS = {f.__name__: f for f in (cutoffs, isostatic)}
VALUES = {"beyond": beyond, "half": half_value, "cut": cut_value,
          "limit": lambda data, solid, n: interval(limit_of(data, solid, int(n))[1])}
