"""Tests the shared modules of the pages. usage: page_test.py examples/page"""

import json
import math
import pathlib
import random
import sys
import tempfile
import unittest

sys.path.insert(0, sys.argv[1])

import data  # noqa: E402
import estimates  # noqa: E402
import limits  # noqa: E402
import marks  # noqa: E402
import pages  # noqa: E402
import scaling  # noqa: E402
import text  # noqa: E402
import troughs  # noqa: E402


class Estimates(unittest.TestCase):
    def test_student(self):
        for freedom, t in ((1, 12.7062), (2, 4.3027), (7, 2.3646), (15, 2.1314), (30, 2.0423), (1000, 1.9623)):
            self.assertAlmostEqual(estimates.student(freedom), t, places=4)
        self.assertAlmostEqual(estimates.student(5, 0.95), 2.0150, places=4)

    def test_estimates(self):
        ours = estimates.estimate_of([0.71, None, 0.69, 0.70])
        self.assertAlmostEqual(ours["mean"], 0.7)
        self.assertAlmostEqual(ours["half_width"], 4.302653 * 0.01 / 3 ** 0.5, places=7)
        self.assertEqual(ours["n"], 3)
        self.assertIsNone(estimates.estimate_of([0.7])["half_width"])
        self.assertIsNone(estimates.estimate_of([None]))
        chosen = estimates.of_choices(ours, [{"mean": 0.72}, None, {"mean": 0.66}])
        self.assertAlmostEqual(chosen["systematic"], 0.03)
        self.assertEqual(chosen["mean"], ours["mean"])

    def test_coverage(self):
        stream = random.Random(3)
        for n in (3, 8, 40):
            hits, trials = 0, 3000
            for _ in range(trials):
                ours = estimates.estimate_of([stream.gauss(2, 1) for _ in range(n)])
                hits += abs(ours["mean"] - 2) <= ours["half_width"]
            self.assertAlmostEqual(hits / trials, 0.95, delta=4 * (0.95 * 0.05 / trials) ** 0.5)

    def test_resamples(self):
        self.assertEqual(estimates.resamples(5, 4, 9), estimates.resamples(5, 4, 9))

    def test_normal_deviate(self):
        # Quantiles of tables: t of 97.5 % and of 99.5 %.
        for freedom, t, z in ((1, 12.7062, 1.95996), (3, 3.18245, 1.95996), (15, 2.13145, 1.95996),
                              (9, 3.24984, 2.57583)):
            self.assertAlmostEqual(estimates.normal_deviate(t, freedom), z, places=4)
            self.assertAlmostEqual(estimates.normal_deviate(-t, freedom), -z, places=4)
        self.assertAlmostEqual(estimates.normal_deviate(1.3, 1e6), 1.3, places=4)
        self.assertAlmostEqual(estimates.normal_deviate(0.0, 5), 0.0)

    def test_deviates_of_few_values_make_chi_square(self):
        stream, over, trials = random.Random(11), 0, 2000
        for _ in range(trials):
            total = 0.0
            for _ in range(4):
                values = [stream.gauss(0, 1) for _ in range(4)]
                deviation = estimates.single_half_width(estimates.estimate_of(values)) / estimates.student(3)
                off = stream.gauss(0, 1) - sum(values) / 4
                total += estimates.normal_deviate(off / deviation, 3) ** 2
            over += total > 9.4877
        self.assertAlmostEqual(over / trials, 0.05, delta=4 * (0.05 * 0.95 / trials) ** 0.5)

    def test_added(self):
        self.assertEqual(estimates.added([(3.0, 7), (1.0, None)])[0], 2.0)
        self.assertAlmostEqual(estimates.added([(3.0, 7)])[1], 7)
        self.assertAlmostEqual(estimates.added([(3.0, 7), (3.0, 7)])[1], 14)  # equal parts: twice as many
        self.assertAlmostEqual(estimates.added([(3.0, 7), (1.0, None)])[1], 16 / (9 / 7))
        self.assertGreater(estimates.added([(1.0, None)])[1], 1e5)

    def test_difference(self):
        stream, hits, trials = random.Random(8), 0, 1000
        for _ in range(trials):
            found = estimates.difference_of([stream.gauss(1, 1) for _ in range(5)],
                                            [stream.gauss(3, 3) for _ in range(9)])
            hits += abs(found["mean"] - 2) <= found["half_width"]
        self.assertAlmostEqual(hits / trials, 0.95, delta=4 * (0.95 * 0.05 / trials) ** 0.5)


