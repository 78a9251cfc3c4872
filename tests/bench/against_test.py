"""Tests against.py with two programs that replace isojam_bench and print given results. usage: against_test.py"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

AGAINST = pathlib.Path(__file__).resolve().parent / "against.py"
FAKE = f"#!{sys.executable} -B" + """
import json, pathlib, sys
here = pathlib.Path(__file__)
with open(here.parent / "log", "a") as log:
    log.write(here.name + "\\n")
answers = json.loads((here.parent / (here.name + ".json")).read_text())
ran = (here.parent / "log").read_text().split().count(here.name)
if ran > len(answers):
    sys.exit(3)
pathlib.Path(sys.argv[sys.argv.index("--ratios") + 1]).write_text(json.dumps({"medians": answers[ran - 1]}))
"""


class Against(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory(prefix="isojam-against-")
        self.addCleanup(directory.cleanup)
        self.root = pathlib.Path(directory.name)

    def compared(self, before, now):
        """Calls against.py with programs that print these results, one result for each round."""
        for name, answers in (("before", before), ("now", now)):
            (self.root / (name + ".json")).write_text(json.dumps(answers))
            (self.root / name).write_text(FAKE)
            (self.root / name).chmod(0o755)
        words = [sys.executable, "-B", AGAINST, self.root / "before", self.root / "now", "--rounds", "3"]
        return subprocess.run(words + ["--filter", "kernel"], capture_output=True, text=True)

    def test_median_of_ratios(self):
        # Ratios 2, 4 and 5; the ratio of the medians, 30 over 8, would be 3.75.
        ended = self.compared([{"kernel/a": 20}, {"kernel/a": 32}, {"kernel/a": 30}],
                              [{"kernel/a": 10}, {"kernel/a": 8}, {"kernel/a": 6}])
        self.assertEqual(ended.returncode, 0, ended.stderr)
        row = ended.stdout.splitlines()[-1].split()
        self.assertEqual(row, ["kernel/a", "30", "ns", "8", "ns", "4.00", "2.00", "…", "5.00"])

    def test_order_changes(self):
        ended = self.compared([{"kernel/a": 1}] * 3, [{"kernel/a": 1}] * 3)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual((self.root / "log").read_text().split(), ["before", "now", "now", "before", "before", "now"])

    def test_what_both_have(self):
        ended = self.compared([{"kernel/a": 1, "kernel/old": 1, "kernel/a#bytes": 1}] * 3,
                              [{"kernel/a": 1, "kernel/new": 1, "kernel/a#bytes": 1}] * 3)
        self.assertEqual([line.split()[0] for line in ended.stdout.splitlines()], ["benchmark", "kernel/a"])

    def test_nothing_in_common(self):
        ended = self.compared([{"kernel/old": 1}] * 3, [{"kernel/new": 1}] * 3)
        self.assertEqual((ended.returncode, ended.stderr), (1, "no benchmark that both have matches kernel\n"))

    def test_failure(self):
        ended = self.compared([{"kernel/a": 1}] * 3, [{"kernel/a": 1}] * 2)
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("exit status 3", ended.stderr)


if __name__ == "__main__":
    unittest.main()
