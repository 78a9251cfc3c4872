"""Runs Chromium for the browser tests: it opens pages from disk without a network, and records all messages."""

import json
import shutil

from selenium import webdriver
from selenium.common.exceptions import NoAlertPresentException
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

FLAGS = ["--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader", "--window-size=1200,1000"]


class Browser:
    """A browser. Its profile and its download directory are below `root`."""

    def __init__(self, root, name, flags=()):
        options = Options()
        options.binary_location = shutil.which("chromium")
        for flag in [*FLAGS, *flags, f"--user-data-dir={root}/profile-{name}"]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.downloads = root / f"downloads-{name}"
        self.downloads.mkdir()
        self.driver.execute_cdp_cmd("Browser.setDownloadBehavior",
                                    {"behavior": "allow", "downloadPath": str(self.downloads)})

    def media(self, **features):
        """Sets media features for pages, such as prefers_color_scheme="dark"."""
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": name.replace("_", "-"), "value": value} for name, value in features.items()]})

    def width(self, pixels):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": pixels, "height": 1000, "deviceScaleFactor": 1, "mobile": False})

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait(self, script, what, seconds=200):
        """Waits until a JavaScript expression is true in the page."""
        self.driver.set_script_timeout(seconds + 5)
        done = self.driver.execute_async_script(f"""
            const done = arguments[arguments.length - 1], until = performance.now() + {seconds * 1000};
            const late = () => performance.now() > until;
            const look = () => (({script}) ? done(true) : late() ? done(false) : setTimeout(look, 20));
            look();""")
        assert done, f"waited {seconds} s in vain for {what}"

    def open(self, page):
        self.driver.get(f"file://{page}")
        self.wait("document.documentElement.dataset.ready === 'yes'", "the page's scripts")
        self.wait("[...document.querySelectorAll('.chart')].every((chart) => chart.dataset.drawn === 'yes')", "charts")

    def errors(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def requests(self):
        """Addresses that pages have requested since the last call."""
        addresses = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            parameters = message["params"]
            if message["method"] == "Network.requestWillBeSent" and parameters["documentURL"].startswith("file:"):
                addresses.append(parameters["request"]["url"])
        return [address for address in addresses if not address.startswith(("file:", "data:", "blob:"))]

    def alert_is_open(self):
        try:
            self.driver.switch_to.alert.dismiss()
        except NoAlertPresentException:
            return False
        return True

    def quit(self):
        self.driver.quit()
