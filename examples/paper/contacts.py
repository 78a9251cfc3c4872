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
NAMES = {"l_max": "l_max of centres", "body_l_max": "l_max of vertices"}


def compared(data, figures, name, extra=None):
    rows = []
    for figure in figures:
        estimate = measured(data, figure)
        rows.append([name(figure), interval(estimate), str(estimate["n"]) if estimate else "0", spread(estimate),
                     said(figure), verdict(estimate, figure), *(extra(figure) if extra else [])])
    return rows


HEAD = ["solid, quantity", "ours", "n", "prediction interval", "paper", "the paper's value is"]


def table_2(data):
    rows = []
    for solid in SOLIDS:
        here = [f for f in data.figures if f["place"] == "Table II" and f["solid"] == solid]
        angles = data.critical.get(solid)
        if not angles:
            continue
        off = max(abs(angles[f["column"]] - f["value"]) - uncertainty(f) for f in here)
        rows.append([solid, *(f"{angles[f['column']]:.3f} ({f['value']:.1f})" for f in here),
                     "yes" if off <= 1e-9 else "**no**"])
    return table(["ours (paper's), degrees", "θ_ef, vertex-face", "θ_ef, edge-edge", "θ_ff, vertex-face",
                  "θ_ff, edge-edge", "θ_ff, edge-face", "equal to the last digit"], rows)


def table_3(data):
    first = [f for f in data.figures if f["place"] == "Table III, column 1"]
    second = [f for f in data.figures if f["place"] == "Table III, column 2"]

    def dice(figure):
        return [number(DICE[figure["column"].removesuffix("_fixed")], 1)]

    def name(figure):
        return figure["column"].removesuffix("_fixed")

    head = ["quantity", *HEAD[1:], "dice (experiment)"]
    return ("Contacts classified by fitted cut-offs:\n\n" + table(head, compared(data, first, name, dice)) +
            "\nMeans over the fixed cut-offs 5°, 15° … 55°:\n\n" + table(head, compared(data, second, name, dice)))


def column_of_solid(figure):
    where = f", Δφ = {number(figure['delta_phi'], 2)}" if "delta_phi" in figure else ""
    return f"{figure['solid']}, {NAMES.get(figure['column'], figure['column'])}{where}"


def by_rule(data):
    """Values of Table IV at the smallest Δφ that is stable according to the caption of the paper's Figure 3."""
    return [{**f, "delta_phi": STABLE_FROM[f["solid"]]} for f in data.figures if f["place"] == "Table IV"]


def table_4(data):
    figures = [f for f in data.figures if f["place"] == "Table IV"]
    return ("At the Δφ of the rule:\n\n" + table(HEAD, compared(data, by_rule(data), column_of_solid)) +
            "\nAt the smallest Δφ of our states:\n\n" + table(HEAD, compared(data, figures, column_of_solid)))


def figure_3(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            for column in ("Z", "C", "Z_ff"):
                cells = [counted(data.at(solid, particles, column, d)) for d in GRID]
                if any(cell != "–" for cell in cells):
                    rows.append([f"{solid} {particles}", column, *cells])
    return table(["solid, N", "quantity",
                  *(f"Δφ = {significant(d, 1 if d != 0.16 and d != 0.0025 else 2)}" for d in GRID)], rows)


def figures_of(data, table_of):
    """Values of Table I, III (both columns) or IV, or of IV at the Δφ of the rule."""
    if table_of == "IV-rule":
        return by_rule(data)
    places = ("Table III, column 1", "Table III, column 2") if table_of == "III" else (f"Table {table_of}",)
    return [f for f in data.figures if f["place"] in places]


def lies(data, table_of, where="packing", *columns):
    """Number of values of a table that lie in the confidence interval of our mean, in this or the prediction interval,
    or above our mean, and number of all; or number of undecided ones."""
    some = [f for f in figures_of(data, table_of) if not columns or f["column"] in columns]
    found = [(f, measured(data, f)) for f in some]
    if where == "above":
        return f"{sum(bool(e) and f['value'] > e['mean'] for f, e in found)} of {len(found)}"
    words = {"mean": (MEAN,), "packing": (MEAN, ONE), "undecided": (UNDECIDED,)}[where]
    if where == "undecided":
        return str(sum(verdict(e, f) in words for f, e in found))
    return f"{sum(verdict(e, f) in words for f, e in found)} of {len(found)}"


def ordered(data, table_of, column, whose="ours"):
    """Solids in ascending order of a column of Table IV."""
    found = [(e["mean"] if whose == "ours" else f["value"], PLURALS[f["solid"]]) for f in figures_of(data, table_of)
             if f["column"] == column and (e := measured(data, f))]
    return ", ".join(solid for _, solid in sorted(found))


def separated(data, table_of, column, first, second):
    """Tells in words whether the intervals of two solids' means, with their systematic errors, are disjoint."""
    found = {f["solid"]: measured(data, f) for f in figures_of(data, table_of) if f["column"] == column}
    wide = [e and e["half_width"] is not None and {**e, "half_width": e["half_width"] + e.get("systematic", 0.0)}
            for e in (found[first], found[second])]
    together = overlap(*wide)
    return "–" if together is None else "overlap" if together else "do not overlap"


def dice_value(data, column):
    return number(DICE[column], 1)


def hyperstatic(data):
    """Distances of GRID at which tetrahedra of some size have Z significantly above 12."""
    found = [d for d in GRID if any((e := data.at("tetrahedron", n, "Z", d)) and e["mean"] - (e["half_width"] or 0) > 12
                                    for n in SIZES)]
    return ", ".join(f"Δφ = {number(d, 2)}" for d in found) or "no Δφ"


def angles_agree(data):
    """Number of critical angles that equal the paper's to its last digit, and number of all."""
    found = [abs(data.critical[f["solid"]][f["column"]] - f["value"]) <= uncertainty(f) + 1e-9
             for f in figures_of(data, "II") if f["solid"] in data.critical]
    return f"{sum(found)} of {len(found)}"


BLOCKS = {f.__name__: f for f in (table_2, table_3, table_4, figure_3)}
VALUES = {"lies": lies, "ordered": ordered, "hyperstatic": hyperstatic, "angles": angles_agree,
          "separated": separated, "dice": dice_value}
