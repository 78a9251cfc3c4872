"""Blocks about the alignment of contacts: regions of angles, order of emergence, correlation of face-face contacts,
and Z_ff as an order parameter."""

import math
import statistics

from data import SIZES, SOLIDS
from estimates import NORMAL, binomial_at_least, estimate_of, pooled_correlation, single_half_width
from expansions import LEFT_OUT
from network import LEVEL, hindrance
from scaling import binned
from text import counted, interval, number, signed, spread, table
from vibrations import DISTANCES, bin_name

ORDERS = ("phi_j", "Q6", "S_order")


def region_shares(data, solid, particles, part):
    shares = [[(max(x, 0), 100 * c[part] / sum(c)) for x, c in zip(*path)]
              for path in data.network(solid, particles, "regions")]
    return [binned(shares, edges)[0] for edges in DISTANCES]


def regions(data):
    """Shares of contacts in the regions of c(θ_ff), by distance."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if data.network(solid, particles, "regions"):
                rows += [[f"{solid} {particles}", str(part + 1),
                          *map(counted, region_shares(data, solid, particles, part))] for part in range(3)]
    return table(["solid, N", "region", *(bin_name(*d) for d in DISTANCES)], rows) if rows else \
        "These records lack the study.\n"


def emergence(data):
    """Number of states with region 1, with hyper-random edge-face angles, with both and with neither."""
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
    return table(["solid, N", "states", "both", "only hyper-random", "only region 1", "neither",
                  "packings: region 1 later", "packings: in the same state", "packings: region 1 earlier"],
                 rows) if rows else \
        "These records lack the study.\n"


def order_of(distances, emerged, hyper):
    """Order in which the two appear as Δφ decreases; each must remain until the last state."""
    def since(flags):
        start = len(flags)
        while start and flags[start - 1]:
            start -= 1
        return start

    a, b = since(emerged), since(hyper)
    return "after" if a > b else "together" if a == b else "before"


def emergence_total(data, what):
    """Counts over all states, or over packings by the order of emergence."""
    states, orders = [], []
    for solid in SOLIDS:
        for n in SIZES:
            for (x, a), (_, b) in zip(data.network(solid, n, "emerged"), data.network(solid, n, "hyper_random")):
                states += zip(a, b)
                orders.append((solid, order_of(x, a, b)))
    if what in ("after", "together", "before"):
        return str(sum(order == what for _, order in orders))
    if what in SOLIDS:
        return str(sum((solid, order) == (what, "together") for solid, order in orders))
    return str({"packings": len(orders), "states": len(states), "neither": states.count((0, 0))}[what])


def least_seen(trials, chance):
    """Smallest number of successes that the test of network.LEVEL finds significant, over the expected number."""
    successes = math.ceil(trials * chance)
    while binomial_at_least(successes, trials, chance) >= LEVEL:
        successes += 1
    return successes / (trials * chance)


def power(data, what, solid, particles):
    """Smallest detectable ratio of densities, for the median number of contacts of a state: region 1 over region 2, or
    c(θ_ef) near 0 over random contacts."""
    counts = [c for _, states in data.network(solid, int(particles), "regions") for c in states]
    if not counts:
        return "–"
    least = min(angle for name, angle in data.critical[solid].items() if name.startswith("ff"))
    if what == "region":
        return number(least_seen(round(statistics.median(a + b for a, b, _ in counts)), 1 / least), 2)
    return number(least_seen(round(statistics.median(map(sum, counts))), 0.1), 2)


def region_least(data, part):
    """Smallest and largest share of a region, %, over all solids, sizes and distances."""
    found = [e["mean"] for solid in SOLIDS for n in SIZES for e in region_shares(data, solid, n, int(part) - 1) if e]
    return f"{number(min(found), 1)} … {number(max(found), 1)}" if found else "–"


def hindrances_of(data, solid, particles):
    """Hindrance of every replicate at the smallest Δφ."""
    entries = [(r.get("network", {}).get("neighbours") or [None])[-1] for r in data.counted(solid, particles)]
    return [made for entry in entries if entry and (made := hindrance(entry))]


def ratio_of(found):
    return estimate_of([f["q"] / f["p"] for f in found])


def rarer(data):
    """Number of solids and sizes whose interval of q/p is below 1, and number of all."""
    found = [e for solid in SOLIDS for n in SIZES if (e := ratio_of(hindrances_of(data, solid, n)))]
    return f"{sum(e['mean'] + (e['half_width'] or 0) < 1 for e in found)} of {len(found)}"


def hindrances(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            found = hindrances_of(data, solid, particles)
            if not found:
                continue
            ratio = ratio_of(found)
            rows.append([f"{solid} {particles}", str(len(found)),
                         *(interval(estimate_of([f[key] for f in found])) for key in ("p", "q")), interval(ratio),
                         interval(estimate_of([f["dispersion"] for f in found])),
                         *(interval(estimate_of([100 * f[key] for f in found])) for key in ("two_or_more", "poisson"))])
    return table(["solid, N", "n", "p", "q", "q/p", "variance/mean of k", "particles with k ≥ 2, %",
                  "Poisson distribution, %"], rows) if rows else "These records lack the study.\n"


def order_parameter(data):
    """Correlation of Z_ff with φ_J and with order over disordered replicates, and Z_ff of crystals."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            without, crystals = order_replicates(data, solid, particles)
            if len(without) < 4:
                continue
            row = [f"{solid} {particles}", str(len(without))]
            row += [correlation_text(r, within) for r, within, _ in (
                order_correlation(without, key) for key in ORDERS)]
            row += [interval(z := estimate_of([value_near(r, "Z_ff") for r in without])), spread(z), str(len(crystals)),
                    ", ".join(number(v, 2) for r in crystals if (v := value_near(r, "Z_ff")) is not None) or "–"]
            rows.append(row)
        pairs = sum(len(order_replicates(data, solid, n)[0]) for n in SIZES)
        rows.append([f"{solid}, both sizes", str(pairs),
                     *(correlation_text(*pooled(data, solid, key)) for key in ORDERS), *["–"] * 4])
    return table(["solid, N", "n", "r(Z_ff, φ_J)", "r(Z_ff, Q6)", "r(Z_ff, S_l)", "Z_ff", "prediction interval",
                  "number of crystals", "Z_ff of crystals"], rows)


