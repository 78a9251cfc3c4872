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


def at(x, y, where):
    """y at x = where, interpolated linearly in ln x between two neighbouring states with numbers; None if there are
    none.

    x must decrease."""
    known = [(a, b) for a, b in zip(x, y) if b is not None and a > 0]
    for (x1, y1), (x2, y2) in zip(known, known[1:]):
        if x2 <= where <= x1:
            return y1 + (y2 - y1) * math.log(where / x1) / math.log(x2 / x1)
    return None
