"""Blocks of the paper's Tables II to IV and Figure 3."""

from constraints import measured
from data import SIZES, SOLIDS
from densities import STABLE_FROM, said
from text import counted, interval, number, significant, spread, table
from verdicts import MEAN, ONE, UNDECIDED, overlap, uncertainty, verdict

GRID = (0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001)
# Experiment with tetrahedral dice, by tomography: the third column of the paper's Table III.
DICE = {"Z": 6.3, "Z_ff": 2.3, "Z_ef": 1.2, "Z_l": 2.8, "C": 12.1}
PLURALS = {solid: solid.replace("hedron", "hedra") for solid in SOLIDS}
NAMES = {"l_max": "l_max between centres", "body_l_max": "l_max between vertices"}


def compared(data, figures, name, extra=None):
    rows = []
    for figure in figures:
        estimate = measured(data, figure)
        rows.append([name(figure), interval(estimate), str(estimate["n"]) if estimate else "0", spread(estimate),
                     said(figure), verdict(estimate, figure), *(extra(figure) if extra else [])])
    return rows


HEAD = ["solid, column", "ours", "n", "one packing", "paper", "the paper's lies"]


def table_2(data):
    rows = []
    for solid in SOLIDS:
        here = [f for f in data.figures if f["place"] == "Table II" and f["solid"] == solid]
        angles = data.critical.get(solid)
        if not angles:
            continue
        off = max(abs(angles[f["column"]] - f["value"]) - uncertainty(f) for f in here)
        rows.append([solid, *(f"{angles[f['column']]:.3f} ({f['value']:.1f})" for f in here),
                     "to the last digit" if off <= 1e-9 else "**differs**"])
    return table(["ours (paper's), degrees", "ef vertex-face", "ef edge-edge", "ff vertex-face", "ff edge-edge",
                  "ff edge-face", "agree"], rows)


def table_3(data):
    first = [f for f in data.figures if f["place"] == "Table III, column 1"]
    second = [f for f in data.figures if f["place"] == "Table III, column 2"]

    def dice(figure):
        return [number(DICE[figure["column"].removesuffix("_fixed")], 1)]

    def name(figure):
        return figure["column"].removesuffix("_fixed")

    head = ["", *HEAD[1:], "dice (experiment)"]
    return ("Classes by fitted cut-offs:\n\n" + table(head, compared(data, first, name, dice)) +
            "\nMeans over fixed cut-offs of 5°, 15° … 55°:\n\n" + table(head, compared(data, second, name, dice)))


def column_of_solid(figure):
    where = f", Δφ = {number(figure['delta_phi'], 2)}" if "delta_phi" in figure else ""
    return f"{figure['solid']}, {NAMES.get(figure['column'], figure['column'])}{where}"


def by_rule(data):
    """Figures of Table IV at the nearest distance that the caption of the paper's Figure 3 leaves as stable."""
    return [{**f, "delta_phi": STABLE_FROM[f["solid"]]} for f in data.figures if f["place"] == "Table IV"]


def table_4(data):
    figures = [f for f in data.figures if f["place"] == "Table IV"]
    return ("At the distance that the rule gives:\n\n" + table(HEAD, compared(data, by_rule(data), column_of_solid)) +
            "\nNearest jamming of our states:\n\n" + table(HEAD, compared(data, figures, column_of_solid)))


def figure_3(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            for column in ("Z", "C", "Z_ff"):
                cells = [counted(data.at(solid, particles, column, d)) for d in GRID]
                if any(cell != "–" for cell in cells):
                    rows.append([f"{solid} {particles}", column, *cells])
    return table(["solid, N", "mean of",
                  *(f"Δφ = {significant(d, 1 if d != .16 and d != .0025 else 2)}" for d in GRID)], rows)


def figures_of(data, table_of):
    """Figures of Table I, III (its first column III-1, its second III-2), IV, and IV at the distance that the rule
    gives."""
    if table_of == "IV-rule":
        return by_rule(data)
    places = {"III": ("Table III, column 1", "Table III, column 2"), "III-1": ("Table III, column 1",),
              "III-2": ("Table III, column 2",)}.get(table_of, (f"Table {table_of}",))
    return [f for f in data.figures if f["place"] in places]


def lies(data, table_of, where="packing", *columns):
    """Number of figures of a table for which the paper's value lies in our mean's interval, is compatible with one
    packing, or lies above our mean; also the number of all, and of undecided ones."""
    some = [f for f in figures_of(data, table_of) if not columns or f["column"] in columns]
    found = [(f, measured(data, f)) for f in some]
    if where == "above":
        return f"{sum(bool(e) and f['value'] > e['mean'] for f, e in found)} of {len(found)}"
    words = {"mean": (MEAN,), "packing": (MEAN, ONE), "undecided": (UNDECIDED,)}[where]
    if where == "undecided":
        return str(sum(verdict(e, f) in words for f, e in found))
    return f"{sum(verdict(e, f) in words for f, e in found)} of {len(found)}"


def ordered(data, table_of, column, whose="ours"):
    """Solids by what a column of Table IV has of them, rising."""
    found = [(e["mean"] if whose == "ours" else f["value"], f, e) for f in figures_of(data, table_of)
             if f["column"] == column and (e := measured(data, f))]
    return ", ".join(f"{PLURALS[f['solid']]} {interval(e) if whose == 'ours' else said(f)}"
                     for _, f, e in sorted(found, key=lambda entry: entry[0]))


def told_apart(data, table_of, column, first, second):
    """True if the intervals of two solids' means, with their systematic errors, do not overlap."""
    found = {f["solid"]: measured(data, f) for f in figures_of(data, table_of) if f["column"] == column}
    wide = [e and e["half_width"] is not None and {**e, "half_width": e["half_width"] + e.get("systematic", 0.0)}
            for e in (found[first], found[second])]
    together = overlap(*wide)
    return "–" if together is None else "not told apart" if together else "told apart"


def dice_value(data, column):
    return number(DICE[column], 1)


def hyperstatic(data):
    """Where tetrahedra have Z above 12 by its interval, of the distances of GRID."""
    found = [(f"N = {n}", d, e) for d in GRID for n in SIZES
             if (e := data.at("tetrahedron", n, "Z", d)) and e["mean"] - (e["half_width"] or 0) > 12]
    return ", ".join(f"{counted(e)} at Δφ = {number(d, 2)} with {name}" for name, d, e in found) or "none"


def angles_agree(data):
    """Critical angles that are the paper's to its last digit, of all."""
    found = [abs(data.critical[f["solid"]][f["column"]] - f["value"]) <= uncertainty(f) + 1e-9
             for f in figures_of(data, "II") if f["solid"] in data.critical]
    return f"{sum(found)} of {len(found)}"


BLOCKS = {f.__name__: f for f in (table_2, table_3, table_4, figure_3)}
VALUES = {"lies": lies, "ordered": ordered, "hyperstatic": hyperstatic, "angles": angles_agree,
          "told": told_apart, "dice": dice_value}
