"""Runs what people bring: their solids, packings and lists of sizes. usage: SECONDS=2 people_test.py ISOJAM

Each test prints what it saw. To validate a solid may take SECONDS, with sanitizers ten times as many."""

import csv
import itertools
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import gsd.hoomd
import numpy
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, HalfspaceIntersection, HalfspaceIntersection
from scipy.spatial.transform import Rotation

import study
from polyhedron import faces

PROGRAM, SECONDS = sys.argv[1], float(os.environ["SECONDS"])
GOLDEN = (1 + 5**0.5) / 2
TURN = Rotation.from_euler("xyz", [.3, .5, .7]).as_matrix()
CUBE = numpy.array(list(itertools.product((0.0, 1.0), repeat=3)))
OCTAHEDRON = numpy.vstack([numpy.eye(3), -numpy.eye(3)]) * 0.75**(1 / 3)


def circle(n, z=0.0, digits=9, part=1.0):
    angle = 2 * numpy.pi * part * numpy.arange(n) / n
    return numpy.round(numpy.c_[numpy.cos(angle), numpy.sin(angle), numpy.full(n, z)], digits)


def rim(n):
    """Ten corners, and a rim of many points."""
    corners = [[a, b, c] for a in (-.8, .8) for b in (-.8, .8) for c in (-.35, .35)]
    return numpy.vstack([[[0, 0, 1], [0, 0, -1]], corners, circle(n)])


def truncated_icosidodecahedron(digits):
    g = GOLDEN
    points = {tuple(numpy.roll([sign[k] * p[k] for k in range(3)], turn)) for turn in range(3)
              for sign in itertools.product((-1, 1), repeat=3)
              for p in ((1 / g, 1 / g, 3 + g), (2 / g, g, 1 + 2 * g), (1 / g, g * g, 3 * g - 1), (2 * g - 1, 2, 2 + g),
                        (g, 3, 2 * g))}
    return numpy.round(sorted(points), digits)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def call(self, command, document, *more, environment=None):
        before = os.times().children_user
        file = study.write(self.folder, document)
        done = subprocess.run([PROGRAM, command, file, *map(str, more)], capture_output=True, text=True, check=False,
                              env={**os.environ, **(environment or {})})
        self.seconds = os.times().children_user - before
        return done.returncode, done.stdout, done.stderr

    def solid(self, what, particles=2000, **keys):
        """The line of a solid, or the error."""
        document = study.manifest("m", {"x": {**what, **keys}}, particles)
        code, output, messages = self.call("validate", document)
        self.assertIn(code, (0, 65), messages)
        print(f"{', '.join(what)} {keys}: {self.seconds:.2f} s, {(output if code == 0 else messages)[:400].strip()}")
        self.assertLess(self.seconds, SECONDS)
        return study.printed_solids(output).get("x"), output + messages

    def file(self, name, content, **keys):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        return self.solid({"file": name}, **keys)

    def is_solid(self, seen, number, volume):
        self.assertTrue(seen[0], seen[1])
        self.assertEqual((seen[0]["faces"], seen[0]["edges"], seen[0]["vertices"]), number)
        self.assertLess(abs(seen[0]["volume"] / volume - 1), 1e-5)


