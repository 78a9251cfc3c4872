"""Tests the pages of examples/paper, examples/rigidity and examples/percolation. usage: studies_test.py examples ISOJAM"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

EXAMPLES, ISOJAM = Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(EXAMPLES / "page"))

import abstracts  # noqa: E402
from data import Data  # noqa: E402
from marks import without_marks  # noqa: E402

STUDIES = ("paper", "rigidity", "percolation")
PAPER_DATA, RIGIDITY_DATA, PERCOLATION_DATA = (EXAMPLES / study / "data/records.json" for study in STUDIES)
CONSTRAINTS = RIGIDITY_DATA.with_name("constraints.json")
FILES = {"paper": [PAPER_DATA, CONSTRAINTS], "rigidity": [PAPER_DATA, RIGIDITY_DATA, CONSTRAINTS], "percolation": [PERCOLATION_DATA]}


def python(*arguments):
    return subprocess.run([sys.executable, "-B", *map(str, arguments)], capture_output=True, text=True, check=False)


def copied(study, here):
    """A copy of a study in another folder, whose page can be changed."""
    for name in ("page", *STUDIES):
        if not (here / "examples" / name).exists():
            shutil.copytree(EXAMPLES / name, here / "examples" / name)
    palette = "tasks/extras/page/palette.json"
    (here / palette).parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(EXAMPLES.parent / palette, here / palette)
    return here / "examples" / study


class Pages(unittest.TestCase):
    def test_are_what_the_data_say(self):
        for study in STUDIES:
            result = python(EXAMPLES / study / "page.py", "--check")
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_projects_page_has_the_table(self):
        result = python(EXAMPLES / "paper/page.py", "--check", "--summary", EXAMPLES.parent / "README.md")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_are_refused_if_changed(self):
        changes = {"paper": (("| octahedron | 0.6", "| octahedron | 0.7"), ("hypostatic: Z at", "isostatic: Z at")),
                   "rigidity": (("2m + 2S/N", "3m + 2S/N"),),
                   "percolation": (("| octahedron | 0 | 0.6", "| octahedron | 0 | 0.7"),
                                   ("Random bonds percolate", "Random bonds do not percolate"))}
        for study, replacements in changes.items():
            for before, after in replacements:
                with tempfile.TemporaryDirectory() as here:
                    folder = copied(study, Path(here))
                    text = (folder / "README.md").read_text(encoding="utf-8")
                    self.assertIn(before, text)
                    (folder / "README.md").write_text(text.replace(before, after), encoding="utf-8")
                    result = python(folder / "page.py", "--check")
                self.assertEqual(result.returncode, 1)
                self.assertRegex(result.stderr, "differs from the data|rewrite it and its claim")

    def test_are_short_and_their_figures_are_shown(self):
        for study in STUDIES:
            text = (EXAMPLES / study / "README.md").read_text(encoding="utf-8")
            self.assertLessEqual(text.count("\n"), 150)
            abstract = re.search(r"\*\*Abstract\.\*\*(.*?)\n\n", without_marks(text), re.S)[1]
            self.assertLessEqual(len(abstract.split()), 150, f"shorten the abstract of {study}")
            figures = {path.stem for path in (EXAMPLES / study).glob("*.svg")}
            self.assertEqual(figures, {path.stem for path in (EXAMPLES / study).glob("*.pdf")})
            for figure in figures - {"structure"}:
                self.assertIn(f"]({figure}.svg)", text)
                self.assertIn(f"]({figure}.pdf)", text)
            for figure in figures:
                self.assertLess((EXAMPLES / study / f"{figure}.svg").stat().st_size, 600_000)


class Abstracts(unittest.TestCase):
    def test_are_recomputed(self):
        for study in STUDIES:
            lines, wrong = abstracts.compared(EXAMPLES / study / "README.md", abstracts.rows_of(FILES[study]))
            print("\n".join(lines))
            self.assertEqual(wrong, 0, "\n".join(line for line in lines if "DIFFERS" in line or "numbers" in line))

    def test_a_changed_number_is_found(self):
        page = (EXAMPLES / "paper/README.md").read_text(encoding="utf-8")
        numbers = list(re.finditer(r"-->([−+]?\d+\.\d+)[^<]*<!--", page[:page.index("<!-- block")]))
        self.assertGreater(len(numbers), 8)
        rows = abstracts.rows_of(FILES["paper"])
        for match in numbers:
            changed = f"{float(match[1].replace('−', '-')) + (0.5 if float(match[1].strip('−+')) > 1 else 0.2):.3f}"
            with tempfile.TemporaryDirectory() as here:
                path = Path(here) / "README.md"
                path.write_text(page[:match.start(1)] + changed + page[match.end(1):], encoding="utf-8")
                self.assertGreater(abstracts.compared(path, rows)[1], 0, match[0])


class Claims(unittest.TestCase):
    def test_page_and_figures_are_made_elsewhere(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder)
            for study in STUDIES:
                for script, arguments in (("figures.py", (here / study, *FILES[study])),
                                          ("page.py", ("--data", *FILES[study], "-o", here / study))):
                    result = python(EXAMPLES / study / script, *arguments)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertEqual(result.stderr, "")
                for name in ("README.md", "tables.md"):
                    page = without_marks((here / study / name).read_text(encoding="utf-8"))
                    for target in re.findall(r"\]\(([^)#\s]+)", page):
                        self.assertTrue("://" in target or (here / study / target).exists(), target)

    def test_a_sentence_that_no_longer_holds_gives_a_message(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder)
            studies = json.loads(PAPER_DATA.read_text(encoding="utf-8"))
            for r in studies["paper-400"]["replicates"]:
                r["states"]["amplitude"] = [0.5 for _ in r["states"]["phi"]]
            (here / "records.json").write_text(json.dumps(studies), encoding="utf-8")
            result = python(EXAMPLES / "paper/page.py", "--data", here / "records.json", *FILES["paper"][1:], "-o",
                            here / "out")
            self.assertIn("The highest modes move almost only particles", result.stderr)
            self.assertIn("rewrite it and its claim together", result.stderr)


class Gathered(unittest.TestCase):
    MANIFEST = {"name": "small", "seed": 3, "sweep": {"solid": ["tetrahedron"], "particles": [64]}, "replicates": 2,
                "protocol": {"final_distance": 0.008, "fit_window": 0.05, "step_fraction": 0.5},
                "measure": ["contacts", "clusters", "modes", "moduli", "rigidity", "prestress"]}

    def test_small_run(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder)
            (here / "m.json").write_text(json.dumps(self.MANIFEST), encoding="utf-8")
            subprocess.run([ISOJAM, "run", here / "m.json", "-o", here / "small", "--quiet"], check=True,
                           capture_output=True)
            result = python(EXAMPLES / "page/gather.py", ISOJAM, here, here / "records.json", "small")
            self.assertEqual(result.returncode, 0, result.stderr)
            records = [json.loads(path.read_text()) for path in sorted((here / "small/records").iterdir())]
            tables = json.loads((here / "small/tables.json").read_text())
            made = Data(here / "records.json")
            self.compare(records, tables["rows"][0], made)
            missing = python(EXAMPLES / "page/gather.py", ISOJAM, here, here / "none.json", "absent")
            self.assertIn("there is no study absent", missing.stderr)

    def compare(self, records, row, made):
        kept = made.kept("tetrahedron", 64)
        self.assertEqual(len(kept), row["phi_j"]["n"])
        self.assertAlmostEqual(made.phi_j("tetrahedron", 64)["mean"], row["phi_j"]["mean"], places=7)
        self.assertAlmostEqual(made.phi_j("tetrahedron", 64)["half_width"], row["phi_j"]["half_width"], places=7)
        for name in ("Z", "C"):
            self.assertAlmostEqual(made.nearest("tetrahedron", 64, name)["mean"], row[name]["mean"], delta=0.01)
        pooled = row["pooled_trough"]
        ours = made.constraints("tetrahedron", 64, "trough")
        if pooled["C"]["n"]:
            self.assertAlmostEqual(ours["mean"], pooled["C"]["mean"], places=3)
            self.assertAlmostEqual(ours["systematic"], (pooled["C_high"]["mean"] - pooled["C_low"]["mean"]) / 2,
                                   places=3)
        else:
            self.assertIsNone(ours)
        last = records[0]["states"][-1]
        self.assertEqual(kept[0]["states"]["floppy"][-1], last["rigidity"]["classes"]["floppy"])
        self.assertAlmostEqual(kept[0]["states"]["missing"][-1],
                               (6 * 64 - 3 - last["rigidity"]["classes"]["rank"]) / 64)
        self.assertEqual(kept[0]["states"]["prestress_10"][-1],
                         last["prestress"]["modes"]["prestress_by_threshold"][2]["modes"])
        size, cluster = made.cluster("tetrahedron")
        centres = list(zip(*cluster["particles"]))[:3]
        self.assertEqual(size, 64)
        self.assertAlmostEqual(max(max(x) - min(x) for x in centres) / cluster["side"],
                               max(r["states"][r["nearest"]]["clusters"]["l_max"] for r in records), places=3)
        entry = made.trough("tetrahedron", 64)
        contacts = sum(state["contacts"]["Z"] * 64 / 2 for state in (r["states"][-1] for r in records))
        self.assertAlmostEqual(sum(entry["theta_ff"][1]), contacts)


class Anew(unittest.TestCase):
    # The data are those of an earlier version of the protocol, which makes other packings from the same initial
    # configuration. Their φ_J differ as those of two packings do.
    SPREAD = 0.01

    def test_replicates_of_the_studies(self):
        committed = json.loads(RIGIDITY_DATA.read_text(encoding="utf-8"))
        for study, shard in (("n50", "10/48"), ("n50", "26/48")):
            with tempfile.TemporaryDirectory() as here:
                manifest = json.loads((EXAMPLES / f"rigidity/{study}.json").read_text(encoding="utf-8"))
                manifest.pop("$schema")
                manifest["measure"] = ["contacts"]
                (Path(here) / "m.json").write_text(json.dumps(manifest), encoding="utf-8")
                subprocess.run([ISOJAM, "run", Path(here) / "m.json", "--shard", shard, "-o", Path(here) / "results",
                                "--quiet"], check=True, capture_output=True)
                records = list((Path(here) / "results/records").iterdir())
                self.assertEqual(len(records), 1)
                record = json.loads(records[0].read_text())
            place = [record["spec"][key] for key in ("solid", "particles", "replicate")]
            before = [r for study in committed.values() for r in study["replicates"]
                      if [r["solid"], r["particles"], r["replicate"]] == place]
            self.assertEqual(len(before), 1, place)
            print(place, "φ_J", record["phi_j"]["phi_j"], "committed", before[0]["phi_j"])
            self.assertLess(abs(record["phi_j"]["phi_j"] - before[0]["phi_j"]), self.SPREAD)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
