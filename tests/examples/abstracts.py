"""Recomputes the numbers of the abstracts of examples/paper, rigidity and percolation with code of its own.

compared() gives one line for each number of the abstract: its value on the page, the recomputed value, and the allowed
difference.
"""

import json
import math
import pathlib
import re

import numpy
from scipy import optimize, stats

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
PAPER = {("tetrahedron", 100): 0.629, ("tetrahedron", 400): 0.634, ("octahedron", 100): 0.6796,
         ("octahedron", 400): 0.686, ("icosahedron", 100): 0.6953, ("icosahedron", 400): 0.7008,
         ("dodecahedron", 100): 0.7065, ("dodecahedron", 400): 0.7085}
APART = ("paper-unstable", "paper-emergence", "rigidity-solids", "paper-4000")  # studies that the abstracts do not use


def rows_of(files):
    """One row for each packing that means use."""
    rows = []
    for file in files:
        for name, study in json.loads(pathlib.Path(file).read_text(encoding="utf-8")).items():
            for r in () if name in APART else study["replicates"]:
                if r["status"] == "done" and not set(study["exclude"]) & set(r["flags"]):
                    by_exponents = name.startswith("rigidity-constraints")
                    rows.append({**r, "by_exponents": by_exponents,
                                 "main": not (by_exponents or "preparation" in r or "until" in r)})
    return rows


def of(rows, solid, particles):
    return [r for r in rows if (r["solid"], r["particles"], r["main"]) == (solid, particles, True)]


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


def changes(rows):
    """{solid: {mean change of φ_J by another preparation: half the width of its interval}}"""
    found = {}
    for solid in SOLIDS:
        phi = {}
        for r in rows:
            if r["solid"] == solid and "preparation" in r:
                phi.setdefault(r["preparation"], []).append(r["phi_j"])
        ours = phi.pop("3.2e-05")
        found[solid] = dict(welch(ours, other) for other in phi.values())
    return found


def reach(means):
    return max(0, *means) - min(0, *means)


def decreases(rows):
    """Decrease of m over the range of φ_J, by a weighted line through the means of the preparations of each solid."""
    for solid, means in changes(rows).items():
        groups = {}
        for r in rows:
            m = r["states"].get("m_x", [None])[-1] if "preparation" in r and r["solid"] == solid else None
            if m is not None and r["states"]["phi"][-1] - r["phi_j"] <= (1e-3 if solid == "tetrahedron" else 3e-4):
                groups.setdefault(r["preparation"], []).append((r["phi_j"], m))
        found = [numpy.array(g).T for g in groups.values() if len(g) > 2]
        weights = [1 / max(stats.t.ppf(0.975, len(m) - 1) * stats.sem(m), 0.01 / len(m)) for _, m in found]
        yield -numpy.polyfit([phi.mean() for phi, _ in found], [m.mean() for _, m in found], 1, w=weights)[0] * reach(means)


def shifts(rows):
    """The least and the greatest change, with half the width of their intervals."""
    every = [pair for found in changes(rows).values() for pair in found.items()]
    return min(every) + max(every)


def paper_numbers(rows, text):
    """Recomputed numbers of the paper's abstract, in their order: (name, value, allowed difference)."""
    z = [contacts_at_jamming(rows, solid) for solid in SOLIDS]
    phi = {key: [density_of(r) for r in of(rows, *key)] for key in PAPER}
    fits = [numpy.mean([c for r in of(rows, s, 400) if (c := r["states"]["C"][-1]) is not None]) for s in SOLIDS]
    return [*verdict_numbers(rows, text), *((str(n), n, 0) for n in (95, 2011, 12, 400, 12)),
            *((f"C by fit, {SOLIDS[k]}", fits[k], 0.0051) for k in (1, 2, 3, 0)),
            ("Z_J, least", min(z), 0.051), ("Z_J, greatest", max(z), 0.051),
            ("largest offset of φ_J", max(abs(PAPER[k] - numpy.mean(v)) for k, v in phi.items()), 0.00051),
            *zip(("shift, least", "its error", "shift, greatest", "its error"), shifts(rows), 4 * [0.00051])]


