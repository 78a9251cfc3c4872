"""Tests Study.contacts() for nearest states and for paths, in cubes, variable cells and mixtures."""

import functools
import subprocess
import tempfile
import warnings

import numpy

import support
from support import CUBES, FREE, MIXED, isojam

from isojam import program


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
            for name, of in everything.by("replicate"):
                rows = study.states[study.states["replicate"] == name]
                rows = rows if whole else rows[rows["nearest"]]
                packings = study.path(name) if whole else [study.packing(name)]
                self.assertEqual(list(dict.fromkeys(of["state"])), list(rows["state"]))
                for packing, row in zip(packings, rows):
                    yield packing, row, of[of["state"] == row["state"]]

    def test_numbers(self):
        seen = 0
        for packing, row, of in self.states():
            n = len(packing)
            self.near(2 * len(of) / n, row["Z"], 1e-13, "Z")
            self.assertTrue((of["delta_phi"] == row["delta_phi"]).all())
            if numpy.isnan(row["Z_ff"]):
                self.assertEqual(set(of["class"]), {""})
                continue
            for name, quantity in (("face_face", "Z_ff"), ("edge_face", "Z_ef"), ("lower_order", "Z_l")):
                self.near(2 * (of["class"] == name).sum() / n, row[quantity], 1e-13, quantity)
                seen += 1
        print(f"{seen} numbers of contacts compared")
        self.assertGreater(seen, 20)

    def test_balance(self):
        worst = 0
        for packing, row, of in self.states():
            force = numpy.zeros((len(packing), 3))
            torque = numpy.zeros((len(packing), 3))
            numpy.add.at(force, of["a"], of["force"])
            numpy.add.at(force, of["b"], -of["force"])
            numpy.add.at(torque, of["a"], of["torque_a"])
            numpy.add.at(torque, of["b"], of["torque_b"])
            mean = numpy.linalg.norm(of["force"], axis=1).mean()
            reach = max(numpy.linalg.norm(solid.vertices, axis=1).max() for solid in packing.solids) * packing.size.max()
            left = numpy.linalg.norm(force, axis=1).max() / mean, numpy.linalg.norm(torque, axis=1).max() / mean / reach
            # Rounding errors of sums of so many terms are far smaller.
            self.assertLessEqual(max(left), 1.001 * row["residual"] + 1e-9, f"{packing}: {left}")
            worst = max(worst, *left)
        print(f"largest imbalance {worst:.2g} of the mean force")

    def test_geometry(self):
        for packing, _, of in self.states():
            size = numpy.linalg.norm(packing.cell)
            force = numpy.linalg.norm(of["force"], axis=1)
            arm_a = of["attack"] - packing.positions[of["a"]]
            arm_b = of["attack"] - packing.positions[of["b"]] - of["image"] @ packing.cell
            for arm, torque, sign in ((arm_a, "torque_a", 1), (arm_b, "torque_b", -1)):
                couple = (of[torque] - sign * numpy.cross(arm, of["force"])) / force[:, None]
                across = numpy.cross(couple, of["normal"])
                self.near(across, numpy.zeros_like(arm), 1e-12 * size, torque)
            self.near(of["force"], -.5 * (of["volume"] * of["area"])[:, None] * of["normal"], 1e-14 * force.max(), "force")
            for side in "ab":
                names = numpy.array(packing.solid_names)[packing.kind[of[side]]]
                self.assertEqual(list(of["solid_" + side]), list(names))

    def test_angles(self):
        for packing, row, of in self.states():
            if not row["nearest"]:
                continue
            directory = next(d for d in support.ALL if packing.name in support.study(d).names)
            angles = support.document(directory, "records", packing.name)["nearest"]["contacts"]["angles"]
            for column, key in (("theta_ff", "face_face"), ("theta_ef", "edge_face")):
                values = numpy.sort(of[column][~numpy.isnan(of[column])])
                self.near(values, angles[key], 1e-12, f"{packing.name} {key}")


class Ways(support.Case):
    def same(self, rows, others):
        self.assertEqual(rows.columns, others.columns)
        for name in rows.columns:
            numpy.testing.assert_array_equal(rows[name], others[name], name)

    def test_one_and_all(self):
        everything = contacts(MIXED)
        for name in support.done(MIXED):
            self.same(contacts(MIXED, name), everything[everything["replicate"] == name])

    def test_an_exported_file(self):
        with tempfile.TemporaryDirectory() as folder:
            name, file = support.done(CUBES)[0], folder + "/contacts.csv"
            subprocess.run([program.find(), "export", CUBES, name, "--format", "contacts", "-o", file], check=True,
                           stdout=subprocess.DEVNULL)
            self.same(isojam.read_table(file), contacts(CUBES, name))

    def test_what_failed(self):
        with self.assertWarnsRegex(UserWarning, "max_density"):
            support.study(MIXED).contacts()
        failed = next(name for name in support.study(MIXED).names if name not in support.done(MIXED))
        self.refused(lambda: support.study(MIXED).contacts(failed), failed, "/status")

    def test_what_the_program_refuses(self):
        copy = self.copy(CUBES)
        name = support.done(CUBES)[0]
        file = copy / "packings" / (name + ".json")
        text = bytearray(file.read_bytes())
        text[len(text) // 2] ^= 1
        file.write_bytes(text)
        with self.assertRaises(isojam.ProgramError) as caught:
            isojam.load(copy).contacts(name)
        self.assertIn("the file is damaged", str(caught.exception))
        self.assertIn(str(copy), caught.exception.command)

    def test_measures_added_later(self):
        copy = self.copy(CUBES)
        subprocess.run([program.find(), "measure", copy, "--add", "rigidity"], check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            study, before = isojam.load(copy), support.study(CUBES)
            self.assertTrue((study.states["self_stress_normals"] >= 0).any())
            for name in study.names:
                numpy.testing.assert_array_equal(study.packing(name).positions, before.packing(name).positions)
                self.assertEqual(len(study.path(name)), len(before.path(name)))
            self.same(study.contacts(), contacts(CUBES))


if __name__ == "__main__":
    support.main()
