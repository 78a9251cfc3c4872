"""Estimates over the packings of the study. All functions are pure; random numbers have fixed seeds."""

import json
import math
import random
import sys
from pathlib import Path

import numpy
from scipy.optimize import minimize
from scipy.special import expit

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from estimates import difference_of, estimate_of, larger_chi_squared  # noqa: E402
from scaling import at  # noqa: E402

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
RANGE = 0.1  # range h of all studies but one
RESAMPLES = 400  # bootstrap samples of the thresholds
FITTED_BELOW = 0.3  # largest S/N of the states to which the common curve S(Z_ff) is fitted


class Data:
    """The replicates of the data files. `of()` selects those that count: they did not fail, and have none of the flags
    that the program excludes by default."""

    def __init__(self, *files):
        studies = {}
        for file in files:
            studies |= json.loads(Path(file).read_text(encoding="utf-8"))
        self.git = sorted({commit for study in studies.values() for commit in study["git"]})
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
        """Packings that were decompressed without cohesion."""
        name = f"percolation-removed{particles}"
        return self.of(name, solid=solid, w=w)

    def strengths(self, until, particles):
        return sorted({r["w"] for r in self.all if r["until"] == until and r["particles"] == particles
                       and r["h"] == RANGE and r["solid"] in SOLIDS and r["w"] > 0})


def last(replicate, column):
    """Value in the last state, which is the one nearest jamming, or the one at zero pressure."""
    values = replicate["states"].get(column)
    return values[-1] if values else None


def mean(replicates, column):
    return estimate_of([r["phi"] if column == "phi_0" else last(r, column) for r in replicates])


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
    """Difference of the means after cohesion of strength w and without cohesion, at a distance to jamming."""
    pair = [values_at(data.removed(solid, particles, strength), column, distance) for strength in (0, w)]
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


def collapse(data, particles, method="fit"):
    """Fits ln S by a cubic polynomial of Z_ff, for states with S below FITTED_BELOW·N. Compares the mean residual of each
    group with its standard error, where the states of a group count as independent only across replicates."""
    chosen = [p for p in points(data, particles, method) if p[1] < FITTED_BELOW * particles]
    z, log_s = numpy.array([p[0] for p in chosen]), numpy.log([p[1] for p in chosen])
    curve = numpy.polynomial.Polynomial.fit(z, log_s, 3)
    groups = {}
    for (_, _, group), residual in zip(chosen, log_s - curve(z)):
        groups.setdefault(group, []).append(residual)
    offsets = {group: estimate_of(residuals) for group, residuals in groups.items() if len(residuals) > 5}
    deviations = [e["mean"] for e in offsets.values()]
    # One state per packing: only these groups have independent states.
    single = [e for (_, _, until), e in offsets.items() if until == "end"]
    return {"curve": curve, "offsets": offsets, "states": len(chosen), "chi_squared": chi_squared(single),
            "within": float(numpy.std(log_s - curve(z))), "between": float(numpy.std(deviations)) if deviations else None}


# ---- Thresholds ----------------------------------------------------------------------------------------------------
def threshold(pairs):
    """Z_ff at which the probability of winding is 1/2, by logistic regression with outcomes from 0 to 1; None unless
    there are outcomes on both sides."""
    if len(pairs) < 8 or not any(y > 0.5 for _, y in pairs) or not any(y < 0.5 for _, y in pairs):
        return None
    z, y = numpy.array([p[0] for p in pairs]), numpy.array([p[1] for p in pairs])

    def loss(parameters):
        middle, log_width = parameters
        p = numpy.clip(expit((z - middle) / math.exp(log_width)), 1e-9, 1 - 1e-9)
        # The weak prior keeps the width finite if the outcomes are separated.
        return -numpy.sum(y * numpy.log(p) + (1 - y) * numpy.log(1 - p)) + 0.5 * (log_width + 1.5) ** 2

    best = minimize(loss, [float(numpy.median(z)), -1.5], method="Nelder-Mead")
    return float(best.x[0]), math.exp(float(best.x[1]))


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
    """Limits of the 95 % confidence interval from values of bootstrap samples; None if more than a tenth are missing."""
    known = sorted(value for value in values if value is not None)
    if len(known) < 0.9 * len(values):
        return None
    return known[round(0.025 * (len(known) - 1))], known[round(0.975 * (len(known) - 1))]


def threshold_of(replicates, method="fit", of_random=False):
    """The threshold with its 95 % confidence interval, from a bootstrap over replicates."""
    pairs = winding_pairs(replicates, method, of_random)
    found = threshold(pairs)
    if not found:
        return None
    generator = random.Random(len(pairs))
    samples = [threshold(generator.choices(pairs, k=len(pairs))) for _ in range(RESAMPLES)]
    limits = interval_of([sample and sample[0] for sample in samples])
    return {"mean": found[0], "width": found[1], "n": len(pairs), "low": limits[0], "high": limits[1]} if limits else None


def crossing_of(smaller, larger, method="fit", of_random=False):
    """Z_ff where the logistic curves of two sizes have the same probability, with its 95 % confidence interval; None
    unless nine tenths of the bootstrap samples have a steeper curve for the larger size."""
    sides = [winding_pairs(replicates, method, of_random) for replicates in (smaller, larger)]

    def crossing(samples):
        curves = [threshold(sample) for sample in samples]
        if None in curves or curves[1][1] >= curves[0][1]:
            return None
        (middle, width), (other, narrower) = curves
        return (other * width - middle * narrower) / (width - narrower)

    found, generator = crossing(sides), random.Random(len(sides[0]))
    limits = interval_of([crossing([generator.choices(side, k=len(side)) for side in sides]) for _ in range(RESAMPLES)]
                         if found is not None else [None])
    return {"mean": found, "low": limits[0], "high": limits[1]} if limits else None


def all_of_size(data, particles, solids=SOLIDS):
    return [r for r in data.of(particles=particles, h=RANGE) if r["solid"] in solids]


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
