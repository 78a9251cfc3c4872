"""Blocks about φ_J: Table I, offsets of the paper, finite-size effects, effect of the fit window."""

from scipy.special import chdtr

from data import SIZES, SOLIDS
from estimates import NORMAL, added, difference_of, estimate_of, normal_deviate, single_half_width, student
from scaling import jamming_density
from text import bounded, counted, number, signed, significant, spread, table
from verdicts import uncertainty, verdict

# Rounded dice in a box, the third column of the paper's Table I.
EXPERIMENT = {"tetrahedron": (0.64, 0.01), "octahedron": (0.64, 0.01), "icosahedron": (0.59, 0.01),
              "dodecahedron": (0.63, 0.01)}
# Smallest Δφ of the paper's stable states, from the caption of its Figure 3.
STABLE_FROM = {"tetrahedron": 0.04, "octahedron": 0.02, "icosahedron": 0.01, "dodecahedron": 0.01}
FITS = {"< 0.02": (0, 0.02), "< 0.04": (0, 0.04), "0.01 – 0.06": (0.01, 0.06), "0.02 – 0.06": (0.02, 0.06),
        "0.02 – 0.12": (0.02, 0.12), "0.04 – 0.16": (0.04, 0.16), "stable – 0.12": (None, 0.12),
        "stable – 0.16": (None, 0.16)}


def said(figure):
    """The paper's value as text."""
    if "digits" not in figure:
        return significant(figure["value"], 4)
    text = number(figure["value"], figure["digits"])
    return text + (f" ± {number(figure['error'], figure['digits'])}" if "error" in figure else "")


def deviation_of(estimate):
    """Standard deviation of one more packing about our mean, sd·√(1 + 1/n), from t·sd/√n."""
    return single_half_width(estimate) / student(estimate["n"] - 1)


def table_i(data):
    return [figure for figure in data.figures if figure["place"] == "Table I"]


def table_1(data):
    rows = []
    for figure in table_i(data):
        estimate = data.of(figure)
        value, error = EXPERIMENT[figure["solid"]]
        rows.append([f"{figure['solid']} {figure['particles']}", bounded(estimate) if estimate else "–",
                     str(estimate["n"]) if estimate else "0", spread(estimate), said(figure),
                     signed(figure["value"] - estimate["mean"], 4) if estimate else "–", verdict(estimate, figure),
                     f"{number(value, 2)} ± {number(error, 2)}"])
    return table(["solid, N", "ours", "n", "prediction interval", "paper", "paper − ours", "the paper's value is",
                  "dice (experiment)"], rows)


def parts_of(estimate, figure):
    """Variances of paper − ours in the form of `added`, if the paper's value is one packing like ours with an
    uncertainty of its own."""
    return [(deviation_of(estimate) ** 2, estimate["n"] - 1), ((uncertainty(figure) / NORMAL) ** 2, None)]


def deviate_of(off, parts):
    deviation, freedom = added(parts)
    return normal_deviate(off / deviation, freedom)


def offsets_of(data):
    """By solid, {size: (paper − ours, its normal deviate, its variances)}."""
    made = {}
    for figure in table_i(data):
        estimate = estimate_of([f[0] for f in data.densities(figure["solid"], figure["particles"])])
        if estimate and estimate["n"] > 2:
            off, parts = figure["value"] - estimate["mean"], parts_of(estimate, figure)
            made.setdefault(figure["solid"], {})[figure["particles"]] = off, deviate_of(off, parts), parts
    return made


def apart_of(sizes):
    """Comparison of a solid's offsets with N = 100 and 400: (difference, standard deviation, its normal deviate)."""
    apart, parts = sizes[400][0] - sizes[100][0], sizes[100][2] + sizes[400][2]
    return apart, added(parts)[0], deviate_of(apart, parts)


def offset_tests(data):
    """(χ² of differences between sizes, probability of a smaller value in %, χ² of all offsets, probability of a larger
    value in %); None if a size is missing."""
    both = [sizes for sizes in offsets_of(data).values() if len(sizes) == len(SIZES)]
    if len(both) < len(SOLIDS):
        return None
    apart = sum(apart_of(sizes)[2] ** 2 for sizes in both)
    every = sum(deviate ** 2 for sizes in both for _, deviate, _ in sizes.values())
    return (apart, 100 * chdtr(len(both), apart), every, 100 - 100 * chdtr(2 * len(both), every))


def offsets(data):
    rows = []
    for solid, sizes in offsets_of(data).items():
        cells = [f"{signed(sizes[n][0], 4)} ({signed(sizes[n][1], 1)})" if n in sizes else "–" for n in SIZES]
        if len(sizes) == len(SIZES):
            apart, deviation, deviate = apart_of(sizes)
            cells += [signed(apart, 4), f"± {number(deviation, 4)} ({signed(deviate, 1)})"]
        else:
            cells += ["–", "–"]
        rows.append([solid, *cells])
    return table(["paper − ours (normal deviate)", "N = 100", "N = 400", "difference",
                  "its standard deviation (deviate)"], rows)


def offset_value(data, *words):
    """paper − ours of one solid and size, or a count over all eight."""
    if words[0] in SOLIDS:
        figure = next(f for f in table_i(data) if (f["solid"], f["particles"]) == (words[0], int(words[1])))
        ours = data.of(figure)
        return signed(figure["value"] - ours["mean"], 4) if ours else "–"
    if words[0] in ("wider", "below", "all"):  # than the paper's own interval; than ours
        off = [(f["value"] - e["mean"], uncertainty(f)) for f in table_i(data) if (e := data.of(f))]
        return str(sum({"wider": abs(x) > own, "below": x < 0, "all": True}[words[0]] for x, own in off))
    if words[0] == "keep":
        return str(sum(s[100][0] * s[400][0] > 0 for s in offsets_of(data).values() if len(s) == len(SIZES)))
    found = offset_tests(data)
    which = ("apart", "apart_less", "every", "every_more").index(words[0])
    return (significant(found[which], 2) if which % 2 else number(found[which], 1)) if found else "–"


def size_effect(data):
    """φ_J with N = 400 less φ_J with N = 100."""
    rows = []
    for solid in SOLIDS:
        small, large = ([f[0] for f in data.densities(solid, n)] for n in SIZES)
        theirs = {f["particles"]: f["value"] for f in table_i(data) if f["solid"] == solid}
        found = difference_of(small, large) if min(len(small), len(large)) > 1 else None
        rows.append([solid, f"{signed(found['mean'], 4)} ± {number(found['half_width'], 4)}" if found else "–",
                     signed(theirs[400] - theirs[100], 4)])
    return table(["φ_J(N = 400) − φ_J(N = 100)", "ours", "paper"], rows)


def window_moves(data, solid, fit):
    """Shift of φ_J by a window over the same states, N = 100, relative to the window nearest jamming, 10⁻⁴."""
    moved = []
    for r, near in zip(data.counted(solid, 100), data.densities(solid, 100)):
        window = (STABLE_FROM[solid] if fit[0] is None else fit[0], fit[1])
        there = jamming_density(r["states"]["phi"], r["states"]["E"], r["phi_j"]["phi_j"], window)
        moved.append(None if there is None else 1e4 * (there - near[0]))
    return estimate_of(moved)


def windows(data):
    return table(["fit window", *SOLIDS], [[name, *(counted(window_moves(data, s, fit)) for s in SOLIDS)]
                                            for name, fit in FITS.items()])


BLOCKS = {f.__name__: f for f in (table_1, size_effect, offsets, windows)}
VALUES = {"offset": offset_value}
