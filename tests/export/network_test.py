"""Tests exported contacts in every state of a decompression."""

import csv
import json
import pathlib
import sys
import unittest

import gsd.hoomd
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import results

HEADER = ("replicate,state,delta_phi,a,b,image_x,image_y,image_z,volume,area,force_x,force_y,force_z,attack_x,attack_y,"
          "attack_z,normal_x,normal_y,normal_z,torque_a_x,torque_a_y,torque_a_z,torque_b_x,torque_b_y,torque_b_z,class,"
          "kind,theta_ef,theta_ff,depth,solid_a,solid_b,x,gap")
CLASSES = {"lower_order": 1, "edge_face": 2, "face_face": 3, "": -1}
TYPES = ["face_face", "edge_face", "lower_order", "undecided"]
KINDS = ["vertex_face", "edge_edge", "edge_face", "face_face", "compound"]

RESULTS, EXPORTED, FREE_RESULTS, FREE_EXPORTED = map(pathlib.Path, sys.argv[1:5])


def rows_of(file):
    with open(file, newline="") as text:
        return list(csv.DictReader(text))


def vectors(rows, name):
    return numpy.array([[float(row[f"{name}_{axis}"]) for axis in "xyz"] for row in rows])


def column(rows, name, kind=float):
    return numpy.array([kind(row[name]) for row in rows])


def gyration_radius(vertices, faces):
    volume, second = results.moments(vertices, faces)
    return numpy.sqrt(second / volume / 3 * 2)


