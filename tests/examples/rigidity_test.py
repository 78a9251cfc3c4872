"""Tests the page examples/rigidity. usage: rigidity_test.py examples/rigidity ISOJAM

- The committed page agrees with the committed data in every block and every number in a sentence. A page with a changed
  number is rejected. The figures are small files, and all of them are on the page.
- Derived columns are quotients of columns of the records, and None if one of these is None. Exponents of quotients are
  differences of exponents, even if some states have no value. Waves are those of an elastic medium.
- Artificial contacts and tilts in a band are counted in this band. A boundary that crosses a band increases the
  systematic error.
- Forces that are drawn from a power law give its exponent in every step, and one exponent fits all of them. For a
  curved distribution, one exponent does not fit.
- Additional missing constraints of small packings are found. Limits that decrease as 1/N are extrapolated. A form with
  a negative limit does not contribute to the error.
- Exponents and values are dashes if there are too few replicates or if the error is large.
- Gathering a small run gives the values of the records. Replicates that were gathered before are kept.
- Two replicates of the studies, run again, have the values of the committed data.
"""

import json
import math
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RIGIDITY, ISOJAM = Path(sys.argv[1]).resolve(), sys.argv[2]
sys.path.insert(0, str(RIGIDITY))

import anew  # noqa: E402
import counting  # noqa: E402
import data  # noqa: E402
import forces  # noqa: E402
import gather  # noqa: E402
import held  # noqa: E402
import rank  # noqa: E402


def replicate(number, states, solid="octahedron", particles=100, **more):
    return {"solid": solid, "particles": particles, "replicate": number, "status": "done", "flags": [], "cpu": 1,
            "stages": {}, "phi_j": {"phi_j": 0.7}, "states": states, **more}


class Made(data.Data):
    """Artificial data of replicates."""

    def __init__(self, replicates):
        super(data.Data, self).__init__({"made": {"replicates": replicates}}, ("made",))
        for r in replicates:
            r["states"] |= data.derived(r["states"], r["particles"])


def expansion(**columns):
    """Twelve artificial states with E ∝ Δφ⁶, and columns that are functions of Δφ."""
    distances = [0.16 * 0.6 ** i for i in range(13)]
    return {"phi": [0.7 + x for x in distances], "E": [x ** 6 for x in distances],
            **{name: [function(x) for x in distances] for name, function in columns.items()}}


class Page(unittest.TestCase):
    def check(self, page):
        return subprocess.run([sys.executable, "-B", RIGIDITY / "page.py", page, "--check"],
                              capture_output=True, text=True, check=False)

    def test_is_what_the_data_say(self):
        result = self.check(RIGIDITY / "README.md")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_is_refused_if_a_figure_was_changed(self):
        text = (RIGIDITY / "README.md").read_text(encoding="utf-8")
        for mark in ("| octahedron 100 | 0.", "<!-- = infinite icosahedron -->0."):
            at = text.index(mark) + len(mark)
            with tempfile.TemporaryDirectory() as here:
                changed = Path(here) / "README.md"
                changed.write_text(text[:at] + str((int(text[at]) + 1) % 10) + text[at + 1:], encoding="utf-8")
                result = self.check(changed)
            self.assertEqual(result.returncode, 1)
            self.assertIn("differs from", result.stderr)

    def test_figures_are_small_and_there(self):
        text = (RIGIDITY / "README.md").read_text(encoding="utf-8")
        for image in RIGIDITY.glob("*.png"):
            self.assertLess(image.stat().st_size, 60_000)
            self.assertIn(f"]({image.name})", text)


