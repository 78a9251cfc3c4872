"""Tests the documentation site that MkDocs builds, in Chromium and opened from disk. usage: site_browser_test.py SOURCE PROGRAM

Doxygen does not run; empty files replace its pages.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

import browser as browsers

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

SOURCE, PROGRAM = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(SOURCE / "docs/site"))
from gather import REFERENCE, gather  # noqa: E402

# Addresses of all files that a page loads or to which it links on this disk, and other addresses that it loads.
ADDRESSES = """return [...document.querySelectorAll("[src], [href]")].map((item) => item.src || item.href)
  .filter((address) => !/^(https?|mailto):/.test(address))
  .concat([...document.querySelectorAll("[src], link")].map((item) => item.src || item.href))"""
WIDER = """const {scrollWidth, clientWidth} = document.documentElement;
  return scrollWidth <= Math.min(clientWidth, innerWidth) ? 0 : scrollWidth"""


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="isojam-site-")
        cls.addClassCleanup(folder.cleanup)
        root = pathlib.Path(folder.name).resolve()
        gather(SOURCE, root, PROGRAM)
        for page in re.findall(r"api/\w+\.html", REFERENCE):
            (root / "source" / page).parent.mkdir(exist_ok=True)
            (root / "source" / page).touch()
        subprocess.run(["mkdocs", "build", "--quiet", "--strict", "-f", root / "mkdocs.yml"], check=True)
        cls.site = root / "site"
        cls.pages = sorted(page for page in cls.site.rglob("*.html") if page.parent.name != "api")
        cls.browser = browsers.Browser(root, "site", ["--disable-gpu"])
        cls.addClassCleanup(cls.browser.quit)

    def open(self, page):
        self.browser.driver.get(f"file://{page}")

    def find(self, selector):
        return self.browser.driver.find_element(By.CSS_SELECTOR, selector)

    def missing(self):
        """Addresses in the page that are not files on this disk."""
        parts = [(address, urllib.parse.urlsplit(address)) for address in self.browser.run(ADDRESSES)]
        return sorted({address for address, part in parts
                       if part.scheme != "file" or not pathlib.Path(urllib.parse.unquote(part.path)).is_file()})

    def test_every_page(self):
        self.assertGreater(len(self.pages), 30)
        wrong = []
        for page in self.pages:
            self.open(page)
            found = [f"there is no {address}" for address in self.missing()]
            for width in (1400, 390):
                self.browser.width(width)
                if wider := self.browser.run(WIDER):
                    found.append(f"it is {wider} pixels wide in a window of {width}")
            wrong += [f"{page.relative_to(self.site)}: {fault}" for fault in found + self.browser.errors()]
        wrong += [f"{address} was asked for" for address in self.browser.requests()]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def follow(self, link, title):
        """Clicks a link, which must be inside the window, and waits for the page to which it leads."""
        self.assertTrue(self.browser.run("""const {left, right} = arguments[0].getBoundingClientRect();
            return left >= 0 && right <= innerWidth""", link))
        link.click()
        self.browser.wait(f"document.title === '{title} - isojam' && document.readyState === 'complete'", title, 20)

    def menu_is_open(self):
        return self.browser.run("return document.querySelector('.wy-nav-side').getBoundingClientRect().left === 0")

    def test_the_menu(self):
        for width in (1400, 390):
            self.browser.width(width)
            self.open(self.site / "index.html")
            for title in ("Commands", "Glossary"):
                self.assertEqual(self.menu_is_open(), width == 1400)
                if width == 390:
                    self.find(".wy-nav-top button").click()
                    self.browser.wait("document.querySelector('.wy-nav-side').getBoundingClientRect().left === 0",
                                      "the menu", 20)
                self.follow(self.browser.driver.find_element(By.LINK_TEXT, title), title)
        self.find(".wy-nav-top button").click()
        self.find(".wy-menu .toctree-l2 a").click()
        self.assertFalse(self.menu_is_open(), "a section of the same page closes the menu")
        self.assertEqual(self.browser.errors(), [])

    def test_the_search(self):
        self.browser.width(1400)
        self.open(self.site / "examples/index.html")
        self.find("[role=search] input").send_keys("Replicate RERUN", Keys.ENTER)
        self.browser.wait("document.querySelectorAll('#found dt').length > 0", "results", 20)
        self.assertRegex(self.find("#count").text, r"\d+ sections")
        self.assertRegex(self.find("#found dd").text.lower(), "replicate")
        self.follow(self.browser.driver.find_element(By.PARTIAL_LINK_TEXT, "Commands: "), "Commands")
        self.assertIn("#", self.browser.driver.current_url)
        self.open(self.site / "search.html")
        self.find("form.wy-form [name=q]").send_keys("nowherewritten", Keys.ENTER)
        self.browser.wait("location.search && document.getElementById('count').textContent", "the count", 20)
        self.assertEqual(self.find("#count").text, "0 sections have all words.")
        self.assertEqual(self.browser.errors(), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
