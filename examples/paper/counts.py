"""Blocks of the summary, the ranks of the constraints, cubes, and CPU time."""

import statistics

from constraints import error_of_rows, limit_of, with_cutoffs
from data import SIZES, SOLIDS
from densities import said, table_i
from estimates import estimate_of
from text import bounded, interval, number, significant, table


def summary(data):
    rows = []
    for figure in table_i(data):
        solid, n = figure["solid"], figure["particles"]
        if not data.counted(solid, n):
            rows.append([f"{solid} {n}", "0", "–", said(figure), *["–"] * 4, number(12 - 4 / n, 2)])
            continue
        rows.append([f"{solid} {n}", str(data.phi_j(solid, n)["n"]), bounded(data.phi_j(solid, n)), said(figure),
                     significant(data.nearest_distance(solid, n)["mean"], 2), interval(data.nearest(solid, n, "Z")),
                     *(bounded(with_cutoffs(data, solid, n, column)) for column in ("Z_ff", "C")),
                     number(12 - 4 / n, 2)])
    return table(["solid, N", "n", "φ_J", "paper", "nearest Δφ", "Z", "Z_ff", "C", "12 − 4/N"], rows)


def short_of_rank(data, solid, particles):
    """6N − 3 less the rank of the constraints, at the smallest Δφ."""
    return estimate_of([6 * particles - 3 - y[-1] for y in data.column(solid, particles, "rank")
                        if y and y[-1] is not None])


def rigidity(data):
    rows = []
    for solid in (*SOLIDS, "cube"):
        for particles in SIZES:
            constraints, rank, stress, normals = (data.nearest(solid, particles, key) for key in (
                "rows", "rank", "self_stress", "self_stress_normals"))
            if not rank:
                continue
            full = 6 * particles - 3
            short = short_of_rank(data, solid, particles)
            rows.append([f"{solid} {particles}", str(rank["n"]),
                         significant(data.nearest_distance(solid, particles)["mean"], 2), interval(constraints),
                         error_of_rows(data, solid, particles), interval(rank), str(full), interval(stress),
                         interval(short), interval(normals)])
    return table(["solid, N", "n", "Δφ", "constraints C·N/2", "error from cut-offs", "rank", "6N − 3",
                  "states of self-stress", "6N − 3 − rank", "states of self-stress, normals only"], rows)


def summary_of_constraints(data):
    rows = []
    for solid in SOLIDS:
        for n in SIZES:
            if not data.counted(solid, n):
                continue
            _, chosen, half = limit_of(data, solid, n)
            rows.append([f"{solid} {n}", interval(chosen), f"± {number(half, 2)}" if half else "–",
                         number(12 - 4 / n, 2), interval(data.nearest(solid, n, "self_stress")),
                         interval(short_of_rank(data, solid, n)), error_of_rows(data, solid, n)])
    return table(["solid, N", "C as Δφ → 0 ± fit ± form", "error from cut-offs", "12 − 4/N", "states of self-stress",
                  "6N − 3 − rank", "error of C·N/2 from cut-offs"], rows)


def cubes(data):
    columns = ("Z", "Z_ff", "C", "S", "percolates", "zero", "negative", "self_stress")
    every = data.all_of("cube", 100)
    if not every:
        return "These records lack the study.\n"
    failed = sum(r["status"] != "done" for r in every)
    row = [str(len(every)), str(failed), str(len(data.counted("cube", 100))), interval(data.phi_j("cube", 100)),
           *(interval(data.nearest("cube", 100, column)) for column in columns)]
    return table(["replicates", "failed", "n", "φ_J", "Z", "Z_ff", "C", "mean cluster size S", "percolate",
                  "zero modes", "negative modes", "states of self-stress"], [row])


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
    shares = [[f"`{stage}`", number(100 * seconds / sum(stages.values()), 1)]
              for stage, seconds in sorted(stages.items(), key=lambda item: -item[1])]
    commits = sorted({commit for study in data.studies.values() for commit in study["git"]})
    return table(["study", "solid", "n", "CPU time, median, s", "smallest … largest, s", "all, minutes"], rows) + \
        "\n" + table(["stage", "share of the CPU time, %"], shares) + \
        f"\nThe records were made by commits {', '.join(commits)}.\n"


BLOCKS = {f.__name__: f for f in (summary, summary_of_constraints, rigidity, cubes, cost)}
VALUES = {"failed": lambda data, solid, n: "{} of {}".format(
    sum(r["status"] != "done" for r in data.all_of(solid, int(n))), len(data.all_of(solid, int(n))))}
