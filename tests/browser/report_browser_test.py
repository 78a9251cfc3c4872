"""Facts proved here, in Chromium, of pages that isojam wrote and that are opened from disk:
- no page has a console error, asks the network for anything, or opens an alert;
- every chart has marks, in every panel, and none of them lies at NaN; tooltips appear;
- charts are saved as SVG, PNG, specification (with the data) and data;
- a mean of one replicate is drawn open and joined to no other; panels and bands say what varies, in full;
- the table sorts by every column, both ways, by click and by keyboard; copies are what `isojam aggregate` prints;
- the 3D view draws, turns by mouse and by keys, zooms, colours, shows the largest cluster alone, animates a mode, and
  turns 400 particles at 10 frames/s and more without a graphics card; without WebGL a sentence stands in its place;
- someone who asked for less motion is shown none;
- pages of failed replicates, of one replicate, without vibrations, of swept parameters, of cubes show what there is and
  say which `measure` would give the rest;
- names and texts that are markup are shown as text;
- nothing is wider than the window on a narrow screen.
usage: report_browser_test.py ISOJAM
"""

import json
import pathlib
import sys
import tempfile
import unittest

import browser as browsers
import report_pages

browsers.demand()

from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402  known to be there only now
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

EXECUTABLE = pathlib.Path(sys.argv.pop(1)).resolve()
CHARTS = ["density", "topology", "edge-face", "face-face", "extrapolation", "spectrum", "scaling", "shear",
          "evaluations", "time", "stops"]

# Pixels of the view that are not background, and a hash of all.
DRAWN = """
const source = document.getElementById('packing');
const copy = Object.assign(document.createElement('canvas'), {width: source.width, height: source.height});
const context = copy.getContext('2d');
context.drawImage(source, 0, 0);
const {data} = context.getImageData(0, 0, copy.width, copy.height);
let drawn = 0, hash = 0;
for (let k = 0; k < data.length; k += 4) {
  drawn += data[k + 3] > 0;
  hash = (Math.imul(hash, 31) + data[k] + 256 * data[k + 1] + 65536 * data[k + 2]) | 0;
}
return {drawn, hash, all: data.length / 4};"""

