"""Tests the page examples/paper. usage: paper_test.py examples/paper ISOJAM

- The committed page, and its table in README.md, agree with the committed data in every block and every number in a
  sentence. A page with a changed number is rejected, and so is a page in which a block is missing or occurs twice.
- The page states whether a value of the paper is in the confidence interval, in the prediction interval, or outside
  both. The comparison is undecided for fewer than three packings, and if the prediction interval is wider than ± half
  of the value.
- Contacts are classified by cut-offs as in the program. Regions, emergence and the distribution of face-face contacts
  agree with counts by hand. If face-face contacts are drawn at random, q and p of network.hindrance() are equal.
- Shifts of φ_J are differences of paired replicates, without crystalline ones. Settings are ranked by χ², and a setting
  with the paper's values is the first. Confidence intervals agree with those computed by hand. Fit windows are chosen
  with the smaller N; one that is chosen with the larger N is marked. The base of the search is the protocol of the
  studies.
- Gathering the results of a small run gives the means and the φ_J of the program's tables.
- Two replicates of the studies, run again, have the values of the committed data.
"""

import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PAPER, ISOJAM = Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(PAPER))

import anew  # noqa: E402
import densities  # noqa: E402
import network  # noqa: E402
import search  # noqa: E402
from data import SOLIDS, Data  # noqa: E402
from estimates import estimate_of, single_half_width  # noqa: E402
from verdicts import MEAN, ONE, OUTSIDE, UNDECIDED, overlap, verdict  # noqa: E402


def of(mean, half_width, n=16, **more):
    return {"mean": mean, "half_width": half_width, "n": n, **more}


class Page(unittest.TestCase):
    def check(self, page, *options):
        return subprocess.run([sys.executable, "-B", PAPER / "page.py", page, "--check", *options],
                              capture_output=True, text=True, check=False)

    def test_is_what_the_data_say(self):
        result = self.check(PAPER / "README.md")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_projects_page_has_some_of_it(self):
        result = self.check(PAPER.parent.parent / "README.md", "--some")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_is_refused_if_a_figure_was_changed(self):
        text = (PAPER / "README.md").read_text(encoding="utf-8")
        for mark in ("| octahedron 100 | 16 | 0.", "<!-- = total states -->"):
            at = text.index(mark) + len(mark)
            with tempfile.TemporaryDirectory() as here:
                changed = Path(here) / "README.md"
                changed.write_text(text[:at] + str((int(text[at]) + 1) % 10) + text[at + 1:], encoding="utf-8")
                result = self.check(changed)
            self.assertEqual(result.returncode, 1)
            self.assertIn("differs from", result.stderr)

    def test_is_refused_without_a_block(self):
        text = (PAPER / "README.md").read_text(encoding="utf-8")
        begin = text.index("<!-- block offsets -->")
        end = text.index("<!-- end -->", begin)
        block = text[begin:end + len("<!-- end -->")]
        with tempfile.TemporaryDirectory() as here:
            changed = Path(here) / "README.md"
            for damaged in (text.replace(block, ""), text + block):
                changed.write_text(damaged, encoding="utf-8")
                self.assertIn("every block once", self.check(changed).stderr)

    def test_figures_are_small_and_there(self):
        text = (PAPER / "README.md").read_text(encoding="utf-8")
        for image in PAPER.glob("*.png"):
            self.assertLess(image.stat().st_size, 60_000)
            self.assertIn(f"]({image.name})", text)


