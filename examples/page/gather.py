"""Extracts the data of a page: python3 gather.py ISOJAM RESULTS FILE STUDY...

Writes FILE from the results directories RESULTS/STUDY. It has, for each replicate, flags, cost, φ_J and the
columns that the pages need of every state. It also has the troughs in the angles of all replicates together, which
`isojam aggregate` finds, and the histograms of these angles. For the figures it has a spectrum and the largest cluster of
face-face contacts of each solid, and the structure factor S(k) of packings with N ≥ 400. Numbers are rounded as in records.py. Incomplete studies
count with the replicates that they have.
"""

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy

from data import CONSTRAINTS, EMERGENCE, LARGE, LINE, NEGATIVE, SOLIDS_64
from records import bin_of, cells_of, found, nearest_of, records_of, write

# Column of a state: where it is in the record.
COLUMNS = {
    "phi": "density", "E": "energy_per_particle", "residual": "residual", "descents": "descents",
    **{name: f"contacts/{name}" for name in ("Z", "Z_ff", "Z_ef", "Z_l", "C")},
    **{f"{name}_fixed": f"contacts/fixed_cutoffs/{name}" for name in ("Z_ff", "Z_ef", "Z_l", "C")},
    **{f"{name}_trough": f"contacts/trough/{name}" for name in ("Z_ff", "Z_ef", "C")},
    "Q6": "order/Q6", "S": "clusters/S", "percolates": "clusters/percolates", "spans": "clusters/spans",
    "l_max": "clusters/l_max", "body_l_max": "clusters/body_l_max", "D_max": "clusters/D",
    "p_h": "modes/highest/participation",
    "zero": "modes/zero", "negative": "modes/negative", "omega_l": "modes/omega_l", "omega_h": "modes/omega_h",
    "amplitude": "modes/face_face_amplitude", "members": "modes/face_face_particles", "K": "moduli/K", "G": "moduli/G",
    "self_stress": "rigidity/classes/self_stress", "floppy": "rigidity/classes/floppy",
    "self_stress_trough": "rigidity/trough/self_stress", "floppy_trough": "rigidity/trough/floppy",
    "floppy_normals": "rigidity/normals/floppy",
    **{f"{key}_{name}": f"rigidity/scaled_cutoffs/{i}/{key}" for i, name in enumerate(("half", "double"))
       for key in ("floppy", "self_stress", "constraints")},
    "backbone_removed": "backbone/removed", "backbone_zero": "backbone/zero", "backbone_negative": "backbone/negative",
    **{f"unstable_{name}": f"difference_modes/{name}/share" for name in ("exact", "h4", "h6", "h8")},
    "held_by_second": "prestress/modes/held_by_second", "C_s": "prestress/C_s",
    **{f"prestress_{t}": f"prestress/modes/prestress_by_threshold/{i}/modes" for i, t in ((1, 3), (2, 10), (3, 30))},
    **{f"{name}_x{end}": f"exponents/{key}{end}" for name, key in (("C", "C"), ("m", "missing"))
       for end in ("", "_low", "_high")},
    **{f"{name}_x": f"exponents/{name}" for name in ("Z_ff", "Z_ef", "Z_l", "between")},
    "self_stress_x": "exponents/rank/self_stress", "m_supported": "exponents/supported/missing",
    "underconstrained": "exponents/supported/removed",
    **{f"{key}_{name}": f"prestress/by_class/{i}/{full}" for i, name in enumerate(("ff", "ef", "l"))
       for key, full in (("contacts", "contacts"), ("tilts", "stiff_tilts"))}}
FITS = {"cut_ff": "contacts/face_face_fit", "cut_ef": "contacts/edge_face_fit"}
HISTOGRAMS_AT = (0.0025, 0.001)  # Δφ of histograms beside those of the tables
SPECTRUM_AT = 0.01  # Δφ of the spectra, the same for all solids
STRUCTURE_FROM, SHELLS = 400, 40  # smallest N, and largest n² of the wave vectors 2π n/L, of structure factors
# Studies of which pages use only the states nearest jamming.
NEAREST_ONLY = (LARGE, NEGATIVE, EMERGENCE, SOLIDS_64, *CONSTRAINTS, *LINE)
EMERGENCE_AT = (0.32, 0.24, 0.16, 0.12, 0.08, 0.04)  # Δφ
NEAR = 1.25  # factor between two values of Δφ that count as the same