def missing(rows, solid):
    """{N: three pairs of a mean of m, by the central, lowest and highest boundaries, and half the width of its interval, or its
    resolution if that is larger}"""
    found = {}
    for r in rows:
        last = {name: values[-1] for name, values in r["states"].items()} if r["by_exponents"] else {}
        within = 1e-3 if solid == "tetrahedron" else 3e-4
        if r["solid"] == solid and last.get("m_x") is not None and last["phi"] - r["phi_j"] <= within:
            found.setdefault(r["particles"], []).append([last[name] for name in ("m_x", "m_x_low", "m_x_high")])
    return {n: [(c.mean(), max(stats.t.ppf(0.975, len(c) - 1) * stats.sem(c), 1 / n / len(c))) for c in numpy.array(m).T]
            for n, m in found.items() if len(m) > 2}


def verdict_numbers(rows, text):
    """m for N → ∞, by weighted least squares, and the bounds that the text names, in the order of the text."""
    made = []
    for solid in sorted(SOLIDS, key=lambda s: text.lower().index(s.replace("hedron", "hedra"))):
        by_size, ends = missing(rows, solid), []
        for k, sign in enumerate((0, -1, 1)):
            n, mean, width = numpy.array([(n, *found[k]) for n, found in by_size.items()]).T
            design = numpy.stack([1 / width, 1 / width / n], axis=1)
            ends.append(numpy.linalg.lstsq(design, mean / width, rcond=None)[0][0]
                        + sign * math.sqrt(numpy.linalg.inv(design.T @ design)[0, 0]))
        name, (central, least, greatest) = solid.replace("hedron", "hedra"), ends
        words = re.search(rf"(?i){name} \([^)]*\)", text)[0]
        made += [(f"m, {solid}", central, 0.00051)]
        made += [("at least", least, 0.00051)] if "at least" in words or "from" in words else []
        made += [("at most", greatest, 0.00051)] if "at most" in words or "from" in words else []
    return made


def rigidity_numbers(rows, text):
    left = [at_all(rows, s, "prestress_10") + at_all(rows, s, "zero") - 0.03 for s in SOLIDS]
    return [*verdict_numbers(rows, text), *((str(n), n, 0) for n in (95, 12, 6, 2, 2, 12)),
            ("range of φ_J", max(map(reach, changes(rows).values())), 0.0051), ("decrease of m", max(decreases(rows)), 0.0051),
            ("modes with most stiffness from both, %, rounded down", 100 * (1 - max(left) / 6), 1),
            ("Δφ", 0.001, 0)]


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
    return welch(*groups)


def welch(first, second):
    """Difference of two means and half the width of its 95 % interval by Welch's t."""
    a, b = (numpy.var(g, ddof=1) / len(g) for g in (first, second))
    freedom = (a + b) ** 2 / (a * a / (len(first) - 1) + b * b / (len(second) - 1))
    return numpy.mean(second) - numpy.mean(first), stats.t.ppf(0.975, freedom) * math.sqrt(a + b)


def constraints_at_zero_pressure(rows, solid):
    """Mean C, and its 95 % interval plus half the difference between doubled and halved cut-offs."""
    states = [r["states"] for r in cohesive(rows, "end", particles=100, solid=solid, w=1e-6)]
    c, half, double = (numpy.array([s[name][-1] for s in states]) for name in ("C", "C_half", "C_double"))
    return c.mean(), stats.t.ppf(0.975, len(c) - 1) * stats.sem(c) + abs(double.mean() - half.mean()) / 2


def percolation_numbers(rows, _):
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
    return re.search(r"\*\*Abstract\.\*\*(.*?)\n\n", page, re.S)[1]


def compared(readme, rows):
    """Lines of the comparison, and the number of differences."""
    text = abstract_of(readme)
    written = [float(x.replace("−", "-")) for x in re.findall(r"(?<![\w.])[−+]?\d+(?:\.\d+)?", text)]
    page = pathlib.Path(readme).read_text(encoding="utf-8")
    make = next((make for word, make in (("rigid", rigidity_numbers), ("percolation", percolation_numbers))
                 if word in page[:60]), paper_numbers)
    numbers = make(rows, text)
    lines, wrong = [], 0
    if len(written) != len(numbers):
        return [f"the abstract has {len(written)} numbers, but this script recomputes {len(numbers)}: {written}"], 1
    for page, (name, value, allowed) in zip(written, numbers):
        differs = value is not None and abs(page - value) > allowed + 1e-9
        wrong += differs
        lines.append(f"{name}: {page:g}, recomputed {'not' if value is None else f'{value:.5g}'} (± {allowed:g})"
                     f"{'  DIFFERS' if differs else ''}")
    return lines, wrong
