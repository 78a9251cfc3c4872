"""Blocks that count: the summary, ranks of the constraints, cubes, what it cost."""

import statistics

from data import SIZES, SOLIDS
from densities import said
from estimates import estimate_of
from text import counted, interval, number, significant, table


def summary(data):
    rows = []
    for solid in SOLIDS:
        theirs = {f["particles"]: said(f) for f in data.figures if f["place"] == "Table I" and f["solid"] == solid}
        rows.append([solid, *(cell for n in SIZES for cell in (counted(data.phi_j(solid, n)), theirs[n])),
                     *(interval(data.nearest(solid, 100, column)) for column in ("Z", "Z_ff", "C")),
                     interval(data.nearest(solid, 400, "C"))])
    return table(["", "φ_J, N = 100", "paper", "φ_J, N = 400", "paper", "Z, 100", "Z_ff, 100", "C, 100",
                  "C, 400"], rows)


def rigidity(data):
    rows = []
    for solid in (*SOLIDS, "cube"):
        for particles in SIZES:
            constraints, rank, stress, normals = (data.nearest(solid, particles, key) for key in (
                "rows", "rank", "self_stress", "self_stress_normals"))
            if not rank:
                continue
            full = 6 * particles - 3
            short = estimate_of([full - y[-1] for y in data.column(solid, particles, "rank")
                                 if y and y[-1] is not None])
            rows.append([f"{solid} {particles}", str(rank["n"]),
                         significant(data.nearest_distance(solid, particles)["mean"], 2), interval(constraints),
                         interval(rank), str(full), interval(stress), interval(short), interval(normals)])
    return table(["nearest jamming", "n", "Δφ", "constraints C·N/2", "rank", "6N − 3", "states of self-stress",
                  "short of full rank", "states of self-stress, normals alone"], rows)


def cubes(data):
    columns = ("Z", "Z_ff", "C", "S", "percolates", "zero", "negative", "self_stress")
    every = data.all_of("cube", 100)
    if not every:
        return "Not in these records.\n"
    failed = sum(r["status"] != "done" for r in every)
    row = [str(len(every)), str(failed), str(len(data.counted("cube", 100))), interval(data.phi_j("cube", 100)),
           *(interval(data.nearest("cube", 100, column)) for column in columns)]
    return table(["replicates", "failed", "n", "φ_J", "Z", "Z_ff", "C", "S", "percolate", "zero modes",
                  "negative modes", "states of self-stress"], [row])


def cost(data):
    rows, stages = [], {}
    for name, study in data.studies.items():
        for solid in (*SOLIDS, "cube"):
            some = [r for r in study["replicates"] if r["solid"] == solid]
            seconds = [r["cpu"] for r in some]
            if seconds:
                rows.append([name.removeprefix("paper-"), solid, str(len(seconds)), f"{statistics.median(seconds):.0f}",
                             f"{min(seconds):.0f} … {max(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
            for r in some:
                for stage, time in r["stages"].items():
                    stages[stage] = stages.get(stage, 0) + time
    for name, replicates in data.search.items():
        seconds = [r["cpu"] for r in replicates]
        rows.append([name.removeprefix("paper-"), "all", str(len(seconds)), f"{statistics.median(seconds):.0f}",
                     f"{min(seconds):.0f} … {max(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
    share = ", ".join(f"{stage} {number(100 * seconds / sum(stages.values()), 1)} %"
                      for stage, seconds in sorted(stages.items(), key=lambda item: -item[1]))
    commits = sorted({commit for study in data.studies.values() for commit in study["git"]})
    return table(["study", "", "n", "median CPU s", "least … greatest", "CPU minutes in all"], rows) + \
        f"\nBy stage: {share}. Made by commits {', '.join(commits)}.\n"


BLOCKS = {f.__name__: f for f in (summary, rigidity, cubes, cost)}
