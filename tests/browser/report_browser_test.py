"""Tests pages of reports in Chromium, opened from disk. usage: report_browser_test.py ISOJAM"""

import unittest

import browser as browsers
from report_case import CHARTS, COUNT, DRAWN, REST, Case
from report_chart_tests import ChartTests
from report_many_tests import ManyTests
from report_mixture_tests import MixtureTests

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select


class Report(ChartTests, ManyTests, MixtureTests, Case):
    # ---- Packings ---------------------------------------------------------------------------------------------

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

    def test_forces_are_drawn_and_the_view_is_saved(self):
        self.open(self.page)
        self.assertIn("All 4 packings are included.", self.find("#view-choice").text)
        self.assertEqual(len(Select(self.find("#view-replicate")).options), 4)
        self.view()
        plain = self.browser.run(DRAWN)
        forces = self.after(self.find("#view-forces").click)
        self.assertNotEqual(forces["hash"], plain["hash"])
        self.find("#view").find_element(By.XPATH, ".//button[text()='Save PNG']").click()
        (picture,) = self.saved(["dodecahedron-N24-r0000.png"])
        data = picture.read_bytes()
        width, height = (int.from_bytes(data[at:at + 4], "big") for at in (16, 20))
        shown = self.browser.run("const {clientWidth, clientHeight} = document.getElementById('packing');"
                                 "return [clientWidth, clientHeight]")
        self.assertEqual((data[:8], [width, height]), (b"\x89PNG\r\n\x1a\n", [2 * side for side in shown]))
        self.assertEqual(self.after(self.find("#view-forces").click)["hash"], plain["hash"], "as before")

    def test_the_view_rests_when_nothing_changes(self):
        self.open(self.page)
        self.view()
        self.expect_rest()

    def expect_rest(self):
        self.browser.run(COUNT)
        self.browser.driver.execute_async_script(REST)

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
        start.click()
        frames = self.browser.run("return Number(document.getElementById('packing').dataset.frames)")
        self.browser.wait(f"document.getElementById('packing').dataset.frames > {frames} + 2", "frames of the motion")
        self.assertNotEqual(self.browser.run(DRAWN)["hash"], still)
        self.assertEqual(start.text, "Stop")
        start.click()
        self.expect_rest()

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
        self.assertIn("failed in jam: made to fail with 24 particles: 1 replicate", self.find("#reservations").text)
        self.assertIn("2, 1 failed", self.find("#table").text)
        everything = self.pages.with_failures("all-failed", self.full, lambda name: True)
        self.open(self.pages.report(everything))
        self.assertIn("0 done, 4 failed", self.find("#summary").text)
        # Failures whose texts differ only in a number are one group.
        self.assertIn("failed in jam: made to fail with 24 to 28 particles: 4 replicates",
                      self.find("#reservations").text)
        self.assertIn("No replicate has a packing to show", self.find("#view").text)
        self.assertIn("No replicate reached a jamming density", self.find(".absent").text)

    def test_one_replicate_has_no_interval(self):
        self.open(self.pages.report(self.pages.single("single", self.full)))
        self.assertIn("1 sweep point, 1 replicate:", self.find("#summary").text)
        self.assertNotIn("±", self.find("#table tbody").text)
        self.assertEqual(self.charts(), CHARTS)

    def test_what_was_not_measured_is_left_out_with_its_reason(self):
        self.open(self.pages.report(self.swept()))
        self.assertEqual(self.charts(), [name for name in CHARTS if name not in ("forces", "pairs", "exponents", "spectrum",
                                                                            "scaling", "moduli", "shear")])
        self.assertIn('isojam measure DIR --add modes', self.find(".absent").text)
        nothing = self.pages.run("bare", measure=[], replicates=1)
        self.open(self.pages.report(nothing))
        self.assertEqual(self.charts(), ["density", "extrapolation", "stops", "evaluations", "time"])
        self.assertIn('isojam measure DIR --add contacts', self.find(".absent").text)

    def test_markup_in_names_is_text(self):
        self.open(self.pages.report(self.pages.forged("forged", self.full)))
        self.assertEqual(self.find("#name").text, "tiny")
        self.assertIn("<img src=x onerror=alert(2)>", self.find("#provenance").text)
        self.assertEqual(self.browser.run("return document.querySelectorAll('main script, main img').length"), 0)

    def test_nothing_is_wider_than_its_place(self):
        self.addCleanup(self.browser.width, 1200)
        self.addCleanup(self.browser.media)
        for width, scheme in ((1400, "light"), (390, "dark")):
            self.browser.width(width)
            self.browser.media(prefers_color_scheme=scheme)
            self.open(self.page)
            self.browser.run("document.querySelectorAll('details').forEach((part) => { part.open = true; })")
            for together in (False, True):
                self.choose("together", together)
                self.expect_nothing_wider(f"{width}, {scheme}, together {together}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
