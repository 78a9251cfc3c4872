"""Means over replicates with intervals: pure functions. An estimate is a dict of mean, half_width (95 %, Student t;
None of one value), n and, where something was varied that replicates do not vary, systematic."""

import functools
import math
import random
import statistics


def _continued_fraction(a, b, x):
    """Of the incomplete beta function, by Lentz's method."""
    tiny = 1e-300
    c, d = 1.0, 1.0 - (a + b) * x / (a + 1)
    d = 1.0 / (d if abs(d) > tiny else tiny)
    value = d
    for m in range(1, 500):
        for term in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                     -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1.0 + term * d
            d = 1.0 / (d if abs(d) > tiny else tiny)
            c = 1.0 + term / c
            c = c if abs(c) > tiny else tiny
            value *= c * d
        if abs(c * d - 1.0) < 1e-15:
            break
    return value


def incomplete_beta(a, b, x):
    """Regularised, I_x(a, b)."""
    if x <= 0.0 or x >= 1.0:
        return 0.0 if x <= 0.0 else 1.0
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x))
    if x < (a + 1) / (a + b + 2):
        return front * _continued_fraction(a, b, x) / a
    return 1.0 - front * _continued_fraction(b, a, 1.0 - x) / b


@functools.cache
def student(freedom, probability=0.975):
    """Quantile of Student's t above the median, by bisection."""
    low, high = 0.0, 1e5
    for _ in range(200):
        t = 0.5 * (low + high)
        below = 1.0 - 0.5 * incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t))
        low, high = (t, high) if below < probability else (low, t)
    return 0.5 * (low + high)


def normal_deviate(t, freedom):
    """The normal deviate that is exceeded, either way, as often as t of Student's distribution: how far off t is,
    however few values its standard deviation is from. At most 8."""
    beyond = incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t)) if t else 1.0
    low, high = 0.0, 8.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if math.erfc(middle / math.sqrt(2)) > beyond else (low, middle)
    return math.copysign(0.5 * (low + high), t)


def added(variances):
    """(standard deviation, degrees of freedom) of a sum, from (variance, degrees of freedom; None of one that is known)
    of its parts, after Welch and Satterthwaite."""
    total = sum(variance for variance, _ in variances)
    spent = sum(variance ** 2 / freedom for variance, freedom in variances if freedom)
    return math.sqrt(total), min(1e6, total ** 2 / spent) if spent > 0 else 1e6


def difference_of(first, second):
    """Mean of `second` less that of `first`, two lists of independent values, with the 95 % interval of Welch's t."""
    parts = [(statistics.variance(values) / len(values), len(values) - 1) for values in (first, second)]
    deviation, freedom = added(parts)
    return {"mean": statistics.fmean(second) - statistics.fmean(first),
            "half_width": student(freedom) * deviation if deviation else 0.0, "n": min(len(first), len(second))}


def binomial_at_least(k, n, p):
    """Probability of k successes or more of n."""
    if k <= 0:
        return 1.0
    return incomplete_beta(k, n - k + 1, p) if k <= n else 0.0


def estimate_of(values, systematic=None):
    """Of the values that are there; None if none is."""
    values = [value for value in values if value is not None]
    if not values:
        return None
    n = len(values)
    width = student(n - 1) * statistics.stdev(values) / math.sqrt(n) if n > 1 else None
    estimate = {"mean": statistics.fmean(values), "half_width": width, "n": n}
    return estimate if systematic is None else {**estimate, "systematic": systematic}


def of_choices(central, others):
    """An estimate by one choice, with half the range of what all choices give beside it as its systematic error."""
    means = [e["mean"] for e in (central, *others) if e]
    return {**central, "systematic": 0.5 * (max(means) - min(means))} if central else None


def single_half_width(estimate):
    """Half width of the 95 % prediction interval of one more packing, t·sd·√(1 + 1/n), from that of the mean."""
    return estimate["half_width"] * math.sqrt(estimate["n"] + 1)


def correlation(x, y):
    """Pearson's r; None where one of them does not vary."""
    if len(x) < 3:
        return None
    mean_x, mean_y = statistics.fmean(x), statistics.fmean(y)
    xx, yy = sum((a - mean_x) ** 2 for a in x), sum((b - mean_y) ** 2 for b in y)
    if xx == 0 or yy == 0:
        return None
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / math.sqrt(xx * yy)


def correlation_interval(r, n):
    """95 %, by Fisher's transformation; None of fewer than four pairs."""
    if r is None or n < 4 or abs(r) >= 1:
        return None
    z, width = math.atanh(r), 1.959964 / math.sqrt(n - 3)
    return math.tanh(z - width), math.tanh(z + width)


def pooled_correlation(found):
    """(r, 95 % interval) of one correlation that several samples share, from (r, pairs) of each, by the weighted mean
    of Fisher's z; None where no sample has four pairs."""
    some = [(math.atanh(r), n - 3) for r, n in found if r is not None and n > 3 and abs(r) < 1]
    weight = sum(w for _, w in some)
    if not weight:
        return None, None
    z, width = sum(z * w for z, w in some) / weight, 1.959964 / math.sqrt(weight)
    return math.tanh(z), (math.tanh(z - width), math.tanh(z + width))


def resamples(count, draws, seed):
    """Indices of `draws` samples with replacement of `count` replicates, the same at every call."""
    stream = random.Random(seed)
    return [[stream.randrange(count) for _ in range(count)] for _ in range(draws)]
