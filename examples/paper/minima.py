"""Blocks about minima: relaxed saddles, near-rattlers, modes by central differences, the paper's minimisation."""

import statistics

from constraints import around
from data import MAIN, SIZES, SOLIDS
from estimates import estimate_of
from expansions import LEFT_OUT
from scaling import at
from text import counted, interval, number, power, significant, table
from vibrations import DISTANCES, MISSING, bin_name

STEPS = {"h4": "10⁻⁴", "h6": "10⁻⁶", "h8": "10⁻⁸"}  # of central differences, V_p^(1/3)
# Caption of the paper's Figure 3: share of unstable modes in %; an upper limit for the last two solids.
PAPERS = {("tetrahedron", 0.01): 5.3, ("tetrahedron", 0.02): 1.2, ("octahedron", 0.01): 1.2}


def by_distance(data, solid, particles, value):
    """Per bin of DISTANCES [states, sum of value(state columns, i)]."""
    bins = [[0, 0] for _ in DISTANCES]
    for r, distances in zip(data.counted(solid, particles), data.distances(solid, particles)):
        for i, x in enumerate(distances):
            for b, (lower, upper) in zip(bins, DISTANCES):
                if lower <= max(x, 0) < upper:
                    b[0] += 1
                    b[1] += value(r["states"], i)
    return bins


def descents(data):
    """Saddles that were relaxed along a negative mode before modes were counted, and states with a negative mode."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            down = by_distance(data, solid, particles, lambda s, i: s["descents"][i] > 0)
            left = by_distance(data, solid, particles, lambda s, i: (s["negative"][i] or 0) > 0)
            rows.append([f"{solid} {particles}", *(
                f"{d[1]} of {d[0]}" + (f"; {n[1]} left" if n[1] else "") if d[0] else "–" for d, n in zip(down, left))])
    return table(["relaxed saddles", *(bin_name(*d) for d in DISTANCES)], rows)


def zeros(data):
    """Numbers of states with a near-rattler and of unresolved states."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            loose = by_distance(data, solid, particles, lambda s, i: s["near_rattlers"][i] > 0)
            soft = by_distance(data, solid, particles,
                               lambda s, i: not s["near_rattlers"][i] and (s["zero"][i] or 0) > 3)
            rows.append([f"{solid} {particles}", *(f"{a[1]} + {b[1]} of {a[0]}" if a[0] else "–"
                                                  for a, b in zip(loose, soft))])
    return table(["near-rattler + unresolved", *(bin_name(*d) for d in DISTANCES)], rows)


def means_of(data, study, solid):
    """Replicates without crystals, and for studies whose means are shown without those that stopped short. With the
    paper's rule almost all stopped short, so all states that they reached count."""
    out = LEFT_OUT if study in MAIN else {"crystalline"}
    return [r for r in data.studies.get(study, {"replicates": []})["replicates"]
            if r["solid"] == solid and r["status"] == "done" and not out & set(r["flags"])]


def unstable_share(data, study, solid, column, where):
    """Share of negative modes of all 6N, %, in states of a bin of Δφ; a replicate counts once."""
    means = []
    for r in means_of(data, study, solid):
        here = [v for x, v in zip(r["states"]["delta_phi"], r["states"].get(column) or [])
                if where[0] <= x < where[1] and v is not None]
        if here:
            means.append(100 * sum(here) / len(here))
    return estimate_of(means)


def unstable(data):
    """Shares of negative modes by central differences and by the exact count, in bins where one of them is above 0."""
    columns = ("unstable_exact", *(f"unstable_{step}" for step in STEPS))
    rows = []
    for name in data.studies:
        for solid in SOLIDS:
            for where in DISTANCES:
                found = [unstable_share(data, name, solid, column, where) for column in columns]
                if any(e and e["mean"] > 0 for e in found):
                    rows.append([name.removeprefix("paper-"), solid, bin_name(*where),
                                 str(max(e["n"] for e in found if e)), *(interval(e) for e in found)])
    if not rows:
        return MISSING
    return table(["study", "solid", "Δφ", "n", "exact, %", *(f"h = {name}" for name in STEPS.values())], rows)


