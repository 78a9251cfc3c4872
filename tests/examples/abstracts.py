"""Recomputes the numbers of the abstracts of examples/paper, rigidity and percolation with code of its own.

compared() gives one line for each number of the abstract: its value on the page, the recomputed value, and the allowed
difference. C by trough has a larger allowed difference than others,
because the trough is found by another method: the smallest number of angles in a sliding window of 0.4 decades.
"""

import csv
import json
import pathlib
import re
import subprocess

import numpy
from scipy import optimize, stats

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
BETWEEN = {"theta_ff": (-4.4, -1.4), "theta_ef": (-4.4, -2.0)}  # log10 of the angles between which a trough may be
PAPER = {("tetrahedron", 100): 0.629, ("tetrahedron", 400): 0.634, ("octahedron", 100): 0.6796,
         ("octahedron", 400): 0.686, ("icosahedron", 100): 0.6953, ("icosahedron", 400): 0.7008,
         ("dodecahedron", 100): 0.7065, ("dodecahedron", 400): 0.7085}
ISOSTATIC = r"(C of ([a-z, ]+?) (is above|is below|agrees with) 12 − 4/N[^.]*\.)"
SIZE_OF_VERDICT = 100
APART = ("paper-unstable", "paper-emergence", "rigidity-solids", "paper-4000")  # studies that the abstracts do not use


def from_files(files):
    """Rows, one for each packing that means use, and pooled angles {(solid, N): {name: (edges, numbers)}}."""
    rows, pooled = [], {}
    for file in files:
        for name, study in json.loads(pathlib.Path(file).read_text(encoding="utf-8")).items():
            for r in () if name in APART else study["replicates"]:
                if r["status"] == "done" and not set(study["exclude"]) & set(r["flags"]):
                    by_exponents = name.startswith("rigidity-constraints")
                    rows.append({**r, "varied": None if by_exponents else "setting" in r, "by_exponents": by_exponents})
            for entry in () if name in APART or "constraints" in name else study.get("troughs", ()):
                if entry["delta_phi"] is None and "theta_ef" in entry:
                    pooled[entry["solid"], entry["particles"]] = {
                        angle: histogram(entry[angle][0] * entry["width"], entry["width"], entry[angle][1])
                        for angle in BETWEEN} | {"packings": entry["packings"], "apart": True}
    return rows, pooled


def histogram(first, width, counts):
    return first + width * numpy.arange(len(counts) + 1), numpy.array(counts, float)


def from_results(isojam, directories):
    """The same from records, with the angles of the exported contacts of the states nearest jamming."""
    rows, pooled = [], {}
    for directory in map(pathlib.Path, directories):
        tables = json.loads((directory / "tables.json").read_text(encoding="utf-8"))
        excluded, varied = set(tables["exclude"]), any(row["parameters"] for row in tables["rows"])
        for path in sorted((directory / "records").glob("*.json")):
            record = json.loads(path.read_text(encoding="utf-8"))
            if record["status"] != "done" or excluded & set(record.get("flags") or ()):
                continue
            rows.append(row_of(record, varied))
            if not varied:
                add_contacts(pooled, rows[-1], isojam, directory, path.stem)
    return rows, pooled


def row_of(record, varied):
    spec, states = record["spec"], record["states"]
    return {"solid": spec["solid"], "particles": spec["particles"], "varied": varied,
            "states": {"Z": [s["contacts"]["Z"] for s in states]}}


def add_contacts(pooled, row, isojam, directory, name):
    export = subprocess.run([isojam, "export", directory, name, "--format", "contacts"], check=True,
                            capture_output=True, text=True).stdout
    contacts = list(csv.DictReader(export.splitlines()))
    here = pooled.setdefault((row["solid"], row["particles"]), {"packings": 0, "apart": False})
    here["packings"] += 1
    for angle in BETWEEN:
        values = [max(float(line[angle]), 1e-12) for line in contacts]
        counts, edges = numpy.histogram(numpy.log10(values), numpy.arange(-12, 0.65, 0.1))
        here[angle] = (edges, counts + here[angle][1] if angle in here else counts.astype(float))


