"""Updates README.md, or makes it and tables.md in OUT: python3 page.py [--data FILE...] [-o OUT] [--check] [--summary PAGE]"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

import pages  # noqa: E402
import preparations  # noqa: E402
import values  # noqa: E402
from comparison import DICE_DENSITY, HARD_DENSITY, STABLE_FROM, drawn_size, figures_of, offset_test, within  # noqa: E402
from data import SOLIDS  # noqa: E402
from tables import (SIZES, TABLES, agreement, contacts_at_jamming, emergence, needed_packings, region_two_ratios,  # noqa: E402, F401
                    structure, summary)
from text import number, significant  # noqa: E402

TITLE = "Jammed packings of Platonic solids"
FILES = (HERE / "data/records.json", HERE.parent / "rigidity/data/constraints.json")
ENTRIES = """An entry a ± b (n) is the mean a over n packings and half the width b of its 95 % confidence interval
(Student t). A third number ± c is a systematic error, which the text defines. *Single packing* is half the width of the
95 % prediction interval: with this probability, another packing of ours is within our mean ± this number. *Nearest* is
the state nearest jamming of each packing. A dash means that the value is unknown."""
BLOCKS = {"summary": summary, "changes": preparations.changes_table}
END = {"least": min, "greatest": max}


def at_jamming(data, end):
    """Z_J of the solid where it is least or greatest, N = 400."""
    found = [e["mean"] for solid in SOLIDS if (e := contacts_at_jamming(data, solid, 400))]
    return number(min(found) if end == "least" else max(found), 2)


def offsets(data, which):
    found = offset_test(data)[which]
    return {"chi_squared": number(found, 1), "freedom": str(found)}.get(which, significant(found, 2))


def lowered(data, end):
    """Decrease of φ_J by a target energy of 1e-9."""
    return number(END[end](-preparations.change(data, s, "1e-09")["mean"] for s in SOLIDS), 3)


def hard_offset(data, solid):
    """Density of maximally random jammed hard solids minus our φ_J, N = 400."""
    return HARD_DENSITY[solid] - data.phi_j(solid, 400)["mean"]


def largest_offset(data):
    return number(max(abs(f["value"] - data.phi_j(f["solid"], f["particles"])["mean"])
                      for f in figures_of("Table I")), 3)


def cluster(data, which):
    """Smallest N, and largest Δφ, of the drawn clusters."""
    found = [data.cluster(solid) for solid in SOLIDS]
    return str(min(n for n, _ in found)) if which == "size" else significant(
        max(one["delta_phi"] for _, one in found), 2)


def region_two(data):
    """Relative differences between the densities of the halves of region 2, with their errors: (difference, error)."""
    return [(abs(ratio["mean"] - 1), ratio["half_width"]) for _, _, ratio in region_two_ratios(data)]


def share_of_minima(data):
    """Percentage of the states of all packings that are minima with three zero modes."""
    states = [pair for s in SOLIDS for n in SIZES for r in data.kept(s, n)
              for pair in zip(r["states"]["zero"], r["states"]["negative"])]
    return number(100 * sum(pair == (3, 0) for pair in states) / len(states), 0)


def outside(data, columns):
    """Values of the paper's Table IV that are larger or smaller than our prediction intervals, at the smallest Δφ of its
    stable packings: {(solid, column): "larger" or "smaller"}."""
    found = {(f["solid"], f["column"]): (f, data.at(f["solid"], 400, f["column"], STABLE_FROM[f["solid"]]))
             for f in figures_of("Table IV") if f["column"] in columns}
    return {place: "larger" if f["value"] > ours["mean"] else "smaller" for place, (f, ours) in found.items()
            if "outside" in within(data, f, ours)}


def offsets_of(data, solid):
    """Absolute differences between the paper's values of φ_J and ours."""
    return [abs(f["value"] - data.phi_j(solid, f["particles"])["mean"])
            for f in figures_of("Table I") if f["solid"] == solid]


value_of = values.value_of({
    **values.VALUES, "Z_J": at_jamming, "offsets": offsets, "lowered": lowered,
    "change": lambda data, *place: preparations.signed(preparations.change(data, *place)),
    "extreme": lambda data, solid, end: preparations.signed(preparations.extreme(data, solid, END[end])),
    "chance": lambda data: number(100 * offset_test(data)["chance"], 0),
    "hard": lambda data, solid: number(hard_offset(data, solid), 3), "largest_offset": largest_offset, "cluster": cluster,
    "region_two": lambda data, which: number(100 * END[which](off for off, _ in region_two(data)), 0),
    "minima_share": share_of_minima,
    "farthest": lambda data: significant(values.farthest(data, SIZES), 2),
    "size": lambda data: str(drawn_size(data))})


def sure(estimate):
    """True if the mean of an estimate differs from 0 by more than its confidence interval."""
    return abs(estimate["mean"]) > estimate["half_width"]


