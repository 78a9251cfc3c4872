"""Updates README.md, or makes it and tables.md in OUT: python3 page.py [--data FILE...] [-o OUT] [--check]"""

import math
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

import pages  # noqa: E402
import preparations  # noqa: E402
import values  # noqa: E402
import verdict  # noqa: E402
from data import SOLIDS, SOLIDS_64  # noqa: E402
from tables import DISTANCES, EDGES, FAR, TABLES, TILTS_AT, drawn_size, main_table, other_solids, tilts_table  # noqa: E402, F401
from text import interval, number, significant  # noqa: E402

TITLE = "What makes a packing rigid"
FILES = (HERE.parent / "paper/data/records.json", HERE / "data/records.json", HERE / "data/constraints.json")
ENTRIES = """An entry a ± b (n) is the mean a over n packings and half the width b of its 95 % confidence interval
(Student t). A third number ± c is a systematic error, which the text defines. *Nearest* is the state nearest jamming of
each packing. A dash means that the value is unknown."""
BLOCKS = {"verdict": verdict.verdict_table, "main": main_table, "tilts": tilts_table}
WITHOUT_TETRAHEDRA = SOLIDS[1:]


def far_exponents(data, column):
    """Local exponents with N = 400 in the ranges of Δφ in FAR, with errors below 1."""
    return [e for solid in SOLIDS for a, e in zip(EDGES, data.exponents(solid, 400, column, EDGES))
            if FAR[0] <= a < FAR[1] and e and e["n"] > 2 and e["half_width"] < 1]


def exponent_end(data, column, end):
    means = [e["mean"] for e in far_exponents(data, column)]
    return number(min(means) if end == "least" else max(means), 2) if means else "–"


def end_of(values_of, places):
    """A function of data and "least" or "greatest" that writes this end of some values."""
    return lambda data, end: number({"least": min, "greatest": max}[end](values_of(data)), places)


def unsupported_modes(data):
    """Modes per particle with less than half from normals and stiff tilts, or that are not resolved."""
    return [data.at(s, 100, "prestress_10_each", TILTS_AT)["mean"] + data.at(s, 100, "unresolved_each", TILTS_AT)["mean"]
            for s in SOLIDS]


def single_by_trough(data, which):
    """Number of packings nearest jamming with one state of self-stress by trough, or of all packings: octahedra, icosahedra
    and dodecahedra."""
    found = [r["states"]["self_stress_trough"][-1] for s in WITHOUT_TETRAHEDRA for n in data.sizes(s)
             for r in data.kept(s, n) if r["states"].get("self_stress_trough", [None])[-1] is not None]
    return str(found.count(1) if which == "one" else len(found))


def wave_ratios(data):
    """⟨ω_l⟩ divided by the frequency of the longest transverse wave, at the Δφ of the tables, of at least three packings."""
    return [e["mean"] for s in SOLIDS for n in data.sizes(s) for d in DISTANCES
            if (e := data.at(s, n, "wave", d)) and e["n"] > 2]


def decreasing(data, solid, column):
    """True if the local exponent with N = 400 at the largest Δφ is smaller than another one by more than the errors."""
    found = [e for e in data.exponents(solid, 400, column, EDGES) if e and e["n"] > 2 and e["half_width"] < 1]
    return any(one["mean"] - found[-1]["mean"] > sum(e["half_width"] + e["systematic"] for e in (one, found[-1]))
               for one in found[:-1])


def of_solids(data, column):
    """Means of a column over the packings of each solid with at least three packings, in the study of many solids."""
    return [e["mean"] for solid in other_solids(data) if (e := data.nearest_of(SOLIDS_64, solid, column)) and e["n"] > 2]


def solids_end(data, column, end):
    means = of_solids(data, column)
    return number(min(means) if end == "least" else max(means), 1) if means else "–"


def stresses(data):
    """Mean S of tetrahedra by each preparation, in the order of φ_J."""
    groups = [[preparations.values(data, SOLIDS[0], p, column) for column in ("phi_j", "self_stress_x")]
              for p in (preparations.OURS, *preparations.PREPARATIONS)]
    return [mean for _, mean in sorted([statistics.fmean(values) for values in pair] for pair in groups if all(pair))]


def single(data):
    """Numbers of octahedra, icosahedra and dodecahedra of all preparations with S = 1, and of all."""
    found = [x for s in WITHOUT_TETRAHEDRA for p in (preparations.OURS, *preparations.PREPARATIONS)
             for x in preparations.values(data, s, p, "self_stress_x")]
    return found.count(1), len(found)


value_of = values.value_of({
    **values.VALUES, "exponent": exponent_end, "solids": solids_end,
    "supported": lambda data: str(math.floor(100 * (1 - max(unsupported_modes(data)) / 6))),
    "waves": end_of(wave_ratios, 1), "single_by_trough": single_by_trough,
    "C_s": lambda data, solid: interval(data.nearest(solid, 100, "C_s")),
    "reach": lambda data, solid: number(preparations.reach(data, solid) if solid in SOLIDS else min(
        preparations.reach(data, s) for s in SOLIDS), 2),
    "alike": lambda data, column, *solids: significant(min(preparations.probability(data, s, column) for s in solids or SOLIDS), 1),
    "stress": end_of(stresses, 0), "single": lambda data, which: str(single(data)[which == "all"]),
    "fall": end_of(lambda data: [preparations.fall(data, s) for s in SOLIDS], 2),
    "slope_by_chance": lambda data: significant(preparations.slope_by_chance(data), 1),
    "size": lambda data: str(drawn_size(data)), "isostatic": lambda data: values.against_isostatic(
        data, "trough", drawn_size(data))})


