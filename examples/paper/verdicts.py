"""What of the paper agrees with our estimates: pure functions of an estimate and of what the paper says."""

import math
import statistics
from dataclasses import dataclass

# Student's t at .975, for 1, 2 … 15 degrees of freedom.
T_975 = (12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, 2.2010, 2.1788, 2.1604,
         2.1448, 2.1314)


def estimate_of(values):
    """Mean and half width of its 95 % interval (Student t), as isojam's tables have them, of up to sixteen values."""
    n = len(values)
    if n == 0:
        return None
    width = T_975[n - 2] * statistics.stdev(values) / math.sqrt(n) if n > 1 else None
    return {"mean": statistics.mean(values), "half_width": width, "n": n}


@dataclass
class Verdict:
    """`word` is one of "agrees", "differs" and "undecided"; `why` says by which interval, or why it is open."""

    word: str
    why: str


def uncertainty(figure):
    """± of a figure of the paper: its own interval, or half a unit of the last digit it is given to."""
    if "error" in figure:
        return figure["error"]
    return 0.5 * 10.0 ** -figure["digits"] if "digits" in figure else 0.0


def single_half_width(estimate):
    """Half width of the 95 % prediction interval of one more packing, t·sd·√(1 + 1/n), from that of the mean,
    t·sd/√n."""
    return estimate["half_width"] * math.sqrt(estimate["n"] + 1)


def verdict(estimate, figure):
    """A figure within the interval of our mean agrees, or, taken to be of one packing, within the spread of ours.

    Where that spread is half of the figure and more, such agreement says nothing. A figure with `limit` is approached
    by the mean: it agrees to that fraction or does not, if the whole interval is on one side of that.
    """
    if not estimate or estimate["n"] < 3 or estimate["half_width"] is None:
        return Verdict("undecided", "fewer than three packings")
    value = figure["value"]
    if "limit" in figure:
        off, width = abs(estimate["mean"] / value - 1), estimate["half_width"] / abs(value)
        said = f"{100 * (estimate['mean'] / value - 1):+.1f} %"
        if abs(off - figure["limit"]) < width:
            return Verdict("undecided", said)
        return Verdict("agrees" if off <= figure["limit"] else "differs", said)
    distance = max(0.0, abs(estimate["mean"] - value) - uncertainty(figure) * (1 + 1e-9))
    if distance > single_half_width(estimate):
        return Verdict("differs", "")
    if value != 0 and single_half_width(estimate) > 0.5 * abs(value):
        return Verdict("undecided", "our packings spread by half of it")
    if distance <= estimate["half_width"]:
        return Verdict("agrees", "with the mean")
    return Verdict("agrees", "with single packings, not with their mean")


def overlap(ours, theirs):
    """Whether two estimates' 95 % intervals have a point in common; None if one of them has no interval."""
    if not ours or not theirs or ours["half_width"] is None or theirs["half_width"] is None:
        return None
    return abs(ours["mean"] - theirs["mean"]) <= (ours["half_width"] + theirs["half_width"]) * (1 + 1e-9)
