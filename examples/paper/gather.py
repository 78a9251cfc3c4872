"""Gathers what the page is made from: python3 gather.py ISOJAM RESULTS OUT

Writes OUT/tables.json, the tables that `ISOJAM aggregate` makes of RESULTS/paper-100, paper-400 and paper-cubes, and
OUT/records.json, what the page needs of single records: costs, counts of unstable states, ranks, and jamming densities
of replicates that began alike and were jammed in different ways.
"""

import json
import subprocess
import sys
from pathlib import Path

MAIN = ("paper-100", "paper-400", "paper-cubes")
BASE = "paper-base"
VARIED = ("paper-rule", "paper-window", "paper-energy", "paper-step", "paper-reading")


def records_of(directory):
    """Records in order of name; none if the directory is not there."""
    for path in sorted((directory / "records").glob("*.json")):
        with open(path, encoding="utf-8") as file:
            yield json.load(file)


def key_of(record):
    return record["spec"]["solid"], record["spec"]["particles"], record["spec"]["replicate"]


def cost_of(records):
    """CPU seconds of a study by solid and by stage."""
    solids, stages = {}, {}
    for record in records:
        solid = record["spec"]["solid"]
        solids.setdefault(solid, []).append(round(record["timing"]["cpu_seconds"], 1))
        for stage, seconds in record["timing"].get("stages", {}).items():
            stages[stage] = stages.get(stage, 0) + seconds
    return {"cpu_seconds": solids, "stages": {stage: round(seconds, 1) for stage, seconds in sorted(stages.items())}}


def stability_of(records):
    """By solid: states, those that are not minima with three zero modes, those with a near-rattler, the worst
    imbalance of forces; and what the records' clusters do."""
    counts = {}
    for record in records:
        if record["status"] != "done":
            continue
        here = counts.setdefault(
            record["spec"]["solid"],
            {"states": 0, "negative": 0, "more_than_three_zero": 0, "near_rattlers": 0, "stable_and_three_zero": 0,
             "residual": 0, "replicates": 0, "percolate": 0, "span": 0, "crystalline": 0})
        here["replicates"] += 1
        here["crystalline"] += "crystalline" in record["flags"]
        clusters = record["nearest"].get("clusters", {})
        here["percolate"] += clusters.get("percolates") or 0
        here["span"] += clusters.get("spans") or 0
        for state in record["states"]:
            modes = state["modes"]
            here["states"] += 1
            here["negative"] += modes["negative"] > 0
            here["more_than_three_zero"] += modes["zero"] > 3
            here["near_rattlers"] += len(modes["near_rattlers"]) > 0
            here["stable_and_three_zero"] += modes["negative"] == 0 and modes["zero"] == 3
            here["residual"] = max(here["residual"], state["residual"])
    return counts


def rigidity_of(records):
    """Rank of the constraints by class in the states nearest jamming, by solid and size."""
    ranks = {}
    for record in records:
        if record["status"] != "done" or record["flags"]:
            continue
        solid, particles, replicate = key_of(record)
        classes = record["nearest"]["rigidity"]["classes"]
        ranks.setdefault(f"{solid} {particles}", []).append(
            {"replicate": replicate, "constraints": classes["constraints"], "rank": classes["rank"],
             "self_stress": classes["self_stress"], "full_rank": 6 * particles - 3})
    return ranks


def by_key(directory):
    """Of each replicate that did not fail: φ_J, its flags, and the worst residual of the states behind φ_J."""
    return {key_of(r): {"phi_j": r["phi_j"]["phi_j"], "flags": r["flags"], "residual": r["phi_j"]["residual"]}
            for r in records_of(directory) if r["status"] == "done"}


def pairs_of(results):
    """φ_J of replicates that began alike: in the base study, and with one thing done otherwise."""
    base, pairs = by_key(results / BASE), {}
    for name in VARIED:
        for key, varied in by_key(results / name).items():
            if key in base:
                pairs.setdefault(name, []).append(
                    {"solid": key[0], "particles": key[1], "replicate": key[2], "base": base[key], "varied": varied})
    return pairs


def main():
    isojam, results, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    present = [results / name for name in MAIN if (results / name / "records").is_dir()]
    tables = subprocess.run([isojam, "aggregate", *present, "--format", "json", "--quiet"], check=True,
                            capture_output=True, text=True).stdout
    out.mkdir(parents=True, exist_ok=True)
    (out / "tables.json").write_text(tables, encoding="utf-8")
    gathered = {"studies": {}, "pairs": pairs_of(results)}
    for path in present:
        records = list(records_of(path))
        gathered["studies"][path.name] = {"git": sorted({r["provenance"]["git"] for r in records}),
                                          "cost": cost_of(records), "stability": stability_of(records),
                                          "rigidity": rigidity_of(records)}
    (out / "records.json").write_text(json.dumps(gathered, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
