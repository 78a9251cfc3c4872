"""Histograms of alignment angles. An entry of the troughs has histograms [number of the first bin, numbers of contacts].
Bin k contains the angles with k·width ≤ log10 θ < (k + 1)·width."""

import math


def density(entry, name, width=0.2):
    """Density of log10 θ of an entry, per particle and decade, in bins of at least this width: lists of the centres
    (radians), of the densities, and of half the widths of their 95 % intervals by Poisson noise."""
    joined = max(1, round(width / entry["width"]))
    first, counts = entry[name]
    sums = {}
    for k, count in enumerate(counts, first):
        sums[k // joined] = sums.get(k // joined, 0) + count
    wide = joined * entry["width"]
    scale = 2 / (entry["particles"] * entry["packings"] * wide)
    centres = sorted(sums)
    return ([10 ** ((k + 0.5) * wide) for k in centres], [scale * sums[k] for k in centres],
            [1.96 * scale * math.sqrt(sums[k]) for k in centres])