def share_at(data, solid, column, distance):
    """Share of negative modes of all 6N, %, with N = 100, at a distance from jamming."""
    found = data.at(solid, 100, column, distance)
    return found and {**found, "mean": 100 * found["mean"], "half_width": 100 * (found["half_width"] or 0.0)}


def differences(data):
    """Shares of negative modes at the paper's unstable points by every step h, and the paper's shares."""
    rows = []
    for (solid, distance), share in PAPERS.items():
        found = [share_at(data, solid, column, distance) for column in ("unstable_exact", *(
            f"unstable_{step}" for step in STEPS))]
        if any(found):
            less = "" if share == max(PAPERS.values()) else "less than "
            rows.append([f"{solid}, Δφ = {number(distance, 2)}", *(counted(e) for e in found), f"{less}{share}"])
    return table(["N = 100, %", "exact", *(f"h = {name}" for name in STEPS.values()), "paper, N = 400"], rows) \
        if rows else MISSING


def rule_value(data, study, what, *solid):
    """A number of a study of minimisations: states, states with a negative mode, smallest Δφ of a solid, largest
    residual, replicates that stopped short."""
    some = [r["states"] for s in (solid or SOLIDS) for r in means_of(data, study, s)]
    if what == "nearest":
        return significant(min(s["delta_phi"][-1] for s in some), 2) if some else "–"
    if what == "short":
        flags = [r["flags"] for s in SOLIDS for r in means_of(data, study, s)]
        return f"{sum('goal_not_reached' in f for f in flags)} of {len(flags)}"
    if what == "worst":
        return power(max(x for s in some for x in s["residual"])) if some else "–"
    shares = [x for s in some for x in s.get("unstable_exact") or [] if x is not None]
    return str(len(shares) if what == "states" else sum(x > 0 for x in shares))


def rule_moves(data, solid):
    """φ_J by the paper's minimisation minus that by ours, for replicates with the same initial configuration, 10⁻⁴."""
    ours = {r["replicate"]: r["phi_j"]["phi_j"] for r in means_of(data, "paper-rule-base", solid)}
    return estimate_of([1e4 * (r["phi_j"]["phi_j"] - ours[r["replicate"]]) for r in means_of(data, "paper-rule", solid)
                        if r["replicate"] in ours])


def rule_shifts(data):
    rows = [[solid, rule_value(data, "paper-rule", "nearest", solid), counted(moved)] for solid in SOLIDS
            if (moved := rule_moves(data, solid))]
    return table(["solid, N = 100", "smallest Δφ by the rule", "φ_J by the rule − ours, 10⁻⁴"], rows) if rows else \
        "These records lack the study.\n"


def rest_missing(state, i, particles):
    """Missing rank of a packing without its near-rattlers. None if it is larger than the removed rows can explain: each
    removed contact had at most three rows, and the rank of all others remains."""
    missing, rank, removed = (state[key][i] for key in ("backbone_missing", "rank", "backbone_removed"))
    if None in (missing, rank, removed):
        return None
    gone = (state["Z"][i] * particles - state["backbone_Z"][i] * (particles - removed)) / 2
    # Half a contact of rounding in either Z.
    return missing if missing <= 6 * (particles - removed) - 3 - (rank - 3 * (gone + 1)) else None


def rest_at(data, solid, particles, distance):
    return estimate_of([at(x, [rest_missing(r["states"], i, particles) for i in range(len(x))], distance)
                        for r, x in zip(data.counted(solid, particles), data.distances(solid, particles))
                        if "backbone_missing" in r["states"]])


