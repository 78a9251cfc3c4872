"""Blocks about φ_J: Table I, what the paper's offsets look like, and the search for a setting that gives its values."""

import itertools
import math
import statistics

from data import SIZES, SOLIDS
from estimates import estimate_of, single_half_width, student
from scaling import jamming_density
from text import counted, interval, number, signed, significant, spread, table
from verdicts import verdict

# Rounded dice in a box, the third column of the paper's Table I.
EXPERIMENT = {"tetrahedron": (0.64, 0.01), "octahedron": (0.64, 0.01), "icosahedron": (0.59, 0.01),
              "dodecahedron": (0.63, 0.01)}
# Lower ends that the paper's stable states leave, from the caption of its Figure 3.
STABLE_FROM = {"tetrahedron": 0.04, "octahedron": 0.02, "icosahedron": 0.01, "dodecahedron": 0.01}
FITS = {"< .02": (0, 0.02), "< .04": (0, 0.04), ".01 – .06": (0.01, 0.06), ".02 – .06": (0.02, 0.06),
        ".02 – .12": (0.02, 0.12), ".04 – .16": (0.04, 0.16), "stable – .12": (None, 0.12),
        "stable – .16": (None, 0.16)}
TARGET = 3.2e-5
BASE = ({"before": False, "step": 0.02, "budget": 2000}, "< .02")


def said(figure):
    """What the paper says."""
    if "digits" not in figure:
        return significant(figure["value"], 4)
    text = number(figure["value"], figure["digits"])
    return text + (f" ± {number(figure['error'], figure['digits'])}" if "error" in figure else "")


def table_1(data):
    rows = []
    for figure in (f for f in data.figures if f["place"] == "Table I"):
        estimate = data.of(figure)
        value, error = EXPERIMENT[figure["solid"]]
        rows.append([f"{figure['solid']} {figure['particles']}", interval(estimate),
                     str(estimate["n"]) if estimate else "0", spread(estimate), said(figure),
                     signed(figure["value"] - estimate["mean"], 4) if estimate else "–", verdict(estimate, figure),
                     f"{number(value, 2)} ± {number(error, 2)}"])
    return table(["", "ours", "n", "one packing", "paper", "paper − ours", "the paper's lies",
                  "dice (experiment)"], rows)


def offsets_of(data):
    """By solid, {size: (paper − ours, standard deviation that one packing of ours has about our mean)}."""
    made = {}
    for figure in (f for f in data.figures if f["place"] == "Table I"):
        values = [f[0] for f in data.densities(figure["solid"], figure["particles"])]
        if len(values) > 2:
            deviation = statistics.stdev(values) * math.sqrt(1 + 1 / len(values))
            made.setdefault(figure["solid"], {})[figure["particles"]] = (
                figure["value"] - statistics.fmean(values), deviation)
    return made