class Network(unittest.TestCase):
    def setUp(self):
        self.rows = rows_of(EXPORTED / "contacts.csv")
        self.by_state = {}
        for row in self.rows:
            self.by_state.setdefault((row["replicate"], int(row["state"])), []).append(row)

    def states(self):
        """Name, index, rows, packing and record of every state."""
        for name in results.names(RESULTS):
            packings, record = results.path(RESULTS, name), results.record(RESULTS, name)
            for k, packing in enumerate(packings):
                with self.subTest(replicate=name, state=k):
                    yield name, k, self.by_state[name, k], packing, record["states"][k]

    def test_csv_and_json_lines_agree(self):
        head = (EXPORTED / "contacts.csv").read_text().splitlines()[0]
        self.assertEqual(head, HEADER)
        lines = [json.loads(line) for line in (EXPORTED / "contacts.jsonl").read_text().splitlines()]
        self.assertEqual(len(lines), len(self.rows))
        for row, line in zip(self.rows, lines):
            self.assertEqual(list(line), HEADER.split(","))
            for key, text in row.items():
                value = line[key]
                self.assertEqual(float(text) if isinstance(value, float) else text, value if isinstance(value, float)
                                 else "" if value is None else str(value), key)

    def test_counts_are_the_record_s(self):
        for _, _, rows, packing, state in self.states():
            record = state["contacts"]
            self.assertEqual(2 * len(rows) / packing.n, record["Z"])
            for name, key in (("face_face", "Z_ff"), ("edge_face", "Z_ef"), ("lower_order", "Z_l")):
                count = sum(row["class"] == name for row in rows)
                if record[key] is None:
                    self.assertTrue(all(row["class"] == "" for row in rows), record[key + "_reason"])
                else:
                    self.assertEqual(2 * count / packing.n, record[key], name)
            pairs = [(int(row["a"]), int(row["b"])) for row in rows]
            self.assertEqual(pairs, sorted(set(pairs)), "in order, and no pair twice")

    def test_forces_cancel_as_far_as_the_record_says(self):
        seen = []
        for name, _, rows, packing, record in self.states():
            a, b, force = column(rows, "a", int), column(rows, "b", int), vectors(rows, "force")
            total, torque = numpy.zeros((2, packing.n, 3))
            numpy.add.at(total, a, force)
            numpy.add.at(total, b, -force)
            numpy.add.at(torque, a, vectors(rows, "torque_a"))
            numpy.add.at(torque, b, vectors(rows, "torque_b"))
            radius = gyration_radius(*results.read_obj(EXPORTED / "nearest" / (name + ".obj")))
            worst = max(numpy.linalg.norm(total, axis=1).max(), numpy.linalg.norm(torque, axis=1).max() / radius)
            residual = worst / numpy.linalg.norm(force, axis=1).mean()
            seen.append((residual, record["residual"]))
            # The record's was found in working precision, whose own rounding it states.
            self.assertAlmostEqual(residual, record["residual"], delta=1e-6 * residual + 10 * record["residual_floor"])
        print("residuals of contacts and record, the largest:", max(seen))

    def test_bonds_are_the_contacts(self):
        for name in results.names(RESULTS):
            with gsd.hoomd.open(str(EXPORTED / "network" / (name + ".gsd"))) as trajectory:
                for k, frame in enumerate(trajectory):
                    rows = self.by_state[name, k]
                    frame.validate()
                    self.assertEqual(frame.bonds.N, len(rows))
                    self.assertEqual(frame.bonds.types, TYPES)
                    self.assertEqual([TYPES[t] for t in frame.bonds.typeid], [row["class"] or "undecided" for row in rows])
                    self.assertEqual(frame.bonds.group.tolist(), [[int(row["a"]), int(row["b"])] for row in rows])
                    log = {key.split("/")[-1]: value for key, value in frame.log.items() if key.startswith("bonds/")}
                    self.assertEqual(log["force"].tolist(), vectors(rows, "force").tolist())
                    for key in ("volume", "area", "depth", "theta_ef", "theta_ff"):
                        self.assertEqual(log[key].tolist(), column(rows, key).tolist(), key)
                    self.assertEqual([KINDS[kind] for kind in log["kind"]], [row["kind"] for row in rows])

    def test_lines_are_the_contacts(self):
        for name, k, rows, packing, _ in self.states():
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(EXPORTED / "network" / f"{name}_{k:04}-contacts.vtp"))
            reader.Update()
            data = reader.GetOutput()
            self.assertEqual(data.GetNumberOfLines(), len(rows))
            points = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 3, 3)
            cell = {data.GetCellData().GetArrayName(i): vtk_to_numpy(data.GetCellData().GetArray(i))
                    for i in range(data.GetCellData().GetNumberOfArrays())}
            a, b = column(rows, "a", int), column(rows, "b", int)
            self.assertEqual((cell["a"].tolist(), cell["b"].tolist()), (a.tolist(), b.tolist()))
            self.assertEqual(cell["contact_class"].tolist(), [CLASSES[row["class"]] for row in rows])
            self.assertEqual([KINDS[kind] for kind in cell["kind"]], [row["kind"] for row in rows])
            self.assertEqual(cell["force_a"].tolist(), vectors(rows, "force").tolist())
            numpy.testing.assert_allclose(cell["force"], numpy.linalg.norm(vectors(rows, "force"), axis=1), rtol=1e-15)
            loose = 20 * results.DOUBLE * (packing.side + abs(packing.positions).max())
            moved = points[:, 0] - packing.positions[a]
            image = numpy.array([[int(row[f"image_{axis}"]) for axis in "xyz"] for row in rows]) * packing.side
            self.assertLess(abs(moved / packing.side - numpy.round(moved / packing.side)).max(), loose)
            self.assertTrue((points[:, 0] >= 0).all() and (points[:, 0] < packing.side).all())
            self.assertLess(abs(points[:, 1] - vectors(rows, "attack") - moved).max(), loose)
            self.assertLess(abs(points[:, 2] - packing.positions[b] - image - moved).max(), loose)

    def test_free_cells(self):
        rows = rows_of(FREE_EXPORTED / "contacts.csv")
        for name in results.names(FREE_RESULTS):
            packing = json.loads((FREE_RESULTS / "packings" / (name + ".json")).read_text())
            own = [row for row in rows if row["replicate"] == name]
            positions, lattice = numpy.array(packing["positions"]), numpy.array(packing["cell"])
            with gsd.hoomd.open(str(FREE_EXPORTED / "network" / (name + ".gsd"))) as trajectory:
                frame = trajectory[0]
            lx, ly, lz, xy, xz, yz = frame.configuration.box.astype(float)
            box = numpy.array([[lx, xy * ly, xz * lz], [0, ly, yz * lz], [0, 0, lz]])
            turn = box @ numpy.linalg.inv(lattice.T)
            force = frame.log["bonds/isojam/force"]
            numpy.testing.assert_allclose(force, vectors(own, "force") @ turn.T, rtol=0,
                                          atol=20 * results.FLOAT * abs(force).max())
            image = numpy.array([[int(row[f"image_{axis}"]) for axis in "xyz"] for row in own]) @ lattice
            a, b = column(own, "a", int), column(own, "b", int)
            distance = numpy.linalg.norm(positions[b] + image - positions[a], axis=1)
            reach = numpy.linalg.norm(vectors(own, "attack") - positions[a], axis=1)
            self.assertTrue((distance < 2.6).all() and (reach < distance).all(), f"{name}: {distance.max()}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
