"""Tests exported packings in cells that are not cubes, with the same readers as the other tests.

usage: free_cell_test.py RESULTS EXPORTED, where EXPORTED contains NAME.gsd, NAME.xyz and NAME.vtp
"""

import itertools
import json
import pathlib
import sys
import unittest

import gsd.hoomd
import numpy

import results
import vtp_test
import xyz_test

IMAGES = numpy.array(list(itertools.product((-1, 0, 1), repeat=3)))


def distances(positions, cell):
    """Distances of all pairs to the nearest periodic image. The rows of `cell` are the lattice vectors."""
    difference = positions[:, None, :] - positions[None, :, :]
    difference -= numpy.round(difference @ numpy.linalg.inv(cell)) @ cell
    images = difference[:, :, None, :] + (IMAGES @ cell)[None, None, :, :]
    return numpy.linalg.norm(images, axis=3).min(axis=2)


class FreeCell(unittest.TestCase):
    where = exported = None

    def packings(self):
        names = results.names(self.where)
        self.assertTrue(names)
        for name in names:
            packing = json.loads(pathlib.Path(self.where, "packings", name + ".json").read_text())
            self.assertNotIn("side", packing)
            cell = numpy.array(packing["cell"])
            n = len(packing["positions"])
            self.assertAlmostEqual(numpy.linalg.det(cell) * packing["density"] / n, 1, places=13)
            self.assertGreater(numpy.abs(cell - numpy.diag(numpy.diag(cell))).max(), 1e-3)
            quaternions = numpy.array(packing["orientations"])
            quaternions /= numpy.linalg.norm(quaternions, axis=1)[:, None]
            yield str(self.exported / name), cell, numpy.array(packing["positions"]), quaternions

    def close(self, value, expected, tolerance, what):
        worst = float(numpy.abs(numpy.asarray(value) - expected).max())
        self.assertLessEqual(worst, tolerance, f"{what}: off by {worst:.3g}")

    def test_gsd(self):
        for stem, cell, positions, quaternions in self.packings():
            with gsd.hoomd.open(stem + ".gsd") as trajectory:
                snapshot = trajectory[0]
            snapshot.validate()
            lx, ly, lz, xy, xz, yz = snapshot.configuration.box.astype(float)
            box = numpy.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])
            size = numpy.linalg.norm(cell)
            self.close(box @ box.T, cell @ cell.T, 8 * results.FLOAT * size * size, "lengths and angles of the box")
            turn = numpy.linalg.inv(cell) @ box  # acts on rows
            self.close(turn.T @ turn, numpy.eye(3), 16 * results.FLOAT, "the frame is turned")
            seen = snapshot.particles.position.astype(float)
            inside = seen @ numpy.linalg.inv(box)
            self.assertLessEqual(numpy.abs(inside).max(), 0.5 + results.FLOAT)
            self.close(distances(seen, box), distances(positions, cell), 32 * results.FLOAT * size, "distances")
            self.close(results.rotation(snapshot.particles.orientation.astype(float)),
                       turn.T @ results.rotation(quaternions), 64 * results.FLOAT, "orientations")
            numpy.testing.assert_array_equal(snapshot.log["isojam/cell"], cell)

    def test_xyz(self):
        for stem, cell, positions, quaternions in self.packings():
            (values, particles), = xyz_test.read_frames(pathlib.Path(stem + ".xyz"))
            numpy.testing.assert_array_equal(numpy.array(values["Lattice"].split(), dtype=float).reshape(3, 3), cell)
            inside = particles["pos"] @ numpy.linalg.inv(cell)
            self.assertGreaterEqual(inside.min(), -1e-14)
            self.assertLess(inside.max(), 1 + 1e-14)
            self.close(distances(particles["pos"], cell), distances(positions, cell), 1e-13, "distances")
            self.close(particles["orientation"], numpy.roll(quaternions, -1, axis=1), 4 * results.DOUBLE, "quaternions")

    def test_vtp(self):
        for stem, cell, positions, _ in self.packings():
            picture = vtp_test.Picture(stem + ".vtp", len(positions))
            numpy.testing.assert_array_equal(picture.field["cell"].reshape(3, 3), cell)
            self.close(distances(picture.centres, cell), distances(positions, cell), 1e-13, "distances")
            z = picture.cell["Z"][::len(picture.faces[0])]
            self.assertGreater(z.sum(), 0)
            self.assertEqual(list(vtp_test.count_contacts(picture, IMAGES @ cell)), list(z), stem)


if __name__ == "__main__":
    FreeCell.where = pathlib.Path(sys.argv[1])
    FreeCell.exported = pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