class Derived(unittest.TestCase):
    def test_quotients(self):
        states = {"phi": [0.8, 0.75], "floppy_classes": [53, None], "G": [1e-4, 4e-6], "K": [1e-2, 1e-3],
                  "omega_l": [0.02, 0.004], "normal_share": [0.5, None], "tilt_share": [0.2, 0.1]}
        made = data.derived(states | {"normal_share": [0.5, None]}, 100)
        self.assertEqual(made["missing"], [0.5, None])
        self.assertAlmostEqual(made["G_over_K"][0], 1e-2)
        self.assertAlmostEqual(made["omega_over_root_G"][1], 2)
        self.assertAlmostEqual(made["prestress_share"][0], 0.3)
        self.assertNotIn("second_each", made)
        self.assertEqual(data.derived({"G": [-1.0], "K": [0.0], "omega_l": [1.0]}, 1)["root_G"], [None])

    def test_exponents(self):
        made = Made([replicate(i, expansion(omega_l=lambda x: (1 + i) * x ** 2.2, G=lambda x: x ** 4.4,
                                            K=lambda x: x ** 4)) for i in range(5)])
        for column, exponent in (("omega_over_root_G", 0), ("omega_over_root_K", 0.2), ("G_over_K", 0.4)):
            for estimate in made.slopes("octahedron", 100, column, held.BINS):
                self.assertAlmostEqual(estimate["mean"], exponent, places=6)

    def test_the_same_states_in_every_column(self):
        made = Made([replicate(i, expansion(omega_l=lambda x: x ** 2.2 * (1 + x), G=lambda x: x ** 4.4 * (1 - x),
                                            K=lambda x: x ** 4), particles=400) for i in range(5)])
        for i, r in enumerate(made.counted("octahedron", 400)):
            r["states"]["G"][3 + i % 3] = None
            r["states"] |= data.derived(r["states"], 400)
        soft, shear, over = (made.slopes("octahedron", 400, column, held.BINS) for column in (
            "soft", "root_G", "omega_over_root_G"))
        for a, b, c in zip(soft, shear, over):
            self.assertAlmostEqual(a["mean"] - b["mean"], c["mean"], places=9)
        number, above, least, greatest = held.about_sure(made, "omega_over_root_G")
        self.assertEqual((number, above), (2, 2))
        self.assertLess(0, least)
        self.assertLess(greatest, 0.3)

    def test_waves(self):
        # A cell with 64 particles at φ = 0.64 has side (100)^(1/3); a transverse wave has ω² = (2π/L)² G/ρ, ρ = φ.
        side = 100 ** (1 / 3)
        self.assertAlmostEqual(data.longest_wave(0.04, 0.64, 64), 2 * math.pi / side * math.sqrt(0.04 / 0.64))

    def test_dashes(self):
        few = Made([replicate(i, expansion(omega_l=lambda x: (1 + i) * x ** 2.2)) for i in range(2)])
        self.assertEqual(set(held.over_grid(few, "octahedron", 100, "omega_l")), {"–"})
        found = [{"mean": 1, "half_width": 1.01, "n": 9}, {"mean": 1, "half_width": 0.9, "n": 2}, None,
                 {"mean": 1, "half_width": 0.5, "n": 3}]
        self.assertEqual(held.exponents(found), ["1.00 ± 0.50 (3)", "–", "–", "–"])


class Bands(unittest.TestCase):
    def test_are_counted(self):
        distance, particles = 0.001, 100
        s = [distance ** -1] * 300 + [distance ** (-5 / 3)] * 120 + [distance ** -5.0] * 30
        state = {"delta_phi": distance, "contacts": {"Z": 9.0, "Z_ef": 2.4, "Z_ff": 0.6, "C": 12.6},
                 "prestress": {"s_normal": sorted(s), "s_tilt": [1.0] * 500 + [distance ** (-5 / 3)] * 180}}
        bands = gather.bands_of({"states": [state]})
        made = Made([replicate(i, expansion(), bands=bands) for i in range(3)])
        by_factor, fits = counting.banded(made, "octahedron", particles, None)[0]
        for factor in by_factor:
            self.assertEqual([round(z, 9) for z in factor], [6.0, 2.4, 0.6, 12.6])
        self.assertEqual([round(z, 9) for z in fits], [6.0, 2.4, 0.6, 12.6])
        self.assertEqual(counting.banded(made, "octahedron", particles, 0.02), [])
        state["prestress"]["s_normal"] = sorted(s[:300] + [1.5 * distance ** (-4 / 3)] * 120 + s[420:])
        by_factor = gather.bands_of({"states": [state]})[0][5]
        self.assertEqual(by_factor, [150, 150, 30])

    def test_powers(self):
        counts = gather.powers_of([0.01 ** -1.0] * 3 + [0.01 ** (-5 / 3)] * 2 + [0.0, 0.01 ** 2], 0.01)
        found = [(round((a + b) / 2, 3), n) for a, b, n in zip(gather.POWERS, gather.POWERS[1:], counts) if n]
        self.assertEqual([n for _, n in found], [3, 2])
        for (centre, _), power in zip(found, (1, 5 / 3)):
            self.assertAlmostEqual(centre, power, delta=0.07)


