"""Jams each of 45 polyhedra, and compares the balance of the exported forces with the record.

usage: jam_test.py ISOJAM [--all] [-o DIR]

Without --all, a fixed sample of four solids; the whole set takes several minutes on 2 cores. N is 32, or the least of
64, 128 and 256 for which the cell is longer than two diameters. Exits 1 if a replicate fails, or if the exported
forces and the record disagree by more than a factor of 3. Prints a line for each solid."""

import argparse
import itertools
import pathlib
import random
import sys
import tempfile

import catalogue
import study

SIZES = (32, 64, 128, 256)
SAMPLE = 4
#: Cubes and truncated cubes do not jam below the usual largest density, because many of them align.
ALIGNING, LARGER_DENSITY = {"P03", "A05"}, 1.05


def chosen(everything):
    names = list(catalogue.polyhedra())
    return names if everything else sorted(random.Random(145).sample(names, SAMPLE))


def size_of(name):
    return next(n for n in SIZES if n >= study.least_particles(catalogue.polyhedra()[name]))


def number(value, form):
    return format(value, form) if value is not None else "-"


def line(name, record, exported):
    """The figures of a replicate, and what is wrong with it."""
    if record["status"] != "done":
        return "", f"failed in {record['failure']['where']}: {record['failure']['why']}"
    state = record["states"][record["nearest"]]
    contacts = state["contacts"]
    text = (f"{name} {record['spec']['particles']:4} {number((record['phi_j'] or {}).get('phi_j'), '.4f')} "
            f"{contacts['Z']:7.4f} {number(contacts['C'], '.4f'):>8} {state['residual']:.2e} {exported:.2e} "
            f"{record['timing']['cpu_seconds']:7.2f}")
    return text, study.unbalanced(record, exported)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("-o", dest="directory")
    options = parser.parse_args()
    directory = pathlib.Path(options.directory or tempfile.mkdtemp())
    directory.mkdir(exist_ok=True)
    solids = catalogue.polyhedra()
    names = chosen(options.all)
    wrong = []
    print("solid  N  phi_j       Z        C  residual exported  CPU s")
    for n, aligning in itertools.product(SIZES, (False, True)):
        group = {name: {"vertices": solids[name].tolist()} for name in names
                 if size_of(name) == n and (name in ALIGNING) == aligning}
        if not group:
            continue
        study_name = f"n{n}{'_aligning' if aligning else ''}"
        results = directory / study_name
        document = study.manifest(study_name, group, n)
        if aligning:
            document["protocol"] = {**document["protocol"], "max_density": LARGER_DENSITY}
        manifest = study.write(directory, document)
        code, _, messages = study.call(options.program, "--quiet", "run", manifest, "-o", results, seconds=None)
        if code not in (0, 1):
            sys.exit(messages)
        exported = study.exported_residuals(options.program, results,
                                            lambda name: study.gyration_radius(solids[name]))
        for replicate, record in study.records(results).items():
            name = record["spec"]["solid"]
            text, problem = line(name, record, exported.get(replicate, float("nan")))
            print(text or f"{name} {problem}", flush=True)
            wrong += [f"{name}: {problem}"] if problem else []
    print(f"{len(names)} solids, {len(wrong)} of them wrong", *wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