def columns_of(states, particles):
    """Columns that at least one state has."""
    columns = {name: [found(state, place) for state in states] for name, place in COLUMNS.items()}
    for name, place in FITS.items():
        columns[name] = [found(s, f"{place}/cutoff") if found(s, f"{place}/verdict") == "fitted" else None
                         for s in states]
    for name in ("half", "double"):
        columns[f"C_{name}"] = [None if n is None else 2 * n / particles for n in columns.pop(f"constraints_{name}")]
    modes = [found(state, "modes/near_rattlers") for state in states]
    columns["near_rattlers"] = [None if some is None else len(some) for some in modes]
    return {name: values for name, values in columns.items() if any(value is not None for value in values)}


def preparation_of(protocol):
    """What distinguishes the protocol from that of the other studies of LINE. Cohesion of 1e-12 is too weak to affect packings;
    with it, compression ends in the same way as with cohesion."""
    if protocol.get("cohesion", {}).get("strength", 0) > 1e-12:
        return "removed"
    return "cycles" if protocol.get("cycles") else f"{protocol['target_energy']:g}"


def replicate_of(record, study):
    """Row of a replicate."""
    spec = record["spec"]
    made = {"solid": spec["solid"], "particles": spec["particles"], "replicate": spec["replicate"],
            "status": record["status"], "flags": record.get("flags") or [],
            "cpu": record["timing"]["cpu_seconds"], "stages": record["timing"].get("stages", {})}
    if study in LINE:
        made["preparation"] = preparation_of(spec["protocol"])
    if record["status"] != "done":
        return made
    made |= {"phi_j": record["phi_j"]["phi_j"], "fit_window": spec["protocol"]["fit_window"]}
    states = record["states"][-1:] if study in NEAREST_ONLY else record["states"]
    return {**made, "states": columns_of(states, spec["particles"])}


def histogram(bins_of_states, kind, below=None):
    """Sum of histograms, [first bin, counts]. Contacts with θ_ff in the bins below `below` are left out of θ_ef."""
    sums = {}
    for bins in bins_of_states:
        for k, count in enumerate(bins[kind]["counts"], bins[kind]["first"]):
            sums[k] = sums.get(k, 0) + count
        for a, b, count in cells_of(bins) if below is not None else ():
            if a < below:
                sums[b] -= count
    used = [k for k, count in sums.items() if count]
    return [min(used), [sums.get(k, 0) for k in range(min(used), max(used) + 1)]] if used else [0, []]


def nearest_to(record, distance):
    """The state nearest to a distance in ln Δφ, if it is within a factor NEAR; the last state if the distance is None."""
    if distance is None:
        return record["states"][-1]
    states = [s for s in record["states"] if s["delta_phi"] > 0]
    best = min(states, key=lambda s: abs(math.log(s["delta_phi"] / distance)), default=None)
    return best if best and 1 / NEAR <= best["delta_phi"] / distance <= NEAR else None


def trough_of(pooled, row, distance, records):
    """Entry of the troughs of a row of the tables, with the histograms of the states at this distance."""
    made = {"solid": row["solid"], "particles": row["particles"], "delta_phi": distance,
            "replicates": pooled["replicates"], "face_face": pooled["face_face"], "edge_face": pooled["edge_face"]}
    for name in ("Z_ff", "Z_ef", "C", "C_low", "C_high"):
        estimate = pooled[name]
        made[name] = {key: estimate[key] for key in ("mean", "half_width", "n")} if estimate["n"] else None
    bins = [found(state, "contacts/angle_bins") for state in (nearest_to(r, distance) for r in records) if state]
    bins = [one for one in bins if one]
    if bins:
        cutoff = pooled["face_face"].get("cutoff")
        below = bin_of(cutoff, bins[0]["width"]) if cutoff else None
        made |= {"width": bins[0]["width"], "packings": len(bins), "theta_ff": histogram(bins, "face_face"),
                 "theta_ef": histogram(bins, "edge_face", below)}
    return made


