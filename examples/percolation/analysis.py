"""Estimates over the packings of the study. All functions are pure; random numbers have fixed seeds."""

import json
import math
import sys
from pathlib import Path

import numpy
from scipy.special import expit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from estimates import difference_of, estimate_of, larger_chi_squared  # noqa: E402
from scaling import at  # noqa: E402

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
RANGE = 0.1  # range h of all studies but one
AFTER = (0.02, 0.01, 0.007)  # Δφ of the states after the cohesion was switched off
AT = 0.01  # Δφ at which packings without cohesion are compared
NO_COHESION = 1e-12  # strength of the packings that count as packings without cohesion
RESAMPLES = 200  # bootstrap samples of the thresholds
FITTED_BELOW = 1.6  # largest Z_ff of the states to which the common curve S(Z_ff) is fitted


class Data:
    """The replicates of the data files. `of()` selects those that count: they did not fail, and have none of the flags
    that the program excludes by default."""

    def __init__(self, *files):
        studies = {}
        for file in files:
            studies |= json.loads(Path(file).read_text(encoding="utf-8"))
        self.excluded = {flag for study in studies.values() for flag in study["exclude"]}
        self.studies = {name: study["replicates"] for name, study in studies.items()}
        self.all = [replicate for replicates in self.studies.values() for replicate in replicates]

    def of(self, study=None, **values):
        chosen = self.all if study is None else self.studies.get(study, [])
        return [r for r in chosen if r["status"] == "done" and not self.excluded & set(r["flags"])
                and all(r[key] == value for key, value in values.items())]

    def kept(self, solid, particles, w, h=RANGE):
        """Packings at zero pressure, with cohesion until the end."""
        return self.of(solid=solid, particles=particles, w=w, h=h, until="end")

    def removed(self, solid, particles, w):
        """Packings that were decompressed without cohesion, which acted during compression with strength w."""
        return [r for r in self.of(solid=solid, particles=particles, w=w, until="decompression") if "cycles" not in r]

    def untreated(self, solid, particles):
        """Packings without cohesion."""
        return self.removed(solid, particles, NO_COHESION)

    def strengths(self, until, particles):
        return sorted({r["w"] for r in self.all if r["until"] == until and r["particles"] == particles
                       and r["h"] == RANGE and r["solid"] in SOLIDS and r["w"] > NO_COHESION})


def last(replicate, column):
    """Value in the last state, which is the one nearest jamming, or the one at zero pressure."""
    values = replicate["states"].get(column)
    return values[-1] if values else None


def mean(replicates, column):
    return estimate_of([r["phi"] if column == "phi_0" else last(r, column) for r in replicates])


def constraints(replicates, distance=None):
    """C by fit, in the last states or at a distance Δφ; its systematic error is half the difference between doubled and
    halved cut-offs."""
    central, half, double = (mean(replicates, name) if distance is None else estimate_of(
        values_at(replicates, name, distance)) for name in ("C", "C_half", "C_double"))
    known = central and half and double
    return {**central, "systematic": 0.5 * abs(double["mean"] - half["mean"])} if known else central


def values_at(replicates, column, distance):
    """Values of the replicates at a distance Δφ, interpolated between their states; without those that have none."""
    found = []
    for r in replicates:
        states = r["states"]
        if column not in states:
            continue
        pairs = [(d, v) for d, v in zip(states["delta"], states[column]) if d and d > 0]
        value = at([d for d, _ in pairs], [v for _, v in pairs], distance)
        if value is not None:
            found.append(value)
    return found


def difference_at(data, solid, particles, w, distance, column="Z_ff_fit"):
    """Difference of the means after cohesion of strength w and without cohesion, at a distance to jamming. If w is
    None, the packings of all strengths count together."""
    strengths = data.strengths("decompression", particles) if w is None else [w]
    after = [r for strength in strengths for r in data.removed(solid, particles, strength)]
    pair = [values_at(packings, column, distance) for packings in (data.untreated(solid, particles), after)]
    return difference_of(*pair) if min(map(len, pair)) > 2 else None


# ---- Is S a function of Z_ff? --------------------------------------------------------------------------------------
def points(data, particles, method="fit"):
    """Triples (Z_ff, S, group) of all states. A group has one solid, one strength and one preparation."""
    made = []
    for r in data.of(particles=particles, h=RANGE):
        if r["solid"] not in SOLIDS:
            continue
        states, group = r["states"], (r["solid"], r["w"], r["until"])
        made += [(z, s, group) for z, s in zip(states.get(f"Z_ff_{method}", []), states.get(f"S_{method}", []))
                 if z is not None and s is not None]
    return made


def collapse(data, particles, below=FITTED_BELOW):
    """Fits ln S by a cubic polynomial of Z_ff, for states with Z_ff below a limit. Compares the mean residual of each group
    with its standard error, and χ² of the groups with one state per packing."""
    chosen = [p for p in points(data, particles) if p[0] < below]
    z, log_s = numpy.array([p[0] for p in chosen]), numpy.log([p[1] for p in chosen])
    curve = numpy.polynomial.Polynomial.fit(z, log_s, 3)
    groups = {}
    for (_, _, group), residual in zip(chosen, log_s - curve(z)):
        groups.setdefault(group, []).append(residual)
    offsets = {group: estimate_of(residuals) for group, residuals in groups.items() if len(residuals) > 5}
    deviations = [e["mean"] for e in offsets.values()]
    # The states of a decompression are not independent.
    single = [e for (_, _, until), e in offsets.items() if until == "end"]
    return {"curve": curve, "offsets": offsets, "chi_squared": chi_squared(single),
            "within": float(numpy.std(log_s - curve(z))), "between": float(numpy.std(deviations))}