# Frames per second while the view is turned by keys as fast as it is drawn.
RATE = """
const done = arguments[arguments.length - 1], canvas = document.getElementById('packing');
const begun = performance.now(), first = Number(canvas.dataset.frames);
const turn = () => {
  const seconds = (performance.now() - begun) / 1000;
  if (seconds > 2) return done((Number(canvas.dataset.frames) - first) / seconds);
  canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', bubbles: true, cancelable: true}));
  requestAnimationFrame(turn);
};
turn();"""


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="isojam-browser-")
        cls.root = pathlib.Path(cls.directory.name)
        cls.pages = report_pages.Pages(EXECUTABLE, cls.root)
        cls.full = cls.pages.run("full")
        cls.page = cls.pages.report(cls.full)
        cls.browser = browsers.Browser(cls.root, "main")

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.directory.cleanup()

    def open(self, page):
        self.browser.open(page)
        self.addCleanup(self.expect_quiet, page)

    def expect_quiet(self, page):
        self.assertFalse(self.browser.alert_is_open(), page)
        self.assertEqual(self.browser.errors(), [], page)
        self.assertEqual(self.browser.requests(), [], page)

    def find(self, selector):
        return self.browser.driver.find_element(By.CSS_SELECTOR, selector)

    def charts(self):
        return self.browser.run("return [...document.querySelectorAll('.chart')].map((c) => c.id.slice(6))")

    # ---- Charts -----------------------------------------------------------------------------------------------

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

    def test_the_density_chart_shows_every_replicate(self):
        self.open(self.page)
        shown = self.browser.run("""
            return [...document.querySelectorAll('#chart-density g.mark-symbol')].map((g) => g.children.length)""")
        self.assertEqual(shown[:2], [4, 2], "replicates, means")

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
        # Of each panel: its marks of means, open ones and those of one replicate, and whether lines join any.
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
        self.assertIn("without replicates flagged crystalline, not_balanced", self.find("#table").text)

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
        self.assertEqual([len(data["values"]) for data in specification["data"]], [4, 2, 0])
        lines = files["density.csv"].read_text().splitlines()
        self.assertEqual(len(lines), 1 + 4 + 2, lines)
        self.assertIn("phi_j", lines[0])

    def saved(self, names):
        """The files, once all of them are there."""
        for _ in range(200):
            paths = [self.browser.downloads / name for name in names]
            if all(path.exists() for path in paths):
                return paths
            self.browser.driver.execute_async_script("setTimeout(arguments[0], 50)")
        self.fail(f"saved {sorted(path.name for path in self.browser.downloads.iterdir())}, expected {names}")

    # ---- Table ------------------------------------------------------------------------------------------------

    def column(self, heading):
        """Numbers of a column of the main table as they stand, one for each sweep point, None for a dash."""
        return self.browser.run("""
            const table = document.querySelector('#table table');
            const names = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
            const column = names.indexOf(arguments[0]);
            return [...table.tBodies].map((body) => parseFloat(body.rows[0].cells[column].textContent))""", heading)

    def test_the_table_sorts_both_ways_by_click_and_by_keyboard(self):
        self.open(self.pages.report(self.swept()))
        names = self.browser.run("""
            return [...document.querySelectorAll('#table th[scope=col]')].map((cell) => cell.textContent)""")
        self.assertIn("consolidation_step", names)
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
                    self.assertEqual(numbers, sorted(numbers), f"{name}, {direction}")
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
                        .join(' '))""", chart, marks)
                for label in ("N = 24, consolidation_step 0.05", "N = 28, consolidation_step 0.07"):
                    shown = [text for text in texts if label in text]
                    self.assertEqual(len(shown), 1, f"{chart} at {width}: {label} in {texts}")

    def swept(self):
        """Results of which both sizes and a parameter were swept; made once."""
        directory = self.root / "swept"
        if directory.exists():
            return directory
        sweep = {"solid": ["dodecahedron"], "particles": [24, 28], "consolidation_step": [0.05, 0.07]}
        protocol = {key: value for key, value in report_pages.manifest()["protocol"].items() if key not in sweep}
        return self.pages.run("swept", sweep=sweep, protocol=protocol, measure=["contacts"])

    def test_copies_are_what_aggregate_prints(self):
        self.open(self.page)
        self.browser.run("navigator.clipboard.writeText = (text) => { window.copied = text; return Promise.resolve(); }")
        for label, form in (("Copy as CSV", "csv"), ("Copy as LaTeX", "latex")):
            self.find("#table").find_element(By.XPATH, f".//button[text()='{label}']").click()
            self.assertEqual(self.browser.run("return window.copied"), self.pages.table(self.full, form), form)

    # ---- Packings ---------------------------------------------------------------------------------------------

    def view(self):
        """The canvas, in the window and drawn."""
        canvas = self.find("#packing")
        self.browser.run("arguments[0].scrollIntoView({block: 'center'})", canvas)
        self.browser.wait("document.getElementById('packing').dataset.frames > 0", "the first frame")
        return canvas

    def after(self, action):
        """What is drawn once an action led to another frame."""
        before = self.browser.run("return Number(document.getElementById('packing').dataset.frames)")
        action()
        self.browser.wait(f"document.getElementById('packing').dataset.frames > {before}", "another frame")
        return self.browser.run(DRAWN)

    def test_the_view_draws_and_turns(self):
        self.open(self.page)
        canvas = self.view()
        seen = [self.browser.run(DRAWN)]
        self.assertGreater(seen[0]["drawn"], 0.1 * seen[0]["all"])
        drag = ActionChains(self.browser.driver).move_to_element(canvas).click_and_hold()
        drag.move_by_offset(120, 40).release()
        seen.append(self.after(drag.perform))
        for key in (Keys.ARROW_LEFT, Keys.ARROW_UP, "+", Keys.HOME):
            seen.append(self.after(lambda pressed=key: canvas.send_keys(pressed)))
        for k in range(1, len(seen)):
            self.assertNotEqual(seen[k]["hash"], seen[k - 1]["hash"], f"view {k} is view {k - 1}")
        self.assertGreater(seen[4]["drawn"], seen[3]["drawn"], "plus comes nearer")
        self.assertEqual(seen[5]["hash"], seen[0]["hash"], "Home is where the view began")

    def test_the_view_rests_when_nothing_changes(self):
        self.open(self.page)
        self.view()
        self.expect_rest()

    def expect_rest(self):
        self.browser.driver.execute_async_script("setTimeout(arguments[0], 400)")
        frames = "return document.getElementById('packing').dataset.frames"
        before = self.browser.run(frames)
        self.browser.driver.execute_async_script("setTimeout(arguments[0], 500)")
        self.assertEqual(self.browser.run(frames), before)

    def test_colours_and_clusters(self):
        self.open(self.page)
        self.view()
        whole = self.browser.run(DRAWN)
        colour = Select(self.find("#view-colour"))
        hashes = {whole["hash"]}
        for name in ("contacts", "local_Q6"):
            hashes.add(self.after(lambda chosen=name: colour.select_by_value(chosen))["hash"])
            self.assertRegex(self.find(".key").text, r"\d")
        self.assertEqual(len(hashes), 3)
        views = Select(self.find("#view-replicate"))
        for index in range(len(views.options)):
            views.select_by_index(index)
            if self.find("#view-alone").is_enabled():
                break
        alone = self.after(self.find("#view-alone").click)
        self.assertGreater(alone["drawn"], 0)
        self.assertLess(alone["drawn"], whole["drawn"])

    def test_modes_move_until_stopped(self):
        self.open(self.page)
        self.view()
        still = self.browser.run(DRAWN)["hash"]
        self.assertEqual(len(Select(self.find("#view-mode")).options), 1 + 8)
        Select(self.find("#view-mode")).select_by_index(1)
        start = self.find("#view-start")
        self.assertNotEqual(self.after(start.click)["hash"], still)
        self.assertEqual(start.text, "Stop")
        start.click()
        self.expect_rest()

    def test_less_motion_means_none(self):
        self.browser.media(prefers_reduced_motion="reduce")
        self.addCleanup(self.browser.media)
        self.open(self.page)
        self.view()
        Select(self.find("#view-mode")).select_by_index(1)
        self.assertFalse(self.find("#view-start").is_enabled())
        still = self.browser.run(DRAWN)["hash"]
        self.assertNotEqual(self.after(lambda: self.find("#view-phase").send_keys(Keys.ARROW_RIGHT * 5))["hash"], still)

    def test_four_hundred_particles_turn_smoothly(self):
        directory = self.pages.by_hand("large", self.full, "dodecahedron", 400, 0.5)
        self.open(self.pages.report(directory))
        self.view()
        self.assertIn("400 particles", self.find("#view").text)
        # Other programs may hold the processor for a while; the page is as fast as its best.
        rates = [self.browser.driver.execute_async_script(RATE) for _ in range(3)]
        print(f"400 dodecahedra: {', '.join(f'{rate:.1f}' for rate in rates)} frames/s", file=sys.stderr)
        self.assertGreaterEqual(max(rates), 10)

    def test_without_webgl_a_sentence_stands_in_its_place(self):
        other = browsers.Browser(self.root, "plain", ["--disable-gpu", "--disable-3d-apis"])
        self.addCleanup(other.quit)
        other.open(self.page)
        self.assertIn("no WebGL", other.driver.find_element(By.ID, "no-webgl").text)
        self.assertEqual(other.errors(), [])

    # ---- Sweeps of all kinds ----------------------------------------------------------------------------------

    def test_failed_replicates(self):
        some = self.pages.with_failures("some-failed", self.full, lambda name: name.endswith("N24-r0000"))
        self.open(self.pages.report(some))
        self.assertIn("3 done, 1 failed", self.find("#summary").text)
        self.assertIn("failed in jam: made to fail", self.find("#reservations").text)
        self.assertIn("2, 1 failed", self.find("#table").text)
        everything = self.pages.with_failures("all-failed", self.full, lambda name: True)
        self.open(self.pages.report(everything))
        self.assertIn("0 done, 4 failed", self.find("#summary").text)
        self.assertIn("No replicate has a packing to show", self.find("#view").text)
        self.assertIn("No replicate reached a jamming density", self.find(".absent").text)

    def test_one_replicate_has_no_interval(self):
        self.open(self.pages.report(self.pages.single("single", self.full)))
        self.assertIn("1 sweep point, 1 replicate:", self.find("#summary").text)
        self.assertNotIn("±", self.find("#table tbody").text)
        self.assertEqual(self.charts(), CHARTS)

    def test_what_was_not_measured_is_left_out_with_its_reason(self):
        self.open(self.pages.report(self.swept()))
        self.assertEqual(self.charts(), [name for name in CHARTS if name not in ("spectrum", "scaling", "shear")])
        self.assertIn('add "modes" to the manifest’s "measure"', self.find(".absent").text)
        nothing = self.pages.run("bare", measure=[], replicates=1)
        self.open(self.pages.report(nothing))
        self.assertEqual(self.charts(), ["density", "extrapolation", "evaluations", "time", "stops"])
        self.assertIn('add "contacts" to the manifest’s "measure"', self.find(".absent").text)

    def test_cubes(self):
        self.open(self.pages.report(self.pages.by_hand("cubes", self.full, "cube", 64, 0.5)))
        self.assertIn("cube", self.find("#table").text)
        self.assertIn("face-face", self.charts())
        self.view()
        self.assertGreater(self.browser.run(DRAWN)["drawn"], 0)

    def test_markup_in_names_is_text(self):
        self.open(self.pages.report(self.pages.forged("forged", self.full)))
        self.assertEqual(self.find("#name").text, "tiny")
        self.assertIn("<img src=x onerror=alert(2)>", self.find("#provenance").text)
        self.assertIn("</script>" + report_pages.HOSTILE, self.find("#reservations").text)
        self.assertEqual(self.browser.run("return document.querySelectorAll('main script, main img').length"), 0)

    def test_nothing_is_wider_than_a_narrow_window(self):
        self.browser.width(390)
        self.addCleanup(self.browser.width, 1200)
        for scheme in ("light", "dark"):
            self.browser.media(prefers_color_scheme=scheme)
            self.open(self.page)
            inner, outer = self.browser.run("return [document.documentElement.scrollWidth, innerWidth]")
            self.assertLessEqual(inner, outer, scheme)
            clipped = self.browser.run("""return [...document.querySelectorAll('.chart')]
                .filter((chart) => chart.scrollWidth > chart.clientWidth + 1).map((chart) => chart.id)""")
            self.assertEqual(clipped, [], scheme)
        self.browser.media()


if __name__ == "__main__":
    unittest.main(verbosity=2)
