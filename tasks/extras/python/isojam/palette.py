"""Colours and markers of solids, the same as in the report. Most are those of Okabe and Ito, which can be distinguished
with any colour vision."""

import json
import pathlib
from collections.abc import Iterable
from typing import Any

# If the module was not built, importing `facts` explains this.
from . import facts as _facts  # noqa: F401

_PALETTE: dict[str, Any] = json.loads(pathlib.Path(__file__).absolute().with_name("palette.json").read_text())

#: Colours by name, as "#rrggbb".
colours: dict[str, str] = _PALETTE["colours"]
#: Colours for curves or clusters, in the order in which to use them.
series: tuple[str, ...] = tuple(colours[name] for name in _PALETTE["series"])


def styles(solids: Iterable[str]) -> dict[str, dict[str, str]]:
    """Colour and marker of each solid, as keyword arguments of matplotlib's plot().

    Each of the five Platonic solids has its own style, which is always the same. Other solids and mixtures get the
    styles that are left, in the order of `solids`."""
    names = list(dict.fromkeys(solids))
    others = [name for name in names if name not in _PALETTE["solids"]]
    free = _PALETTE["others"]
    chosen = {name: _PALETTE["solids"].get(name) or free[others.index(name) % len(free)] for name in names}
    return {name: {"color": colours[style["colour"]], "marker": style["marker"]} for name, style in chosen.items()}
