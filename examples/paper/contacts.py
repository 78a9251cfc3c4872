"""Blocks about contacts: Tables II to IV, Figures 2 and 3, what cut-offs choose, how face-face contacts are spread."""

import functools

from data import SIZES, SOLIDS
from densities import STABLE_FROM, said
from estimates import correlation, correlation_interval, estimate_of, single_half_width
from limits import FORMS, limit_of_choices
from network import FACTORS, hindrance
from scaling import at, binned
from text import counted, interval, number, significant, signed, spread, table
from verdicts import uncertainty, verdict
from vibrations import DISTANCES, bin_name

GRID = (0.16, 0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001)
LIMIT_WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
HALF_TO_TWICE = slice(1, 4)  # of network.FACTORS
# Of tetrahedral dice, by tomography: the third column of the paper's Table III.
DICE = {"Z": 6.3, "Z_ff": 2.3, "Z_ef": 1.2, "Z_l": 2.8, "C": 12.1}


def compared(data, figures, name, extra=None):
    rows = []
    for figure in figures:
        estimate = data.of(figure)
        rows.append([name(figure), interval(estimate), str(estimate["n"]) if estimate else "0", spread(estimate),
                     said(figure), verdict(estimate, figure), *(extra(figure) if extra else [])])
    return rows


HEAD = ["", "ours", "n", "one packing", "paper", "the paper's lies"]


def table_2(data):
    rows = []
    for solid in SOLIDS:
        here = [f for f in data.figures if f["place"] == "Table II" and f["solid"] == solid]
        angles = data.critical.get(solid)
        if not angles:
            continue
        off = max(abs(angles[f["column"]] - f["value"]) - uncertainty(f) for f in here)
        rows.append([solid, *(f"{angles[f['column']]:.3f} ({f['value']:.1f})" for f in here),
                     "to the last digit" if off <= 1e-9 else "**differs**"])
    return table(["ours (paper's), degrees", "ef vertex-face", "ef edge-edge", "ff vertex-face", "ff edge-edge",
                  "ff edge-face", ""], rows)


def table_3(data):
    first = [f for f in data.figures if f["place"] == "Table III, column 1"]
    second = [f for f in data.figures if f["place"] == "Table III, column 2"]

    def dice(figure):
        return [number(DICE[figure["column"].removesuffix("_fixed")], 1)]

    def name(figure):
        return figure["column"].removesuffix("_fixed")

    head = [*HEAD, "dice (experiment)"]
    return ("Classes by fitted cut-offs:\n\n" + table(head, compared(data, first, name, dice)) +
            "\nMeans over fixed cut-offs of 5°, 15° … 55°:\n\n" + table(head, compared(data, second, name, dice)))


def column_of_solid(figure):
    where = f", Δφ = {number(figure['delta_phi'], 2)}" if "delta_phi" in figure else ""
    return f"{figure['solid']}, {figure['column']}{where}"


def table_4(data):
    figures = [f for f in data.figures if f["place"] == "Table IV"]
    by_rule = [{**f, "delta_phi": STABLE_FROM[f["solid"]]} for f in figures]
    return ("At the distance that the rule gives:\n\n" + table(HEAD, compared(data, by_rule, column_of_solid)) +
            "\nNearest jamming of our states:\n\n" + table(HEAD, compared(data, figures, column_of_solid)))