def antimode(edges, counts, between):
    """Index of the edge in the middle of the emptiest window of 0.4 decades."""
    half = max(1, round(0.2 / (edges[1] - edges[0])))
    inside = [k for k in range(half, len(counts) - half + 1) if between[0] <= edges[k] + 1e-9 <= between[1] + 2e-9]
    numbers = [counts[k - half:k + half].sum() for k in inside]
    least = [k for k, n in zip(inside, numbers) if n == min(numbers)]
    return least[len(least) // 2]


def constraints_by_trough(rows, pooled, solid, particles, decades=0):
    """Mean C over the packings, from the pooled numbers of angles below both troughs, moved by some decades."""
    here = pooled[solid, particles]
    scale, below = 2 / (particles * here["packings"]), {}
    for angle in BETWEEN:
        edges, counts = here[angle]
        moved = antimode(edges, counts, BETWEEN[angle]) + round(decades / (edges[1] - edges[0]))
        below[angle] = scale * counts[:moved].sum()
    z = numpy.mean([r["states"]["Z"][-1] for r in of(rows, solid, particles)])
    # θ_ef below the trough belongs to face-face contacts too, unless these were left out: C = Z + 2·n_ff + n_ef.
    return z + below["theta_ff"] * (2 if here["apart"] else 1) + below["theta_ef"]


def of(rows, solid, particles):
    return [r for r in rows if (r["solid"], r["particles"], r["varied"]) == (solid, particles, False)]


def density_of(row):
    """φ_J by a line through (E/N)^(1/6), in the window of the row."""
    phi, root = numpy.array(row["states"]["phi"]), numpy.array(row["states"]["E"]) ** (1 / 6)
    found = row["phi_j"]
    for _ in range(30):
        inside = phi - found < row["fit_window"]
        slope, intercept = numpy.polyfit(phi[inside], root[inside], 1)
        found = -intercept / slope
    return found


def contacts_at_jamming(rows, solid):
    points = [(p - r["phi_j"], z) for r in of(rows, solid, 400) for p, z in zip(r["states"]["phi"], r["states"]["Z"])]
    x, y = numpy.array([p for p in points if 0 <= p[0] < 0.08]).T

    def fit(exponent):
        columns = numpy.vander(x ** exponent, 2)
        solution, *_ = numpy.linalg.lstsq(columns, y, rcond=None)
        return solution, ((columns @ solution - y) ** 2).sum()

    best = optimize.minimize_scalar(lambda e: fit(e)[1], bounds=(0.2, 2), method="bounded").x
    return fit(best)[0][1]


def at(row, column, distance):
    """Value of a column at Δφ, linear in ln Δφ."""
    points = [(numpy.log(p - row["phi_j"]), v) for p, v in zip(row["states"]["phi"], row["states"][column])
              if v is not None and p > row["phi_j"]]
    x, y = zip(*sorted(points))
    return float(numpy.interp(numpy.log(distance), x, y)) if x[0] <= numpy.log(distance) <= x[-1] else None


def at_all(rows, solid, column):
    found = [at(r, column, 0.001) for r in of(rows, solid, 100) if column in r["states"]]
    return numpy.mean([value / 100 for value in found if value is not None])


def shifts(rows):
    """The lowest mean paired shift of φ_J by another protocol, with at least three pairs."""
    found = []
    for solid in SOLIDS:
        standard = (False, 0.02, 2000 if solid == "tetrahedron" else 500)  # compression protocol of the main studies
        varied = {(tuple(r["setting"].values()), r["replicate"]): r["phi_j"] for r in rows
                  if r["varied"] and r["solid"] == solid}
        for setting in {s for s, _ in varied} - {standard}:
            pairs = [phi - varied[standard, i] for (s, i), phi in varied.items()
                     if s == setting and (standard, i) in varied]
            if len(pairs) >= 3:
                found.append(numpy.mean(pairs))
    return min([0, *found])


def paper_numbers(rows, pooled, size):
    """Recomputed numbers of the paper's abstract, in their order: (name, value, allowed difference)."""
    z = [contacts_at_jamming(rows, solid) for solid in SOLIDS]
    phi = {key: [density_of(r) for r in of(rows, *key)] for key in PAPER}
    fits = [numpy.mean([c for r in of(rows, s, 400) if (c := r["states"]["C"][-1]) is not None]) for s in SOLIDS]
    return [("N", 400, 0), *((f"C by fit, {SOLIDS[k]}", fits[k], 0.0051) for k in (1, 2, 3, 0)),
            ("year", 2011, 0), ("12", 12, 0), ("Z_J, least", min(z), 0.051), ("Z_J, greatest", max(z), 0.051),
            *((f"C by trough, {s}, N = 400", constraints_by_trough(rows, pooled, s, 400), 0.2) for s in SOLIDS),
            ("12", 12, 0), ("12", 12, 0),
            ("largest offset of φ_J", max(abs(PAPER[k] - numpy.mean(v)) for k, v in phi.items()), 0.00051),
            ("shift, least", shifts(rows), 0.00051)]


def by_exponents(rows, solid, column, particles):
    """Mean over the states nearest jamming of the study of constraints."""
    within = 1e-3 if solid == "tetrahedron" else 3e-4
    found = [r["states"] for r in rows if r.get("by_exponents") and (r["solid"], r["particles"]) == (solid, particles)
             and r["states"]["phi"][-1] - r["phi_j"] <= within]
    return numpy.mean([s[column][-1] for s in found if s.get(column, [None])[-1] is not None])


def rigidity_numbers(rows, pooled, size):
    left = [at_all(rows, s, "prestress_10") + at_all(rows, s, "zero") - 0.03 for s in SOLIDS]
    missing = [numpy.mean([(r["states"]["floppy_normals"][-1] - 3) / 100 for r in of(rows, s, 100)]) for s in SOLIDS]
    n = SIZE_OF_VERDICT
    return [("N", n, 0), *((f"m, {s}", by_exponents(rows, s, "m_x", n), 0.0051) for s in SOLIDS),
            *((f"C, {s}", by_exponents(rows, s, "C_x", n), 0.0051) for s in SOLIDS),
            ("12", 12, 0), ("6", 6, 0), ("2", 2, 0), ("2", 2, 0), ("12", 12, 0),
            ("modes with most stiffness from both, %, rounded down", 100 * (1 - max(left) / 6), 1), ("N", 100, 0),
            ("Δφ", 0.001, 0), ("missing by normals, least", min(missing), 0.051),
            ("missing by normals, greatest", max(missing), 0.051)]


def cohesive(rows, until, **values):
    """Rows of the study of percolation that are not from its other solids, ranges and cycles."""
    return [r for r in rows if r["until"] == until and r["h"] == 0.1 and r["solid"] in SOLIDS and "cycles" not in r
            and all(r[key] == value for key, value in values.items())]


def at_distance(row, column, distance):
    x, y = zip(*sorted((numpy.log(d), v) for d, v in zip(row["states"]["delta"], row["states"][column])
                       if v is not None and d > 0))
    return float(numpy.interp(numpy.log(distance), x, y)) if x[0] <= numpy.log(distance) <= x[-1] else None


def mean_at(rows, distance=0.01):
    found = [at_distance(r, "Z_ff_fit", distance) for r in rows if "Z_ff_fit" in r["states"]]
    return numpy.mean([value for value in found if value is not None])


def half_point(rows, column):
    """Z_ff at which a logistic curve, fitted by iteratively reweighted least squares, is 1/2, and half the width of its
    95 % confidence interval by the delta method."""
    pairs = [(r["states"]["Z_ff_fit"][-1], float(r["states"][column][-1])) for r in rows
             if "Z_ff_fit" in r["states"] and r["states"]["Z_ff_fit"][-1] is not None]
    z, y = numpy.array(pairs).T
    design, y = numpy.stack([numpy.ones_like(z), z], axis=1), numpy.minimum(y, 1)
    coefficients = numpy.zeros(2)
    for _ in range(60):
        p = 1 / (1 + numpy.exp(-design @ coefficients))
        weights = numpy.maximum(p * (1 - p), 1e-9)
        coefficients = coefficients + numpy.linalg.solve(design.T @ (weights[:, None] * design), design.T @ (y - p))
    middle, dispersion = -coefficients[0] / coefficients[1], ((y - p) ** 2 / numpy.maximum(p * (1 - p), 1e-9)).mean()
    gradient = numpy.array([-1, -middle]) / coefficients[1]
    variance = gradient @ numpy.linalg.inv(design.T @ (weights[:, None] * design)) @ gradient
    return middle, 1.96 * numpy.sqrt(min(1, dispersion) * variance)


def difference(rows, solid, particles):
    """Mean Z_ff at Δφ = 0.01 after cohesion of any strength, minus that without, and the 95 % interval by Welch's t."""
    groups = [numpy.array([v for v in (at_distance(r, "Z_ff_fit", 0.01) for r in some if "Z_ff_fit" in r["states"])
                           if v is not None]) for some in (
        cohesive(rows, "decompression", particles=particles, solid=solid, w=1e-12),
        [r for r in cohesive(rows, "decompression", particles=particles, solid=solid) if r["w"] > 1e-12])]
    interval = stats.ttest_ind(groups[1], groups[0], equal_var=False)
    mean = groups[1].mean() - groups[0].mean()
    return mean, abs(mean / interval.statistic) * stats.t.ppf(0.975, welch_freedom(*groups))


def welch_freedom(first, second):
    a, b = (g.var(ddof=1) / len(g) for g in (first, second))
    return (a + b) ** 2 / (a * a / (len(first) - 1) + b * b / (len(second) - 1))


def constraints_at_zero_pressure(rows, solid):
    """Mean C, and its 95 % interval plus half the difference between doubled and halved cut-offs."""
    states = [r["states"] for r in cohesive(rows, "end", particles=100, solid=solid, w=1e-6)]
    c, half, double = (numpy.array([s[name][-1] for s in states]) for name in ("C", "C_half", "C_double"))
    return c.mean(), stats.t.ppf(0.975, len(c) - 1) * stats.sem(c) + abs(double.mean() - half.mean()) / 2


def percolation_numbers(rows, pooled, size):
    del pooled, size
    kept = [numpy.mean([r["states"]["Z_ff_fit"][-1] for r in cohesive(rows, "end", particles=100, solid=s, w=1e-6)])
            for s in SOLIDS]
    without = [mean_at(cohesive(rows, "decompression", particles=100, solid=s, w=1e-12)) for s in SOLIDS]
    every = [r for until in ("end", "decompression") for r in cohesive(rows, until, particles=100)]
    real, error = half_point(every, "winding_fit")
    random = [half_point([r for r in every if r["solid"] == s], "winds_random_fit")[0] for s in SOLIDS]
    left, left_error = difference(rows, "tetrahedron", 100)
    undetected = max(difference(rows, s, n)[1] for s in SOLIDS[1:] for n in (100, 200))
    (c, c_error), *others = (constraints_at_zero_pressure(rows, s) for s in SOLIDS)
    return [("Z_ff without cohesion, tetrahedron", without[0], 0.0051),
            ("Z_ff, tetrahedron", kept[0], 0.0051), ("Z_ff without cohesion, icosahedron", without[2], 0.0051),
            ("Z_ff, icosahedron", kept[2], 0.0051), ("threshold", real, 0.02), ("its error", error, 0.03),
            ("threshold of random bonds, tetrahedron", random[0], 0.03),
            ("threshold of random bonds, dodecahedron", random[3], 0.03),
            ("Z_ff that tetrahedra keep", left, 0.00051), ("its error", left_error, 0.00051),
            ("undetected change", undetected, 0.0051), ("C, tetrahedron", c, 0.051), ("its error", c_error, 0.051),
            ("C of others, least", min(m for m, _ in others), 0.051),
            ("C of others, greatest", max(m for m, _ in others), 0.051),
            ("its error", max(e for _, e in others), 0.051)]


def abstract_of(readme):
    page = re.sub(r"<!--.*?-->", "", pathlib.Path(readme).read_text(encoding="utf-8"))
    text = re.search(r"\*\*Abstract\.\*\*(.*?)\n\n", page, re.S)[1]
    # Sentences about 12 − 4/N have no measured number.
    return re.sub(ISOSTATIC, "", text), re.findall(ISOSTATIC, text)


def wrong_sentences(rows, pooled, size, sentences):
    """Sentences that place C above or below 12 − 4/N although the recomputed C is not there."""
    wrong = []
    for sentence, names, place in sentences:
        off = [constraints_by_trough(rows, pooled, s, size) - (12 - 4 / size) for s in SOLIDS
               if s.replace("hedron", "hedra") in names]
        if not off or place == "is above" and min(off) < 0 or place == "is below" and max(off) > 0:
            wrong.append(sentence)
    return wrong


def compared(readme, rows, pooled):
    """Lines of the comparison, and the number of differences."""
    text, sentences = abstract_of(readme)
    written = [float(x.replace("−", "-")) for x in re.findall(r"(?<![\w.])[−+]?\d+(?:\.\d+)?", text)]
    page = pathlib.Path(readme).read_text(encoding="utf-8")
    size = int((re.search(r"C by trough, N = (\d+)", page) or [0, 100])[1])
    make = next((make for word, make in (("rigid", rigidity_numbers), ("percolation", percolation_numbers))
                 if word in page[:60]), paper_numbers)
    numbers = make(rows, pooled, size)
    lines = [f"this sentence DIFFERS from the data: {one}" for one in wrong_sentences(rows, pooled, size, sentences)]
    wrong = len(lines)
    if len(written) != len(numbers):
        return [f"the abstract has {len(written)} numbers, but this script recomputes {len(numbers)}: {written}"], 1
    for page, (name, value, allowed) in zip(written, numbers):
        differs = value is not None and abs(page - value) > allowed + 1e-9
        wrong += differs
        lines.append(f"{name}: {page:g}, recomputed {'not' if value is None else f'{value:.5g}'} (± {allowed:g})"
                     f"{'  DIFFERS' if differs else ''}")
    return lines, wrong
