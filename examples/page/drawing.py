"""Shared parts of the figures: colours and symbols of solids, means against Δφ, panel letters, and reproducible files."""

import json
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

from data import SOLIDS  # noqa: E402
from estimates import estimate_of  # noqa: E402
from scaling import at  # noqa: E402

# The palette of the report. The pages are made without a build, and therefore without the module isojam.
PALETTE = json.loads((Path(__file__).resolve().parents[2] / "tasks/extras/page/palette.json").read_text())
COLOURS = {solid: PALETTE["colours"][PALETTE["solids"][solid]["colour"]] for solid in SOLIDS}
MARKERS = {solid: PALETTE["solids"][solid]["marker"] for solid in SOLIDS}
GRID = [0.16 * 2 ** (-i / 2) for i in range(19)]
WIDTH = 7.0  # inches, two columns of a journal
SETTINGS = {"font.size": 8.5, "axes.titlesize": 8.5, "axes.labelsize": 8.5, "legend.fontsize": 8, "xtick.labelsize": 8,
            "ytick.labelsize": 8, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
            "lines.linewidth": 1.1, "lines.markersize": 4, "svg.hashsalt": "isojam", "pdf.fonttype": 42}


def mean_path(data, solid, particles, column, logarithmic=False, grid=GRID):
    """Means over replicates at the distances of the grid, with half the widths of their 95 % confidence intervals.

    Returns a list of distances, a list of means, and two lists of half widths, below and above the means. A distance is
    left out unless at least half of the replicates, and at least three, have a value there. If `logarithmic`, means are
    geometric, for quantities that vary over decades."""
    paths = [(x, [math.log(v) if v and v > 0 else None for v in y] if logarithmic else y)
             for x, y in data.paths(solid, particles, column)]
    x, y, error = [], [], []
    for distance in grid:
        estimate = estimate_of([at(a, b, distance) for a, b in paths])
        if estimate and estimate["n"] >= max(3, len(data.kept(solid, particles)) / 2):
            mean, width = estimate["mean"], estimate["half_width"]
            x.append(distance)
            y.append(math.exp(mean) if logarithmic else mean)
            error.append((math.exp(mean) * (1 - math.exp(-width)), math.exp(mean) * math.expm1(width)) if logarithmic
                         else (width, width))
    return x, y, list(zip(*error))


def curve(axes, path, solid, filled=True, **style):
    """Means of mean_path() with error bars, in the style of the solid."""
    x, y, error = path
    if x:
        axes.errorbar(x, y, error, marker=MARKERS[solid], color=COLOURS[solid], capsize=0, elinewidth=0.8,
                      markerfacecolor=None if filled else "white", **style)


def letter(axes, text, title=""):
    axes.set_title(f"({text})  {title}".rstrip(), loc="left")


def solid_legend(axes, **style):
    handles = [matplotlib.lines.Line2D([], [], color=COLOURS[s], marker=MARKERS[s], label=s) for s in SOLIDS]
    axes.legend(handles=handles, **style)


def save(figure, path):
    """Writes PATH.svg and PATH.pdf. They contain no date, so that the same data give the same files."""
    figure.savefig(path.with_suffix(".svg"), metadata={"Date": None})
    figure.savefig(path.with_suffix(".pdf"), metadata={"CreationDate": None, "Creator": None, "Producer": None})
    pyplot.close(figure)
