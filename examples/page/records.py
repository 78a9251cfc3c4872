"""Reads the records of a results directory, and writes the rounded values that a page uses, one line per replicate."""

import json
import math


def records_of(directory):
    """Pairs (name, record), sorted by name; none if the directory does not exist."""
    for path in sorted((directory / "records").glob("*.json")):
        with open(path, encoding="utf-8") as file:
            yield path.stem, json.load(file)


def nearest_of(record):
    """State nearest jamming; None if the replicate failed."""
    return None if record.get("nearest") is None else record["states"][record["nearest"]]


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


def bin_of(cutoff, width):
    return math.floor(math.log10(cutoff) / width + 1e-9)


def counts_below(numbers, end):
    """Number of contacts in the bins below `end`."""
    return sum(count for i, count in enumerate(numbers["counts"], numbers["first"]) if i < end)


def cells_of(bins):
    """Triples of a bin of θ_ff, a bin of θ_ef and the number of contacts with both."""
    return zip(*[iter(bins["cells"])] * 3)


def constraints_with(state, particles, face_face, edge_face):
    """C with these cut-offs, from the histogram of the angles; None without a histogram or an edge-face contact.
    A cut-off within an occupied bin moves to the lower edge of the bin."""
    bins = found(state, "contacts/angle_bins")
    if not bins:
        return None
    ff, ef = (bin_of(cutoff, bins["width"]) for cutoff in (face_face, edge_face))
    flat = counts_below(bins["face_face"], ff)
    edges = counts_below(bins["edge_face"], ef) - sum(n for a, b, n in cells_of(bins) if a < ff and b < ef)
    # Without an edge-face contact, the gap of θ_ef is between face-face contacts and all others.
    return state["contacts"]["Z"] + 2 * (2 * flat + edges) / particles if edges else None


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
