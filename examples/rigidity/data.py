"""What the blocks are made from: replicates of our studies by solid and size."""

import json
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
    """function of the values of these columns in every state; None where one of them is."""
    columns = [states.get(name) for name in names]
    if None in columns:
        return None
    return [None if None in values else function(*values) for values in zip(*columns)]


def derived(states, particles):
    """Columns that are made from others."""
    made = {
        "missing": each(states, ["floppy_classes"], lambda floppy: (floppy - 3) / particles),
        "G_over_K": each(states, ["G", "K"], lambda shear, bulk: shear / bulk if bulk > 0 else None),
        "root_G": each(states, ["G"], lambda shear: shear ** 0.5 if shear > 0 else None),
        "root_K": each(states, ["K"], lambda bulk: bulk ** 0.5 if bulk > 0 else None),
        "omega_over_root_G": each(states, ["omega_l", "G"], lambda w, g: w / g ** 0.5 if g > 0 and w > 0 else None),
        "omega_over_root_K": each(states, ["omega_l", "K"], lambda w, k: w / k ** 0.5 if k > 0 and w > 0 else None),
        "second_each": each(states, ["second"], lambda n: n / particles),
        "prestress_each": each(states, ["prestress"], lambda n: n / particles),
        "floppy_each": each(states, ["floppy"], lambda n: n / particles),
        "quartic_each": each(states, ["quartic"], lambda n: n / particles),
        "quartic_share": each(states, ["quartic", "floppy"], lambda n, of: n / of if of else None),
        "redundant_each": each(states, ["self_stress"], lambda n: n / particles),
        "prestress_share": each(states, ["normal_share", "tilt_share"], lambda n, t: 1 - n - t)}
    return {name: values for name, values in made.items() if values is not None}
