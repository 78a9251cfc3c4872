"""Shapes of solids, read from files of the program."""

import dataclasses
import os
import pathlib

import numpy
from numpy.typing import NDArray

from .errors import InputError


@dataclasses.dataclass(frozen=True)
class Solid:
    """A convex polyhedron of unit volume. Its centroid is the origin of the body frame.

    vertices  (V, 3)
    faces     for each face, a list of indices of vertices, counter-clockwise seen from outside"""

    name: str
    vertices: NDArray[numpy.float64]
    faces: list[list[int]]

    def __repr__(self) -> str:
        return f"<{self.name}: {len(self.vertices)} vertices, {len(self.faces)} faces>"


def read_obj(file: str | os.PathLike[str]) -> Solid:
    """Reads the solid in a Wavefront OBJ file that `isojam export --format xyz` wrote."""
    name = ""
    vertices: list[list[float]] = []
    faces: list[list[int]] = []
    for number, line in enumerate(pathlib.Path(file).read_text().splitlines(), 1):
        what, *words = line.split() or ["#"]
        try:
            if what == "o":
                name, = words
            elif what == "v":
                vertices.append([float(word) for word in words])
            elif what == "f":
                faces.append([int(word) - 1 for word in words])
        except ValueError:
            raise InputError(file, f"line {number}", f'"{line}" cannot be read',
                             "o NAME, v X Y Z or f V V V…") from None
    return Solid(name, numpy.array(vertices).reshape(-1, 3), faces)
