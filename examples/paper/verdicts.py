"""Where a figure of the paper lies among ours: pure functions of an estimate and of what the paper says."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

from estimates import single_half_width  # noqa: E402

MEAN, ONE, OUTSIDE, UNDECIDED = "in the mean's interval", "as one packing", "**outside**", "undecided"


def uncertainty(figure):
    """± of a figure of the paper: its own interval, or half a unit of the last digit it is given to."""
    if "error" in figure:
        return figure["error"]
    return 0.5 * 10.0 ** -figure["digits"] if "digits" in figure else 0.0


def verdict(estimate, figure):
    """Compares a figure, within its own uncertainty, with our results: it lies within the interval of our mean (both
    errors added), within the range of one more packing of ours, or outside of both. Undecided if packings spread by
    half of the figure or more, or if there are fewer than three."""
    if not estimate or estimate["n"] < 3 or estimate["half_width"] is None:
        return UNDECIDED
    value = figure["value"]
    systematic = estimate.get("systematic", 0.0)
    distance = max(0.0, abs(estimate["mean"] - value) - uncertainty(figure) * (1 + 1e-9))
    single = single_half_width(estimate) + systematic
    if distance > single:
        return OUTSIDE
    if value != 0 and single > 0.5 * abs(value):
        return UNDECIDED
    return MEAN if distance <= estimate["half_width"] + systematic else ONE


def overlap(ours, theirs):
    """True if two estimates' 95 % confidence intervals overlap; None if one of them has no interval."""
    if not ours or not theirs or ours["half_width"] is None or theirs["half_width"] is None:
        return None
    return abs(ours["mean"] - theirs["mean"]) <= (ours["half_width"] + theirs["half_width"]) * (1 + 1e-9)