class Verdicts(unittest.TestCase):
    def test_by_the_intervals(self):
        single = 0.01 * 17 ** 0.5
        for sign in (-1, 1):
            for off, word in ((0.0, MEAN), (0.0099, MEAN), (0.0101, ONE), (0.99 * single, ONE),
                              (1.01 * single, OUTSIDE)):
                self.assertEqual(verdict(of(0.7 + sign * off, 0.01), {"value": 0.7}), word, off)
                # A systematic error widens both.
                wide = of(0.7 + sign * (off + 0.02), 0.01, systematic=0.02)
                self.assertEqual(verdict(wide, {"value": 0.7}), word, off)

    def test_the_papers_own_interval_counts(self):
        self.assertEqual(verdict(of(0.715, 0.001), {"value": 0.7}), OUTSIDE)
        self.assertEqual(verdict(of(0.715, 0.001), {"value": 0.7, "error": 0.014}), MEAN)
        self.assertEqual(verdict(of(0.7, 0.001), {"value": 0.65, "digits": 1}), MEAN)
        self.assertEqual(verdict(of(0.7, 0.001), {"value": 0.65, "digits": 2}), OUTSIDE)

    def test_what_is_undecided(self):
        self.assertEqual(verdict(None, {"value": 1}), UNDECIDED)
        self.assertEqual(verdict(of(1, 0.1, n=2), {"value": 1}), UNDECIDED)
        self.assertEqual(verdict(of(1, 0.2), {"value": 1}), UNDECIDED)  # single packings spread by 0.82
        self.assertEqual(verdict(of(1, 0.1), {"value": 1}), MEAN)

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


class Networks(unittest.TestCase):
    # Four particles in a ring and one across; degrees.
    STATE = {"a": [0, 1, 2, 3, 0], "b": [1, 2, 3, 0, 2], "theta_ff": [1e-5, 0.5, 1e-5, 0.2, 0.01],
             "theta_ef": [0.3, 1e-6, 1e-6, 0.4, 2e-6]}

    def test_classes(self):
        found = network.classes(self.STATE, 1e-4, 1e-5, 4)
        self.assertEqual((found["Z_ff"], found["Z_ef"], found["C"]), (1.0, 1.0, (3 * 2 + 2 * 2 + 1) / 2))
        by_factor, gap = network.by_cutoffs(self.STATE, {"ff": 1e-5, "ef": 2e-6, "gap_ff": 0.1}, 4)
        self.assertEqual(by_factor[2], network.classes(self.STATE, 1e-5, 2e-6, 4)["C"])
        self.assertEqual(by_factor[-1], network.classes(self.STATE, 1e-4, 2e-5, 4)["C"])
        self.assertEqual(gap, 1.5)
        self.assertEqual(network.by_cutoffs(self.STATE, {"ff": None, "ef": 1, "gap_ff": None}, 4), [[None] * 5, None])

    def test_regions(self):
        self.assertEqual(network.regions(self.STATE, 0.3), [3, 1, 1])
        self.assertTrue(network.emerged([20, 80, 5], 1.0))
        self.assertFalse(network.emerged([2, 80, 5], 1.0))
        self.assertFalse(network.emerged([0, 0, 5], 1.0))
        self.assertTrue(network.hyper_random({"theta_ef": [0.01] * 20 + [0.5] * 20}, 0.02))
        self.assertFalse(network.hyper_random({"theta_ef": [0.01] * 4 + [0.5] * 36}, 0.02))

    def test_neighbours(self):
        counts, pairs, others = network.neighbours(self.STATE, 1e-4, 4)
        self.assertEqual((counts, pairs, others), ([0, 4], 0, 2 + 1 + 2 + 1))
        counts, pairs, others = network.neighbours(self.STATE, 0.1, 4)  # 0-1, 2-3, 0-2
        self.assertEqual((counts, pairs, others), ([0, 2, 2], 4, 2 * 2 + 1 + 2 * 2 + 1))

    def test_random_contacts_do_not_hinder(self):
        stream, ratios = random.Random(4), []
        edges = [(i, j) for i in range(60) for j in range(i) if stream.random() < 0.15]
        for _ in range(300):
            chosen = set(stream.sample(range(len(edges)), 40))
            state = {"a": [a for a, _ in edges], "b": [b for _, b in edges],
                     "theta_ff": [0.0 if i in chosen else 1.0 for i in range(len(edges))]}
            found = network.hindrance([*network.neighbours(state, 0.5, 60), len(edges)])
            ratios.append(found["q"] / found["p"])
        mean = estimate_of(ratios)
        self.assertLess(abs(mean["mean"] - 1), 1.5 * mean["half_width"])
        paired = {"a": [0, 2, 4, 0, 2], "b": [1, 3, 5, 2, 4], "theta_ff": [0, 0, 0, 1, 1]}
        self.assertEqual(network.hindrance([*network.neighbours(paired, 0.5, 6), 5])["q"], 0)


