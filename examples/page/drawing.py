"""Shared parts of the figures: colours and symbols of solids, means against Δφ, and writing of reproducible files."""

import json
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

from estimates import estimate_of  # noqa: E402
from scaling import at  # noqa: E402

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
# The palette of the report. The pages are made without a build, and therefore without the module isojam.
PALETTE = json.loads((Path(__file__).resolve().parents[2] / "tasks/extras/page/palette.json").read_text())
COLOURS = {solid: PALETTE["colours"][PALETTE["solids"][solid]["colour"]] for solid in SOLIDS}
MARKERS = {solid: PALETTE["solids"][solid]["marker"] for solid in SOLIDS}
GRID = [0.16 * 2 ** (-i / 2) for i in range(19)]
SETTINGS = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
            "legend.frameon": False, "axes.titlesize": 9}


def mean_path(data, solid, particles, column, logarithmic=False):
    """Means over replicates at the distances of GRID, with half the widths of their 95 % confidence intervals.

    Returns a list of distances, a list of means, and two lists of half widths, below and above the means. A distance is
    left out unless at least half of the replicates have a value there. If `logarithmic`, means are geometric, for
    quantities that vary over decades. With two replicates, the half widths are 0."""
    paths = [(x, [math.log(v) if v and v > 0 else None for v in y] if logarithmic else y)
             for x, y in data.paths(solid, particles, column)]
    x, y, error = [], [], []
    for distance in GRID:
        estimate = estimate_of([at(a, b, distance) for a, b in paths])
        if estimate and estimate["n"] >= max(2, len(data.counted(solid, particles)) / 2):
            mean, width = estimate["mean"], estimate["half_width"] if estimate["n"] > 2 else 0
            x.append(distance)
            y.append(math.exp(mean) if logarithmic else mean)
            error.append((math.exp(mean) * (1 - math.exp(-width)), math.exp(mean) * math.expm1(width)) if logarithmic
                         else (width, width))
    return x, y, list(zip(*error))


def save(figure, path, dpi=100):
    figure.tight_layout()
    # The version of matplotlib is left out, so that the same data give the same file.
    figure.savefig(path, dpi=dpi, metadata={"Software": None}, pil_kwargs={"optimize": True})
    pyplot.close(figure)
