"""Replicates of studies: φ_J of each, and estimates over replicates against Δφ."""

import functools

from estimates import estimate_of, of_choices
from scaling import at, free_exponent, jamming_density, local_slopes

LEFT_OUT = {"crystalline", "goal_not_reached"}
# Fit windows for φ_J, nearest first. The first with enough states is used; the next two give the systematic error.
WINDOWS = ((0, 0.0025), (0, 0.005), (0, 0.01), (0, 0.02))
ENOUGH = 4
CHOICES = 4  # fits of φ_J: three windows and a free exponent


def densities(replicate):
    """φ_J of a replicate by at most three windows with enough states, nearest first, then with a free exponent over the
    last of these. The record's φ_J if no window has enough states. None for a fit that fails."""
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
    """Studies, {name: {"replicates": [...]}}. Estimates use the replicates of the studies named in `main` that are not
    crystalline and reached their goal."""

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
        """Δφ of every state of every replicate by a choice of φ_J. A failed choice is replaced by the first, so that
        choices are compared over the same replicates."""
        return [[x - chosen(found, choice) for x in replicate["states"]["phi"]] for replicate, found in zip(
            self.counted(solid, particles), self.densities(solid, particles))]

    def phi_j(self, solid, particles):
        """Estimate of φ_J, with half the range over fits as systematic error."""
        found = self.densities(solid, particles)
        if not found:
            return None
        choices = [estimate_of([chosen(f, i) for f in found]) for i in range(CHOICES)]
        return of_choices(choices[0], choices[1:])

    def column(self, solid, particles, name):
        """Values of the states of every replicate; None for a replicate without this column."""
        return [r["states"].get(name) for r in self.counted(solid, particles)]

    def paths(self, solid, particles, name, choice=0):
        """(Δφ, values) of every replicate with this column."""
        return [(x, y) for x, y in zip(self.distances(solid, particles, choice), self.column(solid, particles, name))
                if y is not None]

    def nearest(self, solid, particles, name):
        """Estimate in the nearest states."""
        return estimate_of([y[-1] for y in self.column(solid, particles, name) if y])

    def at(self, solid, particles, name, distance):
        """Estimate at a distance from jamming, interpolated between the two states around it."""
        return estimate_of([at(x, y, distance) for x, y in self.paths(solid, particles, name)])

    def nearest_distance(self, solid, particles):
        return estimate_of([x[-1] for x in self.distances(solid, particles)])

    def slopes(self, solid, particles, name, edges):
        """Local exponents in Δφ by bin, with the effect of the choice of φ_J as systematic error."""
        choices = [local_slopes(self.paths(solid, particles, name, i), edges) for i in range(CHOICES)]
        return [of_choices(central, [choice[i] for choice in choices[1:]]) for i, central in enumerate(choices[0])]