def troughs_of(row, records):
    """Entries of a row: nearest jamming, at the distances of its series, and histograms alone at nearer distances."""
    made = [trough_of(place["pooled_trough"], row, distance, records)
            for distance, place in ((None, row), *((p["delta_phi"], p) for p in row.get("series", ())))
            if place.get("pooled_trough")]
    if made:
        nearest = row["pooled_trough"]["face_face"]
        pooled = {"replicates": 0, "face_face": {**nearest, "verdict": "not_called"}, "edge_face": {"verdict": "not_called"},
                  **{name: {"n": 0} for name in ("Z_ff", "Z_ef", "C", "C_low", "C_high")}}
        made += [trough_of(pooled, row, distance, records) for distance in HISTOGRAMS_AT
                 if distance not in {entry["delta_phi"] for entry in made}]
    return [entry for entry in made if entry["face_face"]["verdict"] != "not_called" or "theta_ef" in entry]


def tables_of(isojam, directory):
    command = [isojam, "aggregate", directory, "--format", "json", "--quiet"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def spectrum_of(record):
    """Lowest and highest frequencies of the state next to SPECTRUM_AT; None if there is no such state or spectrum."""
    state = nearest_to(record, SPECTRUM_AT) or {}
    ends = [found(state, f"modes/{end}/omega") for end in ("lowest", "highest")]
    return {"delta_phi": state["delta_phi"], "lowest": ends[0], "highest": ends[1]} if all(ends) else None


def largest_cluster(positions, side, pairs):
    """Indices and unwrapped positions of the cluster with the largest extent along an axis. `pairs` are (a, b, image of
    b)."""
    neighbours = {}
    for a, b, image in pairs:
        neighbours.setdefault(a, []).append((b, image))
        neighbours.setdefault(b, []).append((a, [-i for i in image]))
    found, clusters = set(), []
    for start in neighbours:
        if start in found:
            continue
        cluster, queue = {start: positions[start]}, [start]
        while queue:
            a = queue.pop()
            for b, image in neighbours[a]:
                if b not in cluster:
                    # The centre of b, moved by whole sides to the image that touches a.
                    shift = [round((y - x) / side) for x, y in zip(cluster[a], positions[a])]
                    cluster[b] = [y + side * (i - s) for y, i, s in zip(positions[b], image, shift)]
                    queue.append(b)
        found |= set(cluster)
        clusters.append(cluster)
    return max(clusters, key=lambda c: max(max(axis) - min(axis) for axis in zip(*c.values())), default={})


def cluster_of(isojam, directory, records):
    """The face-face cluster with the largest extent among the states nearest jamming: the vertices and faces of the
    solid, and a row (x, y, z, quaternion w, x, y, z) for each particle; None without clusters."""
    extents = [(found(nearest_of(r), "clusters/l_max") or 0, name) for name, r in records]
    extent, name = max(extents, default=(0, None))
    if not extent:
        return None
    packing = json.loads((directory / "packings" / f"{name}.json").read_text(encoding="utf-8"))
    run = subprocess.run([isojam, "export", directory, name, "--format", "contacts"], check=True, capture_output=True,
                         text=True)
    pairs = [(int(row["a"]), int(row["b"]), [int(row[f"image_{axis}"]) for axis in "xyz"])
             for row in csv.DictReader(run.stdout.splitlines()) if row["class"] == "face_face"]
    run = subprocess.run([isojam, "export", directory, name, "--format", "solids"], check=True, capture_output=True)
    solid, = json.loads(run.stdout).values()
    cluster = largest_cluster(packing["positions"], packing["side"], pairs)
    return {"replicate": name, "delta_phi": nearest_of(dict(records)[name])["delta_phi"], "side": packing["side"],
            "vertices": solid["vertices"], "faces": solid["faces"],
            "particles": [[*where, *packing["orientations"][i]] for i, where in cluster.items()]}


def structure_of(directory, names):
    """Structure factor S(k) = |Σ exp(−ik·x)|²/N of the centres: for each shell of wave vectors with the same length, k (mean
    over the packings), S of each packing, and the number of independent wave vectors."""
    grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(-6, 7)], indexing="ij"), axis=-1).reshape(-1, 3)
    square = (grid ** 2).sum(axis=1)
    positive = grid @ (169, 13, 1) > 0  # one of each pair k, −k
    shells = {}
    for name in names:
        packing = json.loads((directory / "packings" / f"{name}.json").read_text(encoding="utf-8"))
        positions = numpy.array(packing["positions"]) / packing["side"]
        for shell in sorted(set(square[(square > 0) & (square <= SHELLS)])):
            waves = grid[(square == shell) & positive]
            amplitudes = numpy.exp(-2j * math.pi * positions @ waves.T).sum(axis=0)
            made = shells.setdefault(int(shell), {"k": [], "S": [], "vectors": len(waves)})
            made["k"].append(2 * math.pi * math.sqrt(shell) / packing["side"])
            made["S"].append(float((abs(amplitudes) ** 2).mean() / len(positions)))
    return [{**one, "k": sum(one["k"]) / len(one["k"])} for _, one in sorted(shells.items())]


