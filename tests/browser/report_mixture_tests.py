"""Tests of a report of a mixture and its solid, with a stopping rule and a shear, see report_browser_test.py."""

import json
import pathlib

from selenium.webdriver.support.ui import Select

PALETTE = json.loads((pathlib.Path(__file__).resolve().parents[2] / "tasks/extras/page/palette.json").read_text())
MIXTURE = {"name": "mixed", "mixture": [{"solid": "dodecahedron", "fraction": 0.5}, {"solid": "icosahedron", "fraction": 0.5}]}


class MixtureTests:
    def mixed(self):
        """Results of a mixture and one of its solids, with a goal and a shear in both directions. Computed once."""
        directory = self.root / "mixed"
        if directory.exists():
            return directory
        return self.pages.run(
            "mixed", sweep={"solid": ["dodecahedron", MIXTURE], "particles": [28]}, measure=["contacts", "gaps", "shear"],
            replicates={"min": 2, "max": 3, "quantity": "phi_j", "half_width": 1e-6},
            shear={"step": 0.002, "until": 0.006, "back": True})

    def legend(self, chart, attribute):
        return self.browser.run("""
            return [...document.querySelectorAll(`#chart-${arguments[0]} .role-legend-symbol path`)]
              .map((mark) => mark.getAttribute(arguments[1]))""", chart, attribute)

    def test_a_mixture_and_its_solid_differ_in_colour_and_symbol(self):
        self.open(self.pages.report(self.mixed()))
        marks = self.browser.run("""
            return [...document.querySelector('#chart-density g.mark-symbol').children].map((mark) => mark.__data__)
              .map((item) => [item.datum.solid, item.stroke, item.shape])""")
        found = {solid: (colour, shape) for solid, colour, shape in marks}
        solid, other = PALETTE["solids"]["dodecahedron"], PALETTE["others"][0]
        self.assertEqual(found, {
            "dodecahedron": (PALETTE["colours"][solid["colour"]], solid["symbol"]),
            "mixed": (PALETTE["colours"][other["colour"]], other["symbol"])})

    def test_contacts_between_kinds_are_drawn(self):
        self.open(self.pages.report(self.mixed()))
        self.assertIn("kinds", self.charts())
        shown = self.browser.run("""
            return [...document.querySelector('#chart-kinds g.mark-symbol.role-mark').children].map((mark) =>
              mark.__data__.datum).map(({of, other, z, n}) => [of, other, z, n])""")
        self.assertEqual([(of, other) for of, other, _, _ in shown],
                         [(f"kind {i}", f"kind {j}") for i in (1, 2) for j in (1, 2)])
        row = next(row for row in json.loads(self.pages.table(self.mixed(), "json"))["rows"] if row["solid"] == "mixed")
        for k, name in enumerate(("Z_11", "Z_12", "Z_21", "Z_22")):
            self.assertAlmostEqual(shown[k][2], row[name]["mean"], 9)
        self.assertIn("no sweep point is a mixture", self.absent_of(self.page))

    def absent_of(self, page):
        self.open(page)
        return self.find(".absent").text

    def test_the_view_colours_particles_by_kind(self):
        self.open(self.pages.report(self.mixed()))
        self.view()
        views = Select(self.find("#view-replicate"))
        views.select_by_index(next(k for k, option in enumerate(views.options) if "mixed" in option.text))
        self.after(lambda: Select(self.find("#view-colour")).select_by_value("kind"))
        self.assertIn("1: dodecahedron, 14 particles", self.find(".key").text)
        self.assertIn("2: icosahedron, 14 particles", self.find(".key").text)
        colours = self.browser.run("return [...document.querySelectorAll('.key i')].map((box) => box.style.background)")
        self.assertEqual(len(set(colours)), 2)

    def test_legends_show_what_distinguishes_lines(self):
        self.open(self.pages.report(self.mixed()))
        for chart, count in (("face-face", 2), ("edge-face", 2), ("shear", 2)):
            dashes = [dash for dash in self.legend(chart, "stroke-dasharray") if dash is not None or chart == "shear"]
            self.assertGreaterEqual(len(set(dashes)), count, f"{chart}: {dashes}")
        drawn = self.browser.run("""
            return [...document.querySelectorAll('#chart-shear g.mark-line path')].map((line) =>
              line.getAttribute('stroke-dasharray') ?? '')""")
        self.assertEqual(len(set(drawn)), 2, drawn)
        # Each replicate has an arrow for loading and one for unloading, which point in different directions.
        arrows = self.browser.run("""
            return [...document.querySelectorAll('#chart-shear g.mark-symbol path')].map((mark) => mark.__data__)
              .filter((item) => item.datum.stroke && item.angle).map((item) => [item.datum.line, item.angle])""")
        for line, angle in arrows:
            self.assertEqual(0 < angle < 180, line.endswith(" loading"), f"{line}: {angle}")
        self.assertGreater(len(arrows), 3)

    def test_the_table_states_the_goal_and_every_number(self):
        self.open(self.pages.report(self.mixed()))
        text = self.find("#table").text
        for words in ("Goal of the stopping rule", "half width / goal", "not reached"):
            self.assertIn(words, text)
        cells = self.browser.run("""
            return [...document.querySelectorAll('#table table')[0].tBodies].flatMap((body) => [...body.rows[0].cells])
              .filter((cell) => cell.title.includes('over n =')).map((cell) => [cell.title, cell.textContent])""")
        self.assertGreater(len(cells), 5)
        for title, shown in cells:
            self.assertTrue(shown.endswith(f" ({title.split('n = ')[1].split()[0]})"), f"{title}: {shown}")
        self.assertEqual(self.browser.run("return JSON.parse(document.getElementById('data').textContent).csv"),
                         self.pages.table(self.mixed(), "csv"))
