"""Limits of quantities for Δφ → 0, with their uncertainties: pure functions."""

import statistics

from estimates import resamples, student
from scaling import line

FORMS = (0.5, 1.0, None)  # exponents of Δφ; None: the exponent of GRID that fits best
GRID = tuple(round(0.2 + 0.05 * i, 2) for i in range(37))  # 0.2 … 2


def fitted(points, exponent):
    """(a, b, x, sum of squared residuals) of the fit y = a + b Δφ^x. x is `exponent`, or the best value of GRID if
    `exponent` is None."""
    if exponent is None:
        return min((fitted(points, x) for x in GRID), key=lambda fit: fit[3])
    intercept, slope, off = line([x ** exponent for x, _ in points], [y for _, y in points])
    return intercept, slope, exponent, off


def sums(points, exponent):
    """Sums over one replicate for a least-squares line: n, Σx, Σy, Σx², Σxy, Σy² with x = Δφ^exponent."""
    x, y = [a ** exponent for a, _ in points], [b for _, b in points]
    return (len(x), sum(x), sum(y), sum(a * a for a in x), sum(a * b for a, b in zip(x, y)), sum(b * b for b in y))


def from_sums(parts):
    """Intercept and sum of squared residuals of the line through the points of all `parts`, which come from sums()."""
    n, x, y, xx, xy, yy = (sum(column) for column in zip(*parts))
    spread = xx - x * x / n
    slope = (xy - x * y / n) / spread if spread > 0 else 0.0
    return (y - slope * x) / n, yy - y * y / n - slope * (xy - x * y / n)


def limit(paths, window, exponent, draws=100, seed=1):
    """Limit a and exponent x of the fit a + b Δφ^x to all replicates together, for window[0] ≤ Δφ < window[1]. The 95 %
    confidence intervals come from bootstrap samples of the replicates, with Student's t instead of the normal quantile.
    Returns None if there are fewer than three replicates or fewer than four different Δφ."""
    inside = [[(x, y) for x, y in path if window[0] <= x < window[1] and y is not None] for path in paths]
    inside = [path for path in inside if path]
    if len(inside) < 3 or len({x for path in inside for x, _ in path}) < 4:
        return None
    a, _, x, _ = fitted([point for path in inside for point in path], exponent)
    # The sums use values relative to the limit, to avoid cancellation in the sums of squares.
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


def limit_of_choices(paths, windows, central=(0, None), possible=None):
    """(all limits, the central limit). All limits are {(number of the window, form): estimate}. The systematic error
    of the central limit is half the range over all of them. If `possible` is given, the range is only over the central
    limit and the limits for which possible(estimate) is true."""
    every = {(i, form): limit(paths, window, form) for i, window in enumerate(windows) for form in FORMS}
    found = [estimate for estimate in every.values() if estimate]
    chosen = every[central]
    if not chosen:
        return every, None
    means = [estimate["mean"] for estimate in found if estimate is chosen or not possible or possible(estimate)]
    return every, {**chosen, "systematic": 0.5 * (max(means) - min(means))}
