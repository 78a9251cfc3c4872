"""Blocks of the page, {name: function from data to Markdown}, and the numbers within its sentences."""

import statistics

import counting
import evidence
import forces
import held
import rank
from data import SOLIDS
from gather import FORCES, GAPS
from text import interval, number, significant, table


OF_THE_PAPER = ("backbone", "difference_modes")  # measures that `make rigidity` does not need


def seconds_of(replicate):
    return {stage: time for stage, time in replicate["stages"].items() if stage not in OF_THE_PAPER}


def cost(data):
    rows, every = [], {}
    for name, study in data.studies.items():
        for solid in SOLIDS:
            some = [r for r in study["replicates"] if r["solid"] == solid]
            if some:
                seconds = [sum(seconds_of(r).values()) for r in some]
                out = len(some) - len([r for r in data.counted(solid, some[0]["particles"]) if r in some])
                rows.append([name, f"{solid} {some[0]['particles']}", str(len(some)), str(out),
                             f"{statistics.median(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
            for r in some:
                for stage, time in seconds_of(r).items():
                    every[stage] = every.get(stage, 0) + time
    shares = [[f"`{stage}`", number(100 * seconds / sum(every.values()), 1)]
              for stage, seconds in sorted(every.items(), key=lambda item: -item[1])]
    commits = sorted({commit for study in data.studies.values() for commit in study["git"]})
    alone = sum(sum(seconds_of(r).values()) * (0.25 if name.startswith("paper-400") else 1)
                for name, study in data.studies.items() for r in study["replicates"]) / 60
    return table(["study", "solid, N", "replicates", "excluded", "CPU time, median, s", "all, minutes"], rows) + \
        "\n" + table(["stage", "share of the CPU time, %"], shares) + \
        (f"\n`make rigidity` runs a quarter of N = 400. It takes {alone:.0f} CPU minutes, or {alone / 2:.0f} minutes "
         f"on two cores. The records were made by commits {', '.join(commits)}.\n")


BLOCKS = {**evidence.BLOCKS, **held.BLOCKS, **counting.BLOCKS, **rank.BLOCKS, **forces.BLOCKS,
          "cost": cost}


class UnknownValue(Exception):
    """The page uses a value that is not defined."""


def counts_of(data, what):
    """Numbers over all solids and sizes."""

    def laws_of_forces():
        return forces.straight(data, (FORCES, ("lower_order",)), lambda _: forces.WEAK)

    def laws_of_gaps():
        return forces.straight(data, (GAPS[:1], GAPS[1:]), lambda solid: forces.open_gaps(data, solid))

    known = {
        "sure": lambda: held.about_sure(data, "omega_over_root_G")[0],
        "above_G": lambda: held.about_sure(data, "omega_over_root_G")[1],
        "above_K": lambda: held.about_sure(data, "omega_over_root_K")[1],
        "excesses": lambda: rank.excess_counts(data)[0], "not_zero": lambda: rank.excess_counts(data)[1],
        "curves_f": lambda: laws_of_forces()[0], "straight_f": lambda: laws_of_forces()[1],
        "curves_h": lambda: laws_of_gaps()[0], "straight_h": lambda: laws_of_gaps()[1]}
    if what in known:
        return str(known[what]())
    end = what.removeprefix("least_").removeprefix("greatest_")
    if what != end and end in ("G", "K"):
        found = held.about_sure(data, f"omega_over_root_{end}")[2 if what.startswith("least") else 3]
        return "–" if found is None else number(found, 3)
    if what == "most_of_size":
        return number(rank.excess_counts(data)[2], 2)
    raise UnknownValue(what)


def value_of(data, name):
    """`count WHAT`, `distance SOLID N` (the smallest Δφ) or `infinite SOLID` (m as Δφ → 0 and N → ∞)."""
    what, *rest = name.split()
    if what == "count":
        return counts_of(data, *rest)
    if what == "infinite":
        return interval(rank.infinite(data, *rest))
    if what == "distance":
        nearest = data.nearest_distance(rest[0], int(rest[1]))
        return significant(nearest["mean"] if nearest else None, 2)
    raise UnknownValue(name)
