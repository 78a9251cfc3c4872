"""Tests the first day of a user as one story. usage: day_test.py PROGRAM MODULE"""

import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MODULE = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
sys.path.insert(0, str(MODULE))

# Two solids whose packings take about a second each.
STUDY = {"name": "mine", "seed": 11, "replicates": 2, "measure": ["contacts"],
         "sweep": {"solid": ["dodecahedron"], "particles": [28]},
         "protocol": {"initial_density": 0.5, "final_distance": 0.04}}


class Day(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def isojam(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments], cwd=self.here, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def write(self, file, **changes):
        manifest = STUDY | changes
        (self.here / file).write_text(json.dumps(manifest), encoding="utf-8")
        return manifest

    def records(self, directory):
        return {path.name: json.loads(path.read_text(encoding="utf-8"))
                for path in (self.here / directory / "records").glob("*.json")}

    def in_terminal(self, *arguments, columns, errors=subprocess.DEVNULL):
        """The output of the command in a terminal of this width. With `errors` STDOUT, the messages are part of it."""
        master, slave = pty.openpty()
        subprocess.run(["stty", "cols", str(columns), "rows", "40"], stdin=slave, check=True)
        with subprocess.Popen([PROGRAM, *arguments], cwd=self.here, stdin=slave, stdout=slave,
                              stderr=errors) as process:
            os.close(slave)
            out = b""
            try:
                while part := os.read(master, 65536):
                    out += part
            except OSError:  # the end of the output, in Linux
                pass
        os.close(master)
        self.assertEqual(process.returncode, 0)
        return out.decode().replace("\r\n", "\n")

    def test_a_study_grows_and_gets_a_forgotten_measure(self):
        self.write("m.json")
        self.assertIn("OK", self.isojam("validate", "m.json").stdout)
        self.isojam("run", "m.json", "-o", "r")
        before = self.records("r")
        self.write("m.json", sweep={"solid": ["dodecahedron", "octahedron"], "particles": [28, 48]})
        refused = self.isojam("validate", "m.json", code=65).stderr
        self.assertIn("28 is too small for octahedron", refused)
        self.write("m.json", sweep={"solid": ["dodecahedron", "icosahedron"], "particles": [28]})
        self.isojam("run", "m.json", "-o", "r")
        grown = self.records("r")
        self.assertEqual(len(grown), 4)
        self.assertEqual({name: grown[name] for name in before}, before)
        added = self.isojam("measure", "r", "--add", "modes")
        self.assertIn("state nearest jamming", added.stderr)
        self.assertEqual({tuple(record["nearest_only"]) for record in self.records("r").values()}, {("modes",)})
        self.isojam("report", "r")
        import isojam
        study = isojam.load(self.here / "r", program=PROGRAM)
        kept = study.replicates.kept.groupby("solid").phi_j.mean()
        rows = json.loads((self.here / "r/tables.json").read_text(encoding="utf-8"))["rows"]
        self.assertEqual(len(rows), 2)
        for row in rows:
            if row["phi_j"]["n"]:
                self.assertAlmostEqual(kept[row["solid"]], row["phi_j"]["mean"], places=13)

    def test_tables_fit_the_terminal(self):
        self.write("m.json", sweep={"solid": ["dodecahedron", "icosahedron"], "particles": [28]})
        self.isojam("run", "m.json", "-o", "r")
        whole = self.isojam("aggregate", "r").stdout
        self.assertGreater(max(map(len, whole.splitlines())), 100)
        shown = self.in_terminal("aggregate", "r", "--all", columns=80)
        self.assertLessEqual(max(map(len, shown.splitlines())), 80, shown)
        numbers = [word for word in whole.split() if word.replace(".", "").isdigit()]
        self.assertTrue(set(numbers) <= set(shown.split()), "a number was divided or lost")

    def test_cubes_reach_the_target_energy_with_the_defaults(self):
        self.write("m.json", name="cubes", replicates=1, sweep={"solid": ["cube"], "particles": [45]},
                   protocol={"final_distance": 0.05})
        self.isojam("run", "m.json", "-o", "r")
        self.assertEqual([record["status"] for record in self.records("r").values()], ["done"])

    def test_a_stopping_rule_states_its_goal(self):
        rule = {"min": 2, "max": 3, "quantity": "phi_j", "half_width": 1e-4}
        self.write("m.json", replicates=rule)
        done = self.isojam("run", "m.json", "-o", "r")
        self.assertIn("min", done.stderr)
        self.assertEqual(len(self.records("r")), 3)
        goal = next(part for part in done.stdout.split("\n\n") if part.startswith("goal"))
        self.assertIn("1.0e-04", goal.replace("0.0001", "1.0e-04"))
        before = self.records("r")
        self.write("m.json", replicates=rule | {"max": 6})
        shown = self.in_terminal("run", "m.json", "-o", "r", columns=80, errors=subprocess.STDOUT)
        self.assertIn("confidence interval still too wide: running 2 more replicates", shown)
        bars = re.findall(r"\[([#.]*)\] (\d+) of (\d+) replicates?", shown)
        self.assertGreater(len(bars), 1, shown)
        for bar, finished, wanted in bars:
            self.assertEqual(len(bar), 24)
            self.assertLessEqual(int(finished), int(wanted))
        after = self.records("r")
        self.assertEqual((len(after), {name: after[name] for name in before}), (6, before))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
