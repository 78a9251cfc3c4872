"""Reads the records of a results directory, and writes the rounded values that a page uses, one line per replicate."""

import csv
import json
import subprocess
import sys


def records_of(directory):
    """Pairs (name, record), sorted by name; none if the directory does not exist."""
    for path in sorted((directory / "records").glob("*.json")):
        with open(path, encoding="utf-8") as file:
            yield path.stem, json.load(file)


def found(value, place):
    """Value in a record at a place, which consists of keys separated by "/"; None if it is missing."""
    for key in place.split("/"):
        if not isinstance(value, dict) or key not in value:
            return None
        value = value[key]
    return value


def replicate_of(record):
    """The parts of a record that every page needs. States are not included."""
    spec = record["spec"]
    made = {"solid": spec["solid"], "particles": spec["particles"], "replicate": spec["replicate"],
            "status": record["status"], "flags": record.get("flags") or [],
            "cpu": record["timing"]["cpu_seconds"], "stages": record["timing"].get("stages", {})}
    if record["status"] != "done":
        return made
    return {**made, "phi_j": {key: record["phi_j"].get(key) for key in (
        "phi_j", "ci95_half_width", "exponent", "residual")}}


def contacts_of(isojam, directory, name):
    """Contacts of every state of a replicate: one dict per state, with the lists a, b (particles), theta_ef, theta_ff
    (radians)."""
    command = [isojam, "export", directory, name, "--format", "contacts", "--path"]
    states = {}
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        for row in csv.DictReader(process.stdout):
            state = states.setdefault(int(row["state"]), {key: [] for key in ("a", "b", "theta_ef", "theta_ff")})
            for key, kind in (("a", int), ("b", int), ("theta_ef", float), ("theta_ff", float)):
                state[key].append(kind(row[key]))
        error = process.stderr.read()
    if process.returncode:
        sys.exit(f"{name}: {error}")
    return [states[i] for i in sorted(states)]


def rounded(value, digits=4):
    """Rounds numbers: φ and angles to nine significant digits, E/N to six, all others to `digits`."""
    if isinstance(value, float):
        return float(f"{value:.{digits}g}")
    if isinstance(value, list):
        return [rounded(item, digits) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item, 9 if key in ("phi", "phi_j", "angles") else 6 if key == "E" else digits)
                for key, item in value.items()}
    return value


def write(path, value):
    """Writes {name: list} or {name: {..., "replicates": list}} as JSON with one line per replicate, so that diffs are
    readable."""
    parts = []
    for name, entry in rounded(value).items():
        rows = entry["replicates"] if isinstance(entry, dict) else entry
        head = "".join(f'"{key}": {json.dumps(item)}, ' for key, item in entry.items() if key != "replicates") \
            if isinstance(entry, dict) else ""
        lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows)
        parts.append(f'"{name}": ' + (f'{{{head}"replicates": [\n{lines}\n]}}' if isinstance(entry, dict)
                                      else f"[\n{lines}\n]"))
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")
