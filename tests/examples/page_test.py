"""Tests the shared modules of the pages. usage: page_test.py examples/page

- Student's t agrees with tables. The interval of normal samples contains their true mean in 95 of 100 cases. The
  binomial tail is the sum of its terms. The systematic error of choices is half their range.
- A normal deviate has the same probability as its t. Sums of squares of deviates from few values have a χ²
  distribution. Variances are added as by Welch and Satterthwaite, and the interval of a difference contains the true
  value. The common correlation of two samples agrees with Fisher's z.
- Numbers show two digits of their error, with a leading zero, and a minus sign instead of a hyphen.
- φ_J of an exact power law is found with every window, and states outside the window have no effect. With a free
  exponent, φ_J and the exponent are found. Too few states give no result.
- The local exponent of a power law is its exponent in every bin. No slope is computed across a missing value. A
  replicate counts once in a bin.
- A limit is found with the form of the data. Its interval contains the true value in at least 90 of 100 noisy cases.
  Other forms increase the systematic error.
- A page in which a block is missing or occurs twice is rejected. Values in sentences are updated, and nothing else
  changes.
"""

import math
import random
import sys
import unittest

sys.path.insert(0, sys.argv[1])

import estimates  # noqa: E402
import limits  # noqa: E402
import marks  # noqa: E402
import scaling  # noqa: E402
import text  # noqa: E402


class Estimates(unittest.TestCase):
    def test_student(self):
        for freedom, t in ((1, 12.7062), (2, 4.3027), (7, 2.3646), (15, 2.1314), (30, 2.0423), (1000, 1.9623)):
            self.assertAlmostEqual(estimates.student(freedom), t, places=4)
        self.assertAlmostEqual(estimates.student(5, 0.95), 2.0150, places=4)

    def test_binomial(self):
        for n, p in ((12, 0.1), (40, 0.5), (7, 0.93)):
            for k in range(n + 2):
                exact = sum(math.comb(n, j) * p ** j * (1 - p) ** (n - j) for j in range(k, n + 1))
                self.assertAlmostEqual(estimates.binomial_at_least(k, n, p), exact, places=12)

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

    def test_pooled_correlation(self):
        r, within = estimates.pooled_correlation([(0.6, 16)])
        self.assertAlmostEqual(r, 0.6)
        self.assertAlmostEqual(within[0], 0.148, places=3)  # tables of Fisher's z
        self.assertAlmostEqual(within[1], 0.8445, places=3)
        r, within = estimates.pooled_correlation([(0.5, 10), (0.5, 29), (None, 8), (0.9, 3)])
        self.assertAlmostEqual(r, 0.5)
        self.assertAlmostEqual(within[0], estimates.pooled_correlation([(0.5, 7 + 26 + 3)])[1][0], places=12)
        r, _ = estimates.pooled_correlation([(0.8, 13), (-0.8, 13)])
        self.assertAlmostEqual(r, 0.0)
        r, _ = estimates.pooled_correlation([(math.tanh(1.0), 4), (math.tanh(0.4), 5)])  # weights 1 and 2
        self.assertAlmostEqual(math.atanh(r), 0.6)
        self.assertEqual(estimates.pooled_correlation([(None, 9)]), (None, None))


class Text(unittest.TestCase):
    def test_numbers(self):
        def of(mean, half_width, **more):
            return {"mean": mean, "half_width": half_width, "n": 16, **more}

        for estimate, said in ((of(0.68354, 0.00271), "0.6835 ± 0.0027"), (of(-0.05, 0.031), "−0.050 ± 0.031"),
                               (of(12.13, 0.0), "12.13 ± 0"), (of(2.434, None), "2.434"),
                               (of(39.4, 11.2), "39 ± 11"), (of(11.62, 0.091, systematic=0.24), "11.62 ± 0.09 ± 0.24"),
                               (of(0.9996, 0.012), "1.000 ± 0.012"), (None, "–")):
            self.assertEqual(text.interval(estimate), said)
        self.assertEqual(text.bounded(of(0.6895, 0.001, systematic=1e-5)), "0.6895 ± 0.0010 ± < 0.0001")
        self.assertEqual(text.bounded(of(0.6895, 0.001, systematic=6e-5)), "0.6895 ± 0.0010 ± 0.0001")
        self.assertEqual(text.bounded(of(0.874, 0.088)), "0.874 ± 0.088")
        self.assertEqual(text.number(-0.0001, 2), "0.00")
        self.assertEqual(text.number(-12.345, 1), "−12.3")
        self.assertEqual(text.number(0.5, 0), "0")
        self.assertEqual(text.significant(0.012345, 3), "0.0123")
        self.assertEqual(text.significant(1234.5, 2), "1200")
        self.assertEqual(text.power(9.3e-7), "1·10⁻⁶")
        self.assertEqual(text.power(2.1e-7), "3·10⁻⁷")


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

    def test_free_exponent(self):
        for exponent in (5.2, 6.0, 7.1):
            jammed, found = scaling.free_exponent(self.PHI, self.law(exponent), 0.699, (0, 0.05))
            self.assertAlmostEqual(found, exponent, places=4)
            self.assertAlmostEqual(jammed, 0.7, places=6)
        self.assertIsNone(scaling.free_exponent(self.PHI[:3], self.law(6)[:3], 0.7, (0, 1)))

    def test_slopes(self):
        x = [p - 0.7 for p in self.PHI]
        edges = [0.001 * 2 ** i for i in range(9)]
        for found in scaling.local_slopes([(x, self.law(6)), (x, self.law(6))], edges):
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
            _, chosen = limits.limit_of_choices(paths, [(0, 0.03), (0, 0.01)])
            self.assertGreater(chosen["systematic"], 1e-3)
        self.assertIsNone(limits.limit(paths[:2], (0, 1), 1.0))
        self.assertIsNone(limits.limit(paths, (0, 1e-4), 1.0))

    def test_coverage(self):
        stream, hits, trials = random.Random(5), 0, 100
        for _ in range(trials):
            found = limits.limit(self.paths(1.0, 0.1, stream), (0, 0.03), 1.0, draws=60)
            hits += abs(found["mean"] - 12) <= found["half_width"]
        self.assertGreaterEqual(hits, 90)


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
