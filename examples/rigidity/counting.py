"""Limits of C, of missing and of redundant constraints, and the ranges of Δφ that the page uses."""

import functools

from data import SOLIDS
from limits import extrapolated, limit_of_choices

WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))  # of Δφ, for limits
EDGES = (0.0005, 0.001, 0.002, 0.004, 0.008, 0.016, 0.032, 0.064, 0.128)  # of the ranges of local exponents
NEAR_JAMMING = 0.0015  # largest mean Δφ of states that show C at jamming
FAR = (0.008, 0.128)  # range of Δφ in which ω_l is compared with √G and √K


def drawn_size(data):
    """The larger of the paper's sizes with troughs for all solids, near jamming."""
    common = [n for n in (100, 400) if all(
        data.trough(s, n) and data.nearest_distance(s, n)["mean"] < NEAR_JAMMING for s in SOLIDS)]
    return max(common, default=100)


@functools.cache
def limit_at_jamming(data, solid, particles, column):
    """Limits of a column as Δφ → 0 by window and form, and the central one with the errors of the fit and of its form.
    The same forms and windows are used for C, m and S/N."""
    return limit_of_choices([list(zip(x, y)) for x, y in data.paths(solid, particles, column)], WINDOWS)


@functools.cache
def infinite(data, solid, column):
    """Limit as Δφ → 0 and N → ∞: intercept of the limits against 1/N, weighted by their errors."""
    points = [(1 / n, found["mean"], found["half_width"] + found["systematic"]) for n in data.sizes(solid)
              if (found := limit_at_jamming(data, solid, n, column)[1]) and found["half_width"]]
    if len(points) < 3 or any(width <= 0 for _, _, width in points):
        return None
    return extrapolated(points)
