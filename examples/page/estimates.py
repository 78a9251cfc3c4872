"""Means over replicates with confidence intervals: pure functions. An estimate is a dict of mean, half_width and n. The
half width is that of the 95 % confidence interval (Student t), or None for a single value. If several choices of the
analysis were compared, the dict also has `systematic`, the systematic error."""

import math
import random
import statistics

from scipy.special import bdtrc, ndtri, stdtr, stdtrit

NORMAL = float(ndtri(0.975))  # half width of a 95 % confidence interval in standard deviations


def student(freedom, probability=0.975):
    """Quantile of Student's t."""
    return float(stdtrit(freedom, probability))


def normal_deviate(t, freedom):
    """Normal deviate with the same two-sided probability as t has in Student's distribution; limited to ±8."""
    return math.copysign(min(-float(ndtri(stdtr(freedom, -abs(t)))), 8.0), t)


def added(variances):
    """(standard deviation, degrees of freedom) of a sum by Welch and Satterthwaite, from (variance, degrees of freedom)
    of each part. The degrees of freedom of an exactly known variance are None."""
    total = sum(variance for variance, _ in variances)
    spent = sum(variance ** 2 / freedom for variance, freedom in variances if freedom)
    return math.sqrt(total), min(1e6, total ** 2 / spent) if spent > 0 else 1e6


def difference_of(first, second):
    """Mean of `second` minus mean of `first`, two lists of independent values, with the 95 % confidence interval of
    Welch's t test."""
    parts = [(statistics.variance(values) / len(values), len(values) - 1) for values in (first, second)]
    deviation, freedom = added(parts)
    return {"mean": statistics.fmean(second) - statistics.fmean(first),
            "half_width": student(freedom) * deviation if deviation else 0.0, "n": min(len(first), len(second))}


def binomial_at_least(k, n, p):
    """Probability of at least k successes in n trials."""
    return float(bdtrc(k - 1, n, p))


def estimate_of(values, systematic=None):
    """Estimate from the values that are not None. Returns None if all are None."""
    values = [value for value in values if value is not None]
    if not values:
        return None
    n = len(values)
    width = student(n - 1) * statistics.stdev(values) / math.sqrt(n) if n > 1 else None
    estimate = {"mean": statistics.fmean(values), "half_width": width, "n": n}
    return estimate if systematic is None else {**estimate, "systematic": systematic}


def of_choices(central, others):
    """The central estimate. Its systematic error is half the range of the means of all choices."""
    means = [e["mean"] for e in (central, *others) if e]
    return {**central, "systematic": 0.5 * (max(means) - min(means))} if central else None


def single_half_width(estimate):
    """Half width of the 95 % prediction interval for one more packing, t·sd·√(1 + 1/n)."""
    return estimate["half_width"] * math.sqrt(estimate["n"] + 1)


def pooled_correlation(found):
    """Common correlation r of several samples, from (r, number of pairs) of each, by the weighted mean of Fisher's z.
    Returns (r, its 95 % confidence interval), or (None, None) if every sample has fewer than four pairs."""
    some = [(math.atanh(r), n - 3) for r, n in found if r is not None and n > 3 and abs(r) < 1]
    weight = sum(w for _, w in some)
    if not weight:
        return None, None
    z, width = sum(z * w for z, w in some) / weight, NORMAL / math.sqrt(weight)
    return math.tanh(z), (math.tanh(z - width), math.tanh(z + width))


def resamples(count, draws, seed):
    """Bootstrap samples: `draws` lists of `count` random indices of replicates. The same seed gives the same lists."""
    stream = random.Random(seed)
    return [[stream.randrange(count) for _ in range(count)] for _ in range(draws)]
