"""Tests of a report with 400 replicates, see report_browser_test.py."""

from report_case import TOGETHER


class ManyTests:
    def test_four_hundred_replicates(self):
        directory = self.pages.many("many", self.full, 200, {"dodecahedron-N28": "icosahedron"})
        page = self.pages.report(directory)
        self.addCleanup(self.browser.width, 1200)
        self.browser.width(1400)
        self.open(page)
        self.browser.run("document.querySelectorAll('details').forEach((part) => { part.open = true; })")
        for name in ("topology", "extrapolation", "spectrum", "scaling", "moduli", "shear"):
            self.expect_boxes(name)
        for name in ("density", "time"):
            self.expect_a_swarm(name)
        self.expect_lists()
        self.expect_nothing_wider("1400")
        self.expect_crystals_at_the_ends()
        self.expect_all_in_one()
        self.browser.width(390)
        self.open(page)
        for together in (False, True):
            self.choose("together", together)
            self.expect_nothing_wider(f"390, together {together}")

    def expect_boxes(self, name):
        for panel in self.marks(name):
            self.assertGreater(panel["boxes"], 3, name)
            # Beside the boxes: twenty crystals, with a line or two each.
            self.assertLess(panel["lines"], 50, name)

    def expect_a_swarm(self, name):
        shown, hidden = self.browser.run("""
            const discs = [...document.querySelector(`#chart-${arguments[0]} g.mark-symbol`).children].map((disc) => {
              const {x, y, width} = disc.getBoundingClientRect();
              return [x, y, width];
            });
            const near = discs.filter(([x, y, width], k) =>
              discs.some(([u, v], other) => other > k && Math.hypot(x - u, y - v) < width / 2)).length;
            return [discs.length, near];""", name)
        self.assertGreaterEqual(shown, 360, name)
        self.assertEqual(hidden, 0, f"{name}: discs that cover the centre of another")

    def expect_lists(self):
        """The page lists flagged replicates by flag, and states which packings it contains."""
        text = self.find("#reservations").text
        for line in ("crystalline: 40 replicates, excluded from means", "not_stable: 40 replicates",
                     "icosahedron, N = 28, 20 of 200: icosahedron-N28-r0009, icosahedron-N28-r0019"):
            self.assertIn(line, text)
        self.assertIn("2 of 400 packings are included. 398 have no packing in the results directory.",
                      self.find("#view-choice").text)

    def expect_crystals_at_the_ends(self):
        """Crystalline replicates are marked at the end of an axis, unless the reader chooses to extend the axis."""
        ends = """
            const chart = document.getElementById('chart-density');
            const ticks = [...chart.querySelectorAll('.role-axis-label text')].map((text) => parseFloat(text.textContent));
            return [Math.max(...ticks.filter((number) => number > 0 && number < 1)), chart.textContent]"""
        before, text = self.browser.run(ends)
        self.assertIn("20 ▷", text)
        self.assertIn("The axes do not show all of 40 excluded replicates.", self.browser.run(
            "return document.getElementById('chart-extrapolation').parentElement.textContent"))
        self.choose("everything")
        after, text = self.browser.run(ends)
        self.assertGreater(after, before + 0.03)
        self.assertNotIn("▷", text)
        self.choose("everything", False)

    def expect_all_in_one(self):
        apart = {name: self.marks(name) for name in TOGETHER}
        self.choose("together")
        for name, panels in TOGETHER.items():
            found = self.marks(name)
            self.assertEqual((len(apart[name]), len(found)), (2, panels), name)
            for panel in found:
                self.assertEqual(len(panel["colours"]), 2, f"{name}: a colour for each solid")
                self.assertGreaterEqual(len(panel["forms"]), 2, f"{name}: a symbol for each N")
            legend = self.browser.run("""return [...document.querySelectorAll(
                `#chart-${arguments[0]} .role-legend-label text`)].map((text) => text.textContent)""", name)
            for entry in ("dodecahedron", "icosahedron", "N = 24", "N = 28"):
                self.assertIn(entry, legend, name)
        self.expect_nothing_wider("1400, all in one")
        self.choose("together", False)
        self.assertEqual({name: self.marks(name) for name in TOGETHER}, apart)
