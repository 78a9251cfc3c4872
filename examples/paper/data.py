"""Data of the blocks: replicates of our studies, and the paper's values."""

import json
import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from expansions import Expansions  # noqa: E402

COMMITTED = HERE / "data"
SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
SIZES = (100, 400)
MAIN = ("paper-100", "paper-100-tetrahedra", "paper-400", "paper-400-tetrahedra", "paper-cubes")


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


RATIO = "omega_l/sqrt(K)"


def ratio_of(states):
    """⟨ω_l⟩/√K of every state, None where one of them is not there; None if the states have neither column."""
    if "omega_l" not in states or "K" not in states:
        return None
    return [w / math.sqrt(k) if w is not None and k is not None and k > 0 else None
            for w, k in zip(states["omega_l"], states["K"])]


class Data(Expansions):
    """Records of a directory, the search beside them, and what the paper says."""

    def __init__(self, directory):
        records = read(directory / "records.json")
        self.critical = records.pop("critical_angles")["angles"]
        super().__init__(records, MAIN)
        self.search = read(directory / "search.json")
        self.figures = read(COMMITTED / "paper.json")["figures"]

    def column(self, solid, particles, name):
        """Columns of the records, and ⟨ω_l⟩/√K."""
        if name == RATIO:
            return [ratio_of(r["states"]) for r in self.counted(solid, particles)]
        return super().column(solid, particles, name)

    def network(self, solid, particles, name):
        """For every replicate with contacts: (Δφ, the output of network.py for every state)."""
        return [(x, r["network"][name]) for x, r in zip(self.distances(solid, particles),
                                                        self.counted(solid, particles)) if "network" in r]

    def of(self, figure):
        """Our estimate of a figure of the paper; None if it was not measured."""
        solid, particles, column = figure["solid"], figure["particles"], figure["column"]
        if column == "phi_j":
            return self.phi_j(solid, particles)
        if "delta_phi" in figure:
            return self.at(solid, particles, column, figure["delta_phi"])
        return self.nearest(solid, particles, column)