class Solids(Case):
    def test_merge_keeps_the_solid(self):
        half_round = numpy.vstack([circle(201, z, part=.5) for z in (0, 1)])
        cone = numpy.vstack([[[0, 0, .8], [0, 0, -.8]], circle(600)])
        refused = 0
        for points, merge in ((rim(360), .01), (rim(360), .003), (rim(360), 1e-4), (rim(1500), .0025), (half_round, .01),
                              (cone, .01)):
            keys = {"merge": merge, "hull": True}
            seen, text = self.solid({"vertices": points.tolist()}, **keys)
            if not seen:
                refused += 1
                keys.update({key: json.loads(value) for key, value in re.findall(r'"(\w+)" to ([\d.e-]+)', text)})
                seen, text = self.solid({"vertices": points.tolist()}, **keys)
            self.assertLess(abs(seen["volume"] / ConvexHull(points).volume - 1), keys.get("max_volume_change", .01))
            self.assertLessEqual(seen["move"], 5 * keys["merge"] if "corners" not in keys else 1)
            self.assertIn("volume changed by", text)
        self.assertGreater(refused, 0)

    def test_nearly_equal_points(self):
        random = numpy.random.default_rng(4)
        for noise in (1e-4, 1e-5, 1e-6, 1e-7):
            points = numpy.repeat(OCTAHEDRON @ TURN, 4, axis=0) + noise * random.normal(size=(24, 3))
            seen, text = self.solid({"vertices": points.tolist()}, hull=True)
            self.assertLess(abs(seen["volume"] / ConvexHull(points).volume - 1) if seen else 1, 1e-5, text)

    def test_nearly_parallel_planes(self):
        random = numpy.random.default_rng(9)
        for tilt in numpy.repeat(10.0 ** numpy.arange(-10, -5), 4):
            normals = numpy.repeat(random.normal(size=(12, 3)), 2, axis=0)
            normals[::2] += tilt * random.normal(size=(12, 3))
            planes = numpy.c_[normals / numpy.linalg.norm(normals, axis=1)[:, None], numpy.ones(24)]
            seen, text = self.solid({"planes": planes.tolist()}, 20000, merge=1e-4)
            corners = HalfspaceIntersection(planes * [1, 1, 1, -1], numpy.zeros(3)).intersections
            self.assertLess(abs(seen["volume"] / ConvexHull(corners).volume - 1) if seen else 1, 1e-4, text)

    def test_the_remedy_was_tried(self):
        for digits in (5, 6, 7):
            points = {"vertices": truncated_icosidodecahedron(digits).tolist()}
            seen, text = self.solid(points)
            self.assertIsNone(seen)
            merge = float(text.split('"merge" to ')[1].split()[0])
            self.is_solid(self.solid(points, merge=merge), (62, 180, 120), (95 + 50 * 5**.5) * (2 / GOLDEN)**3)

    def test_many_sides(self):
        prism, tips = numpy.vstack([circle(2500, z, 16) for z in (0, 1)]), [[0, 0, -.5], [0, 0, 1.5]]
        cone = numpy.vstack([tips, circle(5000, 0, 16)])
        for points in (prism, cone, numpy.vstack([tips, prism])):
            for turn in numpy.eye(3), TURN:
                seen, _ = self.solid({"vertices": (points @ turn).tolist()}, hull=True, corners=64)
                self.assertEqual(seen["vertices"], 64)
                self.assertIn("set \"", self.solid({"vertices": (points @ turn).tolist()})[1])

    def test_formats(self):
        cube = (6, 12, 8), 1
        loops = faces(CUBE)
        points = "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE)
        continued = points + "".join("f {} {} \\\n  {} {}\n".format(*(v + 1 for v in f)) for f in loops)
        plain = "\n".join(" ".join(map(str, row)) for row in [*CUBE.tolist(), *([4, *f] for f in loops)])
        self.is_solid(self.file("a.obj", continued), *cube)
        self.is_solid(self.file("b.off", f"OFF8 6 12\n{plain}\n"), *cube)
        self.is_solid(self.file("c.obj", points, hull=True), *cube)
        self.is_solid(self.file("d.off", "OFF\n8 0 0\n" + plain.split("\n4 ")[0], hull=True), *cube)
        head = "ply\nformat {} 1.0\ncomment x\nelement vertex 8\nproperty float x\nproperty float y\n" \
               "property float z\nproperty uchar q\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
        text = "".join(f"{x} {y} {z} 7\n" for x, y, z in CUBE) + "".join(f"4 {' '.join(map(str, f))}\n" for f in loops)
        self.is_solid(self.file("e.ply", (head.format("ascii") + text).replace("\n", "\r\n")), *cube)
        for order, name in (("<", "little"), (">", "big")):
            data = b"".join(numpy.array(v, order + "f4").tobytes() + b"\7" for v in CUBE)
            data += b"".join(b"\4" + numpy.array(f, order + "i4").tobytes() for f in loops)
            self.is_solid(self.file(f"f{name}.ply", head.format(f"binary_{name}_endian").encode() + data), *cube)
        shape = "<\nname cube\nradius {}\nnv 8\n" + plain.split("\n4 ")[0] + "\nne 1\n0 1\nnf 6\n" + \
            "\n".join(" ".join(map(str, [4, *f])) for f in loops) + "\nvolume 1\n>\n"
        self.is_solid(self.file("g.shp", shape.format(1e-5)), *cube)
        self.assertIn("radius", self.file("h.shp", shape.format(.05))[1])
        planes = [[*(sign * axis), bound] for axis in numpy.eye(3) for sign, bound in ((2, 2), (-1, 0))]
        self.is_solid(self.solid({"planes": [*planes, [1, 1, 1, 9]]}), *cube)
        self.assertIn("do not bound", self.solid({"planes": planes[:-1]})[1])
        octahedron = [[*sign, 1] for sign in itertools.product((-1, 1), repeat=3)]
        self.is_solid(self.solid({"planes": octahedron}), (8, 12, 6), 4 / 3)
        for sides, digits in ((60, 16), (255, 16), (12, 9), (20, 12), (20, 9)):
            pyramid = numpy.vstack([[0, 0, -1, 0], numpy.c_[circle(sides, 1, 16), numpy.ones(sides)]])
            pyramid = numpy.round(numpy.c_[pyramid[:, :3] @ TURN, pyramid[:, 3]], digits).tolist()
            seen = self.solid({"planes": pyramid})
            if seen[0]:
                self.assertEqual(seen[0]["faces"], sides + 1)
            else:
                key, value = re.search(r'"(merge|corners)" to ([\d.e-]+)', seen[1]).groups()
                seen = self.solid({"planes": pyramid}, **{key: json.loads(value), "max_volume_change": .1})
            self.assertLess(abs(seen[0]["volume"] * 3 / (sides * numpy.tan(numpy.pi / sides)) - 1), .1)
        self.assertIn("~", self.solid({"file": "~/stone.stl"})[1].split("home folder")[0])

    def test_scanned_stones(self):
        """About 20 000 triangles of a stone, and of a ball."""
        random = numpy.random.default_rng(5)
        ball = random.normal(size=(10242, 3))
        ball /= numpy.linalg.norm(ball, axis=1)[:, None]
        stone = ball * (1 + .05 * numpy.sin(4 * ball[:, :1])) * [1, .8, .6]
        for points in (ball, stone):
            text = "".join(f"v {x} {y} {z}\n" for x, y, z in points)
            seen, text = self.file("stone.obj", text, hull=True, corners=60, max_volume_change=.2)
            self.assertEqual(seen["vertices"], 60, text)


