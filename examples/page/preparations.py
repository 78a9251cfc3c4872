"""Packings of 100 particles by other preparations: how φ_J, and C, m and S by exponents, depend on the protocol.

A preparation is named by its target energy, or `removed` (cohesion acted during a compression to 1e-9) or `cycles` (four
training cycles). All other packings of the pages are by OURS."""

import math
import statistics

from scipy.special import ndtr
from scipy.stats import f_oneway

import verdict
from data import LINE, SOLIDS
from estimates import NORMAL, difference_of, estimate_of
from limits import extrapolated
from text import interval, significant, spread, table

OURS, ENERGIES, SIZE = "3.2e-05", ("1e-09", "1e-07", "3.2e-05", "0.001"), 100
PREPARATIONS = {"1e-09": "target energy 1e-9", "1e-07": "1e-7", "0.001": "1e-3", "removed": "removed cohesion",
                "cycles": "four cycles"}


def values(data, solid, preparation, column="phi_j"):
    """Values of all packings, or of those that are near enough to jamming for columns by exponents."""
    rows = verdict.packings(data, solid, SIZE, LINE) if column != "phi_j" else [
        r for name in LINE for r in data.kept_of(name, solid)]
    return [r[column] for r in rows if r["preparation"] == preparation]


def difference(first, second):
    return difference_of(first, second) if min(len(first), len(second)) > 1 else None


def change(data, solid, preparation, column="phi_j"):
    """Change of a mean from OURS. Removed cohesion: from the compression to the same energy without it."""
    return difference(values(data, solid, "1e-09" if preparation == "removed" else OURS, column),
                      values(data, solid, preparation, column))


def changes_from_ours(data, solid, column="phi_j"):
    """Changes of a mean from OURS, without preparations that have too few packings."""
    ours = values(data, solid, OURS, column)
    return [e for p in PREPARATIONS if (e := difference(ours, values(data, solid, p, column)))]


def reach(data, solid):
    """Range of the mean φ_J over all preparations."""
    means = [0, *(e["mean"] for e in changes_from_ours(data, solid))]
    return max(means) - min(means)


def extreme(data, solid, end):
    """The change of φ_J from OURS that is the least (min) or the greatest (max)."""
    return end(changes_from_ours(data, solid), key=lambda e: e["mean"])


def signed(estimate):
    return "+" * bool(estimate and estimate["mean"] > 0) + interval(estimate)


def changes_table(data):
    """Changes of φ_J."""
    return table(["change of φ_J", *PREPARATIONS.values(), "single packing"], [
        [s, *(signed(change(data, s, p)) for p in PREPARATIONS), spread(data.phi_j(s, 400))] for s in SOLIDS])


def mean(data, solid, preparation, column):
    """Mean with the range over the boundaries of the classes."""
    return verdict.with_range(*(estimate_of(values(data, solid, preparation, f"{column}{end}")) for end in ("", "_low", "_high")))


def probability(data, solid, column):
    """Probability that the means of all preparations differ as much by chance (one-way analysis of variance)."""
    groups = [found for p in (OURS, *PREPARATIONS) if len(found := values(data, solid, p, column)) > 2]
    return float(f_oneway(*groups).pvalue) if len(set().union(*groups)) > 1 else 1.0


def slope(data, solid):
    """Slope of a line through the means of m against those of φ_J, weighted by their intervals, or by their resolution."""
    groups = [[estimate_of(values(data, solid, p, column)) for column in ("phi_j", "m_x")] for p in (OURS, *PREPARATIONS)]
    return extrapolated([(phi["mean"], m["mean"], max(m["half_width"], 1 / SIZE / m["n"]))
                         for phi, m in groups if m and m["n"] > 2])["slope"]


def slope_by_chance(data):
    """Probability of slopes of all solids together that differ from 0 as much by chance (Stouffer)."""
    deviates = [NORMAL * e["mean"] / e["half_width"] for e in (slope(data, s) for s in SOLIDS)]
    return 2 * float(ndtr(-abs(sum(deviates)) / math.sqrt(len(deviates))))


def fall(data, solid):
    """Decrease of m over the range of φ_J."""
    return -slope(data, solid)["mean"] * reach(data, solid)


def every_table(data):
    rows = []
    for solid in SOLIDS:
        for p in (OURS, *PREPARATIONS):
            if not (stress := values(data, solid, p, "self_stress_x")):
                continue
            rows.append([solid, PREPARATIONS.get(p, "3.2e-5, as elsewhere"), str(len(stress)),
                         interval(estimate_of(values(data, solid, p))),
                         *(interval(mean(data, solid, p, column)) for column in ("C_x", "m_x")),
                         f"{interval(estimate_of(stress))} ({stress.count(1)})",
                         significant(statistics.median(values(data, solid, p, "distance")), 2)])
    return table(["solid, N = 100", "preparation", "packings", "φ_J", "C", "m", "S (packings with S = 1)", "Δφ, median"], rows)
