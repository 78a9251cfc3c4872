"""Packings: particles, their cell and their solids."""

import functools
import os
from collections.abc import Callable
from typing import Any

import numpy
from numpy.typing import NDArray

from .errors import InputError
from .files import reading
from .rows import Array
from .solid import Solid

Floats = NDArray[numpy.float64]


class Packing:
    """One packing of a replicate, in one state.

    name          name of the replicate
    delta_phi     φ − φ_J
    phi           density φ
    cell          (3, 3): the lattice vectors as rows, in units of V_p^(1/3)
    side          side of the cell; None if the cell is not a cube
    positions     (N, 3): centres, not wrapped into the cell
    orientations  (N, 4): quaternions (w, x, y, z) that rotate the body frame into the lab frame; |q| = 1 within rounding
    kind          (N,): index of the solid of each particle in `solids`
    size          (N,): each particle is its solid, scaled in length by this number
    solid_names   names of the elements of `solids`

    Coordinates are double-doubles. The arrays above are the nearest doubles; `cell_low`, `positions_low` and
    `orientations_low` contain the remainders."""

    def __init__(self, name: str, document: dict[str, Any], file: str | os.PathLike[str], place: str,
                 shapes: Callable[[], dict[str, Solid]], delta_phi: float | None = None) -> None:
        """Makes a packing from the JSON at `place` in a file. `shapes()` returns the solids of the replicate by name.

        `delta_phi` is needed if the JSON does not contain it."""
        self.name = name
        self._document, self._file, self._place, self._shapes = document, file, place, shapes
        self.delta_phi = self._number("delta_phi") if delta_phi is None else delta_phi
        self.phi = self._number("phi")
        n = len(self._at("positions"))
        self.positions: Floats = self._array("positions", (n, 3))
        self.orientations: Floats = self._array("orientations", (n, 4))
        self.side = None if "cell" in document else self._number("side")
        self.cell: Floats = self._array("cell", (3, 3)) if self.side is None else self.side * numpy.eye(3)
        if "kinds" in document:
            self.solid_names: tuple[str, ...] = tuple(kind["solid"] for kind in self._at("kinds"))
            self.kind: NDArray[numpy.int_] = self._array("kind", (n,), int)
            self.size: Floats = self._array("size", (n,))
            if not ((self.kind >= 0) & (self.kind < len(self.solid_names))).all():
                raise InputError(file, place + "/kind", "a particle has an unknown kind", "indices of elements of kinds")
        else:
            self.solid_names = (self._at("solid"),)
            self.kind, self.size = numpy.zeros(n, dtype=int), numpy.ones(n)

    def __len__(self) -> int:
        """Number of particles."""
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<{self.name}: {len(self)} particles, phi {self.phi:.6g}, delta_phi {self.delta_phi:.3g}>"

    @functools.cached_property
    def positions_low(self) -> Floats:
        return self._array("positions_low", (len(self), 3))

    @functools.cached_property
    def orientations_low(self) -> Floats:
        return self._array("orientations_low", (len(self), 4))

    @functools.cached_property
    def cell_low(self) -> Floats:
        if self.side is None:
            return self._array("cell_low", (3, 3))
        return (self._number("side_low") if "side_low" in self._document else 0.) * numpy.eye(3)

    @functools.cached_property
    def solids(self) -> tuple[Solid, ...]:
        """The Solid of each kind of particle, with unit volume. The first access calls the program."""
        with reading(self._file):
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

    def _at(self, key: str) -> Any:
        if key not in self._document:
            raise InputError(self._file, self._place + "/" + key, "the required key is missing",
                             "a packing written by isojam")
        return self._document[key]

    def _array(self, key: str, shape: tuple[int, ...], kind: type = float) -> Array:
        expected = " by ".join(map(str, shape)) + (" integers" if kind is int else " numbers") if shape else "a number"
        with reading(self._file, expected, f"{self._place}/{key}"):
            array: Array = numpy.array(self._at(key))
            if array.shape != shape:
                raise ValueError("the list of numbers has the wrong shape")
            if array.dtype.kind not in ("i" if kind is int else "if"):
                raise TypeError("the list contains other values than numbers")
            return array.astype(kind)

    def _number(self, key: str) -> float:
        return float(self._array(key, ()))
