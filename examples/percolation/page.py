"""Updates README.md, or makes it and tables.md in OUT: python3 page.py [--data FILE...] [-o OUT] [--check]"""

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

import pages  # noqa: E402
import values  # noqa: E402
from analysis import (  # noqa: E402, F401
    AT, SOLIDS, Data, all_of_size, branching_near, chi_squared, collapse, constraints, difference_at,
    last, loops_near, mean, threshold_of, values_at)
from estimates import difference_of, estimate_of  # noqa: E402
from tables import TABLES, change_table, main_table, sizes_table  # noqa: E402, F401
from text import interval, number, significant  # noqa: E402

TITLE = "Cohesion and the percolation of face-face contacts"
FILES = (HERE / "data/records.json",)
ENTRIES = """An entry a ± b (n) is the mean a over n packings and half the width b of its 95 % confidence interval
(Student t). A dash means that the value is unknown."""
BLOCKS = {"main": main_table, "sizes": sizes_table, "memory": change_table}


def kept(data, column, solid, w, particles="100"):
    """Mean of a column at zero pressure."""
    return number(mean(data.kept(solid, int(particles), float(w)), column)["mean"], 2)


def without(data, column, solid, text=lambda found: number(found["mean"], 2)):
    """Mean of a column without cohesion, N = 100, at Δφ = AT."""
    return text(estimate_of(values_at(data.untreated(solid, 100), column, AT)))


def of_solids(data, of_random=False):
    """Thresholds of the solids that have one, N = 100."""
    return [found for solid in SOLIDS if (found := threshold_of(all_of_size(data, 100, (solid,)), "fit", of_random))]


def solid_threshold(data, which):
    """Least or greatest threshold of random bonds in one solid, their difference, or the largest error of a threshold
    of face-face contacts in one solid."""
    means = [one["mean"] for one in of_solids(data, True)]
    errors = [max(one["high"] - one["mean"], one["mean"] - one["low"]) for one in of_solids(data)]
    return number({"least": min(means), "greatest": max(means), "contrast": max(means) - min(means),
                   "error": max(errors)}[which], 2)


def threshold_error(data, particles):
    """The threshold ± half the width of its interval."""
    found = threshold_of(all_of_size(data, int(particles)))
    return interval({**found, "half_width": 0.5 * (found["high"] - found["low"])})


def memory(data, solid, particles, w="all"):
    """Difference of Z_ff from packings without cohesion, at Δφ = AT."""
    return interval(difference_at(data, solid, int(particles), None if w == "all" else float(w), AT))


def undetected(data):
    """Largest half width of the changes of Z_ff of all solids but tetrahedra."""
    found = [difference_at(data, solid, n, None, AT) for solid in SOLIDS[1:] for n in (100, 200)]
    return number(max(e["half_width"] for e in found), 2)


def forgotten(data, particles):
    """Probability of a larger χ² of the differences of all solids but tetrahedra, which are independent."""
    differences = [difference_at(data, solid, int(particles), None, AT) for solid in SOLIDS[1:]]
    return significant(chi_squared(differences)[2], 1)


def misfit(data, which, *below):
    """Factor by which S of a group (`between`) or of one state (`within`) deviates from the common curve, one standard
    deviation; or χ² of the groups, its degrees of freedom, or the probability of a larger one; below a Z_ff."""
    found = collapse(data, 100, *map(float, below))
    if which == "p":
        return significant(found["chi_squared"][2], 1)
    if which in ("chi_squared", "freedom"):
        return number(found["chi_squared"][("chi_squared", "freedom").index(which)], 0)
    return number(math.exp(found[which]), 2)


def density_loss(data, solid, w="1e-6"):
    """φ_J without cohesion minus φ_0, N = 100."""
    pair = data.kept(solid, 100, float(w)), data.untreated(solid, 100)
    return interval(difference_of(*([r["phi"] for r in packings] for packings in pair)))


def weakest(data, solid):
    """C at zero pressure with w = 1e-6, N = 100."""
    return constraints(data.kept(solid, 100, 1e-6))


def constraints_text(data, solid):
    found = weakest(data, solid)
    return f"{number(found['mean'], 1)} ± {number(found['half_width'] + found['systematic'], 1)}"


def others(data, which):
    """Least or greatest C of all solids but tetrahedra, or the largest error."""
    found = [weakest(data, solid) for solid in SOLIDS[1:]]
    means = [e["mean"] for e in found]
    return number({"least": min(means), "greatest": max(means),
                   "error": max(e["half_width"] + e["systematic"] for e in found)}[which], 1)


def ranged(data, solid, h):
    """Z_ff at zero pressure with the range h and w = 1e-5, N = 100."""
    return interval(mean(data.kept(solid, 100, 1e-5, float(h)), "Z_ff_fit"))


def cubes(data, which):
    """Number of packings of cubes that are crystals, or that failed."""
    packings = data.studies["percolation-cubes"]
    counted = {"failed": [r for r in packings if r["status"] != "done"],
               "crystals": [r for r in packings if "crystalline" in r["flags"]]}
    return str(len(counted[which]))


def redundant(data, solid, w):
    """Least number of states of self-stress per particle."""
    found = constraints(data.kept(solid, 100, float(w)))
    return f"{number((found['mean'] - 12) / 2, 1)} ± {number((found['half_width'] + found['systematic']) / 2, 1)}"


