"""Compares dodecahedra whose vertices were rounded to single precision or to six digits, with `merge`, with the named
solid: paired differences of phi_J, Z and C over replicates, with their 95 % confidence intervals.

usage: dodecahedra.py ISOJAM [REPLICATES]

Takes about two minutes on 2 cores. Exits 1 if a replicate fails or is not classified, or if an interval does not
contain zero. Without any difference, one in twenty comparisons is outside of its interval by chance."""

import pathlib
import sys
import tempfile

import numpy

import catalogue
import study

#: Quantiles of Student's t for 95 %, by degrees of freedom.
STUDENT = {3: 3.182, 7: 2.365, 11: 2.201, 15: 2.131, 23: 2.069, 31: 2.040}


def main():
    program, replicates = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 16
    exact = catalogue.polyhedra()["P05"]
    six = [[float(f"{x:.5e}") for x in v] for v in exact.tolist()]
    solids = {"single": {"vertices": exact.astype(numpy.float32).astype(float).tolist(), "merge": 1e-5},
              "six": {"vertices": six, "merge": 1e-4}}
    document = study.manifest("dodecahedra", solids, 64)
    document["sweep"]["solid"].append("dodecahedron")
    document["replicates"] = replicates
    document["protocol"] = {"final_distance": 0.006}
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder, "results")
        code, _, messages = study.call(program, "--quiet", "run", study.write(folder, document), "-o", directory,
                                       seconds=None)
        if code != 0:
            sys.exit(messages)
        values = {}
        for record in study.records(directory).values():
            contacts = record["states"][record["nearest"]]["contacts"]
            values.setdefault(record["spec"]["solid"], []).append(
                [record["phi_j"]["phi_j"], contacts["Z"], contacts["C"]])
    wrong = 0
    named = numpy.array(values.pop("dodecahedron"), dtype=float)
    for solid, rows in values.items():
        difference = numpy.array(rows, dtype=float) - named
        width = STUDENT[replicates - 1] * difference.std(axis=0, ddof=1) / replicates**0.5
        for name, mean, half in zip(("phi_J", "Z", "C"), difference.mean(axis=0), width):
            print(f"{solid:7} {name:6} difference {mean:8.4f} ± {half:.4f}")
            wrong += not abs(mean) <= half
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
