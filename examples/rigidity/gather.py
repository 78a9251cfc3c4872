"""Gathers what the page is made from: python3 gather.py ISOJAM RESULTS OUT

Writes OUT/records.json: of each replicate of the studies below RESULTS its flags, cost, φ_J and, of every state, what
the page needs, column by column; quantiles of θ_ef from the contacts of every state; contacts by bands of stiffness,
and bins of forces and gaps. Numbers are rounded as ../page/records.py does. Studies that are not there, or not
complete, are left out or count with what they have.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

from records import contacts_of, found, records_of, replicate_of, write  # noqa: E402

STUDIES = ("rigidity-50", "rigidity-50-tetrahedra", "paper-100", "paper-100-tetrahedra", "rigidity-200",
           "rigidity-200-tetrahedra", "paper-400", "paper-400-tetrahedra", "rigidity-800")
# Column of a state: where it is in the record.
COLUMNS = {
    "phi": "phi", "E": "energy_per_particle", "Z": "Z", "Z_ff": "Z_ff", "Z_ef": "Z_ef", "C": "C",
    "omega_l": "modes/omega_l", "K": "moduli/K", "G": "moduli/G",
    "self_stress": "rigidity/classes/self_stress", "floppy_classes": "rigidity/classes/floppy",
    "missing_s": "prestress/missing", "self_stress_s": "prestress/self_stress",
    "second": "prestress/modes/held_by_second", "prestress": "prestress/modes/held_by_prestress",
    "looked_at": "prestress/modes/looked_at", "unresolved": "prestress/modes/unresolved",
    "worst_sum": "prestress/modes/worst_sum", "prestress_lambda": "prestress/modes/prestress_lambda",
    "floppy": "quartic/floppy", "quartic": "quartic/quartic",
    "c_floppy": "quartic/coefficient", "dimension": "one_sided/dimension", "least_margin": "one_sided/least_margin",
    "median_margin": "one_sided/median_margin", "outside": "one_sided/outside",
    "rows": "one_sided/constraints", "gaps": "gaps/within_distance", "weak": "gaps/weak_forces"}
THRESHOLDS = (1, 3, 10, 30, 100)
QUANTILES = (0.05, 0.1, 0.2, 0.3, 0.5)
CURVE = tuple((i + 0.5) / 40 for i in range(40))  # of the cumulative distributions that are drawn
DRAWN = (0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)  # at the states next to these
FORCES, GAPS = ("face_face", "edge_face", "lower_order"), ("faces", "edges")


def quantile(ordered, share):
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)] if ordered else None


def median_or_none(values):
    return quantile(sorted(values), 0.5) if values else None


def columns_of(states):
    """Those columns that some state has."""
    columns = {name: [found(state, place) for state in states] for name, place in COLUMNS.items()}
    for i, threshold in enumerate(THRESHOLDS):
        columns[f"C_s_{threshold}"] = [counts[i]["C"] if (counts := found(s, "prestress/thresholds")) else None
                                       for s in states]
    for share in ("normal", "tilt"):
        columns[f"{share}_share"] = [median_or_none(found(s, f"prestress/modes/{share}") or []) for s in states]
    for i in range(3):
        columns[f"rung_{i}"] = [rungs[i]["median"] if len(rungs := found(s, "quartic/rungs") or []) > i else None
                                for s in states]
    return {name: values for name, values in columns.items() if any(value is not None for value in values)}


def bins_of(state):
    """Of the nearest state, numbers in bins of forces by class and of gaps, from the first bin that holds any: [its
    lower edge's logarithm, numbers]; None where classes are not told."""
    gaps = state.get("gaps")
    if not gaps or not gaps["classes_told"]:
        return None
    made = {}
    for names, edges in ((FORCES, gaps["log10_force"]), (GAPS, gaps["log10_gap"])):
        for name in names:
            counts = gaps[name]["counts"]
            first = next((i for i, n in enumerate(counts) if n), len(counts))
            made[name] = [edges[first] if counts[first:] else None, counts[first:]]
    return made


def bands_of(record):
    """Of the states whose stiffnesses the record has: [Δφ, Z, Z_ef, Z_ff, [contacts with s above Δφ^(−3/2) × ½, 1, 2],
    above Δφ^(−10/3) × ½, 1, 2]."""
    made = []
    for state in record["states"]:
        normal, distance = found(state, "prestress/s_normal"), state["delta_phi"]
        if not normal or distance <= 0:
            continue
        above = [[sum(s > factor * distance ** -power for s in normal) for factor in (0.5, 1, 2)]
                 for power in (3 / 2, 10 / 3)]
        made.append([distance, state["Z"], state["Z_ef"], state["Z_ff"], *above])
    return made


def with_states(record):
    made = replicate_of(record)
    if record["status"] != "done":
        return made
    return {**made, "states": columns_of(record["states"]), "bins": bins_of(record["states"][-1]),
            "bands": bands_of(record)}


def angles_of(contacts):
    """Of every state its quantiles of θ_ef, radians."""
    ordered = [sorted(state["theta_ef"]) for state in contacts]
    return {f"theta_{share}": [quantile(angles, share) for angles in ordered] for share in QUANTILES}, ordered


def next_to(states, distance):
    """Of states the one nearest to the distance, if it is within a fifth of it."""
    best = min(range(len(states)), key=lambda i: abs(states[i]["delta_phi"] - distance))
    return best if abs(states[best]["delta_phi"] / distance - 1) < 0.2 else None


def study_of(isojam, directory):
    replicates, git, curves = [], set(), {}
    for name, record in records_of(directory):
        made = with_states(record)
        git.add(record["provenance"]["git"])
        if made["status"] == "done" and made["particles"] == 100 and (directory / "paths" / f"{name}.json").exists():
            columns, angles = angles_of(contacts_of(isojam, directory, name))
            made["states"] |= columns
            for distance in DRAWN:
                i = next_to(record["states"], distance)
                if i is not None and "crystalline" not in made["flags"]:
                    curves.setdefault(f"{made['solid']} {distance}", []).extend(
                        angle / record["states"][i]["delta_phi"] ** (5 / 3) for angle in angles[i])
        replicates.append(made)
    drawn = {name: [quantile(sorted(some), share) for share in CURVE] for name, some in curves.items()}
    return {"git": sorted(git), "collapsed": drawn, "replicates": replicates}


def main():
    isojam, results, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    out.mkdir(parents=True, exist_ok=True)
    studies = {name: study_of(isojam, results / name) for name in STUDIES if (results / name / "records").is_dir()}
    write(out / "records.json", {name: study for name, study in studies.items() if study["replicates"]})


if __name__ == "__main__":
    main()
