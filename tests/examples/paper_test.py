"""Facts proved here: python3 paper_test.py examples/paper ISOJAM

- the committed page is what the committed data say, and a page with one figure changed is refused;
- a figure agrees if it lies within the interval of our mean or, being of one packing, within the spread of our single
  packings; it differs outside, by however little; what has fewer than three packings, or spreads by half of the
  figure, is undecided; a mean that is to approach a limit does so to the fraction asked for and no more, and it is
  undecided where the interval lies on both sides of that;
- a page without one of its blocks, or with one twice, is refused, and there is nothing left to be filled in;
- a shift of φ_J is the mean of differences of the same replicates, crystals left out;
- the prediction interval of one more packing covers 95 % of normal samples, the interval of the mean does not;
- two estimates overlap exactly if their intervals do, in either order;
- gathering results of a small run gives the means over its records, but for crystals and what fell short, rounded, and
  pairs replicates that began alike.
"""

import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PAPER, ISOJAM = Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(PAPER))

from blocks import BLOCKS, interval, said  # noqa: E402
from gather import copy_of_those_that_count, counting  # noqa: E402
from verdicts import estimate_of, overlap, single_half_width, verdict  # noqa: E402


def of(mean, half_width, n=16):
    return {"mean": mean, "half_width": half_width, "n": n}


class Page(unittest.TestCase):
    def check(self, page):
        return subprocess.run(["/usr/bin/python3", "-B", PAPER / "page.py", page, "--check"], capture_output=True,
                              text=True, check=False)

    def test_is_what_the_data_say(self):
        result = self.check(PAPER / "README.md")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_projects_page_has_its_summary(self):
        page = (PAPER / "README.md").read_text(encoding="utf-8")
        summary = page[page.index("<!-- block summary -->"):].split("<!-- end -->")[0]
        first = (PAPER.parent.parent / "README.md").read_text(encoding="utf-8")
        for line in summary.splitlines()[1:]:
            self.assertIn(line, first)

    def test_is_refused_if_a_figure_was_changed(self):
        text = (PAPER / "README.md").read_text(encoding="utf-8")
        at = text.index("| octahedron 100 | .") + len("| octahedron 100 | .")
        with tempfile.TemporaryDirectory() as here:
            changed = Path(here) / "README.md"
            changed.write_text(text[:at] + str((int(text[at]) + 1) % 10) + text[at + 1:], encoding="utf-8")
            result = self.check(changed)
        self.assertEqual(result.returncode, 1)
        self.assertIn("a block is not what", result.stderr)

    def test_is_refused_without_a_block(self):
        text = (PAPER / "README.md").read_text(encoding="utf-8")
        self.assertNotRegex(text, r"(?m)^@")
        begin = text.index("<!-- block shifts -->")
        end = text.index("<!-- end -->", begin)
        block = text[begin:end + len("<!-- end -->")]
        with tempfile.TemporaryDirectory() as here:
            changed = Path(here) / "README.md"
            for damaged in (text.replace(block, ""), text + block):
                changed.write_text(damaged, encoding="utf-8")
                self.assertIn("every block once", self.check(changed).stderr)