def denser(data, solid):
    """Z_ff at about Δφ = AT without cohesion, of packings that were compressed further, to E/N = 3.2e-5."""
    return estimate_of([r["cycles"][0]["Z_ff"] for r in data.of("percolation-cycles", solid=solid)])


def branching(data, particles, null=""):
    """Branching ratio of the packings at the threshold, of their face-face contacts or of random bonds."""
    z = threshold_of(all_of_size(data, int(particles)))["mean"]
    return interval(branching_near(data, int(particles), z, null == "random"))


def loops(data, particles):
    """Share of the face-face contacts that close a loop at the threshold, in per cent."""
    z = threshold_of(all_of_size(data, int(particles)))["mean"]
    return number(100 * loops_near(data, int(particles), z), 0)


FUNCTIONS = {"kept": kept, "without": without, "without_interval": lambda data, column, solid: without(data, column, solid, interval),
             "threshold_error": threshold_error,
             "solid_threshold": solid_threshold, "memory": memory,
             "forgotten": forgotten, "undetected": undetected, "misfit": misfit,
             "branching": branching, "loops": loops, "constraints": constraints_text,
             "others": others, "ranged": ranged, "cubes": cubes, "density_loss": density_loss, "redundant": redundant,
             "denser": lambda data, solid: interval(denser(data, solid))}


value_of = values.value_of(FUNCTIONS)


def cohesive(data):
    """All packings at zero pressure of the four solids, also those that means leave out."""
    return [r for r in data.all if r["until"] == "end" and r["solid"] in SOLIDS and r["status"] == "done"]


def of_strength(data, solid, column, *strengths):
    return [mean(data.kept(solid, 100, w), column)["mean"] for w in strengths]


def tension(data):
    found = [last(r, "tension") for r in cohesive(data)]
    return [value for value in found if value is not None]


# Sentences of README.md that follow from the data only as long as these functions are true.
CLAIMS = {
    "none of these packings is a crystal": lambda data: all("crystalline" not in r["flags"] for r in cohesive(data)),
    "Random bonds percolate at a smaller Z_ff:": lambda data: all(
        threshold_of(all_of_size(data, n), m, True)["high"] < threshold_of(all_of_size(data, n), m)["low"]
        for n in (100, 200) for m in ("fit", "trough")),
    "only tetrahedra keep some of these contacts": lambda data: all(
        float(forgotten(data, n)) > 0.05 for n in (100, 200)) and all(
        (e := difference_at(data, SOLIDS[0], n, None, AT))["mean"] > e["half_width"] for n in (100, 200)),
    "the changes are consistent with 0": lambda data: all(float(forgotten(data, n)) > 0.05 for n in (100, 200)),
    "Cohesive tetrahedra are hyperstatic": lambda data: all(
        found["mean"] - found["half_width"] - found["systematic"] > 12 for w in data.strengths("end", 100)
        if (found := constraints(data.kept("tetrahedron", 100, w)))),
    "C of octahedra and icosahedra is 12 within the total error, and C of dodecahedra is slightly lower.": lambda data: [
        abs(e["mean"] - 12) < e["half_width"] + e["systematic"] for e in (weakest(data, s) for s in SOLIDS[1:])
    ] == [True, True, False],
    "In tetrahedra, it decreases with w by fit, and increases slowly by trough": lambda data: all(
        a > b and c < d for (a, b), (c, d) in [(of_strength(data, SOLIDS[0], "Z_ff_fit", 1e-5, 1e-3),
                                                of_strength(data, SOLIDS[0], "Z_ff_trough", 1e-5, 1e-3))]),
    "all of these packings percolate": lambda data: all(
        last(r, "winding_fit") > 0 for r in data.kept("octahedron", 100, 1e-5, 0.03)),
    "are crystals, and": lambda data: int(cubes(data, "crystals")) + int(cubes(data, "failed")) == len(
        data.studies["percolation-cubes"]),
    "about half of these are under tension": lambda data: 0.35 < min(tension(data)) and max(tension(data)) < 0.7,
    "It is smaller than for random bonds in the same packings": lambda data: float(branching(data, "100").split()[0]) < float(
        branching(data, "100", "random").split()[0]),
    "By the paper's fit of the cut-offs,": lambda data: mean(data.kept("icosahedron", 100, 1e-6), "Z_ff_trough") is None,
    "The data do not show whether the thresholds of face-face contacts differ likewise:": lambda data: float(
        solid_threshold(data, "error")) > float(solid_threshold(data, "contrast")) and all(
            abs(one["mean"] - other["mean"]) < max(one["high"] - one["low"], other["high"] - other["low"])
            for one in of_solids(data) for other in of_solids(data)),
    "The deviations of the groups are not significant": lambda data: collapse(data, 100)["chi_squared"][2] > 0.05,
    "but they are if states up to Z_ff = 1.8 are included": lambda data: collapse(data, 100, 1.8)["chi_squared"][2] < 0.01,
    "A compression that ends at 1e-9 instead of 3.2e-5 alone raises Z_ff of octahedra": lambda data: (
        found := difference_of([r["cycles"][0]["Z_ff"] for r in data.of("percolation-cycles", solid="octahedron")],
                               values_at(data.untreated("octahedron", 100), "Z_ff_fit", AT)))["mean"] > 2 * found["half_width"],
}

if __name__ == "__main__":
    pages.main(sys.modules[__name__], HERE)
