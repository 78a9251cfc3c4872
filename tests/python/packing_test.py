"""Tests packings and solids."""

import pathlib
import subprocess
import tempfile

import gsd.hoomd
import numpy

import support
from support import CUBES, EXPORTED, FREE, MIXED, isojam

import results
import xyz_test


class Exported(support.Case):
    def packings(self):
        """Every packing, with its frame in an XYZ file."""
        for directory, folder, whole in ((CUBES, "exported/nearest", False), (CUBES, "exported/path", True),
                                         (FREE, "free-exported", False)):
            for name in support.done(directory):
                study, stem = support.study(directory), EXPORTED / folder / name
                packings = study.path(name) if whole else [study.packing(name)]
                frames = xyz_test.read_frames(stem.with_name(name + ".xyz"))
                self.assertEqual(len(packings), len(frames))
                self.assertEqual(len(packings) > 1, whole)
                yield from ((packing, *frame, stem) for packing, frame in zip(packings, frames))

    def test_xyz(self):
        for packing, values, particles, _ in self.packings():
            self.assertEqual((packing.density, packing.delta_phi), (float(values["density"]), float(values["delta_phi"])))
            cell = numpy.array(values["Lattice"].split(), dtype=float).reshape(3, 3)
            numpy.testing.assert_array_equal(packing.cell, cell)
            shifts = (packing.positions - particles["pos"]) @ numpy.linalg.inv(cell)
            self.near(shifts, numpy.round(shifts), 64 * results.DOUBLE, "whole translations")
            self.near(packing.orientations, numpy.roll(particles["orientation"], 1, axis=1), 4 * results.DOUBLE, "w, x, y, z")
            self.assertEqual(set(packing.solid_names), set(particles["solid"]))

    def test_density_and_low_parts(self):
        for directory in support.ALL:
            for name in support.done(directory):
                packing = support.study(directory).packing(name)
                self.assertEqual(packing.side is None, directory == FREE)
                volume = abs(numpy.linalg.det(packing.cell))
                self.near((packing.size**3).sum() / volume, packing.density, 1e-13, "density")
                for high, low in ((packing.positions, packing.positions_low), (packing.cell, packing.cell_low),
                                  (packing.orientations, packing.orientations_low)):
                    self.assertEqual(high.shape, low.shape)
                    self.assertTrue((numpy.abs(low) <= .5 * numpy.spacing(numpy.abs(high))).all(), name)
                self.assertGreater(numpy.count_nonzero(packing.positions_low), len(packing))


class Solids(support.Case):
    def test_unit_volume_about_the_centroid(self):
        seen = set()
        for directory in support.ALL:
            for name in support.done(directory):
                for solid in support.study(directory).packing(name).solids:
                    volume, _ = results.moments(solid.vertices, solid.faces)
                    self.near(volume, 1, 1e-13, solid.name)
                    self.near(self.centroid(solid), numpy.zeros(3), 1e-13, f"centroid of the {solid.name}")
                    self.assertEqual(len(solid.vertices) - sum(map(len, solid.faces)) / 2 + len(solid.faces), 2)
                    seen.add(solid.name)
        self.assertEqual(seen, {"tetrahedron", "cube", "dodecahedron", "icosahedron", "brick"})

    @staticmethod
    def centroid(solid):
        """Centroid of a solid with unit volume, from tetrahedra with a vertex at the origin."""
        centroid = numpy.zeros(3)
        for face in solid.faces:
            a = solid.vertices[face[0]]
            for b, c in zip(solid.vertices[face[1:-1]], solid.vertices[face[2:]]):
                centroid += numpy.dot(a, numpy.cross(b, c)) / 24 * (a + b + c)
        return centroid

    def test_the_brick_is_as_the_manifest_says(self):
        name = next(name for name in support.done(MIXED) if name.startswith("brick"))
        brick, = support.study(MIXED).packing(name).solids
        edges = numpy.sort(2 * numpy.abs(brick.vertices[0]))
        self.near(edges, numpy.array([1, 1.5, 2]) / 3 ** (1 / 3), 1e-14, "edges")

    def test_mixtures(self):
        name = next(name for name in support.done(MIXED) if name.startswith("cubes_and"))
        packing = support.study(MIXED).packing(name)
        self.assertEqual(packing.solid_names, ("cube", "tetrahedron"))
        self.assertEqual(list(numpy.bincount(packing.kind)), [26, 26])
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "mixture.gsd")
            subprocess.run([isojam.program.find(), "export", MIXED, name, "--format", "gsd", "-o", file], check=True,
                           stdout=subprocess.DEVNULL)
            with gsd.hoomd.open(str(file)) as trajectory:
                particles = trajectory[0].particles
                shapes = [numpy.array(shape["vertices"]) for shape in particles.type_shapes]
        turns = packing.rotations()
        for i, kind in enumerate(particles.typeid):
            self.near(packing.size[i] * packing.solids[packing.kind[i]].vertices, shapes[kind], 4 * results.FLOAT, f"shape of {i}")
            corners = (packing.corners(i) - packing.positions[i]) @ turns[i]
            self.near(corners, shapes[kind], 4 * results.FLOAT, f"corners of {i}")

    def test_the_program_is_asked_once_for_a_solid(self):
        study = isojam.load(CUBES)
        name = support.done(CUBES)[0]
        solids = study.packing(name).solids
        study._program = "/no/such/program"
        self.assertIs(study.packing(name).solids[0], solids[0])
        with self.assertRaisesRegex(isojam.ProgramError, "/no/such/program"):
            study.packing(support.done(CUBES)[1]).solids


if __name__ == "__main__":
    support.main()
