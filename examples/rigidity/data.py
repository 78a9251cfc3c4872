"""Data of the blocks: replicates of our studies by solid and size."""

import json
import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from expansions import Expansions  # noqa: E402

COMMITTED = HERE / "data"
SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
SIZES = (50, 64, 100, 200, 400, 800)  # tetrahedra of 64 beside the others of 50


class Data(Expansions):
    """Records of a directory. Derived columns are made as they are read."""

    def __init__(self, directory):
        with open(directory / "records.json", encoding="utf-8") as file:
            studies = json.load(file)
        super().__init__(studies, tuple(studies))
        for study in studies.values():
            for replicate in study["replicates"]:
                if replicate["status"] == "done":
                    replicate["states"] |= derived(replicate["states"], replicate["particles"])

    def sizes(self, solid):
        return [n for n in SIZES if self.counted(solid, n)]


def each(states, names, function):
    """Applies the function to the values of these columns in every state; None where one of them is None."""
    columns = [states.get(name) for name in names]
    if None in columns:
        return None
    return [None if None in values else function(*values) for values in zip(*columns)]


def longest_wave(shear, phi, particles):
    """ω of the longest shear wave of the cell in an elastic medium: 2π/L · √(G/φ), with N = φL³ and m = V_p = 1."""
    return 2 * math.pi * (phi / particles) ** (1 / 3) * math.sqrt(shear / phi)


def derived(states, particles):
    """Columns that are computed from others."""
    soft = ["omega_l", "G", "K"]

    def where_all_are(function):
        """Uses only states with all quantities, so that exponents of quotients are differences of exponents."""
        return each(states, soft, lambda w, g, k: function(w, g, k) if min(w, g, k) > 0 else None)

    def per_particle(name):
        return each(states, [name], lambda n: n / particles)

    made = {
        **{f"missing{of}": each(states, [name], lambda floppy: (floppy - 3) / particles)
           for of, name in (("", "floppy_classes"), ("_half", "floppy_half"), ("_double", "floppy_double"),
                            ("_normals", "floppy_normals"))},
        **{f"{name}_each": per_particle(name) for name in (
            "second", "second_0.1", "second_0.01", "prestress", *(f"prestress_{t}" for t in (1, 3, 10, 30, 100)),
            "self_stress", "self_stress_half", "self_stress_double")},
        **{f"tilts_each_{name}": each(states, [f"contacts_{name}", f"tilts_{name}"], lambda n, t: t / n if n else None)
           for name in ("ff", "ef", "l")},
        "gap": each(states, ["least_kept", "largest_dropped"], lambda kept, off: kept / off if off else None),
        "soft": where_all_are(lambda w, g, k: w),
        "root_G": where_all_are(lambda w, g, k: g ** 0.5),
        "root_K": where_all_are(lambda w, g, k: k ** 0.5),
        "omega_over_root_G": where_all_are(lambda w, g, k: w / g ** 0.5),
        "omega_over_root_K": where_all_are(lambda w, g, k: w / k ** 0.5),
        "wave": each(states, ["omega_l", "G", "phi"], lambda w, g, phi: w / longest_wave(g, phi, particles)
                     if min(w, g) > 0 else None),
        "G_over_K": each(states, ["G", "K"], lambda shear, bulk: shear / bulk if bulk > 0 else None),
        "prestress_share": each(states, ["normal_share", "tilt_share"], lambda n, t: 1 - n - t)}
    return {name: values for name, values in made.items() if values is not None}
