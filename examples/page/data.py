"""Replicates of studies by solid and size, and estimates over them as functions of Δφ.

All means use one rule: they leave out failed replicates, and those with a flag that the program excludes by its key
`exclude`. This is the rule of `isojam aggregate`."""

import functools
import json
import math

from estimates import estimate_of, of_choices
from scaling import at, binned, jamming_density, slopes

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
PLURALS = {solid: solid.replace("hedron", "hedra") for solid in SOLIDS}
# Studies of one question each. Means over Platonic solids do not use them.
NEGATIVE, EMERGENCE, SOLIDS_64, LARGE = "paper-unstable", "paper-emergence", "rigidity-solids", "paper-4000"
CONSTRAINTS = ("rigidity-constraints", "rigidity-constraints-tetrahedra")
# Packings of 100 particles by other preparations.
LINE = ("rigidity-line", "rigidity-line-dense", "rigidity-line-cohesion", "rigidity-line-cycles")
APART = (NEGATIVE, EMERGENCE, SOLIDS_64, LARGE, *CONSTRAINTS, *LINE)
CHOICES = (1, 2, 4)  # factors of the fit window of φ_J, whose effect is the systematic error of exponents


def each(states, names, function):
    """A column from others. It is None where one of them is missing, and absent if a column is."""
    if any(name not in states for name in names):
        return None
    return [function(*values) if None not in values else None for values in zip(*(states[name] for name in names))]


def longest_wave(shear_modulus, density, particles):
    """Frequency 2π/L·√(G/ρφ) of the longest transverse wave in a cubic cell with V_p = ρ = 1."""
    return 2 * math.pi * (density / particles) ** (1 / 3) * math.sqrt(shear_modulus / density)


def derived(states, particles):
    """Columns per particle, and quotients of columns."""
    def quotient(a, b):
        return a / b if b and b > 0 else None

    made = {f"missing{of}": each(states, [f"floppy{of}"], lambda floppy: (floppy - 3) / particles)
            for of in ("", "_half", "_double", "_normals", "_trough")}
    made |= {f"redundant{of}": each(states, [f"self_stress{of}"], lambda stress: stress / particles)
             for of in ("", "_half", "_double", "_trough")}
    made |= {f"stiff_tilts_{name}": each(states, [f"contacts_{name}", f"tilts_{name}"],
                                         lambda n, tilts: tilts / n if n else None) for name in ("ff", "ef", "l")}
    made |= {f"{name}_each": each(states, [name], lambda n: n / particles)
             for name in ("held_by_second", "prestress_3", "prestress_10", "prestress_30")}
    made["unresolved_each"] = each(states, ["zero"], lambda zero: (zero - 3) / particles)
    made |= {f"root_{name}": each(states, [name], lambda x: math.sqrt(x) if x > 0 else None) for name in ("G", "K")}
    made["omega_over_root_G"] = each({**states, **made}, ["omega_l", "root_G"], quotient)
    made["omega_over_root_K"] = each({**states, **made}, ["omega_l", "root_K"], quotient)
    made["participating"] = each(states, ["p_h"], lambda share: share * particles)
    made["wave"] = each(states, ["omega_l", "G", "phi"], lambda w, g, phi: w / longest_wave(g, phi, particles)
                        if g > 0 else None)
    return {name: values for name, values in made.items() if values is not None}


