"""Tests the page of a chart in Chromium, opened from disk. usage: chart_browser_test.py ISOJAM"""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import browser as browsers

from selenium.webdriver.common.action_chains import ActionChains

EXECUTABLE = pathlib.Path(sys.argv.pop(1)).resolve()
CONFIG = {"compare": ["equilibrium", "overlap", "atlas", "phi_j", "growth"], "solids": ["dodecahedron"], "particles": 24, "packings": 1,
          "distances": [0.08, 0.05], "fit_window": 0.1, "tolerances": [1e-2, 1e-6], "pairs": 3, "repetitions": 1,
          "max_evaluations": 100, "rule_evaluations": 200, "point_seconds": 1e5, "total_seconds": 1e6,
          "phi_j": {"solid": "dodecahedron", "replicates": 2, "particles": [24, 30], "consolidation_step": [0.04],
                    "target_energy": [1e-5], "fit_window": [0.05, 0.1], "residual": [1e-6, 1e-3]},
          "growth": {"solids": ["dodecahedron"], "particles": [24, 32], "replicates": 1, "distances": [0.05]}}
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

    def family(self, name):
        return next(family for family in self.data["families"] if family["name"] == name)

    def test_every_family_is_drawn(self):
        for family in self.data["families"]:
            if family["name"] in ("phi_j", "growth"):
                continue
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

    def rows_of_settings(self):
        """Boxes of the labels, points and crosses in both panels, from left to right or from top to bottom."""
        return self.browser.run(f"""
            const boxes = (panel, marks) => [...panel.querySelectorAll(marks)].map((mark) => {{
              const {{left, right, top, bottom}} = mark.getBoundingClientRect();
              return {{left, right, top, bottom, text: mark.textContent}}; }});
            const chart = document.getElementById('chart-phi_j');
            const labels = boxes(chart, 'g.role-axis-label text').filter(({{text}}) => /[a-z]/.test(text));
            const dots = (name) => boxes(chart, `[class*=" setting_${{name}}"] path`);
            return {{labels, costs: dots('settings'), good: dots('good'), crosses: dots('failed')}};""")

    def test_settings_of_the_protocol_have_rows(self):
        # One replicate that did not jam, and a setting of which nothing is known.
        data = json.loads(json.dumps(self.data))
        family = next(each for each in data["families"] if each["name"] == "phi_j")
        family["points"][2].update(failed=True, stopped="1 not jammed")
        lost = json.loads(json.dumps(family["points"][3]))
        lost.update(setting="residual 0.1", failed=True, stopped="fewer than two replicates", error=None,
                    further=dict.fromkeys(lost["further"]))
        family["points"].append(lost)
        page = self.page.with_name("failing.html")
        text = self.page.read_text()
        begin = text.index(">", text.index('id="data"')) + 1
        page.write_text(text[:begin] + json.dumps(data).replace("<", "\\u003c") + text[text.index("</script>", begin):])
        settings = [point["setting"] for point in family["points"]]
        for width in (1400, 390):
            self.browser.width(width)
            self.browser.open(page)
            found = self.rows_of_settings()
            texts = [label["text"] for label in found["labels"]]
            # Side by side the panels share their labels; below each other each has its own.
            self.assertEqual(texts, settings * (1 if width > 1000 else 2), width)
            self.assertEqual([len(found[kind]) for kind in ("costs", "good", "crosses")],
                             [len(settings), len(settings) - 2, 2], width)
            densities = sorted(found["good"] + found["crosses"], key=lambda box: box["top"])
            for panel in (found["costs"], densities, found["labels"][:len(settings)]):
                for above, below in zip(panel, panel[1:]):
                    self.assertLess(above["bottom"], below["top"], (width, above, below))
            for points, labels in ((found["costs"], found["labels"]), (densities, found["labels"][-len(settings):])):
                for point, label in zip(points, labels):
                    middle = (point["top"] + point["bottom"]) / 2
                    self.assertTrue(label["top"] < middle < label["bottom"], (width, label, point))
            told = self.browser.run("""
                const box = (mark) => mark.getBoundingClientRect();
                const marks = (of) => [...document.querySelectorAll(`#chart-phi_j ${of}`)];
                return {texts: marks('[class*=" setting_numbers"] text').map((mark) => mark.textContent),
                  left: Math.min(...marks('[class*=" setting_numbers"] text').map((mark) => box(mark).left)),
                  right: Math.max(...marks('g.mark-rule.role-mark line').map((mark) => box(mark).right))};""")
            known = [point["further"] for point in family["points"] if point["further"]["phi_j"] is not None]
            self.assertEqual(len(told["texts"]), len(known) if width > 1000 else 0, told)
            if width > 1000:
                self.assertLess(told["right"], told["left"], told)
                window = next(point["further"] for point in family["points"] if point["setting"] == "fit_window 0.1")
                number = float(told["texts"][settings.index("fit_window 0.1")].split(" ± ")[0].replace("−", "-"))
                self.assertAlmostEqual(number / window["difference"], 1, delta=0.06)
            self.assertLessEqual(max(label["right"] for label in found["labels"]),
                                 min(point["left"] for point in found["costs"]), width)

    def test_costs_have_their_powers_beside_them(self):
        fits = self.family("growth")["fits"]
        self.assertEqual([fit["method"] for fit in fits], ["replicate", "equilibrium", "evaluation"])
        for width in (1400, 390):
            self.browser.width(width)
            self.browser.open(self.page)
            found = self.browser.run("""
                const chart = document.getElementById('chart-growth'), marks = (of) => [...chart.querySelectorAll(of)];
                const box = (mark) => mark.getBoundingClientRect();
                const powers = marks('[class*=" power_"] text').filter((mark) => mark.textContent);
                const points = marks('g.mark-symbol.role-mark path');
                const clash = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
                return {powers: powers.map((mark) => mark.textContent), points: points.length,
                  lines: marks('g.mark-line.role-mark path').filter((mark) => box(mark).width > 50).length,
                  clashes: powers.filter((power) => [...powers, ...points].some((other) =>
                    other !== power && clash(box(power), box(other)))).length,
                  inside: powers.every((mark) => box(mark).right <= box(chart).right)};""")
            written = [f"∝ N^{fit['exponent']:.2f}" for fit in fits]
            self.assertTrue(all(a.startswith(b) for a, b in zip(found["powers"], written)), (found, written))
            self.assertEqual((found["lines"], found["points"], found["clashes"], found["inside"]), (3, 6, 0, True), width)

    def test_the_conclusion_is_that_of_the_data(self):
        told = self.browser.run("return [...document.querySelectorAll('#conclusion li')].map((line) => line.textContent)")
        self.assertEqual(told, [line.replace("phi_J", "φJ") for line in self.data["conclusion"]])
        for residual in CONFIG["tolerances"]:
            self.assertEqual(sum(f"residual {residual:g} is reached" in line for line in told), 1, told)

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

    def test_a_cell_says_why(self):
        cell = self.browser.run("return document.querySelector('#atlas td.cell.fails')")
        ActionChains(self.browser.driver).scroll_to_element(cell).move_to_element(cell).perform()
        row = next(row for row in self.data["atlas"]["rows"] if row["verdict"] == "fails")
        shown = self.browser.run("const box = document.getElementById('tooltip'); return !box.hidden && box.textContent")
        self.assertIn(row["figure"], shown)
        self.assertIn(row["reason"], shown)

    def test_print_shows_every_list(self):
        self.assertEqual(self.browser.run("return document.querySelectorAll('details[open]').length"), 0)
        lists = self.browser.run("dispatchEvent(new Event('beforeprint'));"
                                 "return [...document.querySelectorAll('details')].map(({open}) => open)")
        self.assertGreater(len(lists), 2)
        self.assertTrue(all(lists))

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