class Text(unittest.TestCase):
    def test_numbers(self):
        def of(mean, half_width, **more):
            return {"mean": mean, "half_width": half_width, "n": 16, **more}

        for estimate, said in ((of(0.68354, 0.00271), "0.6835 ± 0.0027"), (of(-0.05, 0.031), "−0.050 ± 0.031"),
                               (of(12.13, 0.0), "12.13 ± 0"), (of(2.434, None), "2.434"),
                               (of(39.4, 11.2), "39 ± 11"), (of(11.62, 0.091, systematic=0.24), "11.62 ± 0.09 ± 0.24"),
                               (of(0.9996, 0.012), "1.000 ± 0.012"), (None, "–")):
            self.assertEqual(text.interval(estimate), said)
        self.assertEqual(text.number(-0.0001, 2), "0.00")
        self.assertEqual(text.number(-12.345, 1), "−12.3")
        self.assertEqual(text.number(0.5, 0), "0")
        self.assertEqual(text.significant(0.012345, 3), "0.0123")
        self.assertEqual(text.significant(1234.5, 2), "1200")
        self.assertEqual([text.signed(x, 3) for x in (0.0204, -0.02, 0.0001)], ["+0.020", "−0.020", "0.000"])


class Scaling(unittest.TestCase):
    PHI = [0.7 + 0.16 * 0.7 ** i for i in range(14)]

    def law(self, exponent, jammed=0.7):
        return [3e-2 * (x - jammed) ** exponent for x in self.PHI]

    def test_jamming_density(self):
        for window in ((0, 0.02), (0.02, 0.12), (0.01, 0.04)):
            found = scaling.jamming_density(self.PHI, self.law(6), 0.703, window)
            self.assertAlmostEqual(found, 0.7, places=10)
        bent = [e * (1.5 if x > 0.72 else 1) for x, e in zip(self.PHI, self.law(6))]
        self.assertAlmostEqual(scaling.jamming_density(self.PHI, bent, 0.7, (0, 0.02)), 0.7, places=10)
        self.assertGreater(abs(scaling.jamming_density(self.PHI, bent, 0.7, (0.01, 0.06)) - 0.7), 1e-4)
        self.assertIsNone(scaling.jamming_density(self.PHI, self.law(6), 0.7, (0.0, 0.001)))

    def test_slopes(self):
        x = [p - 0.7 for p in self.PHI]
        edges = [0.001 * 2 ** i for i in range(9)]
        for found in scaling.binned([scaling.slopes(x, self.law(6))] * 2, edges):
            if found:
                self.assertAlmostEqual(found["mean"], 6, places=9)
                self.assertEqual(found["n"], 2)
        self.assertEqual(len(scaling.slopes([4, 2, 1], [16, None, 1])), 0)
        self.assertEqual(scaling.slopes([4, 1], [16, 1]), [(2.0, 2.0)])
        # One replicate with three values in the bin weighs as much as one with one.
        self.assertAlmostEqual(scaling.binned([[(1, 1), (1, 2), (1, 3)], [(1, 4)]], [0.5, 2])[0]["mean"], 3)

    def test_at(self):
        self.assertAlmostEqual(scaling.at([4, 2, 1], [16, None, 12], 2), 14)
        self.assertIsNone(scaling.at([4, 2, 1], [16, 3, 12], 0.5))
        self.assertEqual(scaling.at([4, 2, 1], [16, 3, 12], 2), 3)

    def test_jamming_density_goes_round(self):
        # States that enter and leave the window as φ_J moves: the mean of the round, whatever it began with.
        bent = [e * (1 + 30 * (x - 0.7)) for x, e in zip(self.PHI, self.law(5))]
        found = {round(scaling.jamming_density(self.PHI, bent, 0.7 - start, (0.03, 0.06)), 9) for start in (0, 0.001)}
        self.assertEqual(len(found), 1)


class Limits(unittest.TestCase):
    X = [0.02 * 0.7 ** i for i in range(10)]

    def paths(self, exponent, noise, stream, n=8):
        return [[(x, 12 - 8 * x ** exponent + own + stream.gauss(0, 0.1 * noise)) for x in self.X]
                for own in (stream.gauss(0, noise) for _ in range(n))]

    def test_exact(self):
        for exponent in (0.5, 0.65, 1.0, 1.5):
            paths = self.paths(exponent, 0, random.Random(1))
            free = limits.limit(paths, (0, 0.02), None)
            self.assertAlmostEqual(free["mean"], 12, places=9)
            self.assertAlmostEqual(free["exponent"], exponent)
        self.assertIsNone(limits.limit(paths[:2], (0, 1), 1.0))
        equal = [[(x, 0.0025) for x, _ in path] for path in paths]
        self.assertIsNone(limits.limit(equal, (0, 0.02), None))
        self.assertAlmostEqual(limits.limit(equal, (0, 0.02), 1.0)["mean"], 0.0025)
        self.assertIsNone(limits.limit(paths, (0, 1e-4), 1.0))

    def test_a_free_exponent_at_the_end_of_its_grid_is_not_used(self):
        paths = self.paths(2.6, 0, random.Random(1))
        self.assertIsNone(limits.limit(paths, (0, 0.02), None))

    def test_coverage(self):
        stream, hits, trials = random.Random(5), 0, 100
        for _ in range(trials):
            found = limits.limit(self.paths(1.0, 0.1, stream), (0, 0.03), 1.0, draws=60)
            hits += abs(found["mean"] - 12) <= found["half_width"]
        self.assertGreaterEqual(hits, 90)


