"""Tests blocks of the page examples/paper. usage: paper_blocks_test.py examples/paper

- The numbers of minima, of unresolved states, and of states with near-rattlers or negative modes agree with numbers
  that are counted by hand, without crystalline replicates.
- A rank that is impossible for the remaining rows is left out. φ_J by the paper's rule is compared replicate by
  replicate.
- The exponent of ⟨ω_l⟩/√K is the exponent of ⟨ω_l⟩ minus half the exponent of K.
- The smallest excess of contacts that a test detects agrees with sums of binomial terms. The order of emergence is
  found. Fractions of random contacts agree with directions drawn at random.
- The error of C from cut-offs uses the states of C. The error of Z_ff is half the difference between fits and gaps.
- Intervals of solids are compared with both errors. Packings with more than three zero modes are counted. Deviates of
  offsets use both the paper's interval and that of isojam. Solids are sorted in ascending order.
"""

import math
import random
import sys
import unittest

sys.path.insert(0, sys.argv[1])

import alignment  # noqa: E402
import constraints  # noqa: E402
import contacts  # noqa: E402
import densities  # noqa: E402
import minima  # noqa: E402
import network  # noqa: E402
import vibrations  # noqa: E402
from data import RATIO, Data  # noqa: E402
from estimates import normal_deviate  # noqa: E402
from expansions import Expansions  # noqa: E402


def of(mean, half_width, n=16, **more):
    return {"mean": mean, "half_width": half_width, "n": n, **more}


class Made(Data):
    """Artificial data of replicates, without files."""

    def __init__(self, studies, figures=()):
        Expansions.__init__(self, {name: {"replicates": some} for name, some in studies.items()}, tuple(studies))
        self.figures = figures


def replicate(number, states, solid="octahedron", particles=100, flags=(), **more):
    """An artificial replicate with φ_J = 0.7, E ∝ Δφ⁶, and states at Δφ = 0.1 · 0.5^i."""
    count = len(next(iter(states.values())))
    x = [0.1 * 0.5 ** i for i in range(count)]
    return {"solid": solid, "particles": particles, "replicate": number, "status": "done", "flags": list(flags),
            "phi_j": {"phi_j": 0.7},
            "states": {"phi": [0.7 + d for d in x], "delta_phi": x, "E": [d ** 6 for d in x], **states}, **more}


