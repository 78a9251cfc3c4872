"""Tables of the page and of tables.md. Each function returns Markdown."""

from analysis import (AFTER, AT, NO_COHESION, SOLIDS, all_of_size, collapse, constraints, difference_at, excess,
                      last, mean, threshold_of, values_at)
from estimates import estimate_of
from text import counted, interval, number, table

METHODS = ("fit", "trough")
ALL = (*SOLIDS, "cube")
SHOWN = (1e-6, 1e-4)  # strengths in the main table


def strength_text(w):
    return "1e−12" if w == NO_COHESION else "0" if w == 0 else f"{w:.0e}".replace("e-0", "e−")


def share_text(replicates, column, positive=lambda x: x > 0):
    values = [last(r, column) for r in replicates if last(r, column) is not None]
    return f"{sum(map(positive, values))} of {len(values)}" if values else "–"


def main_table(data):
    """Packings of 100 particles: without cohesion at Δφ = AT, and with cohesion at zero pressure."""
    rows = []
    for solid in SOLIDS:
        packings = data.untreated(solid, 100)
        z, order = (interval(estimate_of(values_at(packings, column, AT))) for column in ("Z_ff_fit", "Q6"))
        rows.append([solid, "0", interval(estimate_of([r["phi"] for r in packings])), z, interval(constraints(packings, AT)),
                     share_text(packings, "winding_fit"), order])
        for w in SHOWN:
            packings = data.kept(solid, 100, w)
            rows.append([solid, strength_text(w), interval(mean(packings, "phi_0")),
                         interval(mean(packings, "Z_ff_fit")), interval(constraints(packings)),
                         share_text(packings, "winding_fit"), interval(mean(packings, "Q6"))])
    return table(["solid", "w", "φ_0 or φ_J", "Z_ff", "C", "percolate", "Q6"], rows)


def limits_text(found):
    return f"{number(found['mean'], 2)} ({number(found['low'], 2)} … {number(found['high'], 2)})" if found else "–"


def sizes_table(data):
    return table(["N", "face-face contacts", "random bonds"],
                 [[str(n), *(limits_text(threshold_of(all_of_size(data, n), "fit", of_random))
                             for of_random in (False, True))] for n in (100, 200, 400)])


def change_table(data):
    rows = [[solid, *(interval(difference_at(data, solid, *group, AT)) for group in ((100, None), (200, 1e-5)))]
            for solid in SOLIDS]
    return table(["solid", "N = 100, all w", "N = 200, w = 1e-5"], rows)


def kept_table(data):
    """All packings at zero pressure, with three kinds of cut-offs."""
    rows = []
    groups = sorted({(r["particles"], r["h"], ALL.index(r["solid"]), r["w"]) for r in data.all if r["until"] == "end"})
    for particles, h, solid, w in groups:
        packings = data.kept(ALL[solid], particles, w, h)
        crystals = [r for r in data.all if "crystalline" in r["flags"] and (
            r["until"], r["particles"], r["h"], r["solid"], r["w"]) == ("end", particles, h, ALL[solid], w)]
        rows.append([ALL[solid], str(particles), f"{h:g}", strength_text(w), str(len(crystals)),
                     counted(mean(packings, "phi_0")),
                     *(counted(mean(packings, f"Z_ff_{m}")) for m in METHODS), counted(mean(packings, "C")),
                     counted(mean(packings, "C_trough")), interval(mean(packings, "Z")),
                     interval(mean(packings, "Z_grown")), interval(mean(packings, "tension"))])
    return table(["solid", "N", "h", "w", "crystals", "φ_0", *(f"Z_ff by {m}" for m in METHODS), "C by fit",
                  "C by trough", "Z", "Z_grown", "tension"], rows)


def clusters_table(data):
    rows = []
    groups = sorted({(r["particles"], r["h"], SOLIDS.index(r["solid"]), r["w"]) for r in data.all
                     if r["until"] == "end" and r["solid"] in SOLIDS})
    for particles, h, solid, w in groups:
        packings = data.kept(SOLIDS[solid], particles, w, h)
        for m in METHODS:
            if not mean(packings, f"S_{m}"):
                continue
            rows.append([SOLIDS[solid], str(particles), f"{h:g}", strength_text(w), m,
                         counted(mean(packings, f"S_{m}")), interval(mean(packings, f"S_random_{m}")),
                         interval(mean(packings, f"largest_{m}")),
                         share_text(packings, f"winding_{m}"), share_text(packings, f"winding_{m}", lambda d: d > 2),
                         interval(mean(packings, f"winds_random_{m}"))])
    return table(["solid", "N", "h", "w", "cut-off", "S", "S of random bonds", "largest cluster / N", "percolate",
                  "in three directions", "probability for random bonds"], rows)


