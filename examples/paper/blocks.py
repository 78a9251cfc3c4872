"""The blocks of the page: functions from data to Markdown tables."""

import statistics

from verdicts import estimate_of, single_half_width, uncertainty, verdict

SOLIDS = ("tetrahedron", "octahedron", "icosahedron", "dodecahedron")
DISTANCES = (0.16, 0.08, 0.04, 0.02, 0.01, 0.005)


def number(x, places):
    return f"{x:.{places}f}".replace("0.", ".", 1) if abs(x) < 1 else f"{x:.{places}f}"


def places_of(half_width):
    """Decimal places that show two digits of it, at least one, at most five."""
    for places in range(1, 5):
        if half_width * 10 ** places >= 9.5:
            return places
    return 5


def interval(estimate):
    """mean ± half width of the 95 % interval."""
    if not estimate or estimate["mean"] is None:
        return "–"
    if estimate["half_width"] is None:
        return f"{estimate['mean']:.4g} (one)"
    if estimate["half_width"] == 0:
        return f"{estimate['mean']:.4g} in all"
    places = places_of(estimate["half_width"])
    return f"{number(estimate['mean'], places)} ± {number(estimate['half_width'], places)}"


def spread(estimate):
    """Of single packings, 95 %."""
    if estimate["half_width"] == 0:
        return "none"
    return f"± {number(single_half_width(estimate), places_of(estimate['half_width']))}"


def said(figure):
    """What the paper says."""
    if "digits" not in figure:
        return f"{figure['value']:g}"
    text = number(figure["value"], figure["digits"])
    return text + (f" ± {number(figure['error'], figure['digits'])}" if "error" in figure else "")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def compared(data, place, name):
    """Rows of one place of the paper: what, ours, n, spread of single packings, the paper's, verdict."""
    rows = []
    for figure in data.figures:
        if figure["place"] != place:
            continue
        estimate = data.of(figure)
        result = verdict(estimate, figure)
        many = estimate is not None and estimate["half_width"] is not None
        rows.append([
            name(figure), interval(estimate), str(estimate["n"]) if estimate else "0",
            spread(estimate) if many else "–",
            said(figure), f"**{result.word}**" + (f" {result.why}" if result.why else "")])
    return table(["", "ours", "n", "one packing", "paper", ""], rows)


def solid_and_size(figure):
    return f"{figure['solid']} {figure['particles']}" + (", nearer" if figure.get("study") == "nearest" else "")


def column_of_solid(figure):
    where = f", Δφ = {number(figure['delta_phi'], 2)}" if "delta_phi" in figure else ""
    return f"{figure['solid']} {figure['particles']}, {figure['column']}{where}"


def column_alone(figure):
    return figure["column"].removesuffix("_fixed")


def summary(data):
    rows = []
    for solid in SOLIDS:
        theirs = {f["particles"]: said(f) for f in data.figures if f["place"] == "Table I" and f["solid"] == solid}
        study = "nearest" if data.estimate(solid, 100, "C", study="nearest") else "main"
        rows.append([solid, interval(data.estimate(solid, 100, "phi_j")), theirs[100],
                     interval(data.estimate(solid, 400, "phi_j")), theirs[400],
                     *(interval(data.estimate(solid, 100, column, study=study)) for column in ("Z", "Z_ff", "C")),
                     interval(data.estimate(solid, 400, "C"))])
    return table(["", "φ_J, N = 100", "paper", "φ_J, N = 400", "paper", "Z, 100", "Z_ff, 100", "C, 100", "C, 400"],
                 rows)


def table_1(data):
    return compared(data, "Table I", solid_and_size)


def table_2(data):
    rows = []
    for solid in SOLIDS:
        said_here = [f for f in data.figures if f["place"] == "Table II" and f["solid"] == solid]
        if ("main", solid, 100) not in data.rows:
            continue
        angles = data.rows["main", solid, 100]["critical_angles"]
        same = all(abs(angles[f["column"]] - f["value"]) <= uncertainty(f) * (1 + 1e-9) for f in said_here)
        rows.append([solid, *(f"{angles[f['column']]:.3f} ({f['value']:.1f})" for f in said_here),
                     "**agrees**" if same else "**differs**"])
    return table(["ours (paper's), degrees", "ef vertex-face", "ef edge-edge", "ff vertex-face", "ff edge-edge",
                  "ff edge-face", ""], rows)


def table_3(data):
    return ("Classes by fitted cut-offs:\n\n" + compared(data, "Table III, column 1", column_alone) +
            "\nAverages over fixed cut-offs of 5°, 15° … 55°:\n\n" +
            compared(data, "Table III, column 2", column_alone))


def table_4(data):
    return (compared(data, "Table IV", column_of_solid) +
            "\nFarther from jamming, where the paper's last stable packings may have been:\n\n" +
            compared(data, "Table IV, farther", column_of_solid))


def exponents(data):
    return compared(data, "Figure 1(b)", column_of_solid) + "\n" + compared(data, "exponents", column_of_solid)