class Packings(Case):
    def xyz(self, positions, quaternions, side, pbc="T T T", name="octahedron"):
        rows = "".join(f"{name} {' '.join(f'{x:.12g}' for x in [*p, *q])}\n" for p, q in zip(positions, quaternions))
        (self.folder / "p.xyz").write_text(
            f'{len(positions)}\nLattice="{side} 0 0 0 {side} 0 0 0 {side}" '
            f'Properties=species:S:1:pos:R:3:orientation:R:4 pbc="{pbc}"\n{rows}')

    def start(self, solid="octahedron", particles=64, file="p.xyz", **keys):
        return {"name": "m", "seed": 1, "replicates": 1, "sweep": {"solid": [solid], "particles": [particles]},
                "start": {"packing": file, **keys}, "measure": ["contacts"], "protocol": study.QUICK}

    def validated(self, what, document):
        code, output, messages = self.call("validate", document)
        print(f"{what}: exit code {code}, {(output + messages).strip()[-500:]}")
        return code, output, messages

    def octahedra(self, spacing, seed=3):
        cells = numpy.array(list(itertools.product(range(4), repeat=3)))
        turns = Rotation.random(64, random_state=seed)
        return cells * spacing, turns, 4 * spacing

    def test_what_an_xyz_file_states(self):
        positions, turns, side = self.octahedra(1.9)
        quaternions = turns.as_quat()
        for pbc, q, code, word in (("T T T", quaternions, 0, "deepest overlap 0"), ("1 1 1", quaternions, 0, "density"),
                                   ("F F F", quaternions, 65, "vector 1"), ("T T F", quaternions, 65, "vector 3"),
                                   ("T T", quaternions, 65, "three"), ("T T T", 3 * quaternions, 65, "length 3"),
                                   ("T T T", .8 * quaternions, 65, "length 0.8"),
                                   ("T T T", numpy.round(quaternions, 4), 0, "density")):
            self.xyz(positions, q, side, pbc)
            seen = self.validated(f"pbc {pbc}, |q| {numpy.linalg.norm(q[0]):.4f}", self.start(stage="expansion"))
            self.assertEqual(seen[0], code)
            self.assertIn(word, seen[1] + seen[2])
        self.xyz(positions, quaternions, side, name="Ne")  # as ASE writes a type
        code, _, messages = self.validated("names of types", self.start(types={"X": "octahedron"}))
        self.assertEqual((code, '"Ne" is taken for octahedron' in messages, 'no type "X"' in messages), (0, True, True))

    def test_order_of_quaternions(self):
        a = 1.02  # cubes with a common orientation in a cell that is rotated by 45 degrees
        cells = numpy.array([[i, j, k] for i in range(6) for j in range(6) for k in range(4) if (i + j) % 2 == 0])
        positions = cells * [a / 2**.5, a / 2**.5, 3 * 2**.5 * a / 4]
        q = numpy.tile(Rotation.from_euler("z", 45, degrees=True).as_quat(), (72, 1))
        for order, columns in (("x y z w", [0, 1, 2, 3]), ("w x y z", [3, 0, 1, 2])):
            self.xyz(positions, q[:, columns], 3 * 2**.5 * a, name="cube")
            _, output, messages = self.validated(order, self.start("cube", 72, density=.6))
            self.assertEqual("order" in messages and "x y z w" in messages, order == "w x y z", output + messages)

    def test_gaps_agree_with_brute_force(self):
        positions, turns, side = self.octahedra(1.45)
        frame = gsd.hoomd.Snapshot()
        frame.particles.N = 64
        frame.particles.types = ["A"]
        loops = [[int(v) for v in face] for face in faces(OCTAHEDRON)]
        mesh = {"type": "Mesh", "vertices": OCTAHEDRON.tolist(), "indices": loops}
        frame.particles.type_shapes = [mesh]
        frame.particles.position = positions - side / 2
        frame.particles.orientation = turns.as_quat()[:, [3, 0, 1, 2]]
        frame.configuration.box = [side, side, side, 0, 0, 0]
        with gsd.hoomd.open(str(self.folder / "p.gsd"), "wb") as file:
            file.append(frame)
        reach = .15
        document = {**self.start(file="p.gsd", stage="as_given", gap=reach),
                    "measure": ["contacts", "clusters", "order", "gaps"]}
        code, _, messages = self.call("run", document, "-o", self.folder / "r")
        self.assertEqual(code, 0, messages)
        record = next(iter(study.records(self.folder / "r").values()))
        print("the record:", record["path"][0]["stage"], record["phi_j"]["phi_j_reason"])
        self.assertEqual((record["path"][0]["stage"], record["phi_j"]["phi_j"]), ("as_given", None))
        table = self.folder / "c.csv"
        study.call(PROGRAM, "export", self.folder / "r", "all", "--format", "contacts", "-o", table)
        with open(table, newline="") as text:
            rows = {(int(r["a"]), int(r["b"]), *(int(r[f"image_{c}"]) for c in "xyz")): r for r in csv.DictReader(text)}
        stored = json.loads(next((self.folder / "r" / "packings").glob("*")).read_text())
        expected = brute_force(stored, reach)
        errors = {"gap": [], "theta_ff": [], "theta_ef": []}
        for key, (width, angles) in expected.items():
            row = rows[key]
            errors["gap"].append(abs(float(row["gap"]) - max(width, 0)))
            if width > 0 and angles:
                for name, angle in zip(("theta_ff", "theta_ef"), angles):
                    errors[name].append(abs(float(row[name]) - angle))
        overlapping = sum(width <= 0 for width, _ in expected.values())
        print(f"{len(rows)} pairs, {len(expected)} by brute force, {overlapping} overlap; largest errors",
              {name: f"{max(list_):.1e} of {len(list_)}" for name, list_ in errors.items()},
              "Z", record["states"][0]["contacts"]["Z"])
        self.assertEqual(set(rows), set(expected))
        for list_ in errors.values():
            self.assertLess(max(list_), 1e-10)
        self.assertGreater(len(expected), overlapping + 10)
        self.assertAlmostEqual(record["states"][0]["contacts"]["Z"], 2 * len(rows) / 64)
        study.call(PROGRAM, "export", self.folder / "r", "all", "--format", "gsd", "--contacts", "-o", self.folder)
        with gsd.hoomd.open(str(next(self.folder.glob("o*.gsd"))), "rb") as file:
            print(file[0].bonds.N, "bonds in the exported frame")
            self.assertEqual(file[0].bonds.N, len(rows))
        added = subprocess.run([PROGRAM, "measure", self.folder / "r", "--add", "percolation"], capture_output=True,
                               text=True, check=False)
        print("added:", added.returncode, (added.stdout + added.stderr).strip())
        self.assertEqual(added.returncode, 0)
        self.assertNotIn("not saved", added.stderr)

    def test_measures_of_a_packing_as_given(self):
        positions, turns, side = self.octahedra(1.9)
        for n, measure, code, word in ((64, "modes", 65, "as given"), (64, "gaps", 0, ""), (8, "order", 0, ""),
                                       (8, "contacts", 0, "")):
            self.xyz(positions[:n], turns.as_quat()[:n], side)
            document = {**self.start(particles=n, stage="as_given"), "measure": [measure]}
            seen = self.call("run", document, "-o", self.folder / measure)
            print(n, measure, seen[0], seen[2].strip()[:300])
            self.assertEqual(seen[0], code)
            self.assertIn(word, seen[2])

    def test_sizes(self):
        sizes = numpy.round(numpy.random.default_rng(7).lognormal(0, .2, 100), 4)
        (self.folder / "sizes.txt").write_text("# measured\n\n" + "\n".join(map(str, sizes)))
        discrete = {"discrete": [{"size": s, "fraction": .01} for s in sizes]}
        for size in (1, {"values": sizes.tolist()}, {"file": "sizes.txt"}, discrete,
                     {"values": sizes.tolist(), "take": "in_order"}, {"file": "sizes.txt", "take": "drawn", "seed": 5}):
            mixture = {"mixture": [{"solid": "octahedron", "fraction": 1, "size": size}], "name": "stones"}
            document = {"name": "m", "seed": 1, "replicates": 1, "sweep": {"solid": [mixture], "particles": [100]},
                        "measure": ["contacts"], "protocol": {**study.QUICK, "max_density": .5, "max_steps": 1}}
            results = self.folder / str(len(list(self.folder.iterdir())))
            self.call("run", document, "-o", results)
            own = json.loads((results / "manifest.json").read_text())["sweep"]["solid"][0]["mixture"][0]["size"]
            print(str(own)[:70])
            if "values" in str(own):
                expected = sizes if size.get("take") == "in_order" else sorted(sizes)
                self.assertEqual(own["values"], list(expected))
            self.assertEqual(len(study.records(results)), 1)
        for text, code in (("1,05\n1,1", 65), ("1,05; 1,1;", 65), ("1.05,1.1\n", 0), ("1, 2,", 0), ("1,2,3\n", 0)):
            (self.folder / "sizes.txt").write_text(text)
            mixture["mixture"][0]["size"] = {"file": "sizes.txt"}
            seen = self.call("validate", {**document, "sweep": {"solid": [mixture], "particles": [300]}})
            print(repr(text), seen[0], seen[2].strip())
            self.assertEqual((seen[0], "may be one size or two" in seen[2]), (code, code == 65))

    def test_arrays_of_other_schedulers(self):
        document = {**self.start(), "replicates": 3}
        del document["start"]
        none = {"PBS_ARRAY_INDEX": "", "SGE_TASK_ID": "undefined", "LSB_JOBINDEX": "0"}
        for variables, code, word in (({"PBS_ARRAY_INDEX": "2"}, 2, "--shard"), ({"PBS_ARRAYID": "0"}, 2, "--shard"),
                                      ({"LSB_JOBINDEX": "2"}, 2, "--shard"), (none, 0, "3 replicates"),
                                      ({"SGE_TASK_ID": "5", "SGE_TASK_FIRST": "1", "SGE_TASK_LAST": "5",
                                        "SGE_TASK_STEPSIZE": "2"}, 0, "each of 3 shards")):
            seen = self.call("run", document, "-o", self.folder / "r", "--dry-run", environment=variables)
            print(variables, seen[0], (seen[1] + seen[2]).strip()[:300].replace("\n", " | "))
            self.assertEqual(seen[0], code)
            self.assertIn(word, seen[1] + seen[2])


