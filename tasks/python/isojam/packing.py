"""Packings: particles, their cell and their solids."""

import functools

import numpy

from .errors import InputError


class Packing:
    """One state of a replicate.

    name          of the replicate
    delta_phi     φ − φ_J
    phi           density
    cell          (3, 3): its rows are the lattice vectors, in V_p^(1/3); side times the unit matrix in a cube
    side          of a cube, None for a cell that has given way
    positions     (N, 3) centres, not wrapped into the cell
    orientations  (N, 4) quaternions (w, x, y, z) that turn the body frame into the lab frame, |q| = 1 to rounding
    kind          (N,) index into solids
    size          (N,) length of a particle over that of its solid of unit volume
    solid_names   of the kinds

    Coordinates are double-doubles: what stands above is the nearest double, and cell_low, positions_low and
    orientations_low are what is missing."""

    def __init__(self, name, document, file, place, delta_phi, shapes):
        """From the JSON of a packing, which stands at that place of a file. `shapes()` gives the replicate's solids by
        name."""
        self.name, self.delta_phi = name, delta_phi
        self._document, self._file, self._place, self._shapes = document, file, place, shapes
        self.phi = float(self._at("phi"))
        n = len(self._at("positions"))
        self.positions = self._array("positions", (n, 3))
        self.orientations = self._array("orientations", (n, 4))
        self.side = None if "cell" in document else float(self._at("side"))
        self.cell = self._array("cell", (3, 3)) if self.side is None else self.side * numpy.eye(3)
        if "kinds" in document:
            self.solid_names = tuple(kind["solid"] for kind in self._at("kinds"))
            self.kind, self.size = self._array("kind", (n,), int), self._array("size", (n,))
        else:
            self.solid_names = (self._at("solid"),)
            self.kind, self.size = numpy.zeros(n, dtype=int), numpy.ones(n)

    def __len__(self):
        """N."""
        return len(self.positions)

    def __repr__(self):
        return f"<{self.name}: {len(self)} particles, phi {self.phi:.6g}, delta_phi {self.delta_phi:.3g}>"

    @functools.cached_property
    def positions_low(self):
        return self._array("positions_low", (len(self), 3))

    @functools.cached_property
    def orientations_low(self):
        return self._array("orientations_low", (len(self), 4))

    @functools.cached_property
    def cell_low(self):
        if self.side is None:
            return self._array("cell_low", (3, 3))
        return float(self._document.get("side_low", 0)) * numpy.eye(3)

    @functools.cached_property
    def solids(self):
        """The Solid of every kind, of unit volume, asked of the program."""
        shapes = self._shapes()
        return tuple(shapes[name] for name in self.solid_names)

    def rotations(self):
        """(N, 3, 3) matrices that turn body frames into the lab frame."""
        w, x, y, z = (self.orientations / numpy.linalg.norm(self.orientations, axis=1)[:, None]).T
        return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)

    def corners(self, particle):
        """(V, 3): the vertices of one particle where it stands."""
        vertices = self.size[particle] * self.solids[self.kind[particle]].vertices
        return self.positions[particle] + vertices @ self.rotations()[particle].T

    def _at(self, key):
        if key not in self._document:
            raise InputError(self._file, self._place + "/" + key, "is missing", "a packing as isojam wrote it")
        return self._document[key]

    def _array(self, key, shape, kind=float):
        try:
            array = numpy.array(self._at(key), dtype=kind)
        except (TypeError, ValueError):
            array = numpy.empty(0)
        if array.shape != shape:
            raise InputError(self._file, self._place + "/" + key, "is no such list of numbers",
                             " by ".join(map(str, shape)) + " numbers")
        return array
