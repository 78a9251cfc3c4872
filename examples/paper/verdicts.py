"""Comparison of a value of the paper with our results: pure functions of an estimate and the paper's value."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

from estimates import single_half_width  # noqa: E402

MEAN, ONE, OUTSIDE, UNDECIDED = "in the confidence interval", "in the prediction interval", "**outside**", "undecided"


def uncertainty(figure):
    """Uncertainty of a value of the paper: its own interval, or half a unit of its last digit."""
    if "error" in figure:
        return figure["error"]
    return 0.5 * 10.0 ** -figure["digits"] if "digits" in figure else 0.0


def verdict(estimate, figure):
    """Compares a value, within its own uncertainty, with our results. It lies in the confidence interval of our mean
    (both errors added), in the prediction interval of one more packing of ours, or outside of both. It is undecided
    with fewer than three packings, or if the prediction interval is wider than ± half of the value."""
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