class States(unittest.TestCase):
    COUNTS = {"zero": [3, 3, 5, 6, 3], "negative": [0, 1, 0, 0, None], "near_rattlers": [0, 1, 2, 0, 1],
              "descents": [0, 1, 0, 0, 0]}

    def test_counts(self):
        data = Made({"paper-100": [replicate(0, self.COUNTS), replicate(1, self.COUNTS, flags=["crystalline"])]})
        self.assertEqual(minima.state_counts(data), {"states": 5, "descents": 1, "negative": 1, "loose": 3,
                                                     "unresolved": 1, "three": 2, "loose_three": 1,
                                                     "loose_negative": 1})
        near = minima.state_counts(data, nearest=0.02)  # Δφ = 0.1, 0.05, 0.025
        self.assertEqual((near["states"], near["loose"], near["unresolved"]), (3, 2, 0))
        self.assertEqual(minima.every_count(data, "states"), "10")

    def test_share_of_unstable_modes(self):
        states = {"unstable_exact": [0.0, 0.02, 0.0]}
        ordered = replicate(2, {"unstable_exact": [0.5] * 3}, flags=["crystalline"])
        short = replicate(3, {"unstable_exact": [0.5] * 3}, flags=["goal_not_reached"])
        data = Made({"paper-100": [replicate(0, states), replicate(1, states), ordered, short],
                     "paper-rule": [replicate(0, states), short, ordered]})
        ours, rule = (minima.unstable_share(data, study, "octahedron", "unstable_exact", (0.04, 0.08))
                      for study in ("paper-100", "paper-rule"))
        self.assertEqual((ours["mean"], ours["n"]), (2.0, 2))
        self.assertEqual(rule["n"], 2)  # what ended short counts
        self.assertEqual(minima.rule_value(data, "paper-rule", "negative"), "4")
        self.assertEqual(minima.rule_value(data, "paper-rule", "short"), "1 of 2")

    def test_the_rule_is_compared_by_replicate(self):
        def of(number, phi_j):
            return {**replicate(number, {"unstable_exact": [0.0]}), "phi_j": {"phi_j": phi_j}}

        data = Made({"paper-rule": [of(0, 0.698), of(1, 0.702), of(2, 0.5)],
                     "paper-rule-base": [of(1, 0.703), of(0, 0.7)]})
        moved = minima.rule_moves(data, "octahedron")
        self.assertEqual(moved["n"], 2)
        self.assertAlmostEqual(moved["mean"], -15)

    def test_rank_of_the_rest(self):
        # 10 particles of Z = 8 are 40 contacts; one that goes with its four leaves 36: 72/9 = 8. The motions of 9 are
        # 51 without translations; rank 50 of all rows, so at least 50 − 3 · 4 of the rest, or 3 less by rounding: 16
        # may be missing.
        def missing(count, removed=1, rank=50):
            return minima.rest_missing({"backbone_missing": [count], "rank": [rank], "backbone_removed": [removed],
                                        "Z": [8.0], "backbone_Z": [8.0]}, 0, 10)

        self.assertEqual(missing(16), 16)
        self.assertIsNone(missing(17))
        self.assertIsNone(missing(51))
        self.assertEqual(missing(7, 0), 7)
        self.assertIsNone(missing(None))
        self.assertIsNone(missing(7, 0, None))

    def test_exponent_of_the_ratio(self):
        x = [0.1 * 0.5 ** i for i in range(6)]
        data = Made({"paper-400": [replicate(i, {"omega_l": [d ** 2.3 for d in x],
                                                 "K": [5 * d ** (3.8 + 0.2 * i) for d in x]}, particles=400)
                                   for i in range(2)]})
        for found in data.slopes("octahedron", 400, RATIO, vibrations.EDGES):
            if found:
                self.assertAlmostEqual(found["mean"], 2.3 - (1.9 + 2.0) / 2, places=9)
                self.assertEqual(found["n"], 2)
        self.assertEqual(data.column("octahedron", 400, RATIO)[0][0], 0.1 ** 2.3 / (5 * 0.1 ** 3.8) ** 0.5)
        self.assertIsNone(Made({"paper-400": [replicate(0, {"K": [1.0]}, particles=400)]}).column(
            "octahedron", 400, RATIO)[0])

    def test_errors_of_cutoffs(self):
        def of(number, c, gap):
            return replicate(number, {"Z_ff": [0.8], "C": [c[2]]}, network={"by_cutoffs": [[c, gap]]})

        data = Made({"paper-100": [of(0, [9, 10.0, 11.0, 12.0, 20], 1.0), of(1, [9, 10.0, 10.5, 13.0, 20], 0.8),
                                   of(2, [9, 10.0, 11.0, 12.0, 20], 0.9)]})
        self.assertAlmostEqual(constraints.with_cutoffs(data, "octahedron", 100, "C")["systematic"], (1 + 1.5 + 1) / 3)
        self.assertAlmostEqual(constraints.with_cutoffs(data, "octahedron", 100, "Z_ff")["systematic"], 0.05)
        self.assertEqual(constraints.error_of_rows(data, "octahedron", 100), "± 58")

    def test_cutoffs_of_the_same_states(self):
        # Δφ = 0.1, 0.05, 0.025. At 0.04 C is interpolated between the last two. With other cut-offs it is known only
        # for the first and the last.
        def of(number, middle):
            known = [[9, 10.0, 11.0, 12.0, 20], 0.7]
            entries = [known, [[11.0 if middle else None] * 5, 0.7 if middle else None], known]
            return replicate(number, {"Z_ff": [0.5, 0.6, 0.7], "C": [10.0, 11.0, 11.0]},
                             network={"by_cutoffs": entries})

        x = [0.1, 0.05, 0.025]
        self.assertEqual(constraints.around(x, [1, 1, 1], 0.04), (1, 2))
        self.assertEqual(constraints.around(x, [1, None, 1], 0.04), (0, 2))
        self.assertIsNone(constraints.around(x, [None, 1, 1], 0.06))
        data = Made({"paper-100": [of(0, True), of(1, False), of(2, True)]})
        by_factor, fitted, gaps, _ = constraints.cutoff_range(data, "octahedron", 100, 0.04)
        self.assertEqual((by_factor[2]["n"], fitted["n"], gaps["n"]), (2, 2, 2))
        self.assertEqual(constraints.cutoff_range(data, "octahedron", 100)[0][2]["n"], 3)
        self.assertEqual(constraints.cut_missing(data, "octahedron", "100", "0.04"), "1 of 3")
        # Without C by other cut-offs Z_ff keeps its error.
        data = Made({"paper-100": [replicate(i, {"Z_ff": [0.8], "C": [11.0]}, network={"by_cutoffs": [[[None] * 5, 1]]})
                                   for i in range(3)]})
        self.assertAlmostEqual(constraints.with_cutoffs(data, "octahedron", 100, "Z_ff")["systematic"], 0.1)
        self.assertNotIn("systematic", constraints.with_cutoffs(data, "octahedron", 100, "C"))

    def test_rests_between_states(self):
        # At Δφ = 0.04, by ln Δφ 0.32 of the way from 0.05 to 0.025.
        data = Made({"paper-100": [replicate(i, {"backbone_zero": zero})
                                   for i, zero in enumerate(([3, 3, 4], [3, 3, 3], [3, 5, 3]))]})
        self.assertEqual([minima.rest_between(data, what, "0.04") for what in ("all", "farther", "most")],
                         ["2", "1", "4.4"])

    def test_intervals_of_solids(self):
        figures = [{"place": "Table IV", "solid": solid, "particles": 400, "column": "S", "value": 2.0, "digits": 1}
                   for solid in ("octahedron", "icosahedron")]
        for values, said, undecided in (((2.0, 2.1, 2.2), "overlap", "0"), ((4.0, 4.1, 4.2), "do not overlap", "0"),
                                        ((2.0, 4.0, 6.0), "overlap", "1")):
            data = Made({"paper-400": [replicate(i, {"S": [s]}, solid, 400)
                                       for solid, some in (("octahedron", (2.0, 2.1, 2.2)), ("icosahedron", values))
                                       for i, s in enumerate(some)]}, figures=figures)
            self.assertEqual(contacts.separated(data, "IV", "S", "octahedron", "icosahedron"), said)
            self.assertEqual(contacts.lies(data, "IV", "undecided"), undecided)

    def test_solids_in_order(self):
        figures = [{"place": "Table IV", "solid": solid, "particles": 400, "column": "S", "value": value, "digits": 1}
                   for solid, value in (("octahedron", 3.0), ("icosahedron", 1.0))]
        data = Made({"paper-400": [replicate(i, {"S": [s]}, solid, 400) for i in range(3)
                                   for solid, s in (("octahedron", 2.0), ("icosahedron", 4.0))]}, figures=figures)
        self.assertEqual(contacts.ordered(data, "IV", "S"), "octahedra, icosahedra")
        self.assertEqual(contacts.ordered(data, "IV", "S", "paper"), "icosahedra, octahedra")
        self.assertEqual(contacts.lies(data, "IV", "above"), "1 of 2")