class Blocks(unittest.TestCase):
    def test_shifts_are_of_pairs(self):
        def pair(replicate, base, varied, *flags):
            return {"solid": "octahedron", "particles": 100, "replicate": replicate,
                    "base": {"phi_j": base, "flags": [], "residual": 1e-7},
                    "varied": {"phi_j": varied, "flags": list(flags), "residual": 2e-7}}

        pairs = [pair(0, 0.68, 0.681), pair(1, 0.69, 0.6912), pair(2, 0.67, 0.6708, "not_balanced"),
                 pair(3, 0.68, 0.75, "crystalline")]
        data = type("Data", (), {"records": {"pairs": {"paper-rule": pairs}}})
        # Differences of 10, 12 and 8: t 4.3027, sd 2, n 3.
        self.assertIn("| rule | octahedron | 3 | .6800 | 10.0 ± 5.0 | 2e-07 |", BLOCKS["shifts"](data))

    def test_numbers(self):
        self.assertEqual(interval(of(0.68354, 0.00271)), ".6835 ± .0027")
        self.assertEqual(interval(of(-0.05, 0.031)), "-.050 ± .031")
        self.assertEqual(interval(of(12.13, 0.0)), "12.13 in all")
        self.assertEqual(interval({"mean": 2.434, "half_width": None, "n": 1}), "2.434 (one)")
        self.assertEqual(interval(None), "–")
        self.assertEqual(said({"value": 1.01, "error": 0.1, "digits": 2}), "1.01 ± .10")

    def test_estimates(self):
        values = [0.71, 0.69, 0.70]
        ours = estimate_of(values)
        self.assertAlmostEqual(ours["mean"], 0.7)
        self.assertAlmostEqual(ours["half_width"], 4.3027 * 0.01 / 3 ** 0.5)
        self.assertIsNone(estimate_of([0.7])["half_width"])


class Verdicts(unittest.TestCase):
    def word(self, mean, half_width, n=16, **figure):
        return verdict(of(mean, half_width, n), figure).word

    def test_by_the_intervals(self):
        single = 0.01 * 17 ** 0.5
        for sign in (-1, 1):
            for off, why in ((0.0, "with the mean"), (0.0099, "with the mean"), (0.0101, "with single packings"),
                             (0.99 * single, "with single packings")):
                said = verdict(of(0.7 + sign * off, 0.01), {"value": 0.7})
                self.assertEqual(said.word, "agrees", off)
                self.assertTrue(said.why.startswith(why), f"{off}: {said.why}")
            self.assertEqual(self.word(0.7 + sign * 1.01 * single, 0.01, value=0.7), "differs")

    def test_the_papers_own_interval_counts(self):
        self.assertEqual(self.word(0.715, 0.001, value=0.7), "differs")
        self.assertEqual(self.word(0.715, 0.001, value=0.7, error=0.014), "agrees")
        self.assertEqual(self.word(0.7, 0.001, value=0.65, digits=1), "agrees")
        self.assertEqual(self.word(0.7, 0.001, value=0.65, digits=2), "differs")

    def test_what_is_undecided(self):
        self.assertEqual(verdict(None, {"value": 1}).word, "undecided")
        self.assertEqual(self.word(1, 0.1, n=2, value=1), "undecided")
        self.assertEqual(self.word(1, 0.2, value=1), "undecided")  # single packings spread by .82
        self.assertEqual(self.word(1.25, 0.2, value=1), "undecided")  # not better than the one before
        self.assertEqual(self.word(1, 0.1, value=1), "agrees")
        self.assertEqual(self.word(0, 0.1, value=0), "agrees")

    def test_limits(self):
        self.assertEqual(self.word(11.32, 0.03, value=12, limit=0.06), "agrees")
        self.assertEqual(self.word(11.32, 0.05, value=12, limit=0.06), "undecided")
        self.assertEqual(self.word(11.24, 0.05, value=12, limit=0.06), "undecided")
        self.assertEqual(self.word(11.24, 0.03, value=12, limit=0.06), "differs")
        self.assertEqual(self.word(12.76, 0.03, value=12, limit=0.06), "differs")

    def test_single_packings_are_covered(self):
        stream = random.Random(7)
        for n in (3, 8, 16):
            trials = 4000
            single = mean = 0
            for _ in range(trials):
                ours = estimate_of([stream.gauss(0, 1) for _ in range(n)])
                off = abs(stream.gauss(0, 1) - ours["mean"])
                single += off <= single_half_width(ours)
                mean += off <= ours["half_width"]
            self.assertAlmostEqual(single / trials, 0.95, delta=4 * (0.95 * 0.05 / trials) ** 0.5, msg=f"n = {n}")
            self.assertLess(mean / trials, 0.9, f"n = {n}")

    def test_overlap(self):
        for first, second, together in (((1, 0.2), (1.3, 0.11), True), ((1, 0.2), (1.3, 0.09), False),
                                        ((1, 0.5), (1.1, 0.01), True)):
            self.assertIs(overlap(of(*first), of(*second)), together, (first, second))
            self.assertIs(overlap(of(*second), of(*first)), together, (second, first))
        self.assertIsNone(overlap(None, of(1, 1)))


