"""Recomputes the measure `exponents` from exported contacts, with numpy: x, the classes, C, m and S.

usage: exponents_test.py ISOJAM FOLDER [SEED REPLICATES DISTANCE SOLID...]

Packings are decompressed in steps of 4 %, the length of the measure's first step. If this step was used, the state after
a state of the path is the second state of the measure.
"""

import csv
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy

import results

ISOJAM, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
SEED, REPLICATES, DISTANCE, *SOLIDS = sys.argv[3:] or ["6", "2", "0.002", "tetrahedron", "octahedron", "icosahedron", "dodecahedron"]
N, STEP, PARALLEL = 64, 0.04, 1e-9
WEAKEST = 1e-3  # force, in mean forces, below which residuals of up to 1e-6 change x by more than its tolerance
NEAR = 3  # singular values within this factor of their tolerance count either way: they depend on the axes of the tilts


def isojam(*arguments):
    return subprocess.run([ISOJAM, *arguments], check=True, capture_output=True, text=True, cwd=FOLDER).stdout


def run(name, manifest):
    (FOLDER / f"{name}.json").write_text(json.dumps({"name": name, "seed": int(SEED), "replicates": int(REPLICATES), **manifest}))
    isojam("run", f"{name}.json", "-o", name, "--quiet")
    return FOLDER / name


def exponent(before, after, mean_change):
    """x = d ln(|S|²/V) / d ln f^(1/5) of a contact, and f = V|S|/2."""
    (volume, area), (volume_after, area_after) = before, after
    own = numpy.log(volume_after * area_after / (volume * area))
    change = own if own / mean_change >= 0.3 else mean_change
    return 5 * (2 * numpy.log(area_after / area) - numpy.log(volume_after / volume)) / change


class Solid:
    def __init__(self, shape):
        self.vertices = numpy.array(shape["vertices"])
        self.normals, edges = [], set()
        for face in shape["faces"]:
            corners = self.vertices[face]
            normal = numpy.cross(corners[1] - corners[0], corners[2] - corners[0])
            self.normals.append(normal / numpy.linalg.norm(normal) * numpy.sign(normal @ corners[0]))
            edges |= {tuple(sorted(pair)) for pair in zip(face, face[1:] + face[:1])}
        along = [self.vertices[b] - self.vertices[a] for a, b in sorted(edges)]
        self.edges = numpy.array([e / numpy.linalg.norm(e) for e in along])
        volume, second = results.moments(self.vertices, shape["faces"])
        self.radius = numpy.sqrt(second / volume / 3 * 2)


def vector(row, name):
    return numpy.array([float(row[f"{name}_{axis}"]) for axis in "xyz"])


def tilts(row, solid, turn_a, turn_b, kind):
    """Axes of the tilts of a contact, from the face normals or the edge and the face with the exported angle."""
    normal = vector(row, "normal")
    if kind == "face_face":
        faces = (solid.normals @ turn_a.T, -(solid.normals @ turn_b.T))
        angles = numpy.arccos(numpy.clip(faces[0] @ faces[1].T, -1, 1))
        a, b = numpy.unravel_index(abs(angles - float(row["theta_ff"])).argmin(), angles.shape)
        plane = faces[0][a]
        first = numpy.cross(plane, [1, 0, 0] if abs(plane[0]) < 0.6 else [0, 1, 0])
        first /= numpy.linalg.norm(first)
        return [first, numpy.cross(plane, first)]
    if kind == "edge_face":
        best = None
        for own, other in ((turn_a, turn_b), (turn_b, turn_a)):
            edges, faces = solid.edges @ own.T, solid.normals @ other.T
            # Among the pairs with the angle of the contact, the face whose normal is nearest to that of the contact.
            for e, f in zip(*numpy.nonzero(abs(abs(edges @ faces.T) - numpy.sin(float(row["theta_ef"]))) < PARALLEL)):
                best = max(best or (0, None), (abs(faces[f] @ normal), tuple(numpy.cross(edges[e], faces[f]))))
        return [numpy.array(best[1]) / numpy.linalg.norm(best[1])]
    return []


