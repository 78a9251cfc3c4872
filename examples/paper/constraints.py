"""Blocks about the number of constraints: effect of the cut-offs, and C as Δφ → 0."""

import functools
import math

from data import SIZES, SOLIDS
from estimates import estimate_of
from limits import FORMS, limit_of_choices
from network import FACTORS
from scaling import at
from text import counted, interval, number, significant, signed, table
from verdicts import UNDECIDED

LIMIT_WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
HALF_TO_TWICE = slice(1, 4)  # of network.FACTORS
UNKNOWN = 1.0  # with a larger error of C the comparison with 12 is undecided


def around(distances, values, distance):
    """The two states that have values and that scaling.at takes for a distance from jamming; None outside of them."""
    known = [i for i, (x, v) in enumerate(zip(distances, values)) if v is not None and x > 0]
    return next(((i, j) for i, j in zip(known, known[1:]) if distances[j] <= distance <= distances[i]), None)


def same_states(distances, values, others, distance):
    """True if both values come from the same two states around a distance from jamming, or if that is None."""
    return distance is None or around(distances, values, distance) == around(distances, others, distance)


@functools.cache
def cutoff_range(data, solid, particles, distance=None):
    """(C by factor, Z_ff by fits and by gaps where both exist, half the range of C from half to twice the cut-offs):
    estimates at a distance from jamming, or at the smallest. C by factors is known for fewer states than C. A replicate
    counts only if it is interpolated between the same states as C; the same holds for gaps and Z_ff."""
    by_factor, fitted, gaps, half = [], [], [], []
    for r, x in zip(data.counted(solid, particles), data.distances(solid, particles)):
        entries = r.get("network", {}).get("by_cutoffs")
        if not entries:
            continue

        def value(values, distances=x):
            return values[-1] if distance is None else at(distances, values, distance)

        fits = [c[FACTORS.index(1)] for c, _ in entries]
        found = [value([c[i] for c, _ in entries]) if same_states(x, fits, r["states"]["C"], distance) else None
                 for i in range(len(FACTORS))]
        by_factor.append(found)
        all_gaps = [gap for _, gap in entries]
        both = value(all_gaps), value(r["states"]["Z_ff"])
        if None not in both and same_states(x, all_gaps, r["states"]["Z_ff"], distance):
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
                if not by_factor[FACTORS.index(1)] and not fitted:
                    continue
                where = "smallest" if distance is None else number(distance, 2)
                n = by_factor[FACTORS.index(1)]["n"] if by_factor[FACTORS.index(1)] else 0
                rows.append([f"{solid} {particles}", where, str(n), *(interval(c) for c in by_factor),
                             f"± {number(half['mean'], 2)}" if half else "–", counted(fitted), counted(gap)])
    if not rows:
        return "These records lack the study.\n"
    return table(["solid, N", "Δφ", "n",
                  *(f"C, cut-offs × {significant(f, 1) if f != 10 else '10'}" for f in FACTORS),
                  "half the range from × 0.5 to × 2", "Z_ff by fits", "Z_ff by gaps"], rows)


@functools.cache
def limit_of(data, solid, particles):
    """C as Δφ → 0: limits by window and form, the central one, and its error from cut-offs at the smallest Δφ."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "C")]
    every, chosen = limit_of_choices(paths, LIMIT_WINDOWS)
    half = cutoff_range(data, solid, particles)[3]
    return every, chosen, half["mean"] if half else None


def with_cutoffs(data, solid, particles, column, distance=None):
    """Z_ff or C with the systematic error from the cut-offs. For C it is half the range from half to twice the fitted
    cut-offs, for Z_ff half the difference between fits and gaps."""
    estimate = data.nearest(solid, particles, column) if distance is None else \
        data.at(solid, particles, column, distance)
    _, fitted, gaps, half = cutoff_range(data, solid, particles, distance)
    if estimate and column == "C" and half:
        return {**estimate, "systematic": half["mean"]}
    if estimate and column == "Z_ff" and gaps:
        return {**estimate, "systematic": 0.5 * abs(fitted["mean"] - gaps["mean"])}
    return estimate


def measured(data, figure):
    """Our estimate of a value of the paper, with its error from cut-offs if it has one."""
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
            lies = UNDECIDED if sum(errors) > UNKNOWN else "yes" if abs(away) <= sum(errors) else "**no**"
            rows.append([f"{solid} {particles}", str(chosen["n"]), counted(data.nearest(solid, particles, "C")), forms,
                         number(chosen["exponent"], 2), interval(chosen), f"± {number(half, 2)}" if half else "–",
                         number(target, 2), signed(away, 2), f"± {number(sum(errors), 2)}",
                         f"± {number(math.hypot(*errors), 2)}", lies])
    return table(["solid, N", "n", "C at the smallest Δφ", "limit for x = ½ / 1 / free, Δφ < 0.01", "free x",
                  "limit ± fit ± form", "error from cut-offs", "target", "limit − target", "sum of errors",
                  "errors in quadrature", "target within the sum"], rows)


def error_of_rows(data, solid, particles):
    """Error from cut-offs of the number of constraints C·N/2 at the smallest Δφ."""
    found = cutoff_range(data, solid, particles)[3]
    return f"± {number(found['mean'] * particles / 2, 0)}" if found else "–"


def cut_missing(data, solid, particles, where):
    """Number of replicates with C, and how many of them lack C by other cut-offs in the states that C is taken from."""
    known = cutoff_range(data, solid, int(particles), float(where))[0][FACTORS.index(1)]
    every = data.at(solid, int(particles), "C", float(where))
    return f"{every['n'] - (known['n'] if known else 0)} of {every['n']}" if every else "–"


def limit_range(data, *solids):
    """Smallest and largest limit of C of some solids, over both sizes."""
    found = [chosen["mean"] for solid in solids for n in SIZES
             if data.counted(solid, n) and (chosen := limit_of(data, solid, n)[1])]
    return f"{number(min(found), 2)} … {number(max(found), 2)}" if found else "–"


def beyond(data, solid, particles):
    """Difference of a limit of C from its target, less the sum of its errors."""
    _, chosen, half = limit_of(data, solid, int(particles))
    if not chosen:
        return "–"
    errors = chosen["half_width"] + chosen["systematic"] + (half or 0)
    return number(abs(chosen["mean"] - 12 + 4 / int(particles)) - errors, 2)


BLOCKS = {f.__name__: f for f in (cutoffs, isostatic)}
VALUES = {"beyond": beyond, "cut_missing": cut_missing, "limits": limit_range}