class Tests(unittest.TestCase):
    def test_least_seen(self):
        def beyond(k, n, p):
            return sum(math.comb(n, j) * p ** j * (1 - p) ** (n - j) for j in range(k, n + 1))

        for n, p in ((40, 0.1), (200, 0.05)):
            least = round(alignment.least_seen(n, p) * n * p)
            self.assertLess(beyond(least, n, p), network.LEVEL)
            self.assertGreaterEqual(beyond(least - 1, n, p), network.LEVEL)

    def test_random_contacts(self):
        stream = random.Random(2)
        critical = {"ef_one": 40.0, "ef_two": 30.0, "ff_one": 50.0, "ff_edge_face": 20.0}

        def direction():
            v = [stream.gauss(0, 1) for _ in range(3)]
            return [c / math.hypot(*v) for c in v]

        # The angle of a line with a plane, and of two normals, of directions at random.
        cosines = [sum(a * b for a, b in zip(direction(), direction())) for _ in range(40000)]
        for kind, greatest, some in (("ef", 40.0, [math.degrees(math.asin(abs(c))) for c in cosines]),
                                     ("ff", 50.0, [math.degrees(math.acos(c)) for c in cosines])):
            some = [x for x in some if x < greatest]
            angles, free, constrained = network.random_curves(kind, critical)
            self.assertEqual((angles[0], angles[-1], free[-1], constrained[-1]), (0, greatest, 1, 1))
            for angle, share in zip(angles[1:-1:12], free[1:-1:12]):
                error = (share * (1 - share) / len(some)) ** 0.5
                self.assertAlmostEqual(sum(x < angle for x in some) / len(some), share, delta=4 * error)
        self.assertAlmostEqual(constrained[angles.index(10.0)], 0.5)

    def test_order_of_emergence(self):
        x = [0.1, 0.05, 0.02, 0.01]
        self.assertEqual(alignment.order_of(x, [0, 0, 1, 1], [0, 1, 1, 1]), "after")
        self.assertEqual(alignment.order_of(x, [1, 0, 1, 1], [0, 0, 1, 1]), "together")
        self.assertEqual(alignment.order_of(x, [0, 1, 1, 1], [1, 1, 0, 1]), "before")

    def test_offsets_know_both_intervals(self):
        # For 16 replicates with a spread of 1: t = 2.1314 with 15 degrees of freedom corresponds to 1.96 of a normal
        # distribution.
        ours = of(0.0, 2.13145 / 4)
        deviation = (1 + 1 / 16) ** 0.5
        self.assertAlmostEqual(densities.deviation_of(ours), deviation, places=5)
        self.assertAlmostEqual(densities.deviate_of(2.13145 * deviation, densities.parts_of(ours, {"error": 0.0})),
                               1.95996, places=4)
        # A paper's interval as wide as one packing's spread: variances add, and 15 degrees of freedom become 2² · 15.
        both = densities.parts_of(ours, {"error": 1.959964 * deviation})
        self.assertAlmostEqual(densities.deviate_of(2.13145 * deviation, both),
                               normal_deviate(2.13145 / 2 ** 0.5, 60), places=4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
