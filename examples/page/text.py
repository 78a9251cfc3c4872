"""Converts numbers and tables to Markdown. All functions are pure."""

import math

from estimates import single_half_width


def number(x, places):
    """A number with a minus sign instead of a hyphen. A zero has no sign."""
    text = f"{x:.{places}f}"
    return (text.lstrip("-") if float(text) == 0 else text).replace("-", "−")


def places_of(half_width):
    """Number of decimal places that shows two significant digits of `half_width`, at most five."""
    if not half_width > 0:
        return 3
    return min(5, max(0, 1 - math.floor(math.log10(half_width * 1.05))))


def signed(x, places):
    text = number(x, places)
    return text if text.startswith("−") or not float(text) else f"+{text}"


def interval(estimate):
    """mean ± half width of the 95 % confidence interval ± systematic error, if there is one.

    The value of a single replicate has no interval. Equal values have the interval ± 0."""
    if not estimate or estimate["mean"] is None:
        return "–"
    systematic = estimate.get("systematic")
    if estimate["half_width"] is None:
        return significant(estimate["mean"], 4)
    if estimate["half_width"] == 0 and not systematic:
        return f"{significant(estimate['mean'], 4)} ± 0"
    errors = [e for e in (estimate["half_width"], systematic) if e]
    places = places_of(max(errors))
    shown = [estimate["half_width"]] + ([] if systematic is None else [systematic])
    return " ± ".join(number(x, places) for x in (estimate["mean"], *shown))


def counted(estimate):
    """The text of interval(), followed by the number of replicates in parentheses."""
    return f"{interval(estimate)} ({estimate['n']})" if estimate else "–"


def spread(estimate):
    """± half the width of the 95 % prediction interval for another packing."""
    if not estimate or estimate["half_width"] is None:
        return "–"
    if estimate["half_width"] == 0:
        return "± 0"
    return f"± {number(single_half_width(estimate), places_of(single_half_width(estimate)))}"


def significant(x, digits):
    if x is None:
        return "–"
    if x == 0:
        return "0"
    places = digits - 1 - math.floor(math.log10(abs(x)))
    return number(round(x, places), max(0, places)) if -4 < places < 8 else f"{x:.{digits - 1}e}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"
