"""Extracts the data of the page: python3 gather.py ISOJAM RESULTS FILE STUDY...

Writes FILE from the records, the tables and the exported contacts in the results directories RESULTS/STUDY. For each
replicate, it has the settings, the density, the columns of its states, and the branching ratio of the face-face
contacts in its last state. Numbers are rounded as in records.py."""

import csv
import json
import subprocess
import sys
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from records import constraints_with, found, records_of, write  # noqa: E402

# Column of a state: where it is in the record.
METHODS = ("fit", "trough")
COLUMNS = {
    "phi": "density", "delta": "delta_phi", "Z": "contacts/Z", "C": "contacts/C", "Z_ff_fit": "contacts/Z_ff",
    "Z_ff_trough": "contacts/trough/Z_ff", "C_trough": "contacts/trough/C",
    "Z_grown": "contacts/Z_grown", "tension": "contacts/tension", "Q6": "order/Q6",
    **{f"{name}_{method}": f"percolation/{method}/{place}" for method in METHODS for name, place in (
        ("S", "S"), ("largest", "largest"), ("winding", "winding_rank"), ("S_random", "random/S"),
        ("winds_random", "random/winds"))}}


def branching(contacts):
    """Branching ratio ⟨k(k − 1)⟩/⟨k⟩ of the face-face contacts, where k is their number on a particle, and its expected
    value for as many random contacts. `contacts` has (a, b, True for a face-face contact); None for fewer than two."""
    total, chosen = len(contacts), sum(flat for _, _, flat in contacts)
    if chosen < 2:
        return None, None

    def pairs(some):
        degrees = Counter(particle for a, b, _ in some for particle in (a, b))
        return sum(k * (k - 1) for k in degrees.values())

    # Two given contacts are both among the random ones with the probability m(m − 1)/(M(M − 1)).
    expected = pairs(contacts) * chosen * (chosen - 1) / (total * (total - 1))
    return pairs([c for c in contacts if c[2]]) / (2 * chosen), expected / (2 * chosen)


def contacts_of(isojam, directory):
    """Contacts in the last states, {name of the replicate: list of (a, b, True for a face-face contact)}."""
    command = [isojam, "export", directory, "all", "--format", "contacts"]
    made = {}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as export:
        for row in csv.DictReader(export.stdout):
            made.setdefault(row["replicate"], []).append((int(row["a"]), int(row["b"]), row["class"] == "face_face"))
    if export.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {export.returncode}")
    return made


def constraints_with_scaled(state, particles, factor):
    """C with the fitted cut-offs multiplied by a factor; None without fitted cut-offs."""
    fits = [found(state, f"contacts/{kind}_fit") for kind in ("face_face", "edge_face")]
    if any(found(fit, "verdict") != "fitted" for fit in fits):
        return None
    return constraints_with(state, particles, *(factor * fit["cutoff"] for fit in fits))


def replicate_of(record, contacts):
    spec = record["spec"]
    cohesion = spec["protocol"].get("cohesion", {"strength": 0, "range": 0.1, "until": "decompression"})
    made = {"solid": spec["solid"], "particles": spec["particles"], "replicate": spec["replicate"],
            "w": cohesion["strength"], "h": cohesion["range"], "until": cohesion["until"], "status": record["status"],
            "flags": record.get("flags") or [], "cpu": record["timing"]["cpu_seconds"]}
    if record["status"] != "done":
        return made
    states = {name: [found(state, place) for state in record["states"]] for name, place in COLUMNS.items()}
    for name, factor in (("C_half", 0.5), ("C_double", 2)):
        states[name] = [constraints_with_scaled(state, spec["particles"], factor) for state in record["states"]]
    states = {name: values for name, values in states.items() if any(value is not None for value in values)}
    cycles = [{**cycle, **contacts} for cycle, contacts in zip(record.get("cycles", []),
                                                               found(record, "contacts/cycles") or [])]
    made |= {"phi": record.get("phi_0", record["phi_j"]["phi_j"]), "states": states}
    if cycles:
        made["cycles"] = cycles
    last = found(record["states"][-1], "percolation/fit")
    if last and "bonds" in last:
        made["bonds"], made["loops"] = last["bonds"], last["bonds"] - sum((s - 1) * n for s, n in last["sizes"])
    if "Z_ff_fit" in states and states["Z_ff_fit"][-1]:
        made["branching"], made["branching_random"] = branching(contacts)
    return made


def study_of(isojam, directory):
    records = list(records_of(directory))
    tables = json.loads((directory / "tables.json").read_text(encoding="utf-8"))
    contacts = contacts_of(isojam, directory)
    return {"git": sorted({record["provenance"]["git"] for _, record in records}), "exclude": tables["exclude"],
            "replicates": [replicate_of(record, contacts.get(name)) for name, record in records]}


def main(isojam, results, file, *studies):
    Path(file).parent.mkdir(parents=True, exist_ok=True)
    write(Path(file), {study: study_of(isojam, Path(results) / study) for study in studies})


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
