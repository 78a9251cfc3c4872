"""Power laws in Δφ = φ − φ_J, and φ_J itself, from the states of decompressions: pure functions.

A path is a list of states in order of decreasing φ; each value of a state is a number or None."""

import math

from estimates import estimate_of

LEAST_STATES = 2


def line(x, y):
    """Intercept, slope and sum of squared residuals of a least-squares line."""
    n = len(x)
    mean_x, mean_y = sum(x) / n, sum(y) / n
    xx = sum((a - mean_x) ** 2 for a in x)
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / xx
    intercept = mean_y - slope * mean_x
    return intercept, slope, sum((b - intercept - slope * a) ** 2 for a, b in zip(x, y))


def jamming_density(phi, energy, start, window, exponent=6):
    """φ_J: the density at which the line fitted to (E/N)^(1/exponent) reaches zero. It is fitted to the states with
    lower ≤ φ − φ_J < upper. Because these states depend on φ_J, the fit is repeated, beginning with
    φ_J = `start`, until they no longer change. If they repeat in a cycle, returns the mean φ_J of the cycle. Returns
    None if fewer than LEAST_STATES states are in the window."""
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
    """(φ_J, x) of the least-squares fit of ln E for E ∝ (φ − φ_J)^x, with φ_J and x free, over the states with
    φ − `start` in the window. Returns None if there are fewer than four such states."""
    chosen = [i for i, x in enumerate(phi) if window[0] <= x - start < window[1] and energy[i] > 0]
    if len(chosen) < 4:
        return None
    x, y = [phi[i] for i in chosen], [math.log(energy[i]) for i in chosen]
    least, reach = min(x), max(x) - min(x)

    def off(gap):
        return line([math.log(a - least + gap) for a in x], y)[2]

    # Golden section search over ln(gap), where gap is the distance from φ_J to the last state. There is one minimum.
    low, high, ratio = math.log(reach * 1e-4), math.log(reach * 10), (math.sqrt(5) - 1) / 2
    for _ in range(120):
        first, second = high - ratio * (high - low), low + ratio * (high - low)
        low, high = (low, second) if off(math.exp(first)) < off(math.exp(second)) else (first, high)
    gap = math.exp(0.5 * (low + high))
    return least - gap, line([math.log(a - least + gap) for a in x], y)[1]


def slopes(x, y):
    """(geometric mean of x, d ln y/d ln x) for each pair of neighbouring states whose x and y are positive."""
    found = []
    for (x1, y1), (x2, y2) in zip(zip(x, y), zip(x[1:], y[1:])):
        if None in (x1, x2, y1, y2) or min(x1, x2, y1, y2) <= 0 or x1 == x2:
            continue
        found.append((math.sqrt(x1 * x2), math.log(y2 / y1) / math.log(x2 / x1)))
    return found


def binned(paths, edges):
    """An estimate for each bin between ascending edges, from one list of (x, value) per replicate. Each replicate
    contributes one value to a bin: its mean in this bin."""
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
    """An estimate of the local exponent in each bin, from one (x values, y values) per replicate."""
    return binned([slopes(x, y) for x, y in paths], edges)


def at(x, y, where):
    """y at x = `where`, interpolated linearly in ln x between the neighbouring known values. x must decrease. Returns
    None if `where` is outside of the known values."""
    known = [(a, b) for a, b in zip(x, y) if b is not None and a > 0]
    for (x1, y1), (x2, y2) in zip(known, known[1:]):
        if x2 <= where <= x1:
            return y1 + (y2 - y1) * math.log(where / x1) / math.log(x2 / x1)
    return None
