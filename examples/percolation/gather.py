"""Extracts the data of the page: python3 gather.py RESULTS FILE STUDY...

Writes FILE from the records and tables in the results directories RESULTS/STUDY. For each replicate, it has the settings,
the density and the columns of its states. Numbers are rounded as in records.py."""

import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from records import found, records_of, write  # noqa: E402

# Column of a state: where it is in the record.
METHODS = ("fit", "gap", "trough")
COLUMNS = {
    "phi": "phi", "delta": "delta_phi", "Z": "contacts/Z", "C": "contacts/C", "Z_ff_fit": "contacts/Z_ff",
    "Z_ff_gap": "contacts/Z_ff_gap", "Z_ff_trough": "contacts/trough/Z_ff", "Z_grown": "contacts/Z_grown",
    "tension": "contacts/tension", "Q6": "order/Q6",
    **{f"{name}_{method}": f"percolation/{method}/{place}" for method in METHODS for name, place in (
        ("S", "S"), ("largest", "largest"), ("winding", "winding_rank"), ("S_random", "random/S"),
        ("winds_random", "random/winds"))}}


def replicate_of(record):
    spec = record["spec"]
    cohesion = spec["protocol"].get("cohesion", {"strength": 0, "range": 0.1, "until": "decompression"})
    made = {"solid": spec["solid"], "particles": spec["particles"], "replicate": spec["replicate"],
            "w": cohesion["strength"], "h": cohesion["range"], "until": cohesion["until"], "status": record["status"],
            "flags": record.get("flags") or [], "cpu": record["timing"]["cpu_seconds"]}
    if record["status"] != "done":
        return made
    states = {name: [found(state, place) for state in record["states"]] for name, place in COLUMNS.items()}
    states = {name: values for name, values in states.items() if any(value is not None for value in values)}
    cycles = [{**cycle, **contacts} for cycle, contacts in zip(record.get("cycles", []),
                                                               found(record, "contacts/cycles") or [])]
    density = record.get("phi_0", record["phi_j"]["phi_j"])
    return {**made, "phi": density, "states": states, **({"cycles": cycles} if cycles else {})}


def study_of(directory):
    records = [record for _, record in records_of(directory)]
    tables = json.loads((directory / "tables.json").read_text(encoding="utf-8"))
    return {"git": sorted({record["provenance"]["git"] for record in records}), "exclude": tables["exclude"],
            "replicates": [replicate_of(record) for record in records]}


def main(results, file, *studies):
    Path(file).parent.mkdir(parents=True, exist_ok=True)
    write(Path(file), {study: study_of(Path(results) / study) for study in studies})


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
