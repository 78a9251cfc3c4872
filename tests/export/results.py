"""Reads a results directory without isojam, for comparison with exported files."""

import json
import pathlib

import numpy

FLOAT = numpy.finfo(numpy.float32).eps
DOUBLE = numpy.finfo(numpy.float64).eps


class State:
    """One packing: N, side L, positions (N, 3), unit quaternions (w, x, y, z) (N, 4), and delta_phi, which may be
    None."""

    def __init__(self, packing, delta_phi):
        self.solid = packing["solid"]
        self.side = packing["side"]
        self.density = packing["density"]
        self.delta_phi = delta_phi
        self.positions = numpy.array(packing["positions"])
        quaternions = numpy.array(packing["orientations"])
        self.quaternions = quaternions / numpy.linalg.norm(quaternions, axis=1)[:, None]
        self.n = len(self.positions)


def names(results):
    return sorted(path.stem for path in pathlib.Path(results, "records").glob("*.json"))


def record(results, name):
    return json.loads(pathlib.Path(results, "records", name + ".json").read_text())


def nearest_of(document):
    return document["states"][document["nearest"]]


def nearest(results, name):
    """A list with the nearest state."""
    packing = json.loads(pathlib.Path(results, "packings", name + ".json").read_text())
    return [State(packing, nearest_of(record(results, name))["delta_phi"])]


def path(results, name):
    """All states, in the order of decompression."""
    states = json.loads(pathlib.Path(results, "paths", name + ".json").read_text())["states"]
    return [State(state, state["delta_phi"]) for state in states]


def measured(results, name, whole_path):
    """The values of these states in the record."""
    document = record(results, name)
    return document["states"] if whole_path else [nearest_of(document)]


def rotation(quaternions):
    """Rotation matrices (N, 3, 3) of unit quaternions (w, x, y, z)."""
    w, x, y, z = numpy.asarray(quaternions, dtype=float).T
    return numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]).transpose(2, 0, 1)


def distances(positions, side):
    """Distances of all pairs to the nearest periodic image."""
    difference = positions[:, None, :] - positions[None, :, :]
    difference -= side * numpy.round(difference / side)
    return numpy.linalg.norm(difference, axis=2)


def clusters_of(labels):
    """Labels of clusters as in exported files: a particle without a face-face contact has a label in the record, and −1
    here."""
    labels = numpy.asarray(labels)
    sizes = numpy.bincount(labels)
    return numpy.where(sizes[labels] > 1, labels, -1)


def moments(vertices, faces):
    """Volume of a polyhedron and the integral of |x|² over it, from tetrahedra with a vertex at the origin. Both are
    negative if faces are oriented inwards."""
    volume = second = 0.0
    for face in faces:
        a = vertices[face[0]]
        for b, c in zip(vertices[face[1:-1]], vertices[face[2:]]):
            v = numpy.dot(a, numpy.cross(b, c)) / 6
            volume += v
            second += v / 10 * (a @ a + b @ b + c @ c + a @ b + b @ c + c @ a)
    return volume, second


def read_obj(file):
    """Vertices (V, 3), and faces as lists of indices of vertices from 0."""
    vertices, faces = [], []
    for line in pathlib.Path(file).read_text().splitlines():
        words = line.split()
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:]])
        elif words[0] == "f":
            faces.append([int(word) - 1 for word in words[1:]])
    return numpy.array(vertices), faces