class Troughs(unittest.TestCase):
    def test_bins_are_joined(self):
        entry = {"particles": 10, "packings": 2, "width": 0.05, "theta_ef": [-41, [1, 2, 3, 4, 5, 6]]}
        centres, density, _ = troughs.density(entry, "theta_ef")
        self.assertEqual([round(math.log10(x), 6) for x in centres], [-2.1, -1.9, -1.7])
        self.assertEqual([round(d * 0.2 * 10, 6) for d in density], [1, 14, 6])


class Selection(unittest.TestCase):
    def data(self, exclude):
        """Three artificial replicates, one of them crystalline and one short of its goal."""
        states = {"phi": [0.71, 0.701], "E": [1e-12, 1e-18], "Z": [9.0, 8.0], "floppy": [3, 23], "self_stress": [1, 4]}
        rows = [{"solid": "octahedron", "particles": 100, "replicate": i, "status": "done", "flags": flags, "cpu": 1,
                 "stages": {}, "phi_j": 0.7 + i / 100, "states": dict(states)}
                for i, flags in enumerate(([], ["crystalline"], ["goal_not_reached"]))]
        with tempfile.TemporaryDirectory() as here:
            path = pathlib.Path(here) / "records.json"
            path.write_text(json.dumps({"made": {"exclude": exclude, "replicates": rows}}))
            return data.Data(path)

    def test_the_rule_is_the_programs(self):
        for exclude, kept in ((["crystalline"], [0, 2]), ([], [0, 1, 2]), (["goal_not_reached"], [0, 1])):
            made = self.data(exclude)
            self.assertEqual([r["replicate"] for r in made.kept("octahedron", 100)], kept)
            self.assertEqual(made.phi_j("octahedron", 100)["n"], len(kept))

    def test_per_particle(self):
        made = self.data([])
        self.assertAlmostEqual(made.nearest("octahedron", 100, "missing")["mean"], 0.2)
        self.assertAlmostEqual(made.nearest("octahedron", 100, "redundant")["mean"], 0.04)

    def test_waves(self):
        # A cell with 64 particles at φ = 0.64 has side 100^(1/3); a transverse wave has ω² = (2π/L)² G/ρ, ρ = φ.
        self.assertAlmostEqual(data.longest_wave(0.04, 0.64, 64), 2 * math.pi / 100 ** (1 / 3) * math.sqrt(0.04 / 0.64))


class Claims(unittest.TestCase):
    PAGE = "C lies\n<!-- = x -->near<!-- / --> 12.\n"

    def test_supported(self):
        self.assertEqual(pages.claim_errors(self.PAGE, {"C lies near 12.": lambda d: d == 5}, 5), [])

    def test_refused(self):
        for claims in ({"C lies near 12.": lambda d: False}, {"C lies near 12.": lambda d: d["C"] > 1},
                       {"C is far from 12.": lambda d: True}):
            self.assertIn("rewrite it and its claim together", pages.claim_errors(self.PAGE, claims, None)[0])


class Marks(unittest.TestCase):
    PAGE = "before\n<!-- block one -->\nold\n<!-- end -->\nZ is <!-- = Z 100 -->9<!-- / -->, so.\n"

    def test_renewed(self):
        made = marks.renewed(self.PAGE, {"one": lambda data: f"{data}\n"}, 5, lambda data, name: f"{name}: {data}")
        self.assertEqual(made, self.PAGE.replace("old", "5").replace("-->9<", "-->Z 100: 5<"))
        self.assertEqual(marks.without_marks(made.splitlines()[-1]), "Z is Z 100: 5, so.")

    def test_refused(self):
        two = {"one": str, "two": str}
        for page, blocks in ((self.PAGE + self.PAGE, {"one": str}), ("", {"one": str}), (self.PAGE, two)):
            with self.assertRaises(marks.PageError):
                marks.renewed(page, blocks, 5, lambda data, name: name)
        with self.assertRaises(marks.PageError):
            marks.renewed(self.PAGE, {"two": str}, 5, lambda data, name: name, every=False)
        with self.assertRaises(marks.PageError):
            marks.renewed(self.PAGE, {"one": str}, 5)
        marks.renewed(self.PAGE, two, 5, lambda data, name: name, every=False)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
