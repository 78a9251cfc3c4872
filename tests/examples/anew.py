"""Computes replicates of a page's studies again and compares them with the committed data."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path


def gathered(isojam, folder, runs):
    """Runs the gather.py of an example for some replicates of its studies. Returns {name of a data file: its content}.

    A run is a tuple: study, name of its results, shard, measures to add."""
    with tempfile.TemporaryDirectory() as here:
        results = Path(here)
        for study, name, shard, measures in runs:
            commands = [["run", folder / f"{study}.json", "--shard", shard, "-o", results / name, "--quiet"]]
            if measures:
                commands.append(["measure", results / name, "--add", measures])
            for command in commands:
                subprocess.run([isojam, *command], check=True, capture_output=True)
        subprocess.run([sys.executable, "-B", folder / "gather.py", isojam, results, results / "out"], check=True,
                       capture_output=True)
        return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in (results / "out").glob("*.json")}


def rows_of(study):
    return study["replicates"] if isinstance(study, dict) else study


def phi_j_of(row):
    return row["phi_j"]["phi_j"] if isinstance(row["phi_j"], dict) else row["phi_j"]


# The data were computed by version 0.1.0. Its compression gives the same bits as that of later versions, but after a
# rearrangement of the decompression later versions reach other states. A single packing then has another φ_J, within the
# spread of φ_J between packings.
BY_REARRANGEMENTS = 0.01


def same_packings(test, committed, anew):
    """Checks that every replicate in `anew`, {study: replicates}, has the φ_J of the same replicate in `committed` within
    BY_REARRANGEMENTS. Returns the number of replicates."""
    compared = 0
    for name, study in anew.items():
        for row in rows_of(study):
            place = [row[key] for key in ("solid", "particles", "replicate")] + [row.get("setting")]
            before = [old for old in rows_of(committed[name])
                      if [old[key] for key in ("solid", "particles", "replicate")] + [old.get("setting")] == place]
            test.assertEqual(len(before), 1, (name, place))
            print(name, place, "φ_J", phi_j_of(row), "committed", phi_j_of(before[0]))
            test.assertLess(abs(phi_j_of(row) - phi_j_of(before[0])), BY_REARRANGEMENTS, (name, place))
            test.assertEqual(row["status"], before[0]["status"], (name, place))
            compared += 1
    return compared
