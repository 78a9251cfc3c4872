"""Extracts the data of the page: python3 gather.py ISOJAM RESULTS OUT

Writes OUT/records.json. For each replicate of the studies below RESULTS it has flags, cost, φ_J and the columns that
the page needs of every state. From the contacts of every state (keep_path) it has the output of network.py. Writes
OUT/search.json, with φ and E/N of every state of the search of the protocol. Numbers are rounded: φ to nine digits, E/N
to six, all others to four. Missing studies are left out, and incomplete ones count with the replicates that they have.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

# network.py finds what pages have in common.
import network
from records import contacts_of, found, records_of, replicate_of, write

STUDIES = ("paper-100", "paper-100-tetrahedra", "paper-400", "paper-400-tetrahedra", "paper-cubes", "paper-rule",
           "paper-rule-base")
SEARCHES = ("paper-search-protocol", "paper-search-400")
# Column of a state: where it is in the record.
COLUMNS = {
    "phi": "phi", "delta_phi": "delta_phi", "E": "energy_per_particle", "residual": "residual", "descents": "descents",
    **{name: f"contacts/{name}" for name in ("Z", "Z_ff", "Z_ef", "Z_l", "C")},
    "cut_ff": "contacts/face_face_fit/cutoff", "cut_ef": "contacts/edge_face_fit/cutoff",
    **{f"{name}_fixed": f"contacts/fixed_cutoffs/{name}" for name in ("Z_ff", "Z_ef", "Z_l", "C")},
    "Q6": "order/Q6", "S_order": "order/S",
    "S": "clusters/S", "percolates": "clusters/percolates", "spans": "clusters/spans", "l_max": "clusters/l_max",
    "body_l_max": "clusters/body_l_max", "D_max": "clusters/D",
    "zero": "modes/zero", "negative": "modes/negative", "omega_l": "modes/omega_l", "omega_h": "modes/omega_h",
    "amplitude": "modes/face_face_amplitude", "members": "modes/face_face_particles", "K": "moduli/K",
    "rows": "rigidity/classes/constraints", "rank": "rigidity/classes/rank",
    "self_stress": "rigidity/classes/self_stress", "self_stress_normals": "rigidity/normals/self_stress",
    "backbone_removed": "backbone/removed", "backbone_Z": "backbone/Z", "backbone_zero": "backbone/zero",
    "backbone_negative": "backbone/negative", "backbone_omega_l": "backbone/omega_l", "backbone_K": "backbone/K",
    "backbone_missing": "backbone/classes/missing",
    "unstable_exact": "difference_modes/exact/share", "unstable_h4": "difference_modes/h4/share",
    "unstable_h6": "difference_modes/h6/share", "unstable_h8": "difference_modes/h8/share"}
POINTS = 60  # of a curve of angles


def columns_of(states):
    """Columns that at least one state has."""
    columns = {name: [found(state, place) for state in states] for name, place in COLUMNS.items()}
    for fit, column in (("contacts/face_face_fit", "cut_ff"), ("contacts/edge_face_fit", "cut_ef")):
        columns[column] = [value if found(state, f"{fit}/verdict") == "fitted" else None
                           for value, state in zip(columns[column], states)]
    columns["near_rattlers"] = [len(found(state, "modes/near_rattlers") or []) for state in states]
    return {name: values for name, values in columns.items() if any(value is not None for value in values)}


def quantiles(angles):
    """Angles below which (i + ½)/POINTS of them lie, in degrees."""
    ordered = sorted(angles)
    return [math.degrees(ordered[int((i + 0.5) / POINTS * len(ordered))]) for i in range(POINTS)]


def drawn_of(records):
    """Data of the figures, by solid and size, from replicates that are not crystalline: angles of all states nearest
    jamming together, and the spectrum of the first replicate in its nearest state with three zero modes."""
    angles, made = {}, {}
    for record in records:
        if record["status"] != "done" or "crystalline" in record["flags"]:
            continue
        name, nearest = f"{record['spec']['solid']} {record['spec']['particles']}", record["nearest"]
        for kind in ("edge_face", "face_face"):
            angles.setdefault(name, {}).setdefault(kind, []).extend(found(nearest, f"contacts/angles/{kind}") or [])
        resolved = [state for state in record["states"] if found(state, "modes/zero") == 3]
        if resolved and "spectrum" not in made.setdefault(name, {}):
            made[name] |= {"replicate": record["spec"]["replicate"], "delta_phi": resolved[-1]["delta_phi"],
                           "spectrum": [found(resolved[-1], f"modes/{end}/omega") for end in ("lowest", "highest")]}
    for name, kinds in angles.items():
        made.setdefault(name, {}).update({kind: quantiles(some) for kind, some in kinds.items() if some})
    return made


def gap_of(state, which):
    gap = found(state, f"contacts/{which}_gap") or {}
    return gap.get("cutoff") if gap.get("verdict") == "separated" else None


def network_of(contacts, record):
    """For every state: C by other cut-offs, shares of the regions of c(θ_ff), emerged contacts, and the distribution of
    face-face contacts over particles."""
    particles, columns = record["spec"]["particles"], columns_of(record["states"])
    critical = math.radians(min(value for name, value in record["critical"].items() if name.startswith("ff")))
    made = {"by_cutoffs": [], "regions": [], "emerged": [], "hyper_random": [], "neighbours": []}
    for i, state in enumerate(contacts):
        fits = {"ff": columns["cut_ff"][i], "ef": columns["cut_ef"][i],
                "gap_ff": gap_of(record["states"][i], "face_face")}
        made["by_cutoffs"].append(network.by_cutoffs(state, fits, particles))
        counts = network.regions(state, critical)
        made["regions"].append(counts)
        made["emerged"].append(int(network.emerged(counts, critical)))
        made["hyper_random"].append(int(network.hyper_random(state, record["random_angle"])))
        made["neighbours"].append([*network.neighbours(state, fits["ff"], particles), len(state["a"])]
                                  if fits["ff"] is not None else None)
    return made


def with_states(record):
    """The parts of a record that the page needs, without its contacts."""
    made = replicate_of(record)
    if record["status"] != "done":
        return made
    return {**made, "evaluations": [record["path"][state["step"]]["evaluations"] for state in record["states"]],
            "states": columns_of(record["states"])}


def study_of(isojam, directory, critical):
    replicates, records = [], []
    for name, record in records_of(directory):
        records.append(record)
        made = with_states(record)
        angle = found(record, "nearest/contacts/angles/edge_face_random_contact/angle")
        if angle and (directory / "paths" / f"{name}.json").exists():
            record["critical"] = critical[record["spec"]["solid"]]
            record["random_angle"] = angle
            made["network"] = network_of(contacts_of(isojam, directory, name), record)
        replicates.append(made)
    return {"git": sorted({r["provenance"]["git"] for r in records}), "drawn": drawn_of(records),
            "replicates": replicates}


CRYSTALLINE = 0.32  # Q6 above it: the program's own limit, which it flags by its measure of contacts; here order alone


def search_of(directory):
    """For each replicate its settings, flags, φ_J and the states for fit windows."""
    made = []
    for _, record in records_of(directory):
        spec, protocol = record["spec"], record["spec"]["protocol"]
        one = {"solid": spec["solid"], "particles": spec["particles"], "replicate": spec["replicate"],
               "flags": record.get("flags") or [],
               "setting": {"before": protocol["target_before_relaxation"], "step": protocol["consolidation_step"],
                           "budget": protocol["consolidation_evaluations"], "target": protocol["target_energy"]},
               "cpu": record["timing"]["cpu_seconds"], "status": record["status"]}
        if record["status"] == "done":
            if (found(record, "nearest/order/Q6") or 0) > CRYSTALLINE:
                one["flags"] = sorted({*one["flags"], "crystalline"})
            one |= {"phi_j": record["phi_j"]["phi_j"], "phi": [s["phi"] for s in record["states"]],
                    "E": [s["energy_per_particle"] for s in record["states"]]}
        made.append(one)
    return made


def critical_angles(isojam, directories):
    """Critical angles of each solid in degrees: closed forms, copied from the tables."""
    made = {}
    for directory in directories:
        command = [isojam, "aggregate", directory, "--exclude", "none", "--format", "json", "--quiet"]
        rows = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["rows"]
        made |= {row["solid"]: row["critical_angles"] for row in rows if row.get("critical_angles")}
    return made


def main():
    isojam, results, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    out.mkdir(parents=True, exist_ok=True)
    critical = critical_angles(isojam, [results / name for name in STUDIES if (results / name / "records").is_dir()])
    studies = {name: study_of(isojam, results / name, critical) for name in STUDIES
               if (results / name / "records").is_dir()}
    write(out / "records.json", {**{name: study for name, study in studies.items() if study["replicates"]},
                                 "critical_angles": {"angles": critical, "replicates": []}})
    write(out / "search.json", {name: search_of(results / name) for name in SEARCHES
                                if (results / name / "records").is_dir()})


if __name__ == "__main__":
    main()