def brute_force(stored, reach):
    """For each pair (a, b, image) with a gap below `reach`: the gap, and the angles θ_ff and θ_ef after b was moved by
    `reach` along the axis of the gap. The angles are None if the moved solids are disjoint."""
    x, side = numpy.array(stored["positions"]), stored["side"]
    turns = Rotation.from_quat(numpy.array(stored["orientations"])[:, [1, 2, 3, 0]]).as_matrix()
    corners = [OCTAHEDRON @ turn.T for turn in turns]
    loops = faces(OCTAHEDRON)
    edges = sorted({tuple(sorted((f[k], f[k - 1]))) for f in loops for k in range(len(f))})
    normals = [numpy.array([unit(numpy.cross(c[f[1]] - c[f[0]], c[f[2]] - c[f[0]])) for f in loops]) for c in corners]
    rays = [numpy.array([unit(c[b] - c[a]) for a, b in edges]) for c in corners]
    found = {}
    for a, b in itertools.combinations(range(len(x)), 2):
        for image in itertools.product((-1, 0, 1), repeat=3):
            r = x[b] - x[a] + side * numpy.array(image)
            if numpy.linalg.norm(r) > 2.2:
                continue
            cross = numpy.cross(rays[a][:, None], rays[b][None]).reshape(-1, 3)
            cross = cross[numpy.linalg.norm(cross, axis=1) > 1e-9]
            cross /= numpy.linalg.norm(cross, axis=1)[:, None]
            cross *= numpy.where(cross @ r < 0, -1, 1)[:, None]
            axes = numpy.vstack([normals[a], -normals[b], cross])
            gaps = ((corners[b] + r) @ axes.T).min(axis=0) - (corners[a] @ axes.T).max(axis=0)
            width = gaps.max()
            if width < reach:
                moved = r - reach * axes[gaps.argmax()]
                found[(a, b, *image)] = width, angles_of(corners[a], normals[a], rays[a], corners[b] + moved,
                                                         normals[b], rays[b], edges, loops) if width > 0 else None
    return found