class Distributions(unittest.TestCase):
    STEPS = tuple(round(-2.4 + 0.4 * i, 1) for i in range(7))

    def bins(self, values):
        edges = [round(-4 + 0.2 * i, 1) for i in range(26)]
        counts = [0] * (len(edges) - 1)
        for value in values:
            i = math.floor((math.log10(value) - edges[0]) / 0.2)
            if 0 <= i < len(counts):
                counts[i] += 1
        return {name: [edges[0], counts if name == "lower_order" else []] for name in gather.FORCES}

    def rows(self, draw, seed):
        stream = random.Random(seed)
        return [forces.cumulative(self.bins([draw(stream) for _ in range(1500)]), gather.FORCES, self.STEPS)
                for _ in range(8)]

    def test_power_law(self):
        hits = of = 0
        for seed in range(12):
            for estimate in forces.exponents_of(self.rows(lambda s: s.random() ** (1 / 0.8), seed), self.STEPS):
                if estimate:
                    of += 1
                    hits += abs(estimate["mean"] - 0.8) <= estimate["half_width"]
        self.assertGreater(hits / of, 0.88, (hits, of))

    def test_bend(self):
        found = [e for e in forces.exponents_of(self.rows(lambda s: -math.log(1 - s.random()), 1), self.STEPS) if e]
        self.assertAlmostEqual(found[0]["mean"], 1, delta=2 * found[0]["half_width"])
        self.assertLess(found[-1]["mean"] + found[-1]["half_width"], 0.9)

    def test_one_exponent_for_all(self):
        for draw, one in ((lambda s: s.random() ** (1 / 0.8), True), (lambda s: -math.log(1 - s.random()), False)):
            stream = random.Random(5)
            made = Made([replicate(i, expansion(), "octahedron", 400, bins=self.bins(
                [draw(stream) for _ in range(1500)])) for i in range(8)])
            found = forces.common(made, "octahedron", gather.FORCES, self.STEPS)
            self.assertEqual(found["one"], one, found)
            self.assertEqual(forces.straight(made, (gather.FORCES,), lambda _: self.STEPS), (1, int(one)))
            if one:
                self.assertAlmostEqual(found["mean"], 0.8, delta=2 * found["half_width"])

    def test_cumulative_counts_what_is_below(self):
        bins = {"faces": [-2.0, [1, 2, 4]], "edges": [None, []]}
        self.assertEqual(forces.cumulative(bins, gather.GAPS, (-2.0, -1.8, -1.6, -1.4)), [0, 1, 3, 7])


class Sizes(unittest.TestCase):
    def data(self):
        stream, made = random.Random(3), []
        for particles in (50, 100, 200, 400):
            for i in range(8):
                off = stream.gauss(0, 0.01)
                made.append(replicate(i, expansion(floppy_classes=lambda x: 3 + particles * (
                    0.1 + 20 * x + off) + 4), "icosahedron", particles))
        return Made(made)

    def test_what_does_not_scale(self):
        found = rank.excess(self.data(), "icosahedron", 50, 400, 0.01)
        self.assertAlmostEqual(found["mean"], 4 * (1 - 50 / 400), delta=2 * found["half_width"])
        self.assertLess(found["half_width"], 1.5)

    def test_infinite(self):
        found = rank.infinite(self.data(), "icosahedron")
        self.assertAlmostEqual(found["mean"], 0.1, delta=found["half_width"])
        self.assertAlmostEqual(found["slope"], 4, delta=found["slope_half_width"])

    def test_no_rank_is_short_by_less_than_nothing(self):
        # m ∝ Δφ: its limit by the root of Δφ is below 0, beyond what replicates leave open.
        stream = random.Random(8)
        states = [expansion(floppy_classes=lambda x, off=stream.gauss(0, 0.005): 3 + 400 * (20 * x + off))
                  for _ in range(8)]
        made = Made([replicate(i, s, "icosahedron", 400) for i, s in enumerate(states)])
        forms, found = rank.missing_limit(made, "icosahedron", 400)
        self.assertLess(forms[0.5]["mean"] + forms[0.5]["half_width"], 0)
        self.assertLess(found["systematic"], -forms[0.5]["mean"] / 4)
        self.assertAlmostEqual(found["mean"], 0, delta=2 * found["half_width"])


