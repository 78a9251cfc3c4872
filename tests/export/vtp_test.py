"""Tests VTP and PVD files with VTK as their reader."""

import itertools
import xml.etree.ElementTree

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import check
import results

CLASSES = {"none": 0, "lower_order": 1, "edge_face": 2, "face_face": 3}


def read(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def arrays_of(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


class Picture:
    """The content of a file as arrays: corners (N, V, 3), faces (lists of corners) of each particle, cell and field
    data."""

    def __init__(self, file, n):
        self.data = read(file)
        points = vtk_to_numpy(self.data.GetPoints().GetData())
        self.corners = points.reshape(n, -1, 3)
        self.cell = arrays_of(self.data.GetCellData())
        self.field = arrays_of(self.data.GetFieldData())
        polygons = self.data.GetPolys()
        corners = vtk_to_numpy(polygons.GetConnectivityArray())
        offsets = vtk_to_numpy(polygons.GetOffsetsArray())
        self.faces = [[] for _ in range(n)]
        for f, particle in enumerate(self.cell["particle"]):
            own = corners[offsets[f]:offsets[f + 1]] - particle * self.corners.shape[1]
            self.faces[particle].append(list(own))
        self.centres = self.corners.mean(axis=1)  # of a Platonic solid

    def normals(self, particle):
        corners = self.corners[particle]
        normals = [numpy.cross(corners[f[1]] - corners[f[0]], corners[f[2]] - corners[f[1]])
                   for f in self.faces[particle]]
        return numpy.array([normal / numpy.linalg.norm(normal) for normal in normals])

    def edges(self, particle):
        pairs = {tuple(sorted(pair)) for f in self.faces[particle] for pair in zip(f, f[1:] + f[:1])}
        return numpy.array([self.corners[particle][a] - self.corners[particle][b] for a, b in sorted(pairs)])


def apart(a, b, normals, edges_a, edges_b):
    """True if the normal of a face, or a common perpendicular of two edges, separates the corners."""
    crosses = numpy.cross(edges_a[:, None, :], edges_b[None, :, :]).reshape(-1, 3)
    lengths = numpy.linalg.norm(crosses, axis=1)
    keep = lengths > 1e-9 * lengths.max()  # parallel edges have no common perpendicular; normals see to them
    axes = numpy.vstack([normals, crosses[keep] / lengths[keep, None]])
    on_a, on_b = axes @ a.T, axes @ b.T
    return bool(((on_a.max(axis=1) < on_b.min(axis=1)) | (on_b.max(axis=1) < on_a.min(axis=1))).any())


def count_contacts(picture, translations):
    """Number of contacts of each particle, including contacts with these images."""
    n = len(picture.corners)
    reach = 2 * numpy.linalg.norm(picture.corners[0] - picture.centres[0], axis=1).max()
    normals = [picture.normals(i) for i in range(n)]
    edges = [picture.edges(i) for i in range(n)]
    counts = numpy.zeros(n, dtype=int)
    for i, j in itertools.combinations(range(n), 2):
        between = picture.centres[j] - picture.centres[i]
        near = translations[numpy.linalg.norm(between + translations, axis=1) < reach]
        for shift in near:
            if not apart(picture.corners[i], picture.corners[j] + shift, numpy.vstack([normals[i], normals[j]]),
                         edges[i], edges[j]):
                counts[[i, j]] += 1
    return counts


class Vtp(check.RoundTrip):
    def files(self):
        for stem, states, measured, whole in self.cases():
            for k, (state, values) in enumerate(zip(states, measured)):
                file = f"{stem}_{k:04}.vtp" if whole else f"{stem}.vtp"
                yield file, Picture(file, state.n), state, values

    def test_surfaces_are_closed_and_wound_outwards(self):
        for _, picture, state, _ in self.files():
            self.assertEqual(picture.data.GetNumberOfPolys(), picture.data.GetNumberOfCells())
            for i in range(state.n):
                directed = [pair for f in picture.faces[i] for pair in zip(f, f[1:] + f[:1])]
                self.assertEqual(len(set(directed)), len(directed))
                self.assertEqual({(b, a) for a, b in directed}, set(directed), "each edge once in either direction")
                volume, _ = results.moments(picture.corners[i] - picture.centres[i], picture.faces[i])
                self.assert_near(volume, 1, 1000 * results.DOUBLE * state.side, f"volume of particle {i}")

    def test_places_and_orientations(self):
        for file, picture, state, _ in self.files():
            tolerance = 16 * results.DOUBLE * state.side
            self.assertGreaterEqual(picture.centres.min(), -tolerance)
            self.assertLess(picture.centres.max(), state.side + tolerance)
            self.assert_near(results.distances(picture.centres, state.side),
                             results.distances(state.positions, state.side), tolerance, "distances")
            stem = file.replace(".vtp", "").rsplit("_", 1)[0]
            vertices, faces = results.read_obj(stem + ".obj")
            self.assert_near(picture.corners - picture.centres[:, None, :],
                             numpy.einsum("nij,vj->nvi", results.rotation(state.quaternions), vertices), tolerance,
                             "vertices about the centre")
            for i in range(state.n):
                self.assertEqual(picture.faces[i], faces, f"particle {i}")

    def test_data(self):
        for _, picture, state, _ in self.files():
            for key, value in (("side", state.side), ("density", state.density), ("delta_phi", state.delta_phi)):
                self.assertEqual(list(picture.field[key]), [value])
            per_particle = len(picture.faces[0])
            self.assert_near(picture.cell["particle"], numpy.repeat(range(state.n), per_particle), 0, "particle")
            for key in ("Z", "cluster"):
                rows = picture.cell[key].reshape(state.n, per_particle)
                self.assertTrue((rows == rows[:, :1]).all(), key)
            touched = (picture.cell["contact_class"].reshape(state.n, -1) != CLASSES["none"]).any(axis=1)
            self.assertEqual(list(touched), list(picture.cell["Z"][::per_particle] > 0))

    def test_collections(self):
        for stem, states, _, whole in self.cases():
            if not whole:
                continue
            listed = xml.etree.ElementTree.parse(f"{stem}.pvd").getroot().findall("Collection/DataSet")
            names = [entry.get("file") for entry in listed]
            there = sorted(path.name for path in stem.parent.glob(stem.name + "_*.vtp"))
            self.assertEqual(names, there)
            self.assertEqual([float(entry.get("timestep")) for entry in listed], [state.delta_phi for state in states])


if __name__ == "__main__":
    check.main()