class Search(unittest.TestCase):
    PAPERS = {"tetrahedron": 0.629, "octahedron": 0.6796, "icosahedron": 0.6953, "dodecahedron": 0.7065}

    def replicate(self, solid, number, budget, phi_j, *flags):
        phi = [phi_j + 0.1 * 0.7 ** i for i in range(10)]
        return {"solid": solid, "replicate": number, "flags": list(flags), "status": "done", "cpu": 1,
                "setting": {"before": False, "step": 0.02, "budget": budget, "target": 3.2e-5},
                "phi_j": phi_j, "phi": phi, "E": [(x - phi_j) ** 6 for x in phi]}

    def data(self):
        made = []
        for solid, value in self.PAPERS.items():
            for number, off in enumerate((-0.002, 0.0, 0.002)):
                made.append(self.replicate(solid, number, 2000, value + 0.01 + off))
                made.append(self.replicate(solid, number, 50, value + off))
            made.append(self.replicate(solid, 3, 50, 0.75, "crystalline"))
            made.append(self.replicate(solid, 3, 2000, 0.65))
        figures = [{"place": "Table I", "solid": s, "particles": 100, "value": v} for s, v in self.PAPERS.items()]
        return type("Data", (), {"search": {"one": made}, "figures": figures})

    def test_ranked(self):
        entries = search.ranked(self.data())
        self.assertEqual(entries[0].setting["budget"], 50)
        self.assertLess(entries[0].chi, 1e-12)
        base = next(entry for entry in entries if search.is_base(entry))
        self.assertGreater(base.chi, 0)
        self.assertAlmostEqual(estimate_of([0, 1, 5])["half_width"] ** 2 * 4 / 4.302653 ** 2,
                               densities.deviation_of(estimate_of([0, 1, 5])) ** 2, places=5)
        self.assertEqual({e.setting["budget"] for e in search.all_inside(entries)}, {50})
        # With 2000 evaluations octahedra are 0.6876, 0.6896, 0.6916 and 0.65, that is 0.6797 ± 0.0316. Tetrahedra are
        # 0.637 … 0.65, that is 0.6418 ± 0.0091.
        self.assertEqual((base.inside["octahedron"], base.inside["tetrahedron"]), (True, False))

    def test_inside_is_give_or_take_the_papers_interval(self):
        data = self.data()
        made = [self.replicate("octahedron", i, 50, 0.6 + off) for i, off in enumerate((-0.002, 0.0, 0.002))]
        for error, inside in ((0.0, False), (0.001, True)):
            figures = [{"place": "Table I", "solid": "octahedron", "particles": 100, "value": 0.6055, "error": error}]
            entries = search.ranked(type("Data", (), {"search": {"one": made}, "figures": figures}))
            # The mean's interval is ± 4.303 · 0.002/√3 = 0.00497.
            self.assertEqual({e.inside["octahedron"] for e in entries}, {inside})
        self.assertEqual(search.completed(data, "octahedron", 100, "after", "0.020", "50"), "4 of 4")

    def test_shifts_are_of_pairs(self):
        setting = {"before": False, "step": 0.02, "budget": 50, "target": 3.2e-5}
        moved = search.moved_by(self.data(), setting, "octahedron")
        self.assertEqual(moved["n"], 3)
        self.assertAlmostEqual(moved["mean"], -100)
        self.assertAlmostEqual(moved["half_width"], 0, places=9)
        (setting, found), = search.moves_of(self.data())
        self.assertEqual((setting["budget"], set(found)), (50, set(SOLIDS)))

    def test_windows_are_chosen_with_the_smaller_size(self):
        def entry(name, chi):
            return search.Entry(chi, None, {}, name, {}, {}, {})

        pairs = [(entry("a", 5.0), 3.0), (entry("b", 9.0), 1.0), (entry("c", 2.0), 4.0), (entry("d", 8.0), 2.0)]
        for best, names in ((2, "bdc"), (3, "bdac"), (4, "bdac")):
            found = search.least_first(pairs, best)
            self.assertEqual("".join(e.window for e, _, _ in found), names)
            self.assertEqual([small for *_, small in found], [i < best for i in range(len(names))])
        unknown = search.least_first([(entry("a", None), 1.0), (entry("b", None), None)], 1)
        self.assertEqual([e.window for e, *_ in unknown], ["a"])

    def test_the_base_is_the_protocol_of_the_studies(self):
        base = search.in_words({**search.BASE[0], "target": search.TARGET})
        for study in ("n100", "n100-tetrahedra", "n400", "n400-tetrahedra"):
            self.assertEqual(search.protocol_value(None, study), base)


