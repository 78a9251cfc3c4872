"""Histograms of alignment angles, and their troughs for data of version 0.1.0. Later records contain the troughs.

An entry of the troughs has histograms [number of the first bin, numbers of contacts]. Bin k contains the angles with
k·width ≤ log10 θ < (k + 1)·width."""

import math

from estimates import estimate_of

WIDTH = 0.2  # of the bins, decades
# Decimal logarithms between which a cut-off may be: between the peaks of parallel and of other contacts.
RANGE = {"theta_ff": (-4.4, -1.6), "theta_ef": (-4.4, -2.0)}


def antimode(histogram, between):
    """Edges of bins (cut-off, low, high), as numbers of bins: where the density of both neighbouring bins is smallest,
    and the ends of the range around it with densities below √5/2 of this density or within its Poisson noise."""
    first, counts = histogram
    lower, upper = (round((x - first) / WIDTH) for x in between)
    both = {k: counts[k - 1] + counts[k] for k in range(lower, upper + 1)}
    least = min(both.values())
    where = [k for k in both if both[k] == least]
    cutoff = low = high = where[len(where) // 2]
    level = max(math.sqrt(5) / 2 * least, least + 1 + math.sqrt(least + 0.75))
    while low - 1 in both and both[low - 1] <= level:
        low -= 1
    while high + 1 in both and both[high + 1] <= level:
        high += 1
    return cutoff, low, high


def from_bins(replicates):
    """Entry like those of `isojam aggregate`, from bins of θ_ff and θ_ef of the states nearest jamming of replicates
    with the same number of particles. Contacts are face-face below the cut-off of θ_ff, and edge-face below that of θ_ef.
    All face-face contacts are below both."""
    particles = replicates[0]["particles"]
    made, edges = {"particles": particles, "delta_phi": None, "replicates": len(replicates),
                   "packings": len(replicates), "width": WIDTH}, {}
    for name, kind in (("theta_ff", "face_face"), ("theta_ef", "edge_face")):
        first = replicates[0]["bins"][name][0]
        counts = [sum(column) for column in zip(*(r["bins"][name][1] for r in replicates))]
        edges[name] = antimode((first, counts), RANGE[name])
        cutoff, low, high = (10 ** (first + WIDTH * k) for k in edges[name])
        made[name] = [round(first / WIDTH), counts]
        k = edges[name][0]
        made[kind] = {"verdict": "found", "cutoff": cutoff, "low": low, "high": high,
                      "density": (counts[k - 1] + counts[k]) / (2 * WIDTH) * 2 / (particles * len(replicates))}

    def each(edge, weights):
        """Twice the weighted numbers of contacts below both edges, per particle."""
        return estimate_of([2 / particles * (sum(w * sum(r["bins"][name][1][:edges[name][edge]])
                                                 for name, w in weights.items())) for r in replicates])

    total = [2 / particles * sum(r["bins"]["theta_ef"][1]) for r in replicates]
    made["Z_ff"] = each(0, {"theta_ff": 1})
    made["Z_ef"] = each(0, {"theta_ef": 1, "theta_ff": -1})
    for name, edge in (("C", 0), ("C_low", 1), ("C_high", 2)):
        more = [2 / particles * sum(sum(r["bins"][angle][1][:edges[angle][edge]]) for angle in ("theta_ef", "theta_ff"))
                for r in replicates]
        made[name] = estimate_of([a + b for a, b in zip(total, more)])
    return made


def density(entry, name, width=WIDTH):
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
