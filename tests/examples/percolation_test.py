"""Tests the estimates of examples/percolation. usage: percolation_test.py examples/percolation"""

import importlib.util
import math
import pathlib
import random
import sys
import unittest

FOLDER = pathlib.Path(sys.argv[1]).resolve()
sys.path[:0] = [str(FOLDER), str(FOLDER.parent / "page")]

import analysis  # noqa: E402

# Both folders have a gather.py.
spec = importlib.util.spec_from_file_location("percolation_gather", FOLDER / "gather.py")
gather = importlib.util.module_from_spec(spec)
spec.loader.exec_module(gather)


def logistic(z, middle, width):
    return 1 / (1 + math.exp((middle - z) / width))


def packings(stream, count, middle=1.8, width=0.1, until="end", solid="octahedron", factor=1.0, particles=100):
    """Artificial packings: Z_ff is uniform, the outcome follows a logistic curve, and ln S is a quadratic function."""
    made = []
    for _ in range(count):
        z = stream.uniform(0.2, 2.2)
        s = min(99.0, factor * math.exp(1.2 * z * z - 0.4 * z + stream.gauss(0, 0.05)))
        made.append({"status": "done", "flags": [], "solid": solid, "particles": particles, "w": 1e-5, "h": 0.1,
                     "until": until, "states": {"Z_ff_fit": [z], "S_fit": [s],
                                                "winding_fit": [int(stream.random() < logistic(z, middle, width))]}})
    return made


class Made(analysis.Data):
    """Data without a file."""

    def __init__(self, replicates):
        self.excluded, self.all, self.studies = {"crystalline"}, replicates, {}


class Branching(unittest.TestCase):
    def test_chain(self):
        chain = [(i, i + 1, True) for i in range(9)] + [(i, i + 5, False) for i in range(5)]
        # Two ends have one contact, eight particles have two.
        self.assertAlmostEqual(gather.branching(chain)[0], 8 * 2 / 18)
        self.assertEqual(gather.branching(chain[:1] + chain[9:]), (None, None))

    def test_random(self):
        stream = random.Random(3)
        pairs = [(a, b) for a in range(30) for b in range(a) if stream.random() < 0.3]
        contacts = [(a, b, i < 40) for i, (a, b) in enumerate(pairs)]
        draws = [gather.branching([(a, b, i in chosen) for i, (a, b) in enumerate(pairs)])[0]
                 for chosen in (set(stream.sample(range(len(pairs)), 40)) for _ in range(4000))]
        mean = sum(draws) / len(draws)
        print("branching ratio of random contacts:", gather.branching(contacts)[1], "mean of draws", mean)
        self.assertAlmostEqual(gather.branching(contacts)[1], mean, delta=0.01)


class Thresholds(unittest.TestCase):
    def test_coverage(self):
        stream, hits, trials = random.Random(5), 0, 40
        for _ in range(trials):
            found = analysis.threshold_of(packings(stream, 150))
            hits += found["low"] <= 1.8 <= found["high"]
        print("intervals that contain the threshold:", hits, "of", trials)
        self.assertGreaterEqual(hits, 0.85 * trials)

    def test_one_side(self):
        self.assertIsNone(analysis.threshold_of(packings(random.Random(1), 50, middle=9)))


class Collapse(unittest.TestCase):
    def test_groups(self):
        stream = random.Random(4)
        same = [r for solid in analysis.SOLIDS for r in packings(stream, 40, solid=solid)]
        self.assertGreater(analysis.collapse(Made(same), 100)["chi_squared"][2], 0.01)
        larger = same + packings(stream, 40, solid="octahedron", until="decompression", factor=1.5)
        found = analysis.collapse(Made(larger), 100)
        print("deviations between groups:", found["between"], "in one:", found["within"])
        self.assertLess(found["chi_squared"][2], 1e-3)

    def test_excluded(self):
        crystal = {**packings(random.Random(1), 1)[0], "flags": ["crystalline"]}
        self.assertEqual(Made([crystal]).of(), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