class Data:
    """Studies of one or more data files, {name: {"replicates": [...], "exclude": [...], ...}}. See gather.py."""

    def __init__(self, *files):
        self.studies = {}
        for file in files:
            with open(file, encoding="utf-8") as stream:
                self.studies |= json.load(stream)
        self.add_derived()

    def add_derived(self):
        for study in self.studies.values():
            for r in study["replicates"]:
                if "states" in r:
                    r["states"] |= derived(r["states"], r["particles"])

    def main(self):
        return [study for name, study in self.studies.items() if name not in APART]

    def kept_of(self, name, solid):
        """Replicates of one study that means use."""
        study = self.studies.get(name, {"replicates": (), "exclude": ()})
        return [r for r in study["replicates"] if r["solid"] == solid and r["status"] == "done"
                and not set(study["exclude"]) & set(r["flags"])]

    def nearest_of(self, name, solid, column):
        """Estimate over the states nearest jamming of one study."""
        return estimate_of([r["states"][column][-1] for r in self.kept_of(name, solid) if column in r["states"]])

    def all_of(self, solid, particles):
        return [r for study in self.main() for r in study["replicates"]
                if r["solid"] == solid and r["particles"] == particles]

    def sizes(self, solid):
        return sorted({r["particles"] for study in self.main() for r in study["replicates"] if r["solid"] == solid})

    @functools.cache
    def kept(self, solid, particles):
        """Replicates that means use."""
        return [r for study in self.main() for r in study["replicates"]
                if (r["solid"], r["particles"], r["status"]) == (solid, particles, "done")
                and not set(study["exclude"]) & set(r["flags"])]

    def phi_j(self, solid, particles):
        return estimate_of([r["phi_j"] for r in self.kept(solid, particles)])

    @functools.cache
    def distances(self, solid, particles, factor=1):
        """Δφ of every state of every replicate. With a factor, φ_J is fitted in a window that is larger by it."""
        found = []
        for r in self.kept(solid, particles):
            phi, phi_j = r["states"]["phi"], r["phi_j"]
            if factor != 1 and "fit_window" in r:
                wider = jamming_density(phi, r["states"]["E"], phi_j, (0, factor * r["fit_window"]))
                phi_j = phi_j if wider is None else wider
            found.append([x - phi_j for x in phi])
        return found

    def paths(self, solid, particles, name, factor=1):
        """A pair (Δφ, values) for every replicate that has this column."""
        return [(x, r["states"][name]) for x, r in zip(self.distances(solid, particles, factor),
                                                       self.kept(solid, particles)) if name in r["states"]]

    def nearest(self, solid, particles, name):
        """Estimate over the states nearest jamming."""
        return estimate_of([y[-1] for _, y in self.paths(solid, particles, name)])

    def nearest_distance(self, solid, particles):
        return estimate_of([x[-1] for x in self.distances(solid, particles)])

    def at(self, solid, particles, name, distance=None):
        """Estimate at a distance to jamming, interpolated between the two states on either side; or at the nearest."""
        if distance is None:
            return self.nearest(solid, particles, name)
        return estimate_of([at(x, y, distance) for x, y in self.paths(solid, particles, name)])

    def exponents(self, solid, particles, name, edges):
        """Local exponents in Δφ, one estimate for each bin. The systematic error comes from the fit window of φ_J."""
        choices = [binned([slopes(x, y) for x, y in self.paths(solid, particles, name, factor)], edges)
                   for factor in CHOICES]
        return [of_choices(central, [choice[i] for choice in choices[1:]]) for i, central in enumerate(choices[0])]

    @functools.cache
    def trough(self, solid, particles, distance=None):
        """Troughs of `isojam aggregate` in the angles of all replicates together, at a distance or nearest jamming; None if
        there are no angles."""
        for study in self.main():
            for entry in study.get("troughs", ()):
                if (entry["solid"], entry["particles"], entry["delta_phi"]) == (solid, particles, distance):
                    return entry
        return None

    def trough_distances(self, solid, particles):
        return sorted({entry["delta_phi"] for study in self.main() for entry in study.get("troughs", ())
                       if (entry["solid"], entry["particles"]) == (solid, particles) and entry["delta_phi"]})

    def constraints(self, solid, particles, how, distance=None):
        """C by "trough" or "fit". The systematic error is half the difference of C between both edges of the
        trough; for fits, it is half the range from half to twice the cut-offs."""
        if how == "trough":
            found = self.trough(solid, particles, distance)
            if not found or not found.get("C"):
                return None
            return {**found["C"], "systematic": (found["C_high"]["mean"] - found["C_low"]["mean"]) / 2}
        found = self.at(solid, particles, "C", distance)
        half, double = (self.at(solid, particles, f"C_{of}", distance) for of in ("half", "double"))
        if found and half and double:
            found = {**found, "systematic": (double["mean"] - half["mean"]) / 2}
        return found

    def cluster(self, solid):
        """(N, face-face cluster with the largest extent) for the largest N that has one; None without."""
        found = [(int(name.split()[1]), one) for study in self.main() for name, one in study.get("clusters", {}).items()
                 if name.split()[0] == solid]
        return max(found, key=lambda pair: pair[0], default=None)

    def minima(self, solid, particles):
        """States nearest jamming that are minima with three zero modes: by all particles, by the backbone of the others,
        and the number of states."""
        whole = backbone = 0
        kept = self.kept(solid, particles)
        for r in kept:
            last = {name: values[-1] for name, values in r["states"].items()}
            if (last.get("zero"), last.get("negative")) == (3, 0):
                whole += 1
            elif (last.get("backbone_zero"), last.get("backbone_negative")) == (3, 0):
                backbone += 1
        return whole, backbone, len(kept)
