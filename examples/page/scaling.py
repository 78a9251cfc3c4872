"""φ_J and power laws of Δφ = φ − φ_J, from the states of decompressions. All functions are pure.

The states of a replicate are in the order of decreasing φ. A value of a state is a number or None."""

import math

from estimates import estimate_of

LEAST_STATES = 2


def line(x, y):
    """Least-squares line through points: intercept, slope and squared residual."""
    n = len(x)
    mean_x, mean_y = sum(x) / n, sum(y) / n
    xx = sum((a - mean_x) ** 2 for a in x)
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / xx
    intercept = mean_y - slope * mean_x
    return intercept, slope, sum((b - intercept - slope * a) ** 2 for a, b in zip(x, y))


def jamming_density(phi, energy, start, window, exponent=6):
    """φ_J by a linear fit: the density where (E/N)^(1/exponent) vanishes.

    The fit uses the states with lower ≤ φ − φ_J < upper, where `window` is (lower, upper). These states depend on φ_J,
    so the fit is repeated, first with φ_J = `start`, until the states no longer change. If they repeat in a cycle, the
    result is the mean over the cycle. The result is None if too few states are in the window, or if (E/N)^(1/exponent)
    does not increase with φ."""
    lower, upper = window
    found, seen, history = start, [], []
    while True:
        chosen = [i for i, x in enumerate(phi) if lower <= x - found < upper and energy[i] > 0]
        if chosen in seen:
            cycle = history[seen.index(chosen):]
            return sum(cycle) / len(cycle)
        if len(chosen) < LEAST_STATES:
            return None
        intercept, slope, _ = line([phi[i] for i in chosen], [energy[i] ** (1 / exponent) for i in chosen])
        if slope <= 0:
            return None
        found = -intercept / slope
        seen.append(chosen)
        history.append(found)


def free_exponent(phi, energy, start, window):
    """Fit of E ∝ (φ − φ_J)^x by least squares of ln E: (φ_J, x).

    The fit uses the states whose distance from `start` is in the window. The result is None for fewer than four
    states."""
    chosen = [i for i, x in enumerate(phi) if window[0] <= x - start < window[1] and energy[i] > 0]
    if len(chosen) < 4:
        return None
    x, y = [phi[i] for i in chosen], [math.log(energy[i]) for i in chosen]
    least, reach = min(x), max(x) - min(x)

    def off(gap):
        return line([math.log(a - least + gap) for a in x], y)[2]

    # Golden section: as a function of the logarithm of the gap between φ_J and the last state there is one minimum.
    low, high, ratio = math.log(reach * 1e-4), math.log(reach * 10), (math.sqrt(5) - 1) / 2
    for _ in range(120):
        first, second = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, second) if off(math.exp(first)) < off(math.exp(second)) else (first, high)
    gap = math.exp(0.5 * (low + high))
    return least - gap, line([math.log(a - least + gap) for a in x], y)[1]


def slopes(x, y):
    """Pairs (geometric mean of x, d ln y/d ln x) for neighbouring states with positive numbers."""
    found = []
    for (x1, y1), (x2, y2) in zip(zip(x, y), zip(x[1:], y[1:])):
        if None in (x1, x2, y1, y2) or min(x1, x2, y1, y2) <= 0 or x1 == x2:
            continue
        found.append((math.sqrt(x1 * x2), math.log(y2 / y1) / math.log(x2 / x1)))
    return found


def binned(paths, edges):
    """One estimate for each bin between two consecutive edges, which ascend.

    `paths` has one list of pairs (x, value) per replicate. A replicate counts once in a bin, with the mean of its
    values."""
    bins = []
    for lower, upper in zip(edges, edges[1:]):
        means = []
        for path in paths:
            here = [value for x, value in path if lower <= x < upper and value is not None]
            if here:
                means.append(sum(here) / len(here))
        bins.append(estimate_of(means))
    return bins


def local_slopes(paths, edges):
    """Local exponents, one estimate for each bin. `paths` has a pair (values of x, values of y) for each replicate."""
    return binned([slopes(x, y) for x, y in paths], edges)


def at(x, y, where):
    """y at x = where, interpolated linearly in ln x between two neighbouring states with numbers; None if there are
    none.

    x must decrease."""
    known = [(a, b) for a, b in zip(x, y) if b is not None and a > 0]
    for (x1, y1), (x2, y2) in zip(known, known[1:]):
        if x2 <= where <= x1:
            return y1 + (y2 - y1) * math.log(where / x1) / math.log(x2 / x1)
    return None
