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


class Solids(support.Case):
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
        for i, kind in enumerate(particles.typeid):
            self.near(packing.size[i] * packing.solids[packing.kind[i]].vertices, shapes[kind], 4 * results.FLOAT, f"shape of {i}")
            w, q = particles.orientation[i, 0], particles.orientation[i, 1:]
            turned = shapes[kind] + 2 * numpy.cross(q, numpy.cross(q, shapes[kind]) + w * shapes[kind])
            self.near(packing.corners(i) - packing.positions[i], turned, 8 * results.FLOAT, f"corners of {i}")

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
