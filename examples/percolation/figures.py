"""Draws the figures of the page: python3 figures.py OUT DATA..."""

import sys
from pathlib import Path

import numpy

from analysis import AT, NO_COHESION, SOLIDS, Data, all_of_size, collapse, last, mean, points, values_at, winding_pairs
from estimates import estimate_of

from drawing import COLOURS, MARKERS, SETTINGS, WIDTH, letter, pyplot, save, solid_legend
import matplotlib

SIZES = (100, 200, 400)
GREYS = {100: "0.65", 200: "0.4", 400: "0.0"}
DISTANCES = (0.025, 0.02, 0.015, 0.01, 0.007)


def bars(axes, x, estimates, solid, **style):
    """Means with error bars, without missing values."""
    found = [(a, e) for a, e in zip(x, estimates) if e and e["n"] > 3]
    if found:
        axes.errorbar([a for a, _ in found], [e["mean"] for _, e in found], [e["half_width"] for _, e in found],
                      color=COLOURS[solid], marker=MARKERS[solid], capsize=0, elinewidth=0.8, **style)


def strengths(data, out):
    """Z_ff, C and φ_0 against the strength of the cohesion. Z_ff is drawn for cut-offs by fit and, open, by trough."""
    figure, panels = pyplot.subplots(1, 3, figsize=(WIDTH, 2.5), layout="constrained")
    for axes, column, label, name in zip(panels, ("Z_ff_fit", "C", "phi_0"), ("$Z_{ff}$", "$C$", "φ$_0$"), "abc"):
        for solid in SOLIDS:
            w = data.strengths("end", 100)
            bars(axes, w, [mean(data.kept(solid, 100, each), column) for each in w], solid)
            if column == "Z_ff_fit":
                bars(axes, [1.15 * x for x in w], [mean(data.kept(solid, 100, each), "Z_ff_trough") for each in w], solid,
                     markerfacecolor="none", linewidth=0.6, linestyle="--")
            without = (mean(data.untreated(solid, 100), column) if column == "phi_0" else
                       estimate_of(values_at(data.untreated(solid, 100), column, AT)))
            if without:
                axes.axhline(without["mean"], color=COLOURS[solid], linewidth=0.8, linestyle=":")
        axes.set(xscale="log", xlabel="strength w", ylabel=label)
        letter(axes, name)
    panels[1].axhline(12, color="0.5", linewidth=0.8)
    panels[2].set_ylim(0.48, None)  # room for the legend
    solid_legend(panels[2], loc="lower right")
    save(figure, out / "strengths")


def middles(pairs, edges, least=4):
    """Pairs of the middle of a bin of Z_ff and the mean in it, for bins with enough values."""
    found = [(0.5 * (low + high), [y for x, y in pairs if low <= x < high]) for low, high in zip(edges, edges[1:])]
    return [(z, sum(values) / len(values)) for z, values in found if len(values) >= least]


def in_last_states(data, column, place=last):
    """Pairs of Z_ff and a value of the last state of each packing with N = 100."""
    found = [(last(r, "Z_ff_fit"), place(r, column)) for r in all_of_size(data, 100)]
    return [pair for pair in found if None not in pair]


def clusters(data, out):
    """S against Z_ff, the probability of percolation, and branching ratios."""
    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(WIDTH, 2.7), layout="constrained")
    edges = numpy.linspace(0, 2.4, 13)
    for solid in SOLIDS:
        for until in ("decompression", "end"):
            chosen = [(z, s) for z, s, group in points(data, 100) if (group[0], group[2]) == (solid, until)]
            left.plot(*zip(*chosen), MARKERS[solid], color=COLOURS[solid], markersize=2, alpha=0.6, markeredgewidth=0.4,
                      markerfacecolor=COLOURS[solid] if until == "end" else "none")
        own = [(last(r, "Z_ff_fit"), r["branching"]) for r in all_of_size(data, 100, (solid,)) if r.get("branching")]
        right.plot(*zip(*own), MARKERS[solid], color=COLOURS[solid], markersize=2, alpha=0.6, markeredgewidth=0.4)
    left.plot(*zip(*middles(in_last_states(data, "S_random_fit"), edges)), "k--", linewidth=1, label="random bonds")
    found = collapse(data, 100)
    z = numpy.linspace(0.1, 1.6, 60)
    left.plot(z, numpy.exp(found["curve"](z)), "k-", linewidth=1, label="common curve")
    left.set(yscale="log", xlabel="$Z_{ff}$", ylabel="mean cluster size S", xlim=(0, 2.4))
    left.legend(loc="upper left")
    for particles in SIZES:
        for of_random, style in ((False, "o-"), (True, "x--")):
            pairs = winding_pairs(all_of_size(data, particles), "fit", of_random)
            drawn = middles(pairs, edges)
            if drawn:
                middle.plot(*zip(*drawn), style, color=GREYS[particles], markersize=3,
                            label=None if of_random else f"N = {particles}")
    middle.set(xlabel="$Z_{ff}$", ylabel="probability of percolation", ylim=(-0.03, 1.03), xlim=(0, 2.3))
    middle.plot([], [], "kx--", markersize=3, label="random bonds")
    middle.legend(loc="upper left")
    right.plot(*zip(*middles(in_last_states(data, "branching_random", lambda r, name: r.get(name)), edges)), "k--",
               linewidth=1, label="random bonds")
    right.set(xlabel="$Z_{ff}$", ylabel="branching ratio", xlim=(0, 2.4), ylim=(0, None))
    right.legend(loc="upper left")
    for axes, name in zip((left, middle, right), "abc"):
        letter(axes, name)
    save(figure, out / "clusters")


def memory(data, out):
    """Z_ff against Δφ after the cohesion was switched off."""
    figure, panels = pyplot.subplots(1, len(SOLIDS), figsize=(WIDTH, 2.4), sharey=True, layout="constrained")
    shades = {NO_COHESION: "k", 1e-6: "#9ecae1", 1e-5: "#6baed6", 1e-4: "#2171b5", 1e-3: "#08306b"}
    for axes, solid, name in zip(panels, SOLIDS, "abcd"):
        for k, (w, colour) in enumerate(shades.items()):
            chosen = [(d, estimate_of(values_at(data.removed(solid, 100, w), "Z_ff_fit", d))) for d in DISTANCES]
            chosen = [(d, e) for d, e in chosen if e and e["n"] > 3]
            if chosen:
                axes.errorbar([d * 1.015 ** (k - 2) for d, _ in chosen], [e["mean"] for _, e in chosen],
                              [e["half_width"] for _, e in chosen], color=colour, marker="o", markersize=2.5,
                              elinewidth=0.8, label="w = 0" if w == NO_COHESION else f"{w:.0e}")
        axes.set(xscale="log", xlabel="Δφ", xlim=(0.006, 0.028))
        axes.xaxis.set_major_locator(matplotlib.ticker.FixedLocator((0.007, 0.01, 0.02)))
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        letter(axes, name, solid)
    panels[0].set_ylabel("$Z_{ff}$")
    panels[-1].legend(fontsize=7)
    save(figure, out / "memory")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with matplotlib.rc_context(SETTINGS):
        everything, folder = Data(*sys.argv[2:]), Path(sys.argv[1])
        folder.mkdir(parents=True, exist_ok=True)
        for draw in (strengths, clusters, memory):
            draw(everything, folder)