# Sentences of README.md that follow from the data only as long as these functions are true.
CLAIMS = {
    "Contacts are hypostatic": lambda data: all(
        (e := contacts_at_jamming(data, s, 400)) and e["mean"] + e["half_width"] < 10 for s in SOLIDS),
    "C of 400 octahedra, icosahedra and dodecahedra agrees with 12": lambda data: [
        agreement(data, s, "fit") for s in SOLIDS] == ["above", "agrees", "agrees", "agrees"],
    "(tetrahedra), while other preparations change that of tetrahedra by": lambda data: float(largest_offset(data)) < max(
        offsets_of(data, SOLIDS[0])) + 0.0006 and all(
        end(SOLIDS, key=lambda s: preparations.extreme(data, s, end)["mean"]) == SOLIDS[0] for end in (min, max)),
    "Preparations change φ_J by more than these offsets.": lambda data: all(
        abs(preparations.extreme(data, s, min)["mean"]) > max(offsets_of(data, s)) for s in SOLIDS),
    "A compression that ends at E/N = 1e-9 instead of 3.2e-5 lowers φ_J of every solid,": lambda data: all(
        e["mean"] + e["half_width"] < 0 for s in SOLIDS if (e := preparations.change(data, s, "1e-09"))),
    "Ours are nearly as dense,": lambda data: all(
        0 < hard_offset(data, s) < 0.012 for s in SOLIDS[1:]) and hard_offset(data, SOLIDS[0]) > 0.1,
    "Cohesion that is removed raises φ_J of tetrahedra again": lambda data: sure(preparations.change(data, SOLIDS[0], "removed")),
    "among eight offsets, chance alone gives such a least probability": lambda data: offset_test(data)["chance"] > 0.1,
    "The paper's intervals are narrower than the spread of single packings, except that of 400 tetrahedra.": lambda data: [
        (f["solid"], f["particles"]) for f in figures_of("Table I") if f["error"] > (ours := data.phi_j(
            f["solid"], f["particles"]))["half_width"] * (ours["n"] + 1) ** 0.5] == [(SOLIDS[0], 400)],
    "Its mean cut-off nearest jamming lies in the upper half of the trough, on a logarithmic scale, or above it": lambda data: all(
        data.nearest(s, n, "cut_ef")["mean"] ** 2 > entry["edge_face"]["low"] * entry["edge_face"]["high"]
        for s in SOLIDS for n in SIZES if (entry := data.trough(s, n)) and "high" in entry["edge_face"]),
    "No state nearest jamming has a negative mode, because saddles were relaxed along their negative modes.": lambda data: all(
        not r["states"]["negative"][-1] for s in SOLIDS for n in SIZES for r in data.kept(s, n)),
    "can have spurious negative modes": lambda data: all(
        data.nearest(s, 100, "unstable_exact")["mean"] == 0 < data.nearest(s, 100, "unstable_h8")["mean"]
        for s in SOLIDS),
    "The highest modes move almost only particles with a face-face contact, and each mode moves about two particles.":
        lambda data: all(data.nearest(s, 400, "amplitude")["mean"] > 0.95
                         and abs(data.nearest(s, 400, "participating")["mean"] - 2.2) < 0.3 for s in SOLIDS),
    "its Z_ff and mean cluster sizes are within our prediction intervals for one packing.": lambda data: not outside(
        data, ("Z_ff", "S")),
    "if between vertices, only its extents of tetrahedra differ significantly from ours, and if between centres, all but "
    "those of dodecahedra do": lambda data: set(outside(data, ("l_max", "body_l_max"))) == {
        (SOLIDS[0], "body_l_max"), *((s, "l_max") for s in SOLIDS[:3])},
    "in our packings, the densities of the two halves of this range differ by": lambda data: all(
        off > error for off, error in region_two(data)),
    "in each of the eight combinations of solid and N, the paper's interval overlaps our prediction interval for one packing.":
        lambda data: not any("outside" in within(data, f, data.phi_j(f["solid"], f["particles"])) for f in figures_of("Table I")),
    "Small θ_ef are more frequent than in random contacts at all Δφ up to 0.32.": lambda data: len(emergence(data)) > 20
        and all(near["mean"] - near["half_width"] > 1 for *_, near in emergence(data)),
    "Angles θ_ff below 1° become so only at a Δφ between 0.16 and 0.04, in agreement with the paper (in tetrahedra, both are "
    "frequent at 0.32;": lambda data: all(
        (one["mean"] > 1) == (solid == SOLIDS[0] or distance < 0.1) for solid, distance, _, one, _ in emergence(data)
        if distance > 0.15 or distance < 0.05),
    "The structure factor of the centres is below 0.05 for wave numbers k < 1": lambda data: all(
        e["mean"] + e["half_width"] < 0.05 for s in SOLIDS for n in (400, 4000) for k, e in structure(data, s, n) if k < 1),
    "which is weak evidence that the protocols, or the methods to find φ_J, differ.": lambda data: 0.01 < offset_test(data)["p"] < 0.05,
    "For most combinations, only the mean over more than a hundred packings like ours would have such a narrow interval":
        lambda data: sum(needed_packings(data, f) > 100 for f in figures_of("Table I")) > 4,
    "Dice of the other solids are less dense than our packings": lambda data: all(
        data.phi_j(s, n)["mean"] - data.phi_j(s, n)["half_width"] > sum(DICE_DENSITY[s]) for s in SOLIDS[1:] for n in SIZES),
    "In icosahedra and dodecahedra, these are fewer than the particles of a mean cluster": lambda data: all(
        data.nearest(s, n, "participating")["mean"] + data.nearest(s, n, "participating")["half_width"]
        < data.nearest(s, n, "S")["mean"] - data.nearest(s, n, "S")["half_width"] for s in SOLIDS[2:] for n in SIZES),
    "Every state is an equilibrium with a": lambda data: max(
        x for s in SOLIDS for n in SIZES for r in data.kept(s, n) for x in r["states"]["residual"] if x) < 1.01e-6
        and all(data.nearest_distance(s, n)["mean"] < 0.0006 for s in SOLIDS[1:] for n in SIZES),
    "Most decompressions end at about Δφ = 0.0003. That of tetrahedra ends at 0.001 (N = 100) or 0.005 (N = 400).":
        lambda data: all(
        0.7 < data.nearest_distance(SOLIDS[0], n)["mean"] / end < 1.1 for n, end in ((100, 0.001), (400, 0.005))),
}

if __name__ == "__main__":
    pages.main(sys.modules[__name__], HERE)
