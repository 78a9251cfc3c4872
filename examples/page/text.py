"""Numbers and tables of the pages: pure functions from values to Markdown."""

import math
import re

from estimates import single_half_width


def number(x, places):
    """x with the given number of decimal places. A minus sign replaces the hyphen; zero has no sign."""
    text = f"{x:.{places}f}"
    return (text.lstrip("-") if float(text) == 0 else text).replace("-", "−")


def places_of(half_width):
    """Number of decimal places that shows two digits of the half width, at most five."""
    if not half_width > 0:
        return 3
    return min(5, max(0, 1 - math.floor(math.log10(half_width * 1.05))))


def signed(x, places):
    return ("+" if x > 0 else "") + number(x, places)


def interval(estimate):
    """mean ± half width of the 95 % confidence interval, and ± systematic error if there is one. If only one replicate
    has a value, there is no half width. If all replicates have the same value, the half width is 0."""
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


def bounded(estimate):
    """The same text as interval(), but if the last error rounds to zero, it is written as less than one unit of the
    last digit."""
    return re.sub(r"± 0\.(0+)$", lambda match: f"± < 0.{match.group(1)[:-1]}1", interval(estimate))


def counted(estimate):
    """The text of interval() with the number of replicates in brackets."""
    return f"{interval(estimate)} ({estimate['n']})" if estimate else "–"


def spread(estimate):
    """± half width of the 95 % prediction interval for one more packing."""
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


def power(x):
    """1e-7 as 1·10⁻⁷, rounded up to one digit because the pages use it for upper bounds."""
    if not x:
        return "0"
    exponent = math.floor(math.log10(x))
    digit = math.ceil(x / 10 ** exponent - 1e-9)
    if digit == 10:
        digit, exponent = 1, exponent + 1
    raised = str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{digit}·10{raised}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"
