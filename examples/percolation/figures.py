"""Draws the figures of the page: python3 figures.py OUT DATA..."""

import sys
from pathlib import Path

import numpy

from analysis import RANGE, SOLIDS, Data, collapse, last, mean, points, values_at, winding_pairs
from estimates import estimate_of

from drawing import COLOURS, MARKERS, SETTINGS, WIDTH, letter, pyplot, save, solid_legend
import matplotlib

SIZES = (100, 200, 400)
GREYS = {100: "0.65", 200: "0.4", 400: "0.0"}
DISTANCES = (0.02, 0.015, 0.01, 0.0075, 0.005)


def bars(axes, x, estimates, solid, **style):
    """Means with error bars, without missing values."""
    found = [(a, e) for a, e in zip(x, estimates) if e and e["n"] > 1]
    if found:
        axes.errorbar([a for a, _ in found], [e["mean"] for _, e in found], [e["half_width"] for _, e in found],
                      color=COLOURS[solid], marker=MARKERS[solid], capsize=0, elinewidth=0.8, **style)


def strengths(data, out):
    """Z_ff, C and φ_0 against the strength of the cohesion."""
    figure, panels = pyplot.subplots(1, 3, figsize=(WIDTH, 2.5), layout="constrained")
    for axes, column, label, name in zip(panels, ("Z_ff_fit", "C", "phi_0"), ("$Z_{ff}$", "$C$", "φ$_0$"), "abc"):
        for solid in SOLIDS:
            w = data.strengths("end", 100)
            bars(axes, w, [mean(data.kept(solid, 100, each), column) for each in w], solid)
            without = mean(data.removed(solid, 100, 0), column)
            if without:
                axes.axhline(without["mean"], color=COLOURS[solid], linewidth=0.8, linestyle=":")
        axes.set(xscale="log", xlabel="strength w", ylabel=label)
        letter(axes, name)
    panels[1].axhline(12, color="0.5", linewidth=0.8)
    solid_legend(panels[0], loc="lower left", fontsize=7)
    save(figure, out / "strengths")


def sizes(data, out):
    """S against Z_ff for all states, and the probability of winding."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(WIDTH, 3.0), layout="constrained")
    for solid in SOLIDS:
        for until, filled in (("end", True), ("decompression", False)):
            chosen = [(z, s) for z, s, group in points(data, 100) if (group[0], group[2]) == (solid, until)]
            if chosen:
                left.plot(*zip(*chosen), MARKERS[solid], color=COLOURS[solid], markersize=2.5, alpha=0.6,
                          markerfacecolor=COLOURS[solid] if filled else "none", markeredgewidth=0.5)
    null = [(last(r, "Z_ff_fit"), last(r, "S_random_fit")) for r in data.of(particles=100, h=RANGE)
            if last(r, "Z_ff_fit") is not None and r["solid"] in SOLIDS]
    edges = numpy.linspace(0.2, 2.4, 12)
    middle = [(z, estimate_of([s for x, s in null if low <= x < high]))
              for low, high, z in zip(edges, edges[1:], (edges[:-1] + edges[1:]) / 2)]
    middle = [(z, e["mean"]) for z, e in middle if e and e["n"] > 4]
    if middle:
        left.plot(*zip(*middle), "k--", linewidth=1, label="random bonds")
    found = collapse(data, 100)
    z = numpy.linspace(0.1, 1.6, 60)
    left.plot(z, numpy.exp(found["curve"](z)), "k-", linewidth=1, label="common curve")
    left.set(yscale="log", xlabel="$Z_{ff}$", ylabel="mean cluster size S", xlim=(0, 2.5))
    left.legend(loc="lower right")
    for particles in SIZES:
        for of_random, style in ((False, "o-"), (True, "x--")):
            pairs = winding_pairs([r for r in data.of(particles=particles, h=RANGE) if r["solid"] in SOLIDS], "fit",
                                  of_random)
            curve = [(z, estimate_of([y for x, y in pairs if low <= x < high]))
                     for low, high, z in zip(edges, edges[1:], (edges[:-1] + edges[1:]) / 2)]
            curve = [(z, e["mean"]) for z, e in curve if e and e["n"] > 3]
            if curve:
                right.plot(*zip(*curve), style, color=GREYS[particles], markersize=3.5,
                           label=f"N = {particles}" + (", random" if of_random else ""))
    right.set(xlabel="$Z_{ff}$", ylabel="probability of percolation", ylim=(-0.03, 1.03), xlim=(0, 2.5))
    right.legend(loc="upper left", fontsize=7)
    letter(left, "a")
    letter(right, "b")
    save(figure, out / "clusters")


def memory(data, out):
    """Z_ff against Δφ after the cohesion was switched off."""
    figure, panels = pyplot.subplots(1, len(SOLIDS), figsize=(WIDTH, 2.4), sharey=True, layout="constrained")
    shades = {w: c for w, c in zip((0, 1e-6, 1e-5, 1e-4, 1e-3), ("k", "#9ecae1", "#6baed6", "#2171b5", "#08306b"))}
    for axes, solid, name in zip(panels, SOLIDS, "abcd"):
        for w, colour in shades.items():
            chosen = [(d, estimate_of(values_at(data.removed(solid, 100, w), "Z_ff_fit", d))) for d in DISTANCES]
            chosen = [(d, e) for d, e in chosen if e and e["n"] > 3]
            if chosen:
                axes.errorbar([d * (1 + 0.02 * i) for i, (d, _) in enumerate(chosen)], [e["mean"] for _, e in chosen],
                              [e["half_width"] for _, e in chosen], color=colour, marker="o", markersize=2.5,
                              elinewidth=0.8, label="w = 0" if not w else f"{w:.0e}")
        axes.set(xscale="log", xlabel="Δφ")
        axes.xaxis.set_major_locator(matplotlib.ticker.FixedLocator((0.005, 0.01, 0.02)))
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
        for draw in (strengths, sizes, memory):
            draw(everything, folder)
