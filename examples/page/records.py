"""Reads the records of a results directory, and writes the rounded values that a page uses, one line per replicate."""

import json


def records_of(directory):
    """Pairs (name, record), sorted by name; none if the directory does not exist."""
    for path in sorted((directory / "records").glob("*.json")):
        with open(path, encoding="utf-8") as file:
            yield path.stem, json.load(file)


def found(value, place):
    """Value in a record at a place, which consists of keys or indices separated by "/"; None if it is missing."""
    for key in place.split("/"):
        if isinstance(value, list):
            value = value[int(key)] if int(key) < len(value) else None
        elif isinstance(value, dict) and key in value:
            value = value[key]
        else:
            return None
    return value


def rounded(value, digits=4):
    """Rounds numbers: φ to nine significant digits, E/N to six, all others to `digits`."""
    if isinstance(value, float):
        return float(f"{value:.{digits}g}")
    if isinstance(value, list):
        return [rounded(item, digits) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item, 9 if key in ("phi", "phi_j") else 6 if key in ("E", "mean") else digits)
                for key, item in value.items()}
    return value


def write(path, studies):
    """Writes {name: {..., "replicates": list}} as JSON with one line per replicate, so that diffs are readable."""
    parts = []
    for name, study in rounded(studies).items():
        head = json.dumps({key: item for key, item in study.items() if key != "replicates"})[:-1]
        lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in study["replicates"])
        parts.append(f'"{name}": {head}, "replicates": [\n{lines}\n]}}')
    path.write_text("{\n" + ",\n".join(parts) + "\n}\n", encoding="utf-8")
