"""Properties of a state's contacts that the record does not contain: pure functions of the angles and of the particles
in contact. A state is a dict of lists, one entry per contact: a, b (particles), theta_ef, theta_ff (radians)."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

from estimates import binomial_at_least  # noqa: E402

REGION_1 = math.radians(1)  # the paper's gray mask
LEVEL = 0.01  # of tests of single states
FACTORS = (0.1, 0.5, 1, 2, 10)  # by which both cut-offs are multiplied


def classes(state, cut_ff, cut_ef, particles):
    """Z_ff, Z_ef and C by cut-offs, with the paper's classes."""
    ff = sum(x < cut_ff for x in state["theta_ff"])
    ef = sum(e < cut_ef and f >= cut_ff for e, f in zip(state["theta_ef"], state["theta_ff"]))
    return {"Z_ff": 2 * ff / particles, "Z_ef": 2 * ef / particles,
            "C": 2 * (len(state["theta_ff"]) + 2 * ff + ef) / particles}


def by_cutoffs(state, fits, particles):
    """[C at the fitted cut-offs times each of FACTORS, Z_ff by the gap in θ_ff]; None without a fit or gap."""
    ff, ef = fits["ff"], fits["ef"]
    known = ff is not None and ef is not None
    gap = fits["gap_ff"]
    return [[classes(state, f * ff, f * ef, particles)["C"] if known else None for f in FACTORS],
            classes(state, gap, 0, particles)["Z_ff"] if gap is not None else None]


def regions(state, critical):
    """Numbers of contacts in regions 1, 2 and 3 of c(θ_ff), `critical` being θ_ff,c,min in radians."""
    first = sum(x < REGION_1 for x in state["theta_ff"])
    second = sum(REGION_1 <= x < critical for x in state["theta_ff"])
    return [first, second, len(state["theta_ff"]) - first - second]


def emerged(counts, critical):
    """True if region 1 is denser in θ_ff than region 2: it has more contacts than expected by chance (1 %) from the
    density of region 2, given the number in both."""
    both = counts[0] + counts[1]
    return both > 0 and binomial_at_least(counts[0], both, REGION_1 / critical) < LEVEL


def hyper_random(state, angle, fraction=0.1):
    """True if more θ_ef than expected by chance (1 %) lie below `angle`. Random contacts have the share `fraction`
    below it."""
    below = sum(x < angle for x in state["theta_ef"])
    return binomial_at_least(below, len(state["theta_ef"]), fraction) < LEVEL


def neighbours(state, cut_ff, particles):
    """Distribution of face-face contacts over particles: [how many particles have 0, 1, 2 … of them; Σ k(k−1) over
    particles; Σ k(z−1)], z all contacts of a particle and k its face-face contacts. A contact of a particle that has
    another face-face contact is face-face with probability Σ k(k−1) / Σ k(z−1)."""
    of, all_of = [0] * particles, [0] * particles
    for a, b, theta in zip(state["a"], state["b"], state["theta_ff"]):
        for particle in (a, b):
            all_of[particle] += 1
            of[particle] += theta < cut_ff
    counts = [sum(k == i for k in of) for i in range(max(of, default=0) + 1)]
    return [counts, sum(k * (k - 1) for k in of), sum(k * (z - 1) for k, z in zip(of, all_of))]


def hindrance(found):
    """From an entry of `neighbours` and the number of contacts: q, the probability that another contact of a particle
    with a face-face contact is face-face; p, what it would be if face-face contacts were drawn at random among all,
    (n − 1)/(M − 1); variance over mean of k; the share of particles with two and more, and that of a Poisson
    distribution."""
    counts, pairs, others, contacts = found
    particles = sum(counts)
    total = sum(k * n for k, n in enumerate(counts))
    if not total or not others:
        return None
    mean = total / particles
    variance = sum(n * (k - mean) ** 2 for k, n in enumerate(counts)) / particles
    return {"q": pairs / others, "p": (total / 2 - 1) / (contacts - 1), "dispersion": variance / mean,
            "two_or_more": sum(counts[2:]) / particles,
            "poisson": 1 - math.exp(-mean) * (1 + mean)}


def random_curves(kind, critical):
    """Angles θ_ef ("ef") or θ_ff ("ff") in degrees and cumulative shares of random contacts. Free: p ∝ cos θ_ef and p ∝
    sin θ_ff up to the largest critical angle. Edge in a face: θ_ef = 0 and p(θ_ff) uniform up to its own critical
    angle."""
    greatest = max(angle for name, angle in critical.items() if name.startswith(kind))
    angles = [greatest * i / 60 for i in range(61)]
    if kind == "ef":
        free = [math.sin(math.radians(x)) / math.sin(math.radians(greatest)) for x in angles]
        return angles, free, [1.0] * len(angles)
    free = [(1 - math.cos(math.radians(x))) / (1 - math.cos(math.radians(greatest))) for x in angles]
    return angles, free, [min(1.0, x / critical["ff_edge_face"]) for x in angles]
