"""Shows a study in a notebook, as HTML."""

import html
import math

from .rows import Rows

#: Quantities that are shown, if the table has them.
_QUANTITIES = ("phi_j", "Z")
_MOST_LINES = 30


def html_of(title: str, table: Rows | None = None) -> str:
    """HTML with a title, and with the first lines of a table of the program."""
    parts = [f"<p>{html.escape(title)}</p>"]
    if table is not None:
        lines = table[table["over"] == "kept"]
        head = [name for name in table.columns[:table.columns.index("over")]]
        shown = [name for name in _QUANTITIES if f"{name}_mean" in table]
        titles = [*head, *(title for name in shown for title in (f"{name} [95 % confidence interval]", f"n of {name}"))]
        parts.append("<table><thead>" + _line("th", titles) + "</thead><tbody>")
        for line in lines[:_MOST_LINES]:
            parts.append(_line("td", [*(str(line[name]) for name in head),
                                      *(cell for name in shown for cell in _cells(line, name))]))
        parts.append("</tbody></table>")
        if len(lines) > _MOST_LINES:
            parts.append(f"<p>The table has {len(lines) - _MOST_LINES} more rows.</p>")
    return "".join(parts)


def _line(tag: str, cells: list[str]) -> str:
    return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def _cells(line: dict[str, float], name: str) -> tuple[str, str]:
    """The mean with its confidence interval, and the number of values. The interval has two significant digits."""
    mean, low, high, n = (line[f"{name}_{part}"] for part in ("mean", "low", "high", "n"))
    if math.isnan(mean):
        return "", str(n)
    if not high > low:
        return f"{mean:.6g}", str(n)
    digits = max(0, 1 - math.floor(math.log10(high - low)))
    return f"{mean:.{digits}f} [{low:.{digits}f}, {high:.{digits}f}]", str(n)
