"""Runs of the program on manifests that tests write, and the balance of the forces that it exports."""

import csv
import json
import pathlib
import re
import subprocess

import numpy

from polyhedron import faces, volume

#: Few and coarse strain steps: the forces must balance in every equilibrium, however far from jamming.
QUICK = {"initial_density": 0.3, "compression_step": 0.07, "longest_step": 0.03, "step_fraction": 0.4,
         "max_density": 0.93, "final_distance": 0.03, "fit_window": 0.1, "compression_evaluations": 50}


def manifest(name, solids, particles, residual=1e-6, measure=("contacts",)):
    """A study of one replicate for each solid; `solids` is the object of the key of this name."""
    return {"name": name, "seed": 7, "solids": solids, "sweep": {"solid": list(solids), "particles": [particles]},
            "replicates": 1, "protocol": QUICK, "minimiser": {"residual": residual}, "measure": list(measure)}


def least_particles(vertices):
    """The cell must be longer than two diameters at the largest density."""
    diameter = max(numpy.linalg.norm(vertices - v, axis=1).max() for v in vertices)
    return int(8 * diameter**3 / volume(vertices, faces(vertices)) * QUICK["max_density"]) + 1


def write(folder, document):
    path = pathlib.Path(folder, document["name"] + ".json")
    path.write_text(json.dumps(document))
    return path


def call(program, *arguments, seconds=300):
    """Exit code, standard output and messages of the program; an error if it takes longer than that."""
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, errors="replace",
                          timeout=seconds, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


#: The number of a line in a message: "house.off:12: ...".
LINE = re.compile(r"\.\w+:(\d+): ")
SOLID_LINE = re.compile(r"(\w+): (\d+) faces, (\d+) edges, (\d+) vertices; volume (\S+) before scaling; "
                        r"vertices within (\S+) diameters of their faces;"
                        r".*?(?:move of a corner (\S+) diameters|$)", re.M)


def printed_solids(output):
    """For each user-defined solid the numbers in its line."""
    return {line[1]: {"faces": int(line[2]), "edges": int(line[3]), "vertices": int(line[4]), "volume": float(line[5]),
                      "distance": float(line[6]), "move": float(line[7] or 0)}
            for line in SOLID_LINE.finditer(output)}


def records(directory):
    return {path.stem: json.loads(path.read_text()) for path in sorted(pathlib.Path(directory, "records").glob("*"))}


def gyration_radius(vertices):
    """The radius of gyration of the solid with these vertices, scaled to unit volume."""
    vertices = vertices - vertices.mean(axis=0)
    cones = numpy.array([vertices[[loop[0], a, b]] for loop in faces(vertices) for a, b in zip(loop[1:], loop[2:])])
    weight = numpy.linalg.det(cones) / 6
    centroid = weight @ cones.sum(axis=1) / 4 / weight.sum()
    cones -= centroid
    total = cones.sum(axis=1)
    square = ((total**2).sum(axis=1) + (cones**2).sum(axis=(1, 2))) / 20
    return numpy.sqrt(2 / 3 * (weight @ square) / weight.sum()) / numpy.cbrt(weight.sum())


def vectors(rows, what):
    return numpy.array([[float(row[f"{what}_{axis}"]) for axis in "xyz"] for row in rows])


def exported_residuals(program, directory, radius_of):
    """For each replicate: the largest net force, or net torque over the radius of gyration, in units of the mean force.

    `radius_of` gives the radius for the name of a solid."""
    table = pathlib.Path(directory, "contacts.csv")
    code, _, messages = call(program, "export", directory, "all", "--format", "contacts", "-o", table)
    if code != 0:
        raise AssertionError(messages)
    rows = {}
    with open(table, newline="") as text:
        for row in csv.DictReader(text):
            rows.setdefault(row["replicate"], []).append(row)
    result = {}
    for name, record in records(directory).items():
        if name not in rows:
            continue
        contacts, force = rows[name], vectors(rows[name], "force")
        total, torque = numpy.zeros((2, record["spec"]["particles"], 3))
        for end, sign in (("a", 1), ("b", -1)):
            particle = [int(row[end]) for row in contacts]
            numpy.add.at(total, particle, sign * force)
            numpy.add.at(torque, particle, vectors(contacts, f"torque_{end}"))
        worst = max(numpy.linalg.norm(total, axis=1).max(),
                    numpy.linalg.norm(torque, axis=1).max() / radius_of(record["spec"]["solid"]))
        result[name] = worst / numpy.linalg.norm(force, axis=1).mean()
    return result


def unbalanced(record, exported, factor=3):
    """Why the exported forces of a replicate disagree with its record; empty if they agree.

    Residuals below the record's floor are rounding errors."""
    state = record["states"][record["nearest"]]
    floor = state["residual_floor"]
    least, most = sorted((max(state["residual"], floor), max(exported, floor)))
    if most <= factor * least:
        return ""
    return f"residual {state['residual']:.2e} (floor {floor:.1e}), exported forces {exported:.2e}"
