"""Means over replicates with confidence intervals. All functions are pure.

An estimate is a dict with these keys:
- `mean`
- `half_width`: half the width of the 95 % confidence interval (Student's t); None for a single value
- `n`: the number of values
- `systematic`: the systematic error, if a choice in the analysis was varied"""

import math
import random
import statistics

from scipy.special import chdtr, ndtri, stdtr, stdtrit

NORMAL = float(ndtri(0.975))  # half width of a 95 % confidence interval in standard deviations


def student(freedom, probability=0.975):
    """Quantile of Student's t distribution for this number of degrees of freedom."""
    return float(stdtrit(freedom, probability))


def normal_deviate(t, freedom):
    """Converts a value t of Student's distribution to the normal deviate with the same two-sided probability. At most
    8."""
    return math.copysign(min(-float(ndtri(stdtr(freedom, -abs(t)))), 8.0), t)


def larger_chi_squared(chi_squared, freedom):
    """Probability of a larger χ²."""
    return 1 - float(chdtr(freedom, chi_squared))


def added(variances):
    """Standard deviation of a sum, and its degrees of freedom by Welch and Satterthwaite.

    `variances` has a pair (variance, degrees of freedom) for each part of the sum. The degrees of freedom are None if
    the variance is known exactly."""
    total = sum(variance for variance, _ in variances)
    spent = sum(variance ** 2 / freedom for variance, freedom in variances if freedom)
    return math.sqrt(total), min(1e6, total ** 2 / spent) if spent > 0 else 1e6


def difference_of(first, second):
    """Mean of `second` minus mean of `first`, two lists of independent values, with the 95 % interval by Welch's t."""
    parts = [(statistics.variance(values) / len(values), len(values) - 1) for values in (first, second)]
    deviation, freedom = added(parts)
    return {"mean": statistics.fmean(second) - statistics.fmean(first),
            "half_width": student(freedom) * deviation if deviation else 0.0, "n": min(len(first), len(second))}


def estimate_of(values, systematic=None):
    """Estimate from the values that are not None; None if there are no such values."""
    values = [value for value in values if value is not None]
    if not values:
        return None
    n = len(values)
    width = student(n - 1) * statistics.stdev(values) / math.sqrt(n) if n > 1 else None
    estimate = {"mean": statistics.fmean(values), "half_width": width, "n": n}
    return estimate if systematic is None else {**estimate, "systematic": systematic}


def of_choices(central, others):
    """The central estimate with a systematic error: half the range of the means of all choices, including the central
    one."""
    means = [e["mean"] for e in (central, *others) if e]
    return {**central, "systematic": 0.5 * (max(means) - min(means))} if central else None


def single_half_width(estimate):
    """Half the width of the 95 % prediction interval for one more packing: t·sd·√(1 + 1/n). It follows from
    `half_width`."""
    return estimate["half_width"] * math.sqrt(estimate["n"] + 1)


def resamples(count, draws, seed):
    """Lists of `count` random indices below `count`, one list for each of `draws` bootstrap samples.

    Calls with the same arguments give the same lists."""
    stream = random.Random(seed)
    return [[stream.randrange(count) for _ in range(count)] for _ in range(draws)]
