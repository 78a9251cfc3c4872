"""Tests the page of a chart in Chromium, opened from disk. usage: chart_browser_test.py ISOJAM"""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import browser as browsers

EXECUTABLE = pathlib.Path(sys.argv.pop(1)).resolve()
CONFIG = {"compare": ["equilibrium", "overlap", "atlas"], "solids": ["dodecahedron"], "particles": 24, "packings": 1,
          "distances": [0.08, 0.05], "fit_window": 0.1, "tolerances": [1e-2, 1e-6], "pairs": 3, "repetitions": 1,
          "max_evaluations": 100, "rule_evaluations": 200, "point_seconds": 1e5, "total_seconds": 1e6}
SIGNS = {"holds": "✓", "refuses": "–", "fails": "✗"}
CROSS = "path[stroke-width='1.8']"


class Chart(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="isojam-chart-")
        root = pathlib.Path(cls.directory.name)
        (root / "config.json").write_text(json.dumps(CONFIG))
        subprocess.run([EXECUTABLE, "chart", "config.json", "-o", "out", "--quiet"], cwd=root, check=True,
                       stdout=subprocess.DEVNULL)
        cls.data = json.loads((root / "out/data.json").read_text())
        cls.page = root / "out/chart.html"
        cls.browser = browsers.Browser(root, "chart")

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.directory.cleanup()

    def setUp(self):
        self.browser.width(1200)
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.errors(), [])
        self.assertEqual(self.browser.requests(), [])

    def test_every_family_is_drawn(self):
        for family in self.data["families"]:
            found = self.browser.run(f"""
                const chart = document.getElementById('chart-' + arguments[0]);
                const box = (mark) => mark.getBoundingClientRect();
                const texts = [...chart.querySelectorAll('g.mark-text text')]
                  .filter((mark) => mark.textContent.startsWith('failed: '));
                const crosses = [...chart.querySelectorAll("{CROSS}")];
                const clash = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
                return {{text: chart.textContent, reasons: texts.map((mark) => mark.textContent),
                  crosses: crosses.length,
                  fronts: [...chart.querySelectorAll('[class*=" ink_front"] path')].length,
                  clashes: texts.filter((text) => crosses.some((mark) => clash(box(text), box(mark)))).length}};""",
                                     family["name"])
            cases = {point["case"] for point in family["points"]}
            self.assertTrue(all(case in found["text"] for case in cases), found["text"])
            failed = [point for point in family["points"] if point["failed"]]
            self.assertEqual(found["crosses"], len(failed), family["name"])
            self.assertEqual(len(found["reasons"]), len({point["case"] for point in failed}), found["reasons"])
            self.assertEqual(found["clashes"], 0, found["reasons"])
            fronts = collections.Counter(point["case"] for point in family["points"] if point["on_front"])
            self.assertEqual(found["fronts"], len(fronts), family["name"])
        self.assertTrue(any(point["failed"] for point in self.data["families"][0]["points"]))

    def test_the_atlas_is_all_there(self):
        rows = self.data["atlas"]["rows"]
        self.assertGreater(len(rows), 300)
        cells = self.browser.run("""return [...document.querySelectorAll('#atlas td.cell')].map((cell) =>
            ({sign: cell.firstChild.textContent, text: cell.lastChild.textContent}))""")
        told = collections.Counter((cell["sign"], cell["text"]) for cell in cells)
        self.assertEqual(told, collections.Counter(
            (SIGNS[row["verdict"]], f"{row['verdict']}: {row['figure']}; {row['reason']}") for row in rows))
        listed = self.browser.run("""return [...document.querySelectorAll('#atlas .cells tbody tr')].map((row) =>
            [...row.cells].map((cell) => cell.textContent).join('|'))""")
        keys = ("regime", "method", "setting", "verdict", "figure", "reason")
        # The page sets the J of φ_J as an index.
        written = ["|".join(row[key] for key in keys).replace("φ_J", "φJ") for row in rows]
        self.assertEqual(sorted(listed), sorted(written))

    def test_nothing_is_wider_than_a_narrow_window(self):
        self.browser.width(390)
        self.browser.open(self.page)
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)
        # Regimes of the atlas too: what has to be scrolled to is not seen to be there.
        hidden = self.browser.run("""return [...document.querySelectorAll('#atlas .regime')]
            .filter((regime) => regime.scrollWidth > regime.clientWidth).map((regime) => regime.textContent.slice(0, 40))""")
        self.assertEqual(hidden, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
