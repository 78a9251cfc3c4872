"""φ_J of each replicate of some studies, and estimates over replicates as functions of Δφ."""

import functools

from estimates import estimate_of, of_choices
from scaling import at, free_exponent, jamming_density, local_slopes

LEFT_OUT = {"crystalline", "goal_not_reached"}
# Fit windows for φ_J, nearest first. φ_J comes from the first one with enough states, and its systematic error from the
# next two and the free exponent.
WINDOWS = ((0, 0.0025), (0, 0.005), (0, 0.01), (0, 0.02))
ENOUGH = 4
CHOICES = 4  # number of fits of φ_J: three windows and a free exponent


def densities(replicate):
    """φ_J of a replicate, by several fits.

    The fits use the nearest three windows with enough states, and then a free exponent with the last of these windows.
    A fit that fails gives None. If no window has enough states, the only value is φ_J in the record."""
    phi, energy, start = replicate["states"]["phi"], replicate["states"]["E"], replicate["phi_j"]["phi_j"]
    windows = [w for w in WINDOWS if sum(w[0] <= x - start < w[1] for x in phi) >= ENOUGH][:3]
    if not windows:
        return [start]
    found = [jamming_density(phi, energy, start, w) for w in windows]
    free = free_exponent(phi, energy, start, windows[-1])
    return [found[0] if found[0] is not None else start, *found[1:], free[0] if free else None]


def chosen(found, choice):
    return found[choice] if choice < len(found) and found[choice] is not None else found[0]


class Expansions:
    """Estimates over the replicates of studies: {name: {"replicates": [...]}}.

    Only the studies in `main` are used. Crystalline replicates, and replicates that did not reach their goal, are left
    out."""

    def __init__(self, studies, main):
        self.studies, self.main = studies, main

    def all_of(self, solid, particles):
        return [r for name in self.main if name in self.studies for r in self.studies[name]["replicates"]
                if r["solid"] == solid and r["particles"] == particles]

    @functools.cache
    def counted(self, solid, particles):
        return [r for r in self.all_of(solid, particles)
                if r["status"] == "done" and not LEFT_OUT & set(r["flags"])]

    @functools.cache
    def densities(self, solid, particles):
        return [densities(r) for r in self.counted(solid, particles)]

    @functools.cache
    def distances(self, solid, particles, choice=0):
        """Δφ of every state of every replicate, for one choice of φ_J.

        If a fit failed for a replicate, its first φ_J is used instead, so that all choices have the same replicates."""
        return [[x - chosen(found, choice) for x in replicate["states"]["phi"]] for replicate, found in zip(
            self.counted(solid, particles), self.densities(solid, particles))]

    def phi_j(self, solid, particles):
        """Estimate of φ_J. The systematic error is half the range over the fits."""
        found = self.densities(solid, particles)
        if not found:
            return None
        choices = [estimate_of([chosen(f, i) for f in found]) for i in range(CHOICES)]
        return of_choices(choices[0], choices[1:])

    def column(self, solid, particles, name):
        """Values in the states of every replicate; None for a replicate without this column."""
        return [r["states"].get(name) for r in self.counted(solid, particles)]

    def paths(self, solid, particles, name, choice=0):
        """A pair (Δφ, values) for every replicate that has this column."""
        return [(x, y) for x, y in zip(self.distances(solid, particles, choice), self.column(solid, particles, name))
                if y is not None]

    def nearest(self, solid, particles, name):
        """Estimate over the nearest states."""
        return estimate_of([y[-1] for y in self.column(solid, particles, name) if y])

    def at(self, solid, particles, name, distance):
        """Estimate at a distance to jamming, interpolated between the two states on either side."""
        return estimate_of([at(x, y, distance) for x, y in self.paths(solid, particles, name)])

    def nearest_distance(self, solid, particles):
        return estimate_of([x[-1] for x in self.distances(solid, particles)])

    def slopes(self, solid, particles, name, edges):
        """Local exponents in Δφ, one estimate for each bin. The systematic error comes from the choice of φ_J."""
        choices = [local_slopes(self.paths(solid, particles, name, i), edges) for i in range(CHOICES)]
        return [of_choices(central, [choice[i] for choice in choices[1:]]) for i, central in enumerate(choices[0])]
