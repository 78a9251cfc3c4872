"""Facts proved here, of isojam_cones on a small study:
- a row for every state of the replicates asked for with 0 < Δφ < the bound and class cut-offs, in order, with the
  constraints, states of self-stress and contacts outside their patches of its record; --below and --each leave out the
  others; of several directories one after the other; the same bytes on one processor;
- the dimension is that of all self-stress wherever all forces act inside their patches, and never more; elsewhere it is
  0 in some state;
- what cannot be done ends with one sentence, exit code 2 and no file.
usage: cones_test.py CONES RESULTS
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

CONES, RESULTS = map(pathlib.Path, sys.argv[1:3])


def expected(below, each):
    """Rows as the records have them, without dimensions."""
    rows = []
    for file in sorted((RESULTS / "records").glob("*.json")):
        record = json.loads(file.read_text())
        if record["spec"]["replicate"] >= each:
            continue
        for k, state in enumerate(record["states"]):
            if not 0 < state["delta_phi"] < below or state["C"] is None:
                continue
            one_sided = state["one_sided"]
            rows.append({"study": "cones", "solid": record["spec"]["solid"], "particles": record["spec"]["particles"],
                         "replicate": record["spec"]["replicate"], "state": k, "delta_phi": state["delta_phi"],
                         "constraints": one_sided["constraints"],
                         "self_stress": state["rigidity"]["classes"]["self_stress"], "outside": one_sided["outside"],
                         "outside_faces": one_sided["outside_faces"]})
    return rows


class Cones(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory(prefix="isojam-cones-") as directory:
            output = pathlib.Path(directory) / "rows.json"
            subprocess.run([CONES, RESULTS, "-o", output], check=True, stdout=subprocess.DEVNULL)
            cls.text = output.read_bytes()
            cls.all = json.loads(cls.text)["rows"]

    def setUp(self):
        directory = tempfile.TemporaryDirectory(prefix="isojam-cones-")
        self.addCleanup(directory.cleanup)
        self.root = pathlib.Path(directory.name)
        self.output = self.root / "rows.json"

    def ran(self, *words, **options):
        return subprocess.run([CONES, *words], capture_output=True, text=True, check=False, **options)

    def rows(self, *words, **options):
        done = self.ran(*words, "-o", self.output, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads(self.output.read_text())["rows"]

    def test_rows_are_those_asked_for(self):
        for rows, below, each in ((self.all, 0.02, 4), (self.rows(RESULTS, "--below", "0.006"), 0.006, 4),
                                  (self.rows(RESULTS, "--each", "1", "--below", "1"), 1, 1)):
            self.assertGreater(len(rows), 5)
            self.assertTrue(all(list(row)[-1] == "dimension" for row in rows))
            self.assertEqual([dict(list(row.items())[:-1]) for row in rows], expected(below, each))

    def test_directories_and_processors(self):
        self.rows(RESULTS, preexec_fn=lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))}))
        self.assertEqual(self.output.read_bytes(), self.text)
        few = self.rows(RESULTS, "--below", "0.004", "--each", "1")
        self.assertEqual(self.rows(RESULTS, RESULTS, "--below", "0.004", "--each", "1"), few + few)

    def test_dimensions(self):
        rows = self.all
        for row in rows:
            self.assertIsInstance(row["dimension"], int, row)
            self.assertLessEqual(row["dimension"], row["self_stress"], row)
            if row["outside"] == 0:
                self.assertEqual(row["dimension"], row["self_stress"], row)
        self.assertGreater(sum(row["outside"] == 0 and row["self_stress"] > 1 for row in rows), 3)
        self.assertIn(0, [row["dimension"] for row in rows if row["outside"] > 0])

    def test_refusals(self):
        (self.root / "empty").mkdir()
        without_path = self.root / "without_path"
        without_path.mkdir()
        for name in ("manifest.json", "records", "packings"):
            (without_path / name).symlink_to((RESULTS / name).resolve())
        for words in ([], [RESULTS], ["-o", self.output], [RESULTS, "-o"], [RESULTS, "-o", self.root / "no" / "where"],
                      [self.root / "none", "-o", self.output], [self.root / "empty", "-o", self.output],
                      [without_path, "-o", self.output], [RESULTS, "-o", self.output, "--more", "1"],
                      [RESULTS, "-o", self.output, "--below", "0"], [RESULTS, "-o", self.output, "--below", "a"],
                      [RESULTS, "-o", self.output, "--each", "1.5"], [RESULTS, "-o", self.output, "--each", "0"]):
            done = self.ran(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertRegex(done.stderr, r"\Aerror: [^\n]+\n\Z", words)
            self.assertFalse(self.output.exists(), words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
