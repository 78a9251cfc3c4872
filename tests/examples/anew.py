"""Computes replicates of a page's studies again. They must have the values of the committed data on every processor."""

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


def without_times(row):
    return {key: value for key, value in row.items() if key not in ("cpu", "stages")}


def same_figures(test, committed, anew):
    """Checks that every replicate in `anew`, {study: replicates}, has the same values in `committed`, apart from times.
    Returns the number of replicates."""
    compared = 0
    for name, study in anew.items():
        for row in rows_of(study):
            place = [row[key] for key in ("solid", "particles", "replicate")] + [row.get("setting")]
            before = [old for old in rows_of(committed[name])
                      if [old[key] for key in ("solid", "particles", "replicate")] + [old.get("setting")] == place]
            test.assertEqual(len(before), 1, (name, place))
            test.assertEqual(without_times(row), without_times(before[0]), (name, place))
            compared += 1
    return compared