class Gathered(unittest.TestCase):
    MANIFEST = {"seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [24]}, "replicates": 2,
                "protocol": {"initial_density": 0.2, "consolidation_step": 0.04, "step_fraction": 0.4,
                             "final_distance": 0.03, "fit_window": 0.1},
                "measure": ["contacts", "clusters", "modes", "rigidity"]}

    def run_study(self, results, name, replicates=2, **changes):
        manifest = json.loads(json.dumps({**self.MANIFEST, "name": name, "replicates": replicates}))
        manifest["protocol"].update(changes)
        path = results / f"{name}.json"
        path.write_text(json.dumps(manifest), encoding="utf-8")
        subprocess.run([ISOJAM, "run", path, "-o", results / name, "--quiet"], check=True, capture_output=True)

    def test_what_is_left_out(self):
        flags = {"a": [], "b": ["crystalline"], "c": ["goal_not_reached", "not_stable"], "d": ["not_stable"], "e": None, "f": None}
        with tempfile.TemporaryDirectory() as here:
            source = Path(here) / "source"
            (source / "records").mkdir(parents=True)
            (source / "manifest.json").write_text("{}", encoding="utf-8")
            for name, some in flags.items():  # what failed has none, or, of earlier versions, no such key
                record = {} if name == "e" else {"flags": some}
                (source / "records" / f"{name}.json").write_text(json.dumps(record), encoding="utf-8")
            copies = copy_of_those_that_count(Path(here) / "copy", [source])
            self.assertEqual(sorted(path.stem for path in (copies[0] / "records").iterdir()), ["a", "d", "e", "f"])
        records = [{"status": "failed"} if some is None else {"status": "done", "name": name, "flags": some}
                   for name, some in flags.items()]
        self.assertEqual([record["name"] for record in counting(records)], ["a", "d"])

    def test_small_runs(self):
        with tempfile.TemporaryDirectory() as here:
            results = Path(here)
            self.run_study(results, "paper-100")
            self.run_study(results, "paper-base", replicates=1)
            self.run_study(results, "paper-window", fit_window=0.06)
            subprocess.run(["/usr/bin/python3", "-B", PAPER / "gather.py", ISOJAM, results, results / "out"],
                           check=True, capture_output=True)
            tables = json.loads((results / "out" / "tables.json").read_text(encoding="utf-8"))
            records = json.loads((results / "out" / "records.json").read_text(encoding="utf-8"))
            own = [json.loads(path.read_text(encoding="utf-8"))
                   for path in (results / "paper-100" / "records").glob("*.json")]
        counting = [record for record in own if not {"crystalline", "goal_not_reached"} & set(record["flags"])]
        self.assertGreater(len(counting), 0)
        self.assertEqual(len(tables["main"]), 1)
        self.assertEqual(tables["nearest"], [])
        self.assertEqual(tables["main"][0]["replicates"], len(counting))
        for column, values in (("phi_j", [r["phi_j"]["phi_j"] for r in counting]),
                               ("Z", [r["nearest"]["Z"] for r in counting])):
            mean = sum(values) / len(values)
            self.assertAlmostEqual(tables["main"][0][column]["mean"], mean, delta=1e-5 * mean)
        pairs = records["pairs"]["paper-window"]
        self.assertEqual([pair["replicate"] for pair in pairs], [0], "there is no other in the base study")
        self.assertEqual(list(records["pairs"]), ["paper-window"])
        study = records["studies"]["paper-100"]
        self.assertEqual(study["stability"]["dodecahedron"]["replicates"], 2)
        self.assertGreater(study["cost"]["stages"]["jam"], study["cost"]["stages"]["contacts"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
