"""Blocks of the page, {name: function from data to Markdown}, and the numbers within its sentences."""

import statistics

import counting
import forces
import held
import motions
import rank
from data import SOLIDS
from gather import FORCES, GAPS
from text import counted, interval, number, table


def cost(data):
    rows, every = [], {}
    for name, study in data.studies.items():
        for solid in SOLIDS:
            some = [r for r in study["replicates"] if r["solid"] == solid]
            if some:
                seconds = [sum(r["stages"].values()) for r in some]
                out = len(some) - len([r for r in data.counted(solid, some[0]["particles"]) if r in some])
                rows.append([name, f"{solid} {some[0]['particles']}", str(len(some)), str(out),
                             f"{statistics.median(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
            for r in some:
                for stage, time in r["stages"].items():
                    every[stage] = every.get(stage, 0) + time
    share = ", ".join(f"{stage} {number(100 * seconds / sum(every.values()), 1)} %"
                      for stage, seconds in sorted(every.items(), key=lambda item: -item[1]))
    commits = sorted({commit for study in data.studies.values() for commit in study["git"]})
    alone = sum(sum(r["stages"].values()) * (0.25 if name.startswith("paper-400") else 1)
                for name, study in data.studies.items() for r in study["replicates"]) / 60
    return table(["study", "", "replicates", "of these in no mean", "median CPU s", "CPU minutes in all"], rows) + \
        (f"\n{alone:.0f} CPU minutes with a quarter of N = 400. By stage: {share}. "
         f"Made by commits {', '.join(commits)}.\n")


BLOCKS = {**held.BLOCKS, **counting.BLOCKS, **rank.BLOCKS, **motions.BLOCKS, **forces.BLOCKS, "cost": cost}


class UnknownValue(Exception):
    """A name that the page uses and nothing answers to."""


def counts_of(data, what):
    """Numbers over all solids and sizes."""
    if what in ("bins", "zero_G", "zero_K"):
        return str(held.nearer_zero(data)[("bins", "zero_G", "zero_K").index(what)])
    if what in ("median_G", "median_K"):
        return number(held.median_size(data, f"omega_over_root_{what[-1]}"), 2)
    if what in ("excesses", "not_zero"):
        return str(rank.excess_counts(data)[what == "not_zero"])
    if what in ("told", "equal"):
        return str(forces.cone_total(data)[("told", "equal").index(what)])
    if what in ("curves_f", "straight_f"):
        found = forces.straight(data, (FORCES, ("lower_order",)), forces.WEAK)
        return str(found[what == "straight_f"])
    if what in ("curves_h", "straight_h"):
        found = forces.straight(data, (GAPS[:1], GAPS[1:]), forces.STEPS_OF_GAP)
        return str(found[what == "straight_h"])
    raise UnknownValue(what)


def value_of(data, name):
    """`at COLUMN SOLID N Δφ`, `nearest COLUMN SOLID N`, `slope COLUMN SOLID N LOWER`, `law COLUMN SOLID N LOWER UPPER`
    (one exponent over a range), `limit SOLID N`, `missing SOLID N`, `infinite SOLID`, `excess SOLID N [Δφ]`, `force SOLID`, `gap SOLID`, `count WHAT`."""
    what, *rest = name.split()
    if what == "count":
        return counts_of(data, *rest)
    if what == "infinite":
        return interval(rank.infinite(data, *rest))
    if what == "force":
        return counted(forces.common(data, rest[0], FORCES, forces.WEAK))
    if what == "gap":
        return counted(forces.common(data, rest[0], GAPS[1:], forces.STEPS_OF_GAP))
    if what in ("limit", "missing", "threshold"):
        solid, particles = rest[0], int(rest[1])
        if what == "missing":
            return counted(rank.missing_limit(data, solid, particles))
        chosen, thresholds = counting.stiff_limit(data, solid, particles)
        return interval(chosen) if what == "limit" else number(thresholds, 2)
    if what == "excess" and len(rest) == 3:
        return counted(rank.excess(data, rest[0], int(rest[1]), 400, float(rest[2])))
    if what == "excess":
        return forces.excess_exponent(data, rest[0], int(rest[1]))
    column, solid, particles, *where = rest
    particles = int(particles)
    if what == "at":
        return counted(data.at(solid, particles, column, float(where[0])))
    if what == "nearest":
        return counted(data.nearest(solid, particles, column))
    if what == "slope":
        found = data.slopes(solid, particles, column, held.BINS)
        return counted(found[held.BINS.index(float(where[0]))])
    if what == "law":
        return counted(rank.exponent_in_range(data, solid, particles, column, *map(float, where)))
    raise UnknownValue(name)
