"""Applies the diffs of docs/developing.md, whose fields must then appear wherever they are promised.

extending.py SOURCE          checks that each diff still fits the sources
extending.py SOURCE BUILD    also builds a copy of the sources with all diffs in BUILD, and runs it
"""

import csv
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Field, the place of its value in a record, and its name in tables.
QUANTITY = ("number", lambda record: record["states"][record["nearest"]]["clusters"]["number"], "n_clusters")
MEASURE = ("number", lambda record: record["states"][record["nearest"]]["rattlers"]["number"], "rattlers")
PARAMETER = "failed_steps"
MANIFEST = {"name": "extended", "sweep": {"solid": ["octahedron"], "particles": [64]}, "replicates": 1, "seed": 1,
            "protocol": {PARAMETER: 3, "final_distance": 0.01}, "measure": ["contacts", "clusters", "rattlers"]}


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, capture_output=True, **options).stdout


def diffs(source):
    text = (source / "docs/developing.md").read_text(encoding="utf-8")
    found = re.findall(r"^```diff\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert len(found) == 3, f"{len(found)} diffs"
    return found


def copied(source, folder):
    """A copy of the sources with all diffs."""
    for name in run("git", "-C", source, "ls-files").split("\n"):
        if (source / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes((source / name).read_bytes())
    for diff in diffs(source):
        run("patch", "-p1", "--fuzz=0", cwd=folder, input=diff)
        print(re.findall(r"^\+\+\+ b/(\S+)", diff, re.MULTILINE))


def check(program, module, folder):
    (folder / "manifest.json").write_text(json.dumps(MANIFEST), encoding="utf-8")
    run(program, "run", folder / "manifest.json", "-o", folder / "results")
    record = json.loads(next((folder / "results/records").glob("*.json")).read_text(encoding="utf-8"))
    assert record["spec"]["protocol"][PARAMETER] == 3
    schema = json.loads(run(program, "schema", "record"))
    manifest = json.loads(run(program, "schema", "manifest"))
    assert f'"{PARAMETER}"' in json.dumps(manifest) and PARAMETER in run(program, "fields", PARAMETER)
    table = run(program, "export", folder / "results", "all", "--format", "replicates")
    rows = list(csv.DictReader(io.StringIO(table)))
    frame = json.loads(run(sys.executable, "-c", "import isojam, json, sys\nrow = isojam.load(sys.argv[1]).replicates"
                           ".iloc[0]\nprint(json.dumps({n: float(row[n]) for n in sys.argv[2:]}))", folder / "results",
                           QUANTITY[2], MEASURE[2], env={**os.environ, "PYTHONPATH": str(module)}))
    for key, value_of, name in (QUANTITY, MEASURE):
        value = value_of(record)
        assert key in json.dumps(schema) and name in run(program, "fields", name)
        assert float(rows[0][name]) == value == frame[name], (name, value, rows[0][name], frame)
        print(f"{name} = {value} in the record, in CSV and in Python")


def main(source, build=None):
    source = pathlib.Path(source).resolve()
    if build is None:
        with tempfile.TemporaryDirectory() as folder:
            return copied(source, pathlib.Path(folder))
    folder = pathlib.Path(build).resolve() / "source"
    copied(source, folder)
    run("cmake", "-S", folder, "-B", folder.parent / "build", "-G", "Ninja", "-DISOJAM_NATIVE=ON", "-DISOJAM_TESTS=OFF")
    run("cmake", "--build", folder.parent / "build")
    check(folder.parent / "build/isojam", folder.parent / "build/python", folder.parent)


if __name__ == "__main__":
    main(*sys.argv[1:])