def unit(v):
    return v / numpy.linalg.norm(v)


def angles_of(corners_a, normals_a, rays_a, corners_b, normals_b, rays_b, edges, loops):
    offsets_a, offsets_b = (numpy.array([n @ c[f[0]] for n, f in zip(normals, loops)])
                            for normals, c in ((normals_a, corners_a), (normals_b, corners_b)))
    normals, offsets = numpy.vstack([normals_a, normals_b]), numpy.r_[offsets_a, offsets_b]
    inner = linprog([0, 0, 0, -1], A_ub=numpy.c_[normals, numpy.ones(len(normals))], b_ub=offsets,
                    bounds=[(None, None)] * 4)
    if inner.x[3] < 1e-6:
        return None
    vertices = HalfspaceIntersection(numpy.c_[normals, -offsets], inner.x[:3]).intersections
    bounds = (abs(vertices @ normals.T - offsets) < 1e-9).sum(axis=0) >= 3
    of_a, of_b = bounds[:len(normals_a)], bounds[len(normals_a):]
    opposed = -normals_a[of_a] @ normals_b[of_b].T
    ff = numpy.arccos(numpy.clip(opposed, -1, 1)).min() if opposed.size else numpy.pi
    ef = [numpy.pi / 2]
    for corners, rays, walls, bound, faces_ in ((corners_a, rays_a, normals_b, offsets_b, of_b),
                                                (corners_b, rays_b, normals_a, offsets_a, of_a)):
        for (p, q), ray in zip(edges, rays):
            start, end = walls @ corners[p] - bound, walls @ corners[q] - bound
            low = max([0, *(s / (s - e) for s, e in zip(start, end) if s > 0 > e)])
            high = min([1, *(s / (s - e) for s, e in zip(start, end) if s < 0 < e)])
            if high > low and not ((start > 0) & (end > 0)).any() and faces_.any():
                ef.append(numpy.arcsin(numpy.clip(abs(walls[faces_] @ ray), 0, 1)).min())
    return ff, min(ef)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