def singular_values(rows, kinds, packing, solid):
    turns, found = results.rotation(packing.quaternions), []
    for row, kind in zip(rows, kinds):
        a, b = int(row["a"]), int(row["b"])
        parts = [(vector(row, "force"), vector(row, "torque_a") / solid.radius, -vector(row, "force"),
                  vector(row, "torque_b") / solid.radius)]
        zero = numpy.zeros(3)
        parts += [(zero, axis, zero, -axis) for axis in tilts(row, solid, turns[a], turns[b], kind)]
        for force_a, torque_a, force_b, torque_b in parts:
            line = numpy.zeros((packing.n, 6))
            line[a] = [*force_a, *torque_a]
            line[b] = [*force_b, *torque_b]
            found.append(line.ravel() / numpy.linalg.norm(line))
    return numpy.linalg.svd(numpy.array(found), compute_uv=False), len(found)


class Exponents(unittest.TestCase):
    def test_follow_from_exported_contacts(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        checked = stepped = self.exact = self.states = 0
        for name in SOLIDS:
            far = run(f"{name}-far", {"sweep": {"solid": [name], "particles": [N]}, "measure": [],
                                      "protocol": {"final_distance": 1.3 * float(DISTANCE), "fit_window": 0.02}})
            packings = [str(path.resolve()) for path in sorted((far / "packings").glob("*.json"))]
            near = run(name, {"sweep": {"solid": [name], "particles": [N]}, "measure": ["exponents"], "keep_path": True,
                              "exponents_of_all_states": True, "start": {"packing": packings, "stage": "decompression"},
                              "protocol": {"final_distance": float(DISTANCE), "fit_window": 0.02, "step_fraction": STEP}})
            isojam("export", near, "all", "--path", "--format", "contacts", "-o", f"{name}.csv")
            shape, = json.loads(isojam("export", near, "all", "--format", "solids")).values()
            with open(FOLDER / f"{name}.csv", newline="") as text:
                table = list(csv.DictReader(text))
            for replicate in results.names(near):
                own = [row for row in table if row["replicate"] == replicate]
                stepped += self.check(near, replicate, own, Solid(shape))
                checked += 1
        print(f"{checked} packings of {N} particles, {self.states} states, {self.exact} of them with no singular value near its "
              f"tolerance, {stepped} steps of {STEP} recomputed")
        self.assertGreater(stepped, checked)
        self.assertGreater(self.exact, 0.8 * self.states)

    def check(self, directory, replicate, table, solid):
        states = [[row for row in table if int(row["state"]) == k] for k in range(int(table[-1]["state"]) + 1)]
        records, packings, stepped = results.record(directory, replicate)["states"], results.path(directory, replicate), 0
        for k, (rows, state) in enumerate(zip(states, records)):
            self.states += 1
            record = state["exponents"]
            x = [float(row["x"]) if row["x"] else None for row in rows]
            if record["step"] == -STEP and k + 1 < len(states):
                stepped += self.check_x(rows, states[k + 1], x)
            kinds = ["lower_order" if y is None or y >= 0.5 else "edge_face" if y >= -2.5 else "face_face" for y in x]
            if record["C"] is None:
                continue
            constraints = sum({"lower_order": 1, "edge_face": 2, "face_face": 3}[kind] for kind in kinds)
            self.assertAlmostEqual(2 * constraints / N, record["C"], 9)
            values, lines = singular_values(rows, kinds, packings[k], solid)
            least, most = (int((values > factor * record["rank"]["tolerance"]).sum()) for factor in (NEAR, 1 / NEAR))
            rank = lines - record["rank"]["self_stress"]
            self.assertEqual(lines, constraints)
            self.assertTrue(least <= rank <= most, f"{replicate} {k}: {least} … {most}, not {rank}")
            self.assertAlmostEqual((6 * N - 3 - rank) / N, record["missing"], 9, f"{replicate} {k}")
            self.exact += least == most
        return stepped

    def check_x(self, rows, after, x):
        """Compares x with that of the contacts in the next state."""
        def by_pair(contacts):
            return {tuple(row[key] for key in ("a", "b", "image_x", "image_y", "image_z")):
                    (float(row["volume"]), float(row["area"])) for row in contacts}

        before, after = by_pair(rows), by_pair(after)
        if before.keys() != after.keys():
            return 0  # a contact changed its periodic image, because the cell was reduced
        mean = [numpy.mean([volume * area for volume, area in contacts.values()]) for contacts in (before, after)]
        for pair, expected in zip(before, x):
            volume, area = before[pair]
            if volume * area < WEAKEST * mean[0]:
                continue
            self.assertAlmostEqual(exponent(before[pair], after[pair], numpy.log(mean[1] / mean[0])), expected,
                                   delta=1e-3 * max(1, abs(expected)))
        return 1


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
