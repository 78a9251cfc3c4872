"""Tests Study.contacts() for nearest states and for paths, in cubes, variable cells and mixtures."""

import functools
import os
import warnings

import numpy
import pandas

import support
from support import CUBES, FREE, MIXED, isojam


@functools.lru_cache(maxsize=None)
def contacts(directory, name=None, path=False):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return support.study(directory).contacts(name, path)


class Contacts(support.Case):
    def states(self):
        """Every packing, with the row of its state and its contacts."""
        for directory, whole in ((CUBES, False), (CUBES, True), (FREE, False), (MIXED, False)):
            study = support.study(directory)
            everything = contacts(directory, path=whole)
            self.assertEqual(set(everything["replicate"]), set(support.done(directory)))
            for name, of in everything.groupby("replicate"):
                rows = study.states[study.states["replicate"] == name]
                rows = rows if whole else rows[rows["nearest"]]
                packings = study.path(name) if whole else [study.packing(name)]
                self.assertEqual(list(dict.fromkeys(of["state"])), list(rows["state"]))
                for packing, (_, row) in zip(packings, rows.iterrows()):
                    yield packing, row, of[of["state"] == row["state"]]

    def test_geometry(self):
        for packing, _, of in self.states():
            size, forces, normals = numpy.linalg.norm(packing.cell), of.vectors("force"), of.vectors("normal")
            force = numpy.linalg.norm(forces, axis=1)
            arm_a = of.vectors("attack") - packing.positions[of["a"]]
            arm_b = of.vectors("attack") - packing.positions[of["b"]] - of.vectors("image") @ packing.cell
            for arm, torque, sign in ((arm_a, "torque_a", 1), (arm_b, "torque_b", -1)):
                couple = (of.vectors(torque) - sign * numpy.cross(arm, forces)) / force[:, None]
                self.near(numpy.cross(couple, normals), numpy.zeros_like(arm), 1e-12 * size, torque)
            expected = -.5 * (of["volume"] * of["area"]).to_numpy()[:, None] * normals
            self.near(forces, expected, 1e-14 * force.max(), "force")
            for side in "ab":
                names = numpy.array(packing.solid_names)[packing.kind[of[side]]]
                self.assertEqual(list(of["solid_" + side]), list(names))

    def test_angles(self):
        for packing, row, of in self.states():
            if not row["nearest"]:
                continue
            directory = next(d for d in support.ALL if packing.name in support.study(d).names)
            record = support.document(directory, "records", packing.name)
            angles = record["states"][record["nearest"]]["contacts"]["angles"]
            for column, key in (("theta_ff", "face_face"), ("theta_ef", "edge_face")):
                values = numpy.sort(of[column].dropna())
                self.near(values, angles[key], 1e-12, f"{packing.name} {key}")


class Ways(support.Case):
    def test_one_and_all(self):
        everything = contacts(MIXED)
        for name in support.done(MIXED):
            own = everything[everything["replicate"] == name].reset_index(drop=True)
            pandas.testing.assert_frame_equal(contacts(MIXED, name), own)

    def test_what_failed(self):
        with self.assertWarnsRegex(UserWarning, "max_density") as warned:
            support.study(MIXED).contacts()
        self.assertEqual(os.path.basename(warned.filename), "contacts_test.py")
        failed = next(name for name in support.study(MIXED).names if name not in support.done(MIXED))
        with self.assertRaisesRegex(isojam.ProgramError, "failed"):
            support.study(MIXED).contacts(failed)
        with self.assertRaisesRegex(isojam.ProgramError, "no such format") as caught:
            isojam.load(CUBES, program=self.stub("echo no such format >&2; exit 2\n")).contacts()
        self.assertEqual(caught.exception.message, "no such format")
        self.assertIn(str(CUBES), caught.exception.command)


if __name__ == "__main__":
    support.main()