class Gathered(unittest.TestCase):
    MANIFEST = {"name": "paper-100", "seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [24]},
                "replicates": 3, "protocol": {"initial_density": 0.2, "consolidation_step": 0.04, "step_fraction": 0.4,
                             "final_distance": 0.02, "fit_window": 0.1},
                "keep_path": True, "measure": ["contacts", "order", "clusters", "modes", "moduli", "rigidity"]}

    def test_small_run(self):
        with tempfile.TemporaryDirectory() as here:
            results = Path(here)
            for name, replicates in (("paper-100", 3), ("paper-search-protocol", 1)):
                manifest = results / f"{name}.json"
                manifest.write_text(json.dumps({**self.MANIFEST, "name": name, "replicates": replicates}))
                subprocess.run([ISOJAM, "run", manifest, "-o", results / name, "--quiet"], check=True,
                               capture_output=True)
            subprocess.run([sys.executable, "-B", PAPER / "gather.py", ISOJAM, results, results / "out"],
                           check=True, capture_output=True)
            made = subprocess.run([ISOJAM, "aggregate", results / "paper-100", "--exclude",
                                   "crystalline,goal_not_reached", "--format", "json", "--quiet"], check=True,
                                  capture_output=True, text=True)
            row = json.loads(made.stdout)["rows"][0]
            data = Data(results / "out")
        counted = data.counted("dodecahedron", 24)
        self.assertEqual(len(counted), row["phi_j"]["n"])
        self.assertGreater(len(counted), 0)
        for column in ("Z", "Z_ff", "C", "S", "omega_h", "K"):
            if row.get(column) and row[column]["mean"] is not None:
                ours = data.nearest("dodecahedron", 24, column)
                self.assertEqual(ours["n"], row[column]["n"], column)
                self.assertAlmostEqual(ours["mean"], row[column]["mean"], delta=1e-3 * abs(row[column]["mean"]) + 1e-9)
        recorded = estimate_of([r["phi_j"]["phi_j"] for r in counted])
        self.assertAlmostEqual(recorded["mean"], row["phi_j"]["mean"], places=7)
        for r in counted:
            for (by_factor, gap), C in zip(r["network"]["by_cutoffs"], r["states"]["C"]):
                if C is not None:
                    self.assertAlmostEqual(by_factor[network.FACTORS.index(1)], C, delta=2e-3)
            self.assertEqual([2 * sum(c) / 24 for c in r["network"]["regions"]],
                             [round(z * 12) / 12 for z in r["states"]["Z"]])
        searched = data.search["paper-search-protocol"]
        self.assertEqual([r["replicate"] for r in searched], [0])
        self.assertEqual(searched[0]["phi_j"], data.all_of("dodecahedron", 24)[0]["phi_j"]["phi_j"])


class Anew(unittest.TestCase):
    def test_replicates_of_the_studies(self):
        made = anew.gathered(ISOJAM, PAPER, [("cubes", "paper-cubes", "3/16", None),
                                             ("search-protocol", "paper-search-protocol", "200/384", None)])
        for name, studies in made.items():
            committed = json.loads((PAPER / "data" / f"{name}.json").read_text(encoding="utf-8"))
            self.assertEqual(anew.same_packings(self, committed, studies), 1, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
