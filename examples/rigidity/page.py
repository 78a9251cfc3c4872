"""Makes README.md and tables.md: python3 page.py [--data FILE...] [-o OUT] [--check]"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

import pages  # noqa: E402
import values  # noqa: E402
from counting import EDGES, FAR, drawn_size, limit_at_jamming  # noqa: E402
from data import SOLIDS, SOLIDS_64  # noqa: E402
from tables import TABLES, TILTS_AT, main_table, other_solids  # noqa: E402, F401
from text import number  # noqa: E402

TITLE = "What makes a packing rigid"
FILES = (HERE.parent / "paper/data/records.json", HERE / "data/records.json")
ENTRIES = """An entry a ± b (n) is the mean a over n packings and half the width b of its 95 % confidence interval
(Student t). A third number ± c is a systematic error, which the text defines. *Nearest* is the state nearest jamming of
each packing. A dash means that the value is unknown."""
BLOCKS = {"main": main_table}
WITHOUT_TETRAHEDRA = SOLIDS[1:]


def far_exponents(data, column):
    """Local exponents with N = 400 in the ranges of Δφ in FAR, with errors below 1."""
    return [e for solid in SOLIDS for a, e in zip(EDGES, data.exponents(solid, 400, column, EDGES))
            if FAR[0] <= a < FAR[1] and e and e["n"] > 2 and e["half_width"] < 1]


def exponent_end(data, column, end):
    means = [e["mean"] for e in far_exponents(data, column)]
    return number(min(means) if end == "least" else max(means), 2) if means else "–"


def among(data, column, end, places="1"):
    """Least or greatest mean over octahedra, icosahedra and dodecahedra, N = 100, at TILTS_AT."""
    means = [e["mean"] for s in WITHOUT_TETRAHEDRA if (e := data.at(s, 100, column, TILTS_AT))]
    return number(min(means) if end == "least" else max(means), int(places)) if means else "–"


def of_solids(data, column):
    """Means of a column over the packings of each solid with at least three packings, in the study of many solids."""
    return [e["mean"] for solid in other_solids(data) if (e := data.nearest_of(SOLIDS_64, solid, column)) and e["n"] > 2]


def solids_end(data, column, end):
    means = of_solids(data, column)
    return number(min(means) if end == "least" else max(means), 1) if means else "–"


def limits_by_trough(data):
    """Linear limits of C by trough as Δφ → 0, one for each solid, N = 100."""
    return [limit_at_jamming(data, solid, 100, "C_trough")[0][0, 1.0] for solid in SOLIDS]


def limit_errors(data, end):
    errors = [limit["half_width"] for limit in limits_by_trough(data)]
    return number(min(errors) if end == "least" else max(errors), 2)


def missing_solids(data):
    return [s for s in other_solids(data) if len(data.kept_of(SOLIDS_64, s)) < 3]


value_of = values.value_of({
    **values.VALUES, "exponent": exponent_end, "among": among, "solids": solids_end, "limit_errors": limit_errors,
    "size": lambda data: str(drawn_size(data)), "isostatic": lambda data: values.against_isostatic(
        data, "trough", drawn_size(data)),
    "drawn": lambda data, how, solid: values.constraints(data, how, solid, drawn_size(data))})


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
    "In octahedra, icosahedra and dodecahedra near jamming, edges and faces that resist tilting make most vibrations stiff, "
    "not contacts that resist compression.": lambda data: all(
        data.at(s, 100, "held_by_second_each", TILTS_AT)["mean"] > 3 > 0.5 > data.at(
            s, 100, "prestress_10_each", TILTS_AT)["mean"] for s in WITHOUT_TETRAHEDRA),
    "In tetrahedra, normals contribute more in most modes.": lambda data: data.at(
        SOLIDS[0], 100, "held_by_second_each", TILTS_AT)["mean"] < 3,
    "For any classification, C = 12 − 6/N − 2m + 2S/N": identity_holds,
    "Limits for Δφ → 0 agree with them within ±": lambda data: all(
        abs(limit["mean"] - data.constraints(s, drawn_size(data), "trough")["mean"]) < limit["half_width"]
        for s, limit in zip(SOLIDS, limits_by_trough(data))),
    "By trough, constraints are missing in icosahedra and dodecahedra, and redundant in tetrahedra.":
        lambda data: all((m := data.nearest(s, n, "missing_trough"))["mean"] > m["half_width"]
                         for s in SOLIDS[2:] for n in (100, 400))
        and data.nearest(SOLIDS[0], 100, "redundant_trough")["mean"] > 0.05,
    "Fewer are missing in octahedra, and with N = 400 their number is compatible with zero": lambda data:
        data.nearest(SOLIDS[1], 100, "missing_trough")["mean"] < min(
            data.nearest(s, 100, "missing_trough")["mean"] for s in SOLIDS[2:])
        and (m := data.nearest(SOLIDS[1], 400, "missing_trough"))["mean"] < m["half_width"],
    "If stiff tilts are counted instead, hardly any are missing.": lambda data: all(
        (c := data.nearest_of(SOLIDS_64, s, "C_s"))["mean"] + c["half_width"] > 12 - 4 / 64 for s in SOLIDS),
    "It is larger than C by fit in icosahedra and dodecahedra, because some of their other contacts have a stiff tilt.":
        lambda data: all(data.nearest_of(SOLIDS_64, s, "C_s")["mean"] > data.nearest_of(SOLIDS_64, s, "C")["mean"] + 0.2
                         and data.nearest_of(SOLIDS_64, s, "stiff_tilts_l")["mean"] > 0.05 for s in SOLIDS[2:]),
    "That of tetrahedra does not exclude C = 12 − 4/N": lambda data: limits_by_trough(data)[0]["mean"] - limits_by_trough(
        data)[0]["half_width"] < 12 - 4 / 100,
    "⟨ω_l⟩ follows √G more closely than √K": lambda data: max(
        abs(e["mean"]) for e in far_exponents(data, "omega_over_root_G")) < min(
        e["mean"] for e in far_exponents(data, "omega_over_root_K")),
    "The trough has a finite density at the smallest Δφ.": lambda data: all(
        data.trough(s, drawn_size(data))["edge_face"]["density"] > 0.02 for s in SOLIDS),
    "within a factor of about two": lambda data: all(
        0.4 < data.at(s, 400, "wave", 0.02)["mean"] < 1.3 for s in SOLIDS),
    "no quantity follows one power law over the range of Figure 4.": lambda data: all(
        max(means) - min(means) > 0.1 for s in SOLIDS for c in ("E", "K", "omega_l")
        if (means := [e["mean"] for a, e in zip(EDGES, data.exponents(s, 400, c, EDGES)) if e and a >= FAR[0]])),
    "The count of 3, 2 and 1 constraints holds for all these solids, also for those that are not Platonic.": lambda data:
        len(of_solids(data, "C_s")) > 10 and all(
            abs(x - expected) < 0.2 for name, expected in (("ff", 2), ("ef", 1), ("l", 0))
            for x in of_solids(data, f"stiff_tilts_{name}")),
    "All packings of cubes and most packings of rhombic dodecahedra are crystals, and no packing of truncated cubes "
    "reached the target energy, so these three solids are missing": lambda data:
        set(missing_solids(data)) == {"cube", "truncated_cube", "rhombic_dodecahedron"},
    "In icosahedra and dodecahedra, near-rattlers explain at most a part of the missing constraints by fit": lambda data: all(
        data.at(s, 100, "backbone_m", TILTS_AT)["mean"] > 0.5 * data.at(s, 100, "missing", TILTS_AT)["mean"]
        for s in SOLIDS[2:]),
}

if __name__ == "__main__":
    pages.main(sys.modules[__name__], HERE)