def figure_3(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            for column in ("Z", "C", "Z_ff"):
                cells = [counted(data.at(solid, particles, column, d)) for d in GRID]
                if any(cell != "–" for cell in cells):
                    rows.append([f"{solid} {particles}", column, *cells])
    return table(["", "", *(f"Δφ = {significant(d, 1 if d != .16 and d != .0025 else 2)}" for d in GRID)], rows)


def cutoff_range(data, solid, particles, distance=None):
    """(C by factor, Z_ff by fits and by gaps where both are, half the range of C from half to twice the cut-offs):
    estimates at a distance from jamming, or nearest it."""
    by_factor, fitted, gaps, half = [], [], [], []
    for r, x in zip(data.counted(solid, particles), data.distances(solid, particles)):
        entries = r.get("network", {}).get("by_cutoffs")
        if not entries:
            continue

        def value(values, distances=x):
            return values[-1] if distance is None else at(distances, values, distance)

        found = [value([c[i] for c, _ in entries]) for i in range(len(FACTORS))]
        by_factor.append(found)
        both = value([gap for _, gap in entries]), value(r["states"]["Z_ff"])
        if None not in both:
            gaps.append(both[0])
            fitted.append(both[1])
        near = [c for c in found[HALF_TO_TWICE] if c is not None]
        half.append((max(near) - min(near)) / 2 if len(near) == 3 else None)
    return ([estimate_of([c[i] for c in by_factor]) for i in range(len(FACTORS))], estimate_of(fitted),
            estimate_of(gaps), estimate_of(half))


def cutoffs(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            for distance in (0.01, None):
                by_factor, fitted, gap, half = cutoff_range(data, solid, particles, distance)
                if not by_factor[2]:
                    continue
                where = "nearest" if distance is None else number(distance, 2)
                rows.append([f"{solid} {particles}", where, *(interval(c) for c in by_factor),
                             f"± {number(half['mean'], 2)}" if half else "–", counted(fitted), counted(gap)])
    if not rows:
        return "Not in these records.\n"
    return table(["", "Δφ", *(f"C, cut-offs × {significant(f, 1) if f != 10 else '10'}" for f in FACTORS),
                  "half the range, ×½ to ×2", "Z_ff by fits", "Z_ff by gaps"], rows)


@functools.cache
def limit_of(data, solid, particles):
    """C as Δφ → 0: by window and form, and with the cut-off's range nearest jamming added to what these choose."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, "C")]
    every, chosen = limit_of_choices(paths, LIMIT_WINDOWS)
    half = cutoff_range(data, solid, particles)[3]
    return every, chosen, half["mean"] if half else None


def isostatic(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            every, chosen, half = limit_of(data, solid, particles)
            target = 12 - 4 / particles
            if not chosen:
                continue
            total = chosen["half_width"] + chosen["systematic"] + (half or 0)
            away = chosen["mean"] - target
            forms = " / ".join(interval(every[0, form]) if every[0, form] else "–" for form in FORMS)
            rows.append([f"{solid} {particles}", str(chosen["n"]), counted(data.nearest(solid, particles, "C")), forms,
                         number(chosen["exponent"], 2), interval(chosen), f"± {number(half, 2)}" if half else "–",
                         number(target, 2), signed(away, 2), "within" if abs(away) <= total else "**outside**"])
    return table(["", "n", "C nearest jamming", "limit by x = ½ / 1 / free, Δφ < .01", "free x", "limit ± fit ± choice",
                  "cut-offs", "target", "limit − target", "of all three errors"], rows)


def regions(data):
    """Shares of contacts in the regions of c(θ_ff), by distance."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            paths = data.network(solid, particles, "regions")
            if not paths:
                continue
            for part in range(3):
                shares = [[(max(x, 0), 100 * c[part] / sum(c)) for x, c in zip(*path)] for path in paths]
                found = [binned(shares, edges)[0] for edges in DISTANCES]
                rows.append([f"{solid} {particles}", str(part + 1), *(counted(e) for e in found)])
    return table(["contacts, %", "region", *(bin_name(*d) for d in DISTANCES)], rows) if rows else \
        "Not in these records.\n"


def emergence(data):
    """In how many states region 1 is there with and without edge-face angles being hyper-random."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            first = data.network(solid, particles, "emerged")
            second = data.network(solid, particles, "hyper_random")
            if not first:
                continue
            pairs = [(e, h) for (_, a), (_, b) in zip(first, second) for e, h in zip(a, b)]
            order = [order_of(x, a, b) for (x, a), (_, b) in zip(first, second)]
            rows.append([f"{solid} {particles}", str(len(pairs)), *(str(pairs.count(p)) for p in (
                (1, 1), (0, 1), (1, 0), (0, 0))), *(str(order.count(w)) for w in ("after", "together", "before"))])
    return table(["", "states", "both", "hyper-random alone", "region 1 alone", "neither", "packings: region 1 after",
                  "in the same state", "before"], rows) if rows else "Not in these records.\n"


def order_of(distances, emerged, hyper):
    """Which comes first as Δφ falls and stays until the end."""
    def since(flags):
        start = len(flags)
        while start and flags[start - 1]:
            start -= 1
        return start

    a, b = since(emerged), since(hyper)
    return "after" if a > b else "together" if a == b else "before"


def hindrances(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            found = []
            for r in data.counted(solid, particles):
                entry = (r.get("network", {}).get("neighbours") or [None])[-1]
                if entry and (made := hindrance(entry)):
                    found.append(made)
            if not found:
                continue
            ratio = estimate_of([f["q"] / f["p"] for f in found])
            rows.append([f"{solid} {particles}", str(len(found)),
                         *(interval(estimate_of([f[key] for f in found])) for key in ("p", "q")), interval(ratio),
                         interval(estimate_of([f["dispersion"] for f in found])),
                         *(interval(estimate_of([100 * f[key] for f in found])) for key in ("two_or_more", "poisson"))])
    return table(["nearest jamming", "n", "p, of any contact", "q, given another", "q/p", "variance/mean of k",
                  "particles with k ≥ 2, %", "Poisson, %"], rows) if rows else "Not in these records.\n"


def order_parameter(data):
    """Z_ff against φ_J and order over replicates, crystals counted where it says so."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            every = [r for r in data.all_of(solid, particles) if r["status"] == "done" and r["states"].get("Z_ff")]
            without = [r for r in every if not {"crystalline", "goal_not_reached"} & set(r["flags"])]
            crystals = [r for r in every if "crystalline" in r["flags"]]
            if len(without) < 4:
                continue
            row = [f"{solid} {particles}", str(len(without))]
            for key in ("phi_j", "Q6", "S_order"):
                r, within = order_correlation(without, key)
                row.append(f"{signed(r, 2)} ({signed(within[0], 2)} … {signed(within[1], 2)})" if within else "–")
            row += [interval(z := estimate_of([value_near(r, "Z_ff") for r in without])), spread(z), str(len(crystals)),
                    ", ".join(number(v, 2) for r in crystals if (v := value_near(r, "Z_ff")) is not None) or "–"]
            rows.append(row)
    return table(["", "n", "r(Z_ff, φ_J)", "r(Z_ff, Q6)", "r(Z_ff, S)", "Z_ff", "one packing", "crystals",
                  "their Z_ff"], rows)


def order_counts(data):
    """(intervals of correlations, those that leave 0 out, crystals, those whose Z_ff is not that of one disordered
    packing), over all solids and sizes."""
    intervals, excluded, crystals, told = 0, 0, 0, 0
    for solid in SOLIDS:
        for particles in SIZES:
            every = [r for r in data.all_of(solid, particles) if r["status"] == "done" and r["states"].get("Z_ff")]
            without = [r for r in every if not {"crystalline", "goal_not_reached"} & set(r["flags"])]
            if len(without) < 4:
                continue
            for key in ("phi_j", "Q6", "S_order"):
                within = order_correlation(without, key)[1]
                intervals += within is not None
                excluded += within is not None and within[0] * within[1] > 0
            z = estimate_of([value_near(r, "Z_ff") for r in without])
            values = [v for r in every if "crystalline" in r["flags"] and (v := value_near(r, "Z_ff")) is not None]
            crystals += len(values)
            told += sum(abs(v - z["mean"]) > single_half_width(z) for v in values)
    return intervals, excluded, crystals, told


def order_correlation(replicates, key):
    """r of Z_ff and what key says, over replicates, and its interval."""
    pairs = [(value_near(r, "Z_ff"), r["phi_j"]["phi_j"] if key == "phi_j" else value_near(r, key)) for r in replicates]
    pairs = [p for p in pairs if None not in p]
    r = correlation(*zip(*pairs)) if len(pairs) > 3 else None
    return r, correlation_interval(r, len(pairs))


def value_near(replicate, column):
    values = [v for v in replicate["states"].get(column, []) if v is not None]
    return values[-1] if values else None


BLOCKS = {f.__name__: f for f in (table_2, table_3, table_4, figure_3, cutoffs, isostatic, regions, emergence,
                                  hindrances, order_parameter)}