def below(numbers, width, angle):
    """Number of angles below an angle; the bin that contains it is divided in proportion to the angle."""
    total = 0.0
    for k, count in enumerate(numbers["counts"], numbers["first"]):
        low, high = 10 ** (width * k), 10 ** (width * (k + 1))
        total += count * max(0.0, min(1.0, (angle - low) / (high - low)))
    return total


def emergence_of(records, critical):
    """Numbers of contacts at several Δφ, summed over the packings: with θ_ff below 1°, with θ_ff between 1° and the smallest
    critical angle, with θ_ef near 0, and all; and the share of random contacts whose θ_ef is near 0."""
    end = math.radians(min(angle for name, angle in critical.items() if name.startswith("ff")))
    made = []
    for distance in EMERGENCE_AT:
        sums, packings = [0.0] * 4, 0
        for record in records:
            state = nearest_to(record, distance)
            bins = state and found(state, "contacts/angle_bins")
            random = found(nearest_of(record), "contacts/angles/edge_face_random")
            if not bins or not random or not random["expected"]:
                continue
            contacts = record["spec"]["particles"] / 2
            share = random["expected"] / (contacts * nearest_of(record)["contacts"]["Z"])
            first = below(bins["face_face"], bins["width"], math.radians(1))
            for i, number in enumerate((first, below(bins["face_face"], bins["width"], end) - first,
                                        below(bins["edge_face"], bins["width"], random["angle"]),
                                        contacts * state["contacts"]["Z"])):
                sums[i] += number
            packings += 1
        if packings:
            made.append({"delta_phi": distance, "packings": packings, "first": sums[0], "second": sums[1],
                         "edge_face": sums[2], "contacts": sums[3], "random_share": share, "end": math.degrees(end)})
    return made


def study_of(isojam, directory):
    tables = tables_of(isojam, directory)
    named = list(records_of(directory))
    records = [record for _, record in named]
    made = {"git": sorted({r["provenance"]["git"] for r in records}), "exclude": tables["exclude"],
            "critical_angles": {}, "spectra": {}, "clusters": {}, "structure": {}, "emergence": {}, "troughs": []}
    for row in [] if directory.name in (*CONSTRAINTS, *LINE) else tables["rows"]:
        kept = [r for r in records if r["status"] == "done" and not set(tables["exclude"]) & set(r.get("flags") or ())
                and (r["spec"]["solid"], r["spec"]["particles"]) == (row["solid"], row["particles"])]
        if row.get("critical_angles"):
            made["critical_angles"][row["solid"]] = row["critical_angles"]
        spectra = [spectrum for spectrum in map(spectrum_of, kept) if spectrum]
        if spectra:
            made["spectra"][f"{row['solid']} {row['particles']}"] = spectra[0]
        of_row = [(name, r) for name, r in named if any(r is one for one in kept)]
        if row["particles"] >= STRUCTURE_FROM and kept and directory.name != NEGATIVE:
            made["structure"][f"{row['solid']} {row['particles']}"] = structure_of(directory, [name for name, _ in of_row])
        cluster = cluster_of(isojam, directory, of_row)
        if cluster:
            made["clusters"][f"{row['solid']} {row['particles']}"] = cluster
        made["troughs"] += troughs_of(row, kept)
        if directory.name == EMERGENCE:
            made["emergence"][row["solid"]] = emergence_of(kept, row["critical_angles"])
    return {**made, "replicates": [replicate_of(record, directory.name) for record in records]}


def main():
    isojam, results, file, *studies = sys.argv[1:]
    Path(file).parent.mkdir(parents=True, exist_ok=True)
    missing = [name for name in studies if not (Path(results) / name / "records").is_dir()]
    if missing:
        sys.exit(f"{results}: there is no study {', '.join(missing)}; run it first, or leave it out of the command")
    write(Path(file), {name: study_of(isojam, Path(results) / name) for name in studies})


if __name__ == "__main__":
    main()