class Gathered(unittest.TestCase):
    MANIFEST = {"name": "rigidity-50", "seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [24]},
                "replicates": 2, "protocol": {"initial_density": 0.2, "consolidation_step": 0.04, "step_fraction": 0.4,
                             "final_distance": 0.02, "fit_window": 0.1}, "keep_path": True,
                "measure": ["contacts", "order", "clusters", "modes", "moduli", "rigidity", "backbone", "prestress",
                            "gaps"]}

    def test_small_run(self):
        with tempfile.TemporaryDirectory() as here:
            results = Path(here)
            (results / "m.json").write_text(json.dumps(self.MANIFEST))
            subprocess.run([ISOJAM, "run", results / "m.json", "-o", results / "rigidity-50", "--quiet"], check=True,
                           capture_output=True)
            subprocess.run([sys.executable, "-B", RIGIDITY / "gather.py", ISOJAM, results, results / "out"],
                           check=True, capture_output=True)
            records = [json.loads(path.read_text()) for path in sorted((results / "rigidity-50/records").iterdir())]
            made = data.Data(results / "out")
        self.assertEqual(len(records), 2)
        every = made.all_of("dodecahedron", 24)
        for record, r in zip(records, every):
            for i, state in enumerate(record["states"]):
                second = state["prestress"]["modes"]["held_by_second"]
                self.assertAlmostEqual(r["states"]["second_each"][i], second / 24, places=9)
                self.assertAlmostEqual(r["states"]["C_s_10"][i], state["prestress"]["C_s"], delta=1e-2)
                rank_here = state["rigidity"]["classes"]["rank"]
                missing = r["states"]["missing"][i]
                if rank_here is None:
                    self.assertIsNone(missing)
                else:
                    self.assertAlmostEqual(missing, (6 * 24 - 3 - rank_here) / 24, places=9)
            last = record["states"][-1]["gaps"]
            if "faces" in (r["bins"] or {}):
                self.assertEqual(sum(sum(r["bins"][name][1]) for name in gather.FORCES),
                                 sum(sum(last[name]["counts"]) for name in gather.FORCES))

    def test_what_was_gathered_before_is_kept(self):
        here = {"rigidity-50": {"git": ["b"], "replicates": [replicate(1, {"phi": [1], "Z": [8]}),
                                                            replicate(3, {"phi": [3]})]}}
        before = {"rigidity-50": {"git": ["a"], "replicates": [replicate(0, {"phi": [0]}),
                                                              replicate(1, {"phi": [1], "Z": [7], "G": [5]}, bins=4),
                                                              replicate(3, {"phi": [2], "G": [6]})]},
                  "paper-400": {"git": ["a"], "replicates": [replicate(0, {"phi": [0]})]}}
        made = gather.completed(here, before)
        self.assertEqual([(r["replicate"], r["states"]) for r in made["rigidity-50"]["replicates"]],
                         [(0, {"phi": [0]}), (1, {"phi": [1], "Z": [8], "G": [5]}), (3, {"phi": [3]})])
        self.assertEqual(made["rigidity-50"]["replicates"][1]["bins"], 4)
        self.assertEqual(made["rigidity-50"]["git"], ["a", "b"])
        self.assertEqual(list(made), ["rigidity-50", "paper-400"])
        self.assertEqual(gather.completed(here, {})["rigidity-50"], here["rigidity-50"])


class Anew(unittest.TestCase):
    def test_replicates_of_the_studies(self):
        measures = "prestress,gaps"
        made = anew.gathered(ISOJAM, RIGIDITY, [("n50", "rigidity-50", "38/48", measures),
                                                ("n50-tetrahedra", "rigidity-50-tetrahedra", "2/16", measures)])
        committed = json.loads((RIGIDITY / "data" / "records.json").read_text(encoding="utf-8"))
        self.assertEqual(anew.same_packings(self, committed, made["records"]), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
