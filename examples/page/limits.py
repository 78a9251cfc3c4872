"""Limits of quantities for Δφ → 0 or N → ∞, with their uncertainty. All functions are pure."""

import math
import statistics

from estimates import resamples, student
from scaling import line

GRID = tuple(round(0.2 + 0.05 * i, 2) for i in range(37))  # 0.2 … 2


def fitted(points, exponent):
    """Fit of y = a + b Δφ^x: (a, b, x, squared residual). If the exponent is None, x is the best one in GRID."""
    if exponent is None:
        return min((fitted(points, x) for x in GRID), key=lambda fit: fit[3])
    intercept, slope, off = line([x ** exponent for x, _ in points], [y for _, y in points])
    return intercept, slope, exponent, off


def sums(points, exponent):
    """Sums over the points of one replicate for a least-squares fit, with x = Δφ^exponent: n, Σx, Σy, Σx², Σxy, Σy²."""
    x, y = [a ** exponent for a, _ in points], [b for _, b in points]
    return (len(x), sum(x), sum(y), sum(a * a for a in x), sum(a * b for a, b in zip(x, y)), sum(b * b for b in y))


def from_sums(parts):
    """Intercept and squared residual of the fit to all replicates, from the sums() of each."""
    n, x, y, xx, xy, yy = (sum(column) for column in zip(*parts))
    spread = xx - x * x / n
    slope = (xy - x * y / n) / spread if spread > 0 else 0.0
    return (y - slope * x) / n, yy - y * y / n - slope * (xy - x * y / n)


def limit(paths, window, exponent, draws=100, seed=1):
    """Limit a, and exponent x, of a + b Δφ^x, fitted to the points of all replicates with window[0] ≤ Δφ < window[1].

    The 95 % intervals come from bootstrap samples of the replicates, with Student's t instead of the normal quantile.
    The result is None for fewer than three replicates, or fewer than four different values of Δφ. It is also None if
    the exponent is free and the data do not determine it: all values are equal, or it is at an end of GRID."""
    inside = [[(x, y) for x, y in path if window[0] <= x < window[1] and y is not None] for path in paths]
    inside = [path for path in inside if path]
    if len(inside) < 3 or len({x for path in inside for x, _ in path}) < 4:
        return None
    if exponent is None and len({y for path in inside for _, y in path}) == 1:
        return None
    a, _, x, _ = fitted([point for path in inside for point in path], exponent)
    if exponent is None and x in (GRID[0], GRID[-1]):
        return None
    # Values relative to the limit, so that sums of squares do not cancel.
    tried = GRID if exponent is None else (exponent,)
    parts = {e: [sums([(d, y - a) for d, y in path], e) for path in inside] for e in tried}
    found = []
    for chosen in resamples(len(inside), draws, seed):
        fits = [(*from_sums([parts[e][i] for i in chosen]), e) for e in tried]
        intercept, _, e = min(fits, key=lambda fit: fit[1])
        found.append((a + intercept, e))
    t = student(len(inside) - 1)
    return {"mean": a, "half_width": t * statistics.stdev(fit[0] for fit in found), "n": len(inside), "exponent": x,
            "exponent_half_width": t * statistics.stdev(fit[1] for fit in found)}


def extrapolated(points):
    """Intercept and slope of a line through points (x, y, half width of y), weighted by their half widths."""
    weights = [width ** -2 for _, _, width in points]
    total = sum(weights)
    mean_x = sum(w * x for w, (x, _, _) in zip(weights, points)) / total
    mean_y = sum(w * y for w, (_, y, _) in zip(weights, points)) / total
    xx = sum(w * (x - mean_x) ** 2 for w, (x, _, _) in zip(weights, points))
    slope = sum(w * (x - mean_x) * (y - mean_y) for w, (x, y, _) in zip(weights, points)) / xx
    return {"mean": mean_y - slope * mean_x, "half_width": math.sqrt(1 / total + mean_x ** 2 / xx), "n": len(points),
            "slope": {"mean": slope, "half_width": math.sqrt(1 / xx), "n": len(points)}}
