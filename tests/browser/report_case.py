"""Shared parts of the browser tests of reports: pages that are made once, a browser, and queries of a page."""

import pathlib
import sys
import tempfile
import unittest

import browser as browsers
import report_pages

from selenium.webdriver.common.by import By

EXECUTABLE = pathlib.Path(sys.argv.pop(1)).resolve()
CHARTS = ["density", "topology", "edge-face", "face-face", "edge-face-histogram", "face-face-histogram", "forces", "pairs",
          "exponents", "extrapolation", "spectrum", "scaling", "moduli", "shear", "stops", "evaluations", "time"]
# Charts of all solids together, and the number of charts of single solids.
TOGETHER = {"topology": 3, "edge-face": 1, "face-face": 1, "extrapolation": 1, "spectrum": 1, "scaling": 1, "moduli": 2,
            "shear": 1, "edge-face-histogram": 1, "face-face-histogram": 1, "forces": 1, "pairs": 1, "exponents": 1}

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

# Counts, from here on, the frames that the page asks for.
COUNT = """
Object.assign(window, {asked: 0, frame: window.requestAnimationFrame.bind(window)});
window.requestAnimationFrame = (work) => { asked += 1; return frame(work); };"""

# Done when the page has asked for no frame while thirty went by.
REST = """
const done = arguments[arguments.length - 1];
let quiet = 0, before = asked;
const look = () => {
  quiet = asked === before ? quiet + 1 : 0;
  before = asked;
  return quiet === 30 ? done(true) : frame(look);
};
look();"""

class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="isojam-browser-")
        cls.root = pathlib.Path(cls.directory.name)
        cls.pages = report_pages.Pages(EXECUTABLE, cls.root)
        nearer = {**report_pages.manifest()["protocol"], "final_distance": 0.015, "fit_window": 0.05}
        cls.full = cls.pages.run("full", protocol=nearer)
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

    def choose(self, name, on=True):
        """Sets a switch of all charts, and waits until they are drawn again."""
        self.browser.run(f"""const box = document.getElementById('choose-{name}');
            if (box.checked !== {str(on).lower()}) box.click();""")
        self.browser.wait("[...document.querySelectorAll('.chart')].every((chart) => chart.dataset.drawn === 'yes')",
                          "charts to be drawn again")

    def marks(self, chart):
        """Marks in each panel of a chart: colours, shapes and number of symbols, lines with more than one point, and
        boxes."""
        return self.browser.run("""
            const panels = [...document.querySelectorAll(`#chart-${arguments[0]} g.role-scope > g`)]
              .filter((panel) => panel.querySelector(':scope > g .role-axis'));
            const all = (panel, what) => [...panel.querySelectorAll(what)];
            return panels.map((panel) => ({
              colours: [...new Set(all(panel, 'g.mark-symbol path').map((mark) => mark.getAttribute('stroke')))],
              forms: [...new Set(all(panel, 'g.mark-symbol path').map((mark) => mark.getAttribute('d')))],
              symbols: all(panel, 'g.mark-symbol path').length,
              lines: all(panel, 'g.mark-line path').filter((line) => /L|H|V/.test(line.getAttribute('d') ?? '')).length,
              boxes: all(panel, 'g.mark-rect.role-mark path').filter((box) => box.getAttribute('fill-opacity')).length,
            }));""", chart)

    def saved(self, names):
        """Waits until the browser has saved these files, and returns their paths."""
        for _ in range(2000):
            paths = [self.browser.downloads / name for name in names]
            if all(path.exists() for path in paths):
                return paths
            self.browser.driver.execute_async_script("setTimeout(arguments[0], 50)")
        self.fail(f"saved {sorted(path.name for path in self.browser.downloads.iterdir())}, expected {names}")

    def view(self):
        """Scrolls to the 3D view, waits until it is drawn, and returns its canvas."""
        canvas = self.find("#packing")
        self.browser.run("arguments[0].scrollIntoView({block: 'center'})", canvas)
        self.browser.wait("document.getElementById('packing').dataset.frames > 0", "the first frame")
        return canvas

    def after(self, action):
        """Calls `action`, waits for the next frame of the 3D view, and returns what is drawn."""
        before = self.browser.run("return Number(document.getElementById('packing').dataset.frames)")
        action()
        self.browser.wait(f"document.getElementById('packing').dataset.frames > {before}", "another frame")
        return self.browser.run(DRAWN)

    def expect_nothing_wider(self, what):
        inner, outer = self.browser.run("return [document.documentElement.scrollWidth, innerWidth]")
        self.assertLessEqual(inner, outer, what)
        clipped = self.browser.run("""
            const scrolls = (part) => part.scrollWidth > part.clientWidth + 1 && part.clientWidth > 0 &&
              ['auto', 'scroll', 'hidden'].includes(getComputedStyle(part).overflowX);
            const beyond = (part) => part.getBoundingClientRect().right > document.documentElement.clientWidth + 1;
            return [...document.querySelectorAll('main *:not(svg *)')].filter((part) => scrolls(part) || beyond(part))
              .map((part) => `${part.tagName} ${part.id} ${part.className} ${part.textContent.slice(0, 40)}`)""")
        self.assertEqual(clipped, [], what)