def chi_square_below(x, freedom):
    """Probability of a lesser χ², of an even number of degrees of freedom."""
    half = x / 2
    return 1 - math.exp(-half) * sum(half ** i / math.factorial(i) for i in range(freedom // 2))


def offsets(data):
    found = offsets_of(data)
    both = {solid: sizes for solid, sizes in found.items() if len(sizes) == len(SIZES)}
    rows = []
    for solid, sizes in found.items():
        cells = [f"{signed(sizes[n][0], 4)} ({number(sizes[n][0] / sizes[n][1], 1)} sd)" if n in sizes else "–"
                 for n in SIZES]
        if solid in both:
            apart = math.hypot(sizes[100][1], sizes[400][1])
            cells += [signed(sizes[400][0] - sizes[100][0], 4), f"± {number(apart, 4)}"]
        else:
            cells += ["–", "–"]
        rows.append([solid, *cells])
    text = table(["paper − ours", "N = 100", "N = 400", "400 less 100", "sd of that, single packings"], rows)
    if len(both) == len(SOLIDS):
        chi = sum(((s[400][0] - s[100][0]) / math.hypot(s[100][1], s[400][1])) ** 2 for s in both.values())
        text += (f"\nOf the last two columns χ² = {number(chi, 2)} for four solids; of single packings it would be as "
                 f"small or smaller in {significant(100 * chi_square_below(chi, 4), 2)} of 100 cases.\n")
        every = sum((off / sd) ** 2 for sizes in both.values() for off, sd in sizes.values())
        text += (f"Of all eight offsets, in sd, it is {number(every, 1)}; of single packings it would be as large or larger "
                 f"in {significant(100 - 100 * chi_square_below(every, 8), 1)} of 100.\n")
    return text


def searched_of(data, particles):
    return [r for r in itertools.chain(*data.search.values()) if r.get("particles", 100) == particles]


def settings_of(data, particles=100):
    """{setting: {solid: replicates that count}} of the search."""
    made = {}
    for replicate in searched_of(data, particles):
        if replicate["status"] == "done" and not {"crystalline"} & set(replicate["flags"]):
            key = tuple(sorted(replicate["setting"].items()))
            made.setdefault(key, {}).setdefault(replicate["solid"], []).append(replicate)
    return made


def refitted(replicates, fit, solid):
    window = (STABLE_FROM[solid] if fit[0] is None else fit[0], fit[1])
    return estimate_of([jamming_density(r["phi"], r["E"], r["phi_j"], window) for r in replicates])


def ranked(data, particles=100):
    """Settings that have all solids that were searched, best first: (χ², root mean square of paper − ours, setting,
    window, estimates, paper − ours)."""
    theirs = {f["solid"]: f["value"] for f in data.figures if f["place"] == "Table I" and f["particles"] == particles}
    made, searched = [], searched_solids(data, particles)
    for setting, solids in settings_of(data, particles).items():
        for name, fit in FITS.items():
            found = {s: refitted(solids.get(s, []), fit, s) for s in searched}
            if any(not e or e["n"] < 3 for e in found.values()):
                continue
            off = {s: theirs[s] - found[s]["mean"] for s in searched}
            # One packing's standard deviation about our mean: half_width is t·sd/√n.
            chi = sum((off[s] / deviation_of(found[s])) ** 2 for s in searched)
            root_mean_square = math.sqrt(statistics.fmean(x * x for x in off.values()))
            made.append((chi, root_mean_square, dict(setting), name, found, off))
    return sorted(made, key=lambda entry: entry[0])


def searched_solids(data, particles=100):
    """Those of which some setting has three replicates: of a search under way, not all."""
    return [s for s in SOLIDS if any(len(solids.get(s, [])) >= 3 for solids in settings_of(data, particles).values())]


def all_inside(entries):
    """In how many settings every value of the paper lies within the interval of our mean."""
    return sum(all(abs(off) <= found[s]["half_width"] for s, off in offs.items())
               for _, _, _, _, found, offs in entries)


def deviation_of(estimate):
    """sd·√(1 + 1/n), from t·sd/√n."""
    return single_half_width(estimate) / student(estimate["n"] - 1)


def is_base(entry):
    return entry[3] == BASE[1] and is_base_setting(entry[2])


def name_of(setting, window):
    reading = "before" if setting["before"] else "after"
    if setting["target"] != TARGET:
        reading += f", {significant(setting['target'], 1)}"
    return [reading, number(setting["step"], 3), str(setting["budget"]), window]


def search(data, best=6):
    entries, searched = ranked(data), searched_solids(data)
    if not entries:
        return "Not in these records.\n"
    shown = entries[:best] + [entry for entry in entries[best:] if is_base(entry)]
    by_size = min(entries, key=lambda entry: entry[1])
    if by_size not in shown:
        shown.append(by_size)
    rows = [[str(entries.index(e) + 1), *name_of(e[2], e[3]), number(e[0], 2), number(e[1], 4),
             *(f"{number(e[4][s]['mean'], 4)} ± {number(e[4][s]['half_width'], 4)} ({signed(e[5][s], 4)})"
               for s in searched)] for e in shown]
    return table(["rank", "target read", "step", "budget", "window", "χ²", "rms offset",
                  *(f"{s}, ours (paper − ours)" for s in searched)], rows) + (
        f"\n{len(entries)} settings and windows of {len(searched)} solids; in {all_inside(entries)} of them all of the "
        f"paper's values lie within the intervals of our means.\n")


def both_sizes(data):
    """Settings and windows of which both sizes are known: (χ² of all values, the entry of N = 100, that of 400)."""
    small = {(tuple(sorted(e[2].items())), e[3]): e for e in ranked(data)}
    found = [(small[key], e) for e in ranked(data, 400) if (key := (tuple(sorted(e[2].items())), e[3])) in small]
    return sorted(((a[0] + b[0], a, b) for a, b in found), key=lambda entry: entry[0])


def failed_of(data, particles):
    """In words, which ways up led replicates past the greatest density."""
    counts = {}
    for r in searched_of(data, particles):
        key = (r["solid"], "before" if r["setting"]["before"] else "after")
        failed, every = counts.get(key, (0, 0))
        counts[key] = (failed + (r["status"] != "done"), every + 1)
    told = [f"{solid}, {reading}: {failed} of {every}" for (solid, reading), (failed, every) in counts.items() if failed]
    return f"Consolidation did not end in {'; '.join(told)} replicates. " if told else ""


def search_400(data, best=4):
    entries = both_sizes(data)
    if not entries:
        return "Not in these records.\n"
    searched = searched_solids(data, 400)
    rows = [[*name_of(b[2], b[3]), number(a[0], 2), number(b[0], 2),
             *(f"{number(b[4][s]['mean'], 4)} ± {number(b[4][s]['half_width'], 4)} ({signed(b[5][s], 4)})"
               for s in searched)] for _, a, b in entries[:best]]
    return table(["target read", "step", "budget", "window", "χ², N = 100", "χ², N = 400",
                  *(f"{s}, N = 400, ours (paper − ours)" for s in searched)], rows) + (
        f"\n{failed_of(data, 400)}{len(entries)} settings and windows of {len(searched)} solids with N = 400; in "
        f"{sum(all_inside([a]) and all_inside([b]) for _, a, b in entries)} of them all values of both sizes lie within "
        f"the intervals of our means.\n")


def moved_by(data, setting, solid):
    """Shift of φ_J, 10⁻⁴, against the base setting, in pairs of replicates that began alike."""
    every = [r for r in searched_of(data, 100)
             if r["solid"] == solid and r["status"] == "done" and "crystalline" not in r["flags"]]
    base = {r["replicate"]: r["phi_j"] for r in every if is_base_setting(r["setting"])}
    return estimate_of([1e4 * (r["phi_j"] - base[r["replicate"]]) for r in every
                        if r["setting"] == setting and r["replicate"] in base])


def is_base_setting(setting):
    return setting["target"] == TARGET and all(setting[key] == value for key, value in BASE[0].items())


def levers(data):
    """What each choice of the way up moves."""
    rows = []
    for setting in map(dict, settings_of(data)):
        if not is_base_setting(setting):
            rows.append(([setting["target"] != TARGET, setting["before"], setting["step"], setting["budget"]],
                         [*name_of(setting, "")[:3], *(counted(moved_by(data, setting, s)) for s in SOLIDS)]))
    return table(["target read", "step", "budget", *SOLIDS], [row for _, row in sorted(rows)]) if rows else \
        "Not in these records.\n"


def levers_of(data, solid, reading, step, budget):
    setting = {"before": reading == "before", "step": float(step), "budget": int(budget), "target": TARGET}
    return counted(moved_by(data, setting, solid))


def windows(data):
    """What windows over the same states move, N = 100, against the nearest."""
    rows = []
    for name, fit in FITS.items():
        cells = []
        for solid in SOLIDS:
            moved = []
            for r, near in zip(data.counted(solid, 100), data.densities(solid, 100)):
                window = (STABLE_FROM[solid] if fit[0] is None else fit[0], fit[1])
                there = jamming_density(r["states"]["phi"], r["states"]["E"], r["phi_j"]["phi_j"], window)
                moved.append(None if there is None else 1e4 * (there - near[0]))
            cells.append(counted(estimate_of(moved)))
        rows.append([name, *cells])
    return table(["fit over Δφ", *SOLIDS], rows)


BLOCKS = {f.__name__: f for f in (table_1, offsets, search, search_400, levers, windows)}
