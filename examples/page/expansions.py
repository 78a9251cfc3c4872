"""Replicates of studies, state by state against Δφ: the φ_J of each, and estimates over them."""

import functools

from estimates import estimate_of, of_choices
from scaling import at, free_exponent, jamming_density, local_slopes

LEFT_OUT = {"crystalline", "goal_not_reached"}
# Fit windows for φ_J, nearest first. The first with enough states is used; the next two show the effect of this choice.
WINDOWS = ((0, 0.0025), (0, 0.005), (0, 0.01), (0, 0.02))
ENOUGH = 4
CHOICES = 4  # of φ_J: three windows and a free exponent


def densities(replicate):
    """φ_J of a replicate by the nearest windows that hold enough states, at most three, then with a free exponent over
    the last of these; the record's own if none does. None where a fit cannot be had."""
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
    """Studies, {name: {"replicates": [...]}}, of which those named `main` count. Nothing in them that is counted is
    crystalline or short of its goal."""

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
        """Δφ of every state of every replicate, by that choice of φ_J, or by the first where it gives none: choices are
        compared over the same replicates."""
        return [[x - chosen(found, choice) for x in replicate["states"]["phi"]] for replicate, found in zip(
            self.counted(solid, particles), self.densities(solid, particles))]

    def phi_j(self, solid, particles):
        """With half the range over fits as systematic error."""
        found = self.densities(solid, particles)
        if not found:
            return None
        choices = [estimate_of([chosen(f, i) for f in found]) for i in range(CHOICES)]
        return of_choices(choices[0], choices[1:])

    def column(self, solid, particles, name):
        """Values of the states of every replicate; None for a replicate without this column."""
        return [r["states"].get(name) for r in self.counted(solid, particles)]

    def paths(self, solid, particles, name, choice=0):
        """(Δφ, values) of every replicate that has them."""
        return [(x, y) for x, y in zip(self.distances(solid, particles, choice), self.column(solid, particles, name))
                if y is not None]

    def nearest(self, solid, particles, name):
        """In the states nearest jamming."""
        return estimate_of([y[-1] for y in self.column(solid, particles, name) if y])

    def at(self, solid, particles, name, distance):
        """Between the two states around that distance from jamming."""
        return estimate_of([at(x, y, distance) for x, y in self.paths(solid, particles, name)])

    def nearest_distance(self, solid, particles):
        return estimate_of([x[-1] for x in self.distances(solid, particles)])

    def slopes(self, solid, particles, name, edges):
        """Local exponents in Δφ by bin, with what the choice of φ_J does as systematic error."""
        choices = [local_slopes(self.paths(solid, particles, name, i), edges) for i in range(CHOICES)]
        return [of_choices(central, [choice[i] for choice in choices[1:]]) for i, central in enumerate(choices[0])]