def identity_holds(data):
    """True if C = 12 − 6/N − 2m + 2S/N in all states that have these values, within their rounding."""
    checked = 0
    for study in data.main():
        for r in study["replicates"]:
            states, n = r.get("states", {}), r["particles"]
            for c, m, s in zip(states.get("C", ()), states.get("missing", ()), states.get("redundant", ())):
                if None not in (c, m, s):
                    checked += 1
                    if abs(c - (12 - 6 / n - 2 * m + 2 * s)) > 0.006:
                        return False
    return checked > 100


# Sentences of README.md that follow from the data only as long as these functions are true.
CLAIMS = {
    "For any classification, C = 12 − 6/N − 2m + 2S/N": identity_holds,
    "At this Δφ, C_s of icosahedra and dodecahedra agrees with 12 − 4/N, and C_s of octahedra and tetrahedra exceeds it.":
        lambda data: [
        abs((c := data.nearest_of(SOLIDS_64, s, "C_s"))["mean"] - (12 - 4 / 64)) < c["half_width"] for s in SOLIDS] == [
            False, False, True, True] and min(data.nearest_of(SOLIDS_64, s, "C_s")["mean"] for s in SOLIDS[:2]) > 12,
    "Nearer to jamming, C_s of icosahedra and dodecahedra is below 12 − 4/N": lambda data: all(
        (c := data.nearest(s, 100, "C_s"))["mean"] + c["half_width"] < 12 - 4 / 100 for s in SOLIDS[2:]),
    "packings of octahedra, icosahedra and dodecahedra, so that only m changes C.": lambda data: (
        one := verdict.single_stress(data))[0] > 0.95 * one[1],
    "Denser packings lack slightly fewer constraints: m decreases with φ_J in every solid,": lambda data: all(
        preparations.slope(data, s)["mean"] < 0 for s in SOLIDS) and preparations.slope_by_chance(data) < 0.01,
    "So the preparation decides where a packing jams, but hardly how many constraints it lacks": lambda data: all(
        preparations.probability(data, s, "m_x") > 0.05 for s in SOLIDS),
    "packings of octahedra, icosahedra and dodecahedra, while in tetrahedra it increases with φ_J from": lambda data:
        single(data)[0] > 0.95 * single(data)[1] and stresses(data)[0] < 0.7 * stresses(data)[-1]
        and preparations.probability(data, SOLIDS[0], "self_stress_x") < 0.05,
    "In octahedra, m exceeds 0 for all boundaries at every N, but the limit would be uncertain without N = 64.": lambda data: all(
        verdict.mean(data, SOLIDS[1], n, "m_x")["least"] > 0 for n in verdict.sizes(data, SOLIDS[1])) and verdict.call(
        data, SOLIDS[1], without=64) == "uncertain",
    "Tetrahedra would be uncertain without N = 400, and with N = 400 alone.": lambda data: verdict.call(
        data, SOLIDS[0], without=400) == "uncertain" and verdict.mean(data, SOLIDS[0], 400, "m_x")["greatest"] > verdict.FEW,
    "few missing constraints belong to underconstrained particles": lambda data: all(
        sum(p["m_supported"] for p in verdict.every(data, s)) > 0.7 * sum(p["m_x"] for p in verdict.every(data, s))
        for s in WITHOUT_TETRAHEDRA),
    "packings of these three solids.": lambda data: int(single_by_trough(data, "one")) > 0.9 * int(single_by_trough(data, "all")),
    "The exponents of E and K of octahedra, icosahedra and dodecahedra are not constant: at the largest Δφ, they are smaller "
    "than nearer to jamming.": lambda data: all(decreasing(data, s, column) for s in WITHOUT_TETRAHEDRA for column in ("E", "K")),
    "⟨ω_l⟩ follows √G more closely than √K": lambda data: 3 * statistics.fmean(
        abs(e["mean"]) for e in far_exponents(data, "omega_over_root_G")) < statistics.fmean(
        e["mean"] for e in far_exponents(data, "omega_over_root_K")),
    "The trough has a finite density at the smallest Δφ.": lambda data: all(
        data.trough(s, drawn_size(data))["edge_face"]["density"] > 0.02 for s in SOLIDS),
    "The count of 3, 2 and 1 constraints holds for all these solids, also for those that are not Platonic.": lambda data:
        len(of_solids(data, "C_s")) > 10 and all(
            abs(x - expected) < 0.2 for name, expected in (("ff", 2), ("ef", 1), ("l", 0))
            for x in of_solids(data, f"stiff_tilts_{name}")),
}

if __name__ == "__main__":
    pages.main(sys.modules[__name__], HERE)
