"""Packings: particles, their cell and their solids."""

import dataclasses
import os
from collections.abc import Callable
from typing import Any

import numpy
from numpy.typing import NDArray

from .errors import InputError
from .files import reading

Floats = NDArray[numpy.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Solid:
    """A convex polyhedron of unit volume. Its centroid is the origin of the body frame.

    vertices  (V, 3)
    faces     for each face, a list of indices of vertices, counter-clockwise seen from outside"""

    name: str
    vertices: Floats
    faces: list[list[int]]

    def __repr__(self) -> str:
        return f"<{self.name}: {len(self.vertices)} vertices, {len(self.faces)} faces>"


class Packing:
    """One packing of a replicate, in one state.

    name          name of the replicate
    delta_phi     φ − φ_J; NaN if there is no φ_J
    density       density φ
    cell          (3, 3): the lattice vectors as rows, in units of V_p^(1/3)
    side          side of the cell; None if the cell is not a cube
    positions     (N, 3): centres, not wrapped into the cell
    orientations  (N, 4): quaternions (w, x, y, z) that rotate the body frame into the lab frame; |q| = 1 within rounding
    kind          (N,): index of the solid of each particle in `solids`
    size          (N,): each particle is its solid, scaled in length by this number
    solid_names   names of the elements of `solids`

    Coordinates are double-doubles. The arrays above are the nearest doubles; `cell_low`, `positions_low` and
    `orientations_low` contain the remainders."""

    def __init__(self, name: str, document: dict[str, Any], delta_phi: float | None, shapes: Callable[[], dict[str, Solid]],
                 file: str | os.PathLike[str], place: str = "") -> None:
        """Makes a packing from the JSON at `place` in a file. `shapes()` returns the solids of the replicate by name."""
        self.name, self._shapes = name, shapes

        def array(key: str, *shape: int, kinds: str = "if") -> Any:
            numbers = " by ".join(map(str, shape)) + " numbers" if shape else "a number"
            with reading(file, numbers, f"{place}/{key}"):
                found = numpy.array(document[key])
                if found.shape != shape or found.dtype.kind not in kinds or not numpy.isfinite(found).all():
                    raise InputError(file, f"{place}/{key}", "not the numbers that belong here", numbers)
                return found.astype(float if "f" in kinds else int)

        with reading(file, "a packing written by isojam", place):
            n = len(document["positions"])
            mixed = "kinds" in document
            self.solid_names = tuple(str(one["solid"]) for one in (document["kinds"] if mixed else [document]))
        self.delta_phi = numpy.nan if delta_phi is None else float(delta_phi)
        self.density = float(array("density"))
        self.positions: Floats = array("positions", n, 3)
        self.positions_low: Floats = array("positions_low", n, 3)
        self.orientations: Floats = array("orientations", n, 4)
        self.orientations_low: Floats = array("orientations_low", n, 4)
        self.side = None if "cell" in document else float(array("side"))
        if self.side is None:
            self.cell: Floats = array("cell", 3, 3)
            self.cell_low: Floats = array("cell_low", 3, 3)
        else:
            self.cell = self.side * numpy.eye(3)
            self.cell_low = (array("side_low") if "side_low" in document else 0.) * numpy.eye(3)
        self.kind: NDArray[numpy.int_] = array("kind", n, kinds="i") if mixed else numpy.zeros(n, dtype=int)
        self.size: Floats = array("size", n) if mixed else numpy.ones(n)
        if not ((self.kind >= 0) & (self.kind < len(self.solid_names))).all():
            raise InputError(file, f"{place}/kind", "a particle has an unknown kind", "indices of elements of kinds")

    def __len__(self) -> int:
        """Number of particles."""
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<{self.name}: {len(self)} particles, density {self.density:.6g}, delta_phi {self.delta_phi:.3g}>"

    @property
    def solids(self) -> tuple[Solid, ...]:
        """The Solid of each kind of particle, with unit volume. The first access calls the program."""
        shapes = self._shapes()
        return tuple(shapes[name] for name in self.solid_names)

    def rotations(self) -> Floats:
        """(N, 3, 3): matrices that rotate the body frame of each particle into the lab frame."""
        w, x, y, z = (self.orientations / numpy.linalg.norm(self.orientations, axis=1)[:, None]).T
        return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)

    def corners(self, particle: int) -> Floats:
        """(V, 3): the vertices of one particle in the lab frame."""
        vertices = self.size[particle] * self.solids[self.kind[particle]].vertices
        corners: Floats = self.positions[particle] + vertices @ self.rotations()[particle].T
        return corners