def memory_table(data):
    """Differences of Z_ff from packings without cohesion, after it was switched off."""
    rows = []
    for particles in (100, 200):
        for solid in SOLIDS:
            for w in data.strengths("decompression", particles):
                rows.append([solid, str(particles), strength_text(w),
                             *(counted(difference_at(data, solid, particles, w, d)) for d in AFTER)])
    return table(["solid", "N", "w", *(f"Δφ = {d:g}" for d in AFTER)], rows)


def thresholds_table(data):
    rows = []
    for m in METHODS:
        for solids, name in ((SOLIDS, "all"), *(((s,), s) for s in SOLIDS if m == "fit")):
            for particles in (100, 200, 400):
                packings = all_of_size(data, particles, solids)
                row = [m, name, str(particles)]
                for of_random in (False, True):
                    found = threshold_of(packings, m, of_random)
                    row.append(limits_text(found))
                if row[3:] != ["–", "–"]:
                    rows.append(row)
    return table(["cut-off", "solid", "N", "Z_ff where half of the packings percolate", "the same for random bonds"],
                 rows)


def collapse_table(data):
    found = collapse(data, 100)
    rows = [[solid, strength_text(w), until, counted(e)]
            for (solid, w, until), e in sorted(found["offsets"].items())]
    return table(["solid", "w", "cohesion until", "mean of ln S − ln S of the common curve"], rows)


def excess_table(data):
    return table(["solid", "ln(S/S of random bonds), Z_ff = 0.8 … 1.6"],
                 [[solid, counted(e)] for solid, e in excess(data, 100).items()])


def cycles_table(data):
    rows = []
    for solid in SOLIDS:
        packings = data.of("percolation-cycles", solid=solid)
        if not packings:
            continue
        count = max(len(r.get("cycles", [])) for r in packings)
        for k in range(count):
            rows.append([solid, str(k + 1), *(counted(estimate_of([r["cycles"][k].get(key) for r in packings]))
                                              for key in ("phi_j", "Z_ff", "Z"))])
        rows.append([solid, "last decompression", counted(estimate_of([r["phi"] for r in packings])),
                     counted(mean(packings, "Z_ff_fit")), counted(mean(packings, "Z"))])
    return table(["solid", "cycle", "φ_J", "Z_ff", "Z"], rows)


TABLES = [
    ("Packings at zero pressure", """Cohesion acts until the end. Z counts the pairs that touch, and Z_grown the pairs
     that attract each other. Crystals are counted, and left out of the means. *Tension* is the share of the contacts that
     are under tension.""", kept_table),
    ("Clusters at zero pressure", """S is the mean cluster size. *Percolate* counts packings in which a cluster is
     connected to its own periodic image. Random bonds are as many contacts, drawn at random from all contacts of the
     same packing.""", clusters_table),
    ("Thresholds", """Logistic regression of whether a packing percolates on its Z_ff, over all packings of a size. In
     parentheses: 95 % confidence interval (percentiles of a bootstrap over packings).""", thresholds_table),
    ("The common curve", """A cubic polynomial of Z_ff was fitted to ln S of all states with N = 100 and Z_ff < 1.6.
     The table has the mean deviation of each group from this curve. The states of a decompression are not
     independent, so the intervals of groups with cohesion until decompression are too narrow.""", collapse_table),
    ("Clusters beside those of random bonds", "N = 100, in the last state of each packing.", excess_table),
    ("After the cohesion was switched off", """Z_ff minus Z_ff of packings without cohesion, at three distances to
     jamming. The interval is that of Welch's t.""", memory_table),
    ("Training cycles", """Each cycle is a decompression to Δφ = 0.01 and a compression to E/N = 3.2e-5, without
     cohesion, N = 100. Z_ff and Z are those at the end of the decompression.""", cycles_table),
]
