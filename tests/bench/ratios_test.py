"""Tests ratios.py with made-up results of benchmarks. usage: ratios_test.py"""

import contextlib
import io
import unittest

import ratios


def run(name, time, unit="ns", **more):
    return {"run_type": "iteration", "run_name": name, "cpu_time": time, "real_time": 2 * time, "time_unit": unit} | more


class Ratios(unittest.TestCase):
    def test_medians(self):
        found, failed = ratios.medians({"benchmarks": [
            run("f/a/x/iterations:1/repeats:3", 2, "us", bytes=7), run("f/a/x/iterations:1/repeats:3", 5, "us", bytes=9),
            run("f/a/x/iterations:1/repeats:3", 3, "us", bytes=8), run("f/b/N=4/real_time", 10),
            run("f/c/x", 1, error_occurred=True, error_message="failed"), {"run_type": "aggregate"}]})
        self.assertEqual(found, {"f/a/x": 3000, "f/a/x#bytes": 8, "f/b/N=4": 20})
        self.assertEqual(failed, {"f/c/x": "failed"})

    def test_claims_hold_on_one_side_of_their_bound(self):
        found = {"f/ours/x": 200, "f/peer/x": 1000}
        for kind, peer, ratio in (("faster", "f/peer/x", 5), ("costs", "f/peer/x", 0.2), ("costs", None, 200)):
            for bound, met in ((ratio * 0.99, kind == "faster"), (ratio, True), (ratio * 1.01, kind != "faster")):
                row = ratios.judge((kind, "f/ours/x", peer, bound, 1, 1), found)
                self.assertEqual((row["ratio"], row["met"]), (ratio, met), (kind, bound))
        self.assertEqual(ratios.judge(("faster", "f/ours/x", "f/peer/x", 1, 10, 1), found)["ratio"], 50)
        self.assertIsNone(ratios.judge(("faster", "f/ours/x", "f/other/x", 1, 1, 1), found))

    def test_two_programs_run_in_turn(self):
        times = {"before": [{"a": 20, "old": 1}, {"a": 32}, {"a": 30}], "now": [{"a": 10, "new": 1}, {"a": 8}, {"a": 6}]}
        log, printed = [], io.StringIO()

        def measure(binary, _):
            log.append(binary)
            return times[binary][log.count(binary) - 1]

        with contextlib.redirect_stdout(printed):
            ratios.against(["before", "now"], ".", 3, measure)
        self.assertEqual(log, ["before", "now", "now", "before", "before", "now"])
        # Ratios 2, 4 and 5; the ratio of the medians, 30 over 8, would be 3.75.
        self.assertEqual(printed.getvalue().splitlines()[1:],
                         [f"{'a':50}{30:10} ns{8:10} ns  4.00  2.00 … 5.00"])
        with self.assertRaisesRegex(SystemExit, "no benchmark that both have matches x"):
            ratios.against(["before", "now"], "x", 1, lambda binary, _: {binary: 1})


if __name__ == "__main__":
    unittest.main()
