"""Shared parts of the tests of exported files: every replicate with its nearest state, and with its path.

usage of each test, such as gsd_test.py: gsd_test.py RESULTS EXPORTED. The folder EXPORTED contains nearest/NAME.gsd and
path/NAME.gsd, or the files of the other format."""

import pathlib
import sys
import unittest

import numpy

import results


class RoundTrip(unittest.TestCase):
    """Base class of the tests. `cases()` returns the file name without extension, the states, their values in the
    record, and whether it is a path."""

    where = exported = None
    at = ""  # the case, for messages

    def _formatMessage(self, msg, standardMsg):
        return f"{self.at}: {super()._formatMessage(msg, standardMsg)}"

    def cases(self):
        names = results.names(self.where)
        self.assertTrue(names, f"no records in {self.where}")
        for name in names:
            for folder, read in (("nearest", results.nearest), ("path", results.path)):
                whole = folder == "path"
                self.at = f"{folder}/{name}"
                states = read(self.where, name)
                self.assertGreater(len(states), 1 if whole else 0)
                yield self.exported / folder / name, states, results.measured(self.where, name, whole), whole

    def assert_near(self, value, expected, tolerance, what):
        """The largest absolute difference is at most `tolerance`. Arrays of different shape are an error."""
        value, expected = numpy.asarray(value, dtype=float), numpy.asarray(expected, dtype=float)
        self.assertEqual(value.shape, expected.shape, what)
        self.assertTrue(numpy.isfinite(value).all(), f"{what}: not finite")
        worst = float(numpy.max(numpy.abs(value - expected), initial=0))
        self.assertLessEqual(worst, tolerance, f"{what}: off by {worst:.3g}, allowed {tolerance:.3g}")


def main():
    RoundTrip.where = pathlib.Path(sys.argv[1])
    RoundTrip.exported = pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1], module="__main__")
