"""Numbers and tables as the pages have them: pure functions from values to Markdown."""

import math
import re

from estimates import single_half_width


def number(x, places):
    text = f"{x:.{places}f}"
    if float(text) == 0:
        text = text.lstrip("-")
    return text.replace("0.", ".", 1).replace("-", "−") if abs(float(text)) < 1 and places > 0 else \
        text.replace("-", "−")


def places_of(half_width):
    """Decimal places that show two digits of it, at most five."""
    if not half_width > 0:
        return 3
    return min(5, max(0, 1 - math.floor(math.log10(half_width * 1.05))))


def signed(x, places):
    return ("+" if x > 0 else "") + number(x, places)


def interval(estimate):
    """mean ± half width of the 95 % interval ± systematic error, where there are such."""
    if not estimate or estimate["mean"] is None:
        return "–"
    systematic = estimate.get("systematic")
    if estimate["half_width"] is None:
        return f"{significant(estimate['mean'], 4)} (one)"
    if estimate["half_width"] == 0 and not systematic:
        return f"{significant(estimate['mean'], 4)} in all"
    errors = [e for e in (estimate["half_width"], systematic) if e]
    places = places_of(max(errors))
    shown = [estimate["half_width"]] + ([] if systematic is None else [systematic])
    return " ± ".join(number(x, places) for x in (estimate["mean"], *shown))


def bounded(estimate):
    """The interval, a last error that rounds to nothing as less than a unit of the last digit."""
    return re.sub(r"± \.(0+)$", lambda match: f"± < .{match.group(1)[:-1]}1", interval(estimate))


def counted(estimate):
    """The interval with the number of replicates."""
    return f"{interval(estimate)} ({estimate['n']})" if estimate else "–"


def spread(estimate):
    """Spread of single packings, 95 %."""
    if not estimate or estimate["half_width"] is None:
        return "–"
    if estimate["half_width"] == 0:
        return "none"
    return f"± {number(single_half_width(estimate), places_of(single_half_width(estimate)))}"


def significant(x, digits):
    if x is None:
        return "–"
    if x == 0:
        return "0"
    places = digits - 1 - math.floor(math.log10(abs(x)))
    return number(round(x, places), max(0, places)) if -4 < places < 8 else f"{x:.{digits - 1}e}"


def power(x):
    """1e-7 as 1·10⁻⁷, rounded up to one digit: of greatest values."""
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
