"""Tests of the charts and tables of a report, see report_browser_test.py."""

import json

import report_pages
from report_case import CHARTS

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys


def half_digit(number):
    """Half of the last digit that is shown."""
    return 0.5 * 10.0 ** -len(str(number).partition(".")[2])


class ChartTests:
    def test_every_chart_has_marks_in_every_panel(self):
        self.open(self.page)
        self.assertEqual(self.charts(), CHARTS)
        for name in CHARTS:
            found = self.browser.run("""
                const chart = document.getElementById(`chart-${arguments[0]}`);
                const marks = 'g[class*="role-mark"] path, g[class*="role-mark"] line, g[class*="role-mark"] text';
                const panels = [...chart.querySelectorAll('g.role-scope > g')]
                  .filter((panel) => panel.querySelector(':scope > g .role-axis'));
                return {marks: chart.querySelectorAll('g.mark-symbol path, g.mark-line path, g.mark-rect path').length,
                        panels: panels.map((panel) => {
                          const places = [...panel.querySelectorAll(marks)].map((mark) => mark.getBoundingClientRect());
                          return {count: places.length, apart: new Set(places.map(({x}) => Math.round(x))).size};
                        }),
                        text: chart.innerHTML};""", name)
            self.assertGreater(found["marks"], 1, name)
            for panel in found["panels"]:
                self.assertGreater(panel["count"], 2, name)
                self.assertGreater(panel["apart"], 2, f"{name}: marks beside each other")
            for wrong in ("NaN", "undefined", "Infinity"):
                self.assertNotIn(wrong, found["text"], name)

    def test_symbols_are_set_as_mathematics(self):
        self.open(self.page)
        # For each axis title: its text, the italic parts and the shifted parts.
        titles = self.browser.run("""
            const titles = [...document.querySelectorAll('.role-axis-title text')].map((title) => {
              const spans = [...title.children];
              return [title.textContent, {
                italic: spans.filter((span) => span.getAttribute('font-style') === 'italic').map((span) => span.textContent),
                shifted: spans.map((span) => Math.sign(Number(span.getAttribute('dy') ?? 0)))}];
            });
            return Object.fromEntries(titles);""")
        self.assertEqual(titles["c(θff)"], {"italic": ["c", "θ", "ff"], "shifted": [0, 0, 0, 1, -1]})
        self.assertEqual(titles["(E/N)1/6"], {"italic": ["E", "N"], "shifted": [0, 0, 0, 0, 0, -1]})
        self.assertEqual(titles["jamming density φJ"]["italic"], ["φ", "J"])
        heading = self.browser.run("""
            const html = [...document.querySelectorAll('#table thead button')].map((part) => part.innerHTML);
            return [html.includes('<i>φ</i><sub><i>J</i></sub>'), html.includes('<i>Z</i><sub><i>ff</i></sub>'), html]""")
        self.assertEqual(heading[:2], [True, True], heading[2])
        self.assertNotIn("$", self.browser.run("return document.querySelector('main').innerHTML"))

    def tooltip_of(self, mark):
        self.browser.run("arguments[0].scrollIntoView({block: 'center'})", mark)
        ActionChains(self.browser.driver).move_to_element(mark).perform()
        self.browser.wait("!document.getElementById('tooltip').hidden", "the tooltip")
        return self.find("#tooltip").text

    def test_tooltips_name_the_replicate(self):
        self.open(self.page)
        self.assertIn("dodecahedron-N24-r000", self.tooltip_of(self.find("#chart-density g.mark-symbol path")))

    def test_a_mean_of_one_replicate_is_open_and_on_no_line(self):
        nearer = {**report_pages.manifest()["protocol"], "final_distance": 0.008, "fit_window": 0.03}
        study = self.pages.run("nearer", measure=["contacts"], protocol=nearer)
        flags = {"dodecahedron-N28-r0000": ["crystalline"]}
        self.open(self.pages.report(self.pages.flagged("one-left", study, flags)))
        mean = self.browser.driver.find_elements(By.CSS_SELECTOR, "#chart-density g.mark-symbol")[1]
        self.assertRegex(self.tooltip_of(mean.find_elements(By.CSS_SELECTOR, "path")[1]), r"n\W*1$")
        # For each panel: its marks of means, open ones and those of one replicate, and whether lines join any.
        panels = self.browser.run("""
            const panels = [...document.querySelectorAll('#chart-topology g.role-scope > g')]
              .filter((panel) => panel.querySelector(':scope > g .role-axis'));
            return panels.map((panel) => {
              const marks = [...[...panel.querySelectorAll('g.mark-symbol')].at(-1).children];
              const lines = [...panel.querySelectorAll('g.mark-line path')].map((path) => path.getAttribute('d') ?? '');
              return {open: marks.map((mark) => mark.getAttribute('fill') === 'transparent'),
                      one: marks.map((mark) => mark.__data__.datum.n === 1),
                      joined: lines.some((line) => line.includes('L'))};
            })""")
        self.assertGreater(min(len(panel["open"]) for panel in panels), 5)
        self.assertEqual([panel["open"] for panel in panels], [panel["one"] for panel in panels])
        self.assertEqual([all(panel["one"]) for panel in panels], [False, True])
        self.assertEqual([panel["joined"] for panel in panels], [True, False])
        self.assertIn("2, 1 excluded", self.find("#table").text)
        self.assertIn("Excluded from means: crystalline (1), not_balanced (0).", self.find("#table").text)

    def test_charts_are_saved_in_every_form(self):
        self.open(self.page)
        figure = self.find("#chart-density").find_element(By.XPATH, "..")
        expected = ["density.svg", "density.png", "density.vg.json", "density.csv"]
        for control, name in zip(figure.find_elements(By.CSS_SELECTOR, ".controls button"), expected):
            self.browser.run("arguments[0].click()", control)
            self.browser.wait(f"document.querySelectorAll('#chart-density ~ .controls button')"
                              f"[{expected.index(name)}].textContent.endsWith('✓')", f"{name} to be saved")
        files = {path.name: path for path in self.saved(expected)}
        self.assertIn("<svg", files["density.svg"].read_text())
        self.assertEqual(files["density.png"].read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        specification = json.loads(files["density.vg.json"].read_text())
        self.assertEqual([len(data["values"]) for data in specification["data"]], [4, 2, 0, 0])
        lines = files["density.csv"].read_text().splitlines()
        self.assertEqual(len(lines), 1 + 4 + 2, lines)
        self.assertIn("phi_j", lines[0])

    def column(self, heading):
        """Numbers in a column of the main table as they are shown: one for each sweep point, None for a dash."""
        return self.browser.run("""
            const table = document.querySelector('#table table');
            const names = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
            const column = names.indexOf(arguments[0]);
            return [...table.tBodies].map((body) => parseFloat(body.rows[0].cells[column].textContent))""", heading)

    def test_the_table_sorts_both_ways_by_click_and_by_keyboard(self):
        self.open(self.pages.report(self.swept()))
        names = self.browser.run("""
            return [...document.querySelectorAll('#table th[scope=col]')].map((cell) => cell.textContent)""")
        self.assertIn("compression_step", names)
        for press in (lambda control: control.click(), lambda control: control.send_keys(Keys.ENTER)):
            for place, name in enumerate(names):
                if name == "solid":
                    continue
                control = self.browser.driver.find_elements(By.CSS_SELECTOR, "#table th button")[place]
                for direction, sign in (("ascending", 1), ("descending", -1)):
                    press(control)
                    heading = control.find_element(By.XPATH, "..")
                    self.assertEqual(heading.get_attribute("aria-sort"), direction, name)
                    shown = self.column(name)
                    numbers = [sign * number for number in shown if number is not None]
                    # A mean with a wide interval is shown with few digits.
                    steps = [half_digit(one) + half_digit(next) for one, next in zip(numbers, numbers[1:])]
                    self.assertTrue(all(one <= next + step for one, next, step in zip(numbers, numbers[1:], steps)),
                                    f"{name}, {direction}: {numbers}")
                    self.assertEqual(shown[len(numbers):].count(None), shown.count(None), f"{name}: dashes stand last")

    def test_panels_and_bands_say_what_varies(self):
        for width in (1200, 390):
            self.browser.width(width)
            self.addCleanup(self.browser.width, 1200)
            self.open(self.pages.report(self.swept()))
            for chart, marks in (("topology", "g.role-title text"), ("density", "g.role-axis-label text")):
                texts = self.browser.run("""
                    return [...document.querySelectorAll(`#chart-${arguments[0]} ${arguments[1]}`)].map((text) =>
                      (text.children.length > 0 ? [...text.children] : [text]).map((part) => part.textContent)
                        .join(' ').replace(/\\s+/g, ' '))""", chart, marks)
                for label in ("N = 24, compression_step 0.05", "N = 28, compression_step 0.07"):
                    shown = [text for text in texts if label in text]
                    self.assertEqual(len(shown), 1, f"{chart} at {width}: {label} in {texts}")

    def swept(self):
        """Results of a study that sweeps the number of particles and a parameter. They are computed once."""
        directory = self.root / "swept"
        if directory.exists():
            return directory
        sweep = {"solid": ["dodecahedron"], "particles": [24, 28], "compression_step": [0.05, 0.07]}
        protocol = {key: value for key, value in report_pages.manifest()["protocol"].items() if key not in sweep}
        return self.pages.run("swept", sweep=sweep, protocol=protocol, measure=["contacts"])

    def test_copies_are_what_aggregate_prints(self):
        self.open(self.page)
        self.browser.run("navigator.clipboard.writeText = (text) => { window.copied = text; return Promise.resolve(); }")
        for label, form in (("Copy as CSV", "csv"), ("Copy as LaTeX", "latex")):
            self.find("#table").find_element(By.XPATH, f".//button[text()='{label}']").click()
            self.assertEqual(self.browser.run("return window.copied"), self.pages.table(self.full, form), form)
