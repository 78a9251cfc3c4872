"""Shared parts of the tests of the Python module.

usage of each test: NAME_test.py MODULE RESULTS EXPORTED. The folder MODULE contains the package isojam. RESULTS are the
results of manifest.json. The folder EXPORTED contains what tests/export writes: results, exported/, free-results and
free-exported/."""

import functools
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy

MODULE, RESULTS, EXPORTED = map(pathlib.Path, sys.argv[1:4])
sys.path[:0] = [str(MODULE), str(pathlib.Path(__file__).parent.parent / "export")]

import isojam  # noqa: E402

#: Results with cubic cells, with relaxed cells, and with mixtures and failures.
CUBES, FREE, MIXED = EXPORTED / "results", EXPORTED / "free-results", RESULTS
ALL = (CUBES, FREE, MIXED)


@functools.lru_cache(maxsize=None)
def study(directory):
    return isojam.load(directory)


def document(directory, folder, name):
    """The content of a file, read by the json module only."""
    return json.loads(pathlib.Path(directory, folder, name + ".json").read_text())


def done(directory):
    """Names of the replicates that did not fail."""
    return [name for name in study(directory).names if document(directory, "records", name)["status"] == "done"]


def at(value, pointer):
    """Value at a JSON pointer; None if it is missing."""
    for key in pointer.split("/")[1:]:
        if isinstance(value, list):
            value = value[int(key)] if int(key) < len(value) else None
        else:
            value = value.get(key) if isinstance(value, dict) else None
    return value


class Case(unittest.TestCase):
    def near(self, value, expected, tolerance, what):
        """The largest absolute difference is at most `tolerance`, and the shapes are equal."""
        value, expected = numpy.asarray(value, dtype=float), numpy.asarray(expected, dtype=float)
        self.assertEqual(value.shape, expected.shape, what)
        worst = float(numpy.max(numpy.abs(value - expected), initial=0))
        self.assertTrue(worst <= tolerance, f"{what}: off by {worst:.3g}, allowed {tolerance:.3g}")

    def refused(self, call, *words):
        """Checks that a call raises an InputError whose text contains all these words. Returns the exception."""
        with self.assertRaises(isojam.InputError) as caught:
            call()
        for word in words:
            self.assertIn(word, str(caught.exception))
        return caught.exception

    def folder(self):
        """Makes a directory that is removed at the end of the test."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return folder.name

    def copy(self, directory):
        """Makes a copy of a results directory."""
        return pathlib.Path(shutil.copytree(directory, pathlib.Path(self.folder(), "copy")))

    def stub(self, body, version=None):
        """Writes a shell script that replaces isojam. `--version` prints the version of the module, or the text of a
        file."""
        facts = isojam.facts
        own = f"isojam {facts.version} (stub)\nschemas: {' '.join(facts.schemas.values())}\n"
        file = pathlib.Path(self.folder(), "isojam")
        file.write_text("#!/bin/sh\n[ \"$1\" != --version ] || { "
                        + (f"cat {version}" if version else f"echo '{own}'") + "; exit; }\n" + body)
        file.chmod(0o755)
        return file


def main():
    unittest.main(argv=sys.argv[:1], module="__main__")