def order_replicates(data, solid, particles):
    """(disordered replicates, crystals) that have a Z_ff."""
    every = [r for r in data.all_of(solid, particles) if r["status"] == "done" and r["states"].get("Z_ff")]
    return ([r for r in every if not LEFT_OUT & set(r["flags"])], [r for r in every if "crystalline" in r["flags"]])


def correlation_text(r, within):
    return f"{signed(r, 2)} ({signed(within[0], 2)} … {signed(within[1], 2)})" if within else "–"


def pooled(data, solid, key):
    """Correlation of Z_ff with a quantity, pooled over both sizes, and its interval."""
    found = [order_correlation(order_replicates(data, solid, n)[0], key) for n in SIZES]
    return pooled_correlation([(r, pairs) for r, _, pairs in found])


def pooled_value(data):
    """Number of pooled intervals that exclude 0, and number of all."""
    found = [within for s in SOLIDS for key in ORDERS if (within := pooled(data, s, key)[1])]
    return f"{sum(low * high > 0 for low, high in found)} of {len(found)}"


def resolved(data, which):
    """Smallest |r| whose interval excludes 0, for the row with the fewest or the most pairs."""
    pairs = [n for s in SOLIDS for size in SIZES if (n := len(order_replicates(data, s, size)[0])) > 3]
    if not pairs:
        return "–"
    return number(math.tanh(NORMAL / math.sqrt((min(pairs) if which == "fewest" else max(pairs)) - 3)), 2)


def order_counts(data):
    """(intervals of correlations, those that exclude 0, crystals, crystals with Z_ff outside of the prediction interval
    of disordered packings), over all solids and sizes."""
    intervals, excluded, crystals, outside = 0, 0, 0, 0
    for solid in SOLIDS:
        for particles in SIZES:
            without, ordered = order_replicates(data, solid, particles)
            if len(without) < 4:
                continue
            for key in ORDERS:
                within = order_correlation(without, key)[1]
                intervals += within is not None
                excluded += within is not None and within[0] * within[1] > 0
            z = estimate_of([value_near(r, "Z_ff") for r in without])
            values = [v for r in ordered if (v := value_near(r, "Z_ff")) is not None]
            crystals += len(values)
            outside += sum(abs(v - z["mean"]) > single_half_width(z) for v in values)
    return intervals, excluded, crystals, outside


def order_correlation(replicates, key):
    """Correlation of Z_ff with a quantity over replicates, its interval and the number of pairs."""
    pairs = [(value_near(r, "Z_ff"), r["phi_j"]["phi_j"] if key == "phi_j" else value_near(r, key)) for r in replicates]
    pairs = [p for p in pairs if None not in p]
    try:
        r = statistics.correlation(*zip(*pairs)) if len(pairs) > 3 else None
    except statistics.StatisticsError:  # one of the two is constant
        r = None
    return r, pooled_correlation([(r, len(pairs))])[1], len(pairs)


def value_near(replicate, column):
    values = [v for v in replicate["states"].get(column, []) if v is not None]
    return values[-1] if values else None


BLOCKS = {f.__name__: f for f in (regions, emergence, hindrances, order_parameter)}
VALUES = {
    "rarer": rarer,
    "emergence": emergence_total, "power": power, "region": region_least, "pooled": pooled_value, "resolved": resolved,
    "order": lambda data, what: str(order_counts(data)[("all", "excluded", "crystals", "outside").index(what)])}