def backbone(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not any(data.column(solid, particles, "backbone_removed")):
                continue
            columns = ("backbone_removed", "backbone_Z", "Z", "backbone_zero", "backbone_negative")
            cells = [counted(data.at(solid, particles, column, 0.005)) for column in columns]
            cells.append(counted(rest_at(data, solid, particles, 0.005)))
            slopes = [data.slopes(solid, particles, c, (0.005, 0.02))[0] for c in ("backbone_omega_l", "backbone_K")]
            rows.append([f"{solid} {particles}", *cells, *(counted(s) for s in slopes)])
    if not rows:
        return MISSING
    return table(["Δφ = 0.005", "removed particles", "Z of the rest", "Z of all", "zero modes", "negative modes",
                  "missing rank", "exponent of ⟨ω_l⟩, Δφ = 0.005 – 0.02", "exponent of K"], rows)


def stability(data):
    rows = []
    for name, study in data.studies.items():
        for solid in (*SOLIDS, "cube"):
            every = [r for r in study["replicates"] if r["solid"] == solid]
            done = [r for r in every if r["status"] == "done"]
            if not done or "zero" not in done[0]["states"]:
                continue
            states = [(s["zero"][i], s["negative"][i], s["near_rattlers"][i], s["descents"][i], s["residual"][i])
                      for s in (r["states"] for r in done) for i in range(len(s["phi"]))]
            ends = [r["states"] for r in done]
            rows.append([name.removeprefix("paper-"), solid, str(len(every)), str(len(every) - len(done)),
                         *(str(sum(flag in r["flags"] for r in done)) for flag in ("goal_not_reached", "crystalline")),
                         *(str(sum(bool(s[key][-1]) for s in ends)) for key in ("percolates", "spans")),
                         str(len(states)),
                         str(sum(z == 3 and n == 0 for z, n, *_ in states)),
                         str(sum((n or 0) > 0 for _, n, *_ in states)), str(sum(r > 0 for _, _, r, *_ in states)),
                         str(sum(d > 0 for *_, d, _ in states)), power(max(r for *_, r in states))])
    return table(["study", "solid", "replicates", "failed", "stopped short", "crystalline", "percolate", "span",
                  "states", "three zero modes, none negative", "with negative modes", "with near-rattlers",
                  "relaxed saddles", "largest residual"], rows)


def state_counts(data, solids=SOLIDS, nearest=0.0):
    """Numbers of states by stability, over all states of disordered packings or over those with Δφ ≥ nearest."""
    made = dict.fromkeys(("states", "descents", "negative", "loose", "unresolved", "three", "loose_three",
                          "loose_negative"), 0)
    for solid in solids:
        for n in SIZES:
            for r, distances in zip(data.counted(solid, n), data.distances(solid, n)):
                s = r["states"]
                for i, x in enumerate(distances):
                    if nearest and x < nearest:
                        continue
                    zero, loose = s["zero"][i] or 0, s["near_rattlers"][i] > 0
                    negative = (s["negative"][i] or 0) > 0
                    three = zero == 3 and not negative
                    for key, true in (("states", True), ("descents", s["descents"][i] > 0), ("negative", negative),
                                      ("loose", loose), ("unresolved", zero > 3 and not loose), ("three", three),
                                      ("loose_three", three and loose), ("loose_negative", negative and loose)):
                        made[key] += true
    return made


def state_table(data):
    """Numbers of states by stability, over all Δφ and over the paper's range."""
    columns = {"states": "states", "three": "three zero modes, none negative", "loose": "with a near-rattler",
               "loose_three": "both of these", "unresolved": "unresolved", "negative": "with a negative mode",
               "loose_negative": "with a negative mode and a near-rattler", "descents": "relaxed saddles"}
    rows = {"all solids, all Δφ": state_counts(data), "all solids, Δφ ≥ 0.01": state_counts(data, nearest=0.01),
            **{f"{solid}, Δφ ≥ 0.01": state_counts(data, (solid,), 0.01) for solid in SOLIDS}}
    return table(["", *columns.values()],
                 [[name, *(str(counts[column]) for column in columns)] for name, counts in rows.items()])


def every_count(data, what):
    """Numbers of states over all replicates of the paper's four solids, without exclusions."""
    states = [(r["states"], i) for name in MAIN for r in data.studies.get(name, {"replicates": []})["replicates"]
              if r["status"] == "done" and r["solid"] in SOLIDS for i in range(len(r["states"]["phi"]))]
    return str(sum({"states": True, "descents": s["descents"][i] > 0, "negative": (s["negative"][i] or 0) > 0}[what]
                   for s, i in states))


def rest_value(data, what, lower, upper):
    """Number of states in a range of Δφ whose packing without near-rattlers has more than three zero modes, or an
    impossible rank, and number of all."""
    found = []
    for solid in SOLIDS:
        for n in SIZES:
            for r, distances in zip(data.counted(solid, n), data.distances(solid, n)):
                s = r["states"]
                found += [((s["backbone_zero"][i] or 0) > 3, s["backbone_missing"][i] is not None and
                           s["rank"][i] is not None and rest_missing(s, i, n) is None)
                          for i, x in enumerate(distances) if float(lower) <= max(x, 0) < float(upper)
                          and "backbone_zero" in s]
    return f"{sum(f[what == 'rank'] for f in found)} of {len(found)}"


def rest_between(data, what, distance):
    """Packings that without near-rattlers have more than three zero modes at a distance from jamming, interpolated: how
    many, in how many the farther of the two states has three, and the largest number of zero modes."""
    where, found = float(distance), []
    for solid in SOLIDS:
        for n in SIZES:
            for r, x in zip(data.counted(solid, n), data.distances(solid, n)):
                zero = r["states"].get("backbone_zero")
                if zero and (value := at(x, zero, where)) and value > 3:
                    found.append((value, zero[around(x, zero, where)[0]] == 3))
    return {"all": str(len(found)), "farther": str(sum(three for _, three in found)),
            "most": number(max((value for value, _ in found), default=0), 1)}[what]


def percolation(data, what, particles, where):
    """Number of disordered packings in which face-face clusters percolate or span, at the smallest Δφ or at any; or
    number of crystals among all packings that percolate."""
    n = int(particles)
    if what == "crystals":
        every = [r for s in SOLIDS for r in data.all_of(s, n)
                 if r["status"] == "done" and r["states"]["percolates"][-1]]
        return f"{sum('crystalline' in r['flags'] for r in every)} of {len(every)}"
    some = [r["states"][what] for s in SOLIDS for r in data.counted(s, n)]
    return f"{sum(bool(v[-1]) if where == 'nearest' else any(v) for v in some)} of {len(some)}"


def percolating(data):
    rows = [[str(n), *(percolation(data, what, n, where) for what in ("percolates", "spans")
                       for where in ("nearest", "any"))] for n in SIZES]
    return table(["N", "percolate, smallest Δφ", "percolate, any Δφ", "span, smallest Δφ", "span, any Δφ"], rows)


def minimisations(data):
    """The paper's rule and our minimisation in bins of Δφ."""
    rows, edges = [], (1, 0.1, 0.06, 0.04, 0.028, 0.018)
    for solid in SOLIDS:
        for upper, lower in zip(edges, edges[1:]):
            cells = []
            for study in ("paper-rule", "paper-rule-base"):
                some = [(e, s) for r in data.studies.get(study, {"replicates": []})["replicates"]
                        if r["solid"] == solid and r["status"] == "done"
                        for x, e, s in zip(r["states"]["delta_phi"], r["evaluations"], r["states"]["residual"])
                        if lower <= x < upper]
                if some:
                    cells += [str(len(some)), str(statistics.median_high(e for e, _ in some)),
                              power(max(s for _, s in some))]
                else:
                    cells += ["0", "–", "–"]
            if cells[0] != "0" or cells[3] != "0":
                rows.append([solid, f"{number(lower, 3)} … {number(upper, 3)}", *cells])
    if not rows:
        return "These records lack the study.\n"
    return table(["solid", "Δφ", "states, rule", "evaluations, rule", "largest residual, rule", "states, ours",
                  "evaluations, ours", "largest residual, ours"], rows)


BLOCKS = {f.__name__: f for f in (descents, zeros, unstable, differences, backbone, stability, minimisations,
                                  state_table, percolating, rule_shifts)}
VALUES = {
    "total": lambda data, what, nearest="0": str(state_counts(data, nearest=float(nearest))[what]),
    "every": every_count, "rest": rest_value, "rest_between": rest_between,
    "percolation": percolation, "rule": rule_value}
