"""The paper's values, and what we compare with them."""

import json
import math
from pathlib import Path

from data import SOLIDS
from estimates import NORMAL, added, estimate_of, larger_chi_squared, normal_deviate, single_half_width, student

VALUES = json.loads((Path(__file__).resolve().parent / "data/paper.json").read_text(encoding="utf-8"))["figures"]
# Rounded dice in a box, the third column of the paper's Table I, and tetrahedral dice, that of its Table III. The errors
# of C and Z are those of Jaoshvili et al. (2010).
DICE_DENSITY = {"tetrahedron": (0.64, 0.01), "octahedron": (0.64, 0.01), "icosahedron": (0.59, 0.01),
                "dodecahedron": (0.63, 0.01)}
# Maximally random jammed packings of hard solids, Jiao and Torquato (2011), from memory.
HARD_DENSITY = {"tetrahedron": 0.763, "octahedron": 0.697, "icosahedron": 0.707, "dodecahedron": 0.716}
DICE = {"Z": "6.3 ± 0.5", "Z_ff": "2.3", "Z_ef": "1.2", "Z_l": "2.8", "C": "12.1 ± 1.6"}
NEAR_JAMMING = 0.0015  # largest mean Δφ of states that show C at jamming
# Smallest Δφ of the paper's stable states, from the caption of its Figure 3.
STABLE_FROM = {"tetrahedron": 0.04, "octahedron": 0.02, "icosahedron": 0.01, "dodecahedron": 0.01}


def figures_of(place):
    return [figure for figure in VALUES if figure["place"] == place]


def uncertainty(figure):
    """The paper's own confidence interval, or half a unit of the last digit."""
    if "error" in figure:
        return figure["error"]
    digits = figure.get("digits", len(str(figure["value"]).partition(".")[2]))
    return 0.5 * 10 ** -digits


def drawn_size(data):
    """The larger of the paper's sizes for which C by troughs is known for all solids, near jamming."""
    return 400 if all(data.constraints(s, 400, "trough") and data.nearest_distance(s, 400)["mean"] < NEAR_JAMMING
                      for s in SOLIDS) else 100


def offset(data, figure):
    """(paper − ours, normal deviate) of a value of φ_J, if it is one packing like ours with the paper's uncertainty."""
    ours = data.phi_j(figure["solid"], figure["particles"])
    if not ours or ours["n"] < 3:
        return None
    deviation = single_half_width(ours) / student(ours["n"] - 1)
    total, freedom = added([(deviation ** 2, ours["n"] - 1), ((uncertainty(figure) / NORMAL) ** 2, None)])
    off = figure["value"] - ours["mean"]
    return off, normal_deviate(off / total, freedom)


def offset_test(data):
    """χ² of all offsets, its degrees of freedom, the probability of a larger χ², the least probability of one offset, and the
    probability that the least of as many is as small by chance."""
    squares = [one[1] ** 2 for figure in figures_of("Table I") if (one := offset(data, figure))]
    least = larger_chi_squared(max(squares), 1)
    return {"chi_squared": sum(squares), "freedom": len(squares), "p": larger_chi_squared(sum(squares), len(squares)),
            "least": least, "chance": 1 - (1 - least) ** len(squares)}


def within(data, figure, estimate):
    """The place of the paper's value: in our confidence interval, in the prediction interval, or outside."""
    if not estimate or estimate["n"] < 3 or estimate["half_width"] is None:
        return "–"
    rest = abs(figure["value"] - estimate["mean"]) - uncertainty(figure)
    if rest <= estimate["half_width"] + estimate.get("systematic", 0.0):
        return "confidence interval"
    return "prediction interval" if rest <= single_half_width(estimate) else "**outside**"


def region_two(histogram, width, critical):
    """Region 2 of c(θ_ff), from 1° to the smallest critical angle (degrees): density of its upper half divided by that of
    its lower half, and the 95 % interval of the ratio by the Poisson noise of the numbers. Bins that an edge cuts are
    divided in proportion to the angle."""
    first, counts = histogram
    middle = (1 + critical) / 2

    def inside(low, high):
        total = 0.0
        for k, count in enumerate(counts, first):
            a, b = (math.degrees(10 ** (width * (k + i))) for i in (0, 1))
            total += count * max(0.0, min(b, high) - max(a, low)) / (b - a)
        return total

    lower, upper = inside(1, middle), inside(middle, critical)
    if min(lower, upper) < 1:
        return None
    ratio = upper / lower
    return estimate_of([ratio]) | {"half_width": ratio * NORMAL * math.sqrt(1 / lower + 1 / upper)}
