"""φ_J of each replicate, and estimates over replicates as functions of Δφ."""

import functools

from estimates import estimate_of, of_choices
from scaling import at, free_exponent, jamming_density, local_slopes

LEFT_OUT = {"crystalline", "goal_not_reached"}
# Windows of φ − φ_J in which φ_J is fitted, smallest first. The first window with at least ENOUGH states gives φ_J. The
# next two contribute to its systematic error.
WINDOWS = ((0, 0.0025), (0, 0.005), (0, 0.01), (0, 0.02))
ENOUGH = 4
CHOICES = 4  # fits of φ_J: three windows and a free exponent


def densities(replicate):
    """A list of fitted φ_J of a replicate: from the first three windows with enough states, then with a free exponent
    in the last of these windows. A failed fit is None; if the first fit fails, the φ_J of the record replaces it. If no
    window has enough states, the list contains only the φ_J of the record."""
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
    """Replicates of several studies, {name: {"replicates": [...]}}. Estimates use only studies that are named in
    `main`, and only replicates without a flag of LEFT_OUT."""

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
        """Δφ of every state of every replicate, measured from the fitted φ_J with the number `choice`. If this fit
        failed, the first fit replaces it, so that all choices use the same replicates."""
        return [[x - chosen(found, choice) for x in replicate["states"]["phi"]] for replicate, found in zip(
            self.counted(solid, particles), self.densities(solid, particles))]

    def phi_j(self, solid, particles):
        """Estimate of φ_J. Its systematic error is half the range over the fits."""
        found = self.densities(solid, particles)
        if not found:
            return None
        choices = [estimate_of([chosen(f, i) for f in found]) for i in range(CHOICES)]
        return of_choices(choices[0], choices[1:])

    def column(self, solid, particles, name):
        """For every replicate the list of values of its states, or None if it does not have this column."""
        return [r["states"].get(name) for r in self.counted(solid, particles)]

    def paths(self, solid, particles, name, choice=0):
        """(list of Δφ, list of values) of every replicate that has this column."""
        return [(x, y) for x, y in zip(self.distances(solid, particles, choice), self.column(solid, particles, name))
                if y is not None]

    def nearest(self, solid, particles, name):
        """Estimate over the nearest states of all replicates."""
        return estimate_of([y[-1] for y in self.column(solid, particles, name) if y])

    def at(self, solid, particles, name, distance):
        """Estimate at a distance from jamming, interpolated between the two states around it."""
        return estimate_of([at(x, y, distance) for x, y in self.paths(solid, particles, name)])

    def nearest_distance(self, solid, particles):
        return estimate_of([x[-1] for x in self.distances(solid, particles)])

    def slopes(self, solid, particles, name, edges):
        """Local exponents in Δφ for each bin. Their systematic error is half the range over the fits of φ_J."""
        choices = [local_slopes(self.paths(solid, particles, name, i), edges) for i in range(CHOICES)]
        return [of_choices(central, [choice[i] for choice in choices[1:]]) for i, central in enumerate(choices[0])]
