"""Gathers what the page is made from: python3 gather.py ISOJAM RESULTS OUT

Writes OUT/tables.json, the tables that `ISOJAM aggregate` makes of RESULTS/paper-100, paper-400, paper-400-tetrahedra
and paper-cubes and, apart from them, of paper-nearest, all without replicates that are crystalline or ended short of
their goal (near-rattlers are no reason to leave one out); and OUT/records.json, what the page needs of single records:
costs, counts of unstable states, ranks, and jamming densities of replicates that began alike and were jammed in
different ways. To keep them small, numbers are rounded to six digits, and what is given against Δφ is without its
bootstrap. Studies that are not there, or not complete, are left out or count with what they have.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from verdicts import estimate_of

MAIN = ("paper-100", "paper-400", "paper-400-tetrahedra", "paper-cubes")
NEAREST = ("paper-nearest",)
LEFT_OUT = {"crystalline", "goal_not_reached"}
# Studies that do one thing otherwise, and the one that does not.
VARIED = {"paper-rule": "paper-rule-base", "paper-window": "paper-base", "paper-energy": "paper-base",
          "paper-reading": "paper-base"}


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
    """By solid: replicates, those that failed and those left out; states, those that are not minima with three zero
    modes, those with a near-rattler, the worst imbalance of forces; and what clusters do in the states nearest
    jamming."""
    counts = {}
    for record in records:
        here = counts.setdefault(
            record["spec"]["solid"],
            {"states": 0, "negative": 0, "near_rattlers": 0, "stable_and_three_zero": 0, "residual": 0,
             "replicates": 0, "failed": 0, "percolate": 0, "span": 0, "crystalline": 0, "goal_not_reached": 0})
        here["replicates"] += 1
        if record["status"] != "done":
            here["failed"] += 1
            continue
        for flag in LEFT_OUT:
            here[flag] += flag in record["flags"]
        clusters = record["nearest"].get("clusters", {})
        here["percolate"] += clusters.get("percolates") or 0
        here["span"] += clusters.get("spans") or 0
        for state in record["states"]:
            modes = state["modes"]
            here["states"] += 1
            here["negative"] += modes["negative"] > 0
            here["near_rattlers"] += len(modes["near_rattlers"]) > 0
            here["stable_and_three_zero"] += modes["negative"] == 0 and modes["zero"] == 3
            here["residual"] = max(here["residual"], state["residual"])
    return counts


def counting(records):
    """Those that neither failed nor are left out."""
    return [record for record in records if record["status"] == "done" and not LEFT_OUT & set(record["flags"])]


def rigidity_of(records):
    """Rank of the constraints by class in the states nearest jamming, by solid and size."""
    ranks = {}
    for record in counting(records):
        solid, particles, replicate = key_of(record)
        classes = record["nearest"]["rigidity"]["classes"]
        ranks.setdefault(f"{solid} {particles}", []).append(
            {"replicate": replicate, "constraints": classes["constraints"], "rank": classes["rank"],
             "self_stress": classes["self_stress"], "full_rank": 6 * particles - 3})
    return ranks


def extents_of(records):
    """Largest extent of a cluster between vertices, over L, in the states nearest jamming; by solid and size."""
    extents = {}
    for record in counting(records):
        solid, particles, _ = key_of(record)
        extent = record["nearest"]["clusters"].get("body_l_max")
        if extent is not None:
            extents.setdefault(f"{solid} {particles}", []).append(extent)
    return {name: {"body_l_max": estimate_of(values)} for name, values in extents.items()}


def by_key(directory):
    """Of each replicate that did not fail: φ_J, its flags, and the worst residual of the states behind φ_J."""
    return {key_of(r): {"phi_j": r["phi_j"]["phi_j"], "flags": r["flags"], "residual": r["phi_j"]["residual"]}
            for r in records_of(directory) if r["status"] == "done"}


def minimisations_of(directory):
    """Of each state of the expansions: solid, distance from jamming, evaluations, residual and why it was left."""
    return [{"solid": r["spec"]["solid"], "delta_phi": s["delta_phi"], "residual": s["residual"],
             "evaluations": r["path"][s["step"]]["evaluations"], "stopped": s["stopped"]}
            for r in records_of(directory) for s in r.get("states", [])]


def pairs_of(results):
    """φ_J of replicates that began alike: in the study that is the base, and with one thing done otherwise."""
    pairs = {}
    for name, reference in VARIED.items():
        base = by_key(results / reference)
        for key, varied in by_key(results / name).items():
            if key in base:
                pairs.setdefault(name, []).append(
                    {"solid": key[0], "particles": key[1], "replicate": key[2], "base": base[key], "varied": varied})
    return pairs


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, list):
        return [rounded(item) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return value


def without_bootstrap(value):
    if isinstance(value, dict):
        return {key: without_bootstrap(item) for key, item in value.items() if key not in ("bootstrap95", "ci95")}
    return [without_bootstrap(item) for item in value] if isinstance(value, list) else value


def copy_of_those_that_count(results, directories):
    """Results as isojam reads them, but for the replicates that are left out."""
    copies = []
    for directory in directories:
        copy = results / directory.name
        (copy / "records").mkdir(parents=True)
        shutil.copy(directory / "manifest.json", copy)
        for path in sorted((directory / "records").glob("*.json")):
            with open(path, encoding="utf-8") as file:
                left_out = LEFT_OUT & set(json.load(file).get("flags") or [])
            if not left_out:
                shutil.copy(path, copy / "records")
        if any((copy / "records").iterdir()):
            copies.append(copy)
    return copies


def rows_of(isojam, directories):
    """The rows that isojam makes of the directories together."""
    with tempfile.TemporaryDirectory() as here:
        copies = copy_of_those_that_count(Path(here), directories)
        if not copies:
            return []
        command = [isojam, "aggregate", *copies, "--exclude", "none", "--format", "json", "--quiet"]
        rows = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["rows"]
    # Nothing is excluded from what is left.
    rows = [{key: value for key, value in row.items() if key != "excluded"} for row in rows]
    return [{**row, "series": without_bootstrap(row["series"])} for row in rows]


def write(path, value):
    """A line for each entry two levels down: small, and changes show."""
    parts = [f'"{name}": ' + ("[\n" + ",\n".join(json.dumps(row) for row in entry) + "\n]" if isinstance(entry, list) else
                              "{\n" + ",\n".join(f'"{key}": {json.dumps(row)}' for key, row in entry.items()) + "\n}")
             for name, entry in rounded(value).items()]
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")


def main():
    isojam, results, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    main_studies, nearest = ([results / name for name in names if (results / name / "records").is_dir()]
                             for names in (MAIN, NEAREST))
    studies = {}
    for path in [*main_studies, *nearest]:
        records = list(records_of(path))
        studies[path.name] = {"git": sorted({r["provenance"]["git"] for r in records}), "cost": cost_of(records),
                              "stability": stability_of(records), "rigidity": rigidity_of(records),
                              "extents": extents_of(records)}
    out.mkdir(parents=True, exist_ok=True)
    write(out / "tables.json", {"main": rows_of(isojam, main_studies), "nearest": rows_of(isojam, nearest)})
    write(out / "records.json", {"studies": studies, "pairs": pairs_of(results),
                                   "minimisations": {name: minimisations_of(results / name)
                                                     for name in ("paper-rule", "paper-rule-base")}})


if __name__ == "__main__":
    main()