def isostatic(data):
    return compared(data, "Figure 3(b)", solid_and_size)


def figure_3(data):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            for column in ("Z", "C", "Z_ff"):
                rows.append([solid, str(particles), column] + [
                    interval(data.estimate(solid, particles, column, distance)) for distance in DISTANCES])
    return table(["", "N", "", *(f"Δφ = {number(d, 3 if d < .01 else 2)}" for d in DISTANCES)], rows)


def stability(data):
    rows = []
    for study, found in sorted(data.records["studies"].items()):
        for solid, counts in sorted(found["stability"].items()):
            rows.append([study, solid, *(str(counts[key]) for key in (
                "replicates", "failed", "goal_not_reached", "crystalline", "percolate", "span", "states",
                "stable_and_three_zero", "negative", "near_rattlers")), f"{counts['residual']:.0e}"])
    return table(["study", "", "replicates", "failed", "short of goal", "crystalline", "percolate", "span", "states",
                  "minima with three zero modes", "with negative modes", "with near-rattlers", "worst residual"], rows)


def rigidity(data):
    rows = []
    for study, found in sorted(data.records["studies"].items()):
        for name, ranks in sorted(found["rigidity"].items()):
            count = len(ranks)
            mean = {key: sum(r[key] for r in ranks) / count
                    for key in ("constraints", "rank", "self_stress", "full_rank")}
            rows.append([study, name, str(count), f"{mean['constraints']:.0f}", f"{mean['rank']:.1f}",
                         f"{mean['full_rank']:.0f}", f"{mean['self_stress']:.1f}",
                         f"{mean['full_rank'] - mean['rank']:.1f}"])
    return table(["study", "", "n", "constraints C·N/2", "rank", "6N − 3", "states of self-stress",
                  "short of full rank"], rows)


def cubes(data):
    columns = ("phi_j", "Z", "Z_ff", "C", "S", "percolates", "zero_modes", "negative_modes", "self_stress_classes")
    row = [interval(data.estimate("cube", 100, column)) for column in columns]
    return table(columns, [row])


def shifts(data):
    """Mean shift of φ_J against the base study, over replicates that are neither crystalline nor ended short of their
    goal in either."""
    rows = []
    for name, pairs in data.records["pairs"].items():
        for solid in SOLIDS:
            some = [p for p in pairs if p["solid"] == solid
                    and not {"crystalline", "goal_not_reached"} & {*p["base"]["flags"], *p["varied"]["flags"]}]
            if not some:
                continue
            moved = estimate_of([1e4 * (p["varied"]["phi_j"] - p["base"]["phi_j"]) for p in some])
            base = statistics.mean(p["base"]["phi_j"] for p in some)
            rows.append([name.removeprefix("paper-"), solid, str(len(some)), number(base, 4), interval(moved),
                         f"{max(p['varied']['residual'] for p in some):.0e}"])
    return table(["varied", "", "n", "φ_J, base", "shift of φ_J, 10⁻⁴", "worst residual"], rows)


def minimisations(data):
    """The paper's rule and ours, state by state."""
    rows = []
    edges = (1, .1, .06, .04, .028, .018)
    for solid in SOLIDS:
        for upper, lower in zip(edges, edges[1:]):
            cells = []
            for study in ("paper-rule", "paper-rule-base"):
                some = [m for m in data.records["minimisations"].get(study, [])
                        if m["solid"] == solid and lower <= m["delta_phi"] < upper]
                cells += [str(len(some)), f"{statistics.median(m['evaluations'] for m in some):.0f}",
                          f"{max(m['residual'] for m in some):.0e}"] if some else ["0", "–", "–"]
            if cells[0] != "0" or cells[3] != "0":
                rows.append([solid, f"{number(lower, 3)} … {number(upper, 3)}", *cells])
    return table(["", "Δφ", "states, rule", "evaluations", "worst residual", "states, ours", "evaluations",
                  "worst residual"], rows)


def cost(data):
    rows, stages = [], {}
    for study, found in sorted(data.records["studies"].items()):
        for solid, seconds in sorted(found["cost"]["cpu_seconds"].items()):
            rows.append([study, solid, str(len(seconds)), f"{statistics.median(seconds):.0f}",
                         f"{min(seconds):.0f} … {max(seconds):.0f}", f"{sum(seconds) / 60:.1f}"])
        for stage, seconds in found["cost"]["stages"].items():
            stages[stage] = stages.get(stage, 0) + seconds
    share = ", ".join(f"{stage} {100 * seconds / sum(stages.values()):.1f} %"
                      for stage, seconds in sorted(stages.items(), key=lambda item: -item[1]))
    return table(["study", "", "n", "median CPU s", "least … greatest", "CPU minutes in all"], rows) + \
        f"\nBy stage: {share}.\n"


BLOCKS = {f.__name__: f for f in (summary, table_1, table_2, table_3, table_4, exponents, isostatic, figure_3,
                                  stability, rigidity, cubes, shifts, minimisations, cost)}