# ---- Thresholds ----------------------------------------------------------------------------------------------------
def logistic_middles(pairs):
    """Logistic curves p = 1/(1 + exp((m − z)/s)) of pairs (z, outcome from 0 to 1): array of m, for the pairs themselves and
    then for bootstrap samples of them. It is NaN for a sample without outcomes on both sides of 1/2.

    Jeffreys' prior keeps the curves finite where the outcomes are separated (D. Firth, Biometrika 80, 27, 1993)."""
    z, y = numpy.array(pairs).T
    middle, spread = z.mean(), z.std() or 1.0
    x, n = (z - middle) / spread, len(z)
    draws = numpy.random.default_rng(n).integers(n, size=(RESAMPLES, n))
    counts = numpy.stack([numpy.ones(n), *(numpy.bincount(draw, minlength=n) for draw in draws)])
    b0, b1 = numpy.zeros(len(counts)), numpy.zeros(len(counts))
    for _ in range(40):
        p = expit(b0[:, None] + b1[:, None] * x)
        w = counts * p * (1 - p)
        s0, s1, s2 = w.sum(1), w @ x, w @ (x * x)
        determinant = s0 * s2 - s1 * s1
        hat = p * (1 - p) * (s2[:, None] - 2 * s1[:, None] * x + s0[:, None] * x * x) / determinant[:, None]
        score = counts * (y - p + hat * (0.5 - p))
        u0, u1 = score.sum(1), score @ x
        step = numpy.stack([s2 * u0 - s1 * u1, s0 * u1 - s1 * u0]) / determinant
        step *= numpy.minimum(1, 2 / numpy.maximum(numpy.abs(step).max(0), 1e-300))
        b0, b1 = b0 + step[0], b1 + step[1]
    sides = (counts @ (y > 0.5) > 0) & (counts @ (y < 0.5) > 0) & (b1 > 0)
    b1 = numpy.where(sides, b1, numpy.nan)
    return middle - spread * b0 / b1


def winding_pairs(replicates, method, of_random):
    """Pairs of Z_ff and the outcome in the last state of each replicate."""
    made = []
    for r in replicates:
        z = last(r, f"Z_ff_{method}")
        y = last(r, f"winds_random_{method}" if of_random else f"winding_{method}")
        if z is not None and y is not None:
            made.append((z, y if of_random else float(y > 0)))
    return made


def interval_of(values):
    """The first value with the 95 % confidence interval from the others, the bootstrap samples; None if the first or
    more than a tenth of the others are NaN."""
    known = numpy.sort(values[1:][~numpy.isnan(values[1:])])
    if numpy.isnan(values[0]) or len(known) < 0.9 * (len(values) - 1):
        return None
    low, high = (float(known[round(share * (len(known) - 1))]) for share in (0.025, 0.975))
    return {"mean": float(values[0]), "low": low, "high": high}


def threshold_of(replicates, method="fit", of_random=False):
    """Z_ff at which half of the packings percolate."""
    pairs = winding_pairs(replicates, method, of_random)
    return interval_of(logistic_middles(pairs)) if len(pairs) > 7 else None


def all_of_size(data, particles, solids=SOLIDS):
    return [r for r in data.of(particles=particles, h=RANGE) if r["solid"] in solids]


def branching_near(data, particles, z, of_random=False):
    """Mean branching ratio of the packings with Z_ff by fit within 0.15 of z."""
    name = "branching_random" if of_random else "branching"
    near = [r for r in all_of_size(data, particles) if abs((last(r, "Z_ff_fit") or 0) - z) < 0.15]
    return estimate_of([r.get(name) for r in near])


def loops_near(data, particles, z):
    """Share of the face-face contacts that close a loop, in the packings with Z_ff by fit within 0.15 of z."""
    near = [r for r in all_of_size(data, particles) if abs((last(r, "Z_ff_fit") or 0) - z) < 0.15 and "loops" in r]
    return sum(r["loops"] for r in near) / sum(r["bonds"] for r in near)


def excess(data, particles, method="fit"):
    """Mean of ln(S/S_random) over the states with Z_ff from 0.8 to 1.6, for each solid."""
    found = {}
    for solid in SOLIDS:
        values = []
        for r in all_of_size(data, particles, (solid,)):
            z, s, null = (last(r, f"{name}_{method}") for name in ("Z_ff", "S", "S_random"))
            if z is not None and s and null and 0.8 < z < 1.6:
                values.append(math.log(s / null))
        found[solid] = estimate_of(values)
    return found


def chi_squared(differences):
    """χ² of differences from 0, its degrees of freedom, and the probability of a larger value. Intervals count as those
    of the normal distribution."""
    terms = [(d["mean"] / (d["half_width"] / 1.96)) ** 2 for d in differences if d and d["half_width"]]
    return sum(terms), len(terms), larger_chi_squared(sum(terms), len(terms)) if terms else None
