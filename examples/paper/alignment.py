"""Blocks about how contacts are aligned and spread: regions of angles, what emerges first, whether face-face contacts
are rare together, what Z_ff tells of order."""

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
    return table(["solid, N", "states", "both", "hyper-random alone", "region 1 alone", "neither",
                  "packings: region 1 after", "in the same state", "before"], rows) if rows else \
        "Not in these records.\n"


def order_of(distances, emerged, hyper):
    """Which comes first as Δφ falls and stays until the end."""
    def since(flags):
        start = len(flags)
        while start and flags[start - 1]:
            start -= 1
        return start

    a, b = since(emerged), since(hyper)
    return "after" if a > b else "together" if a == b else "before"


def emergence_total(data, what):
    """Counts over all states, or over packings by what comes first."""
    states, orders = [], []
    for solid in SOLIDS:
        for n in SIZES:
            for (x, a), (_, b) in zip(data.network(solid, n, "emerged"), data.network(solid, n, "hyper_random")):
                states += zip(a, b)
                orders.append((solid, order_of(x, a, b)))
    kinds = {"alone": (1, 0), "neither": (0, 0), "second": (0, 1)}
    if what in ("after", "together", "before"):
        return str(sum(order == what for _, order in orders))
    if what in SOLIDS:
        return str(sum((solid, order) == (what, "together") for solid, order in orders))
    return str(len(orders) if what == "packings" else len(states) if what == "states" else states.count(kinds[what]))


def least_seen(trials, chance):
    """Successes over those expected, of the fewest that the test of network.LEVEL calls more than chance."""
    successes = math.ceil(trials * chance)
    while binomial_at_least(successes, trials, chance) >= LEVEL:
        successes += 1
    return successes / (trials * chance)


def power(data, what, solid, particles):
    """How many times as dense as region 2 region 1 must be, or as random contacts c(θ_ef) near 0, to be told: with the
    median number of contacts of a state."""
    counts = [c for _, states in data.network(solid, int(particles), "regions") for c in states]
    if not counts:
        return "–"
    least = min(angle for name, angle in data.critical[solid].items() if name.startswith("ff"))
    if what == "region":
        return number(least_seen(round(statistics.median(a + b for a, b, _ in counts)), 1 / least), 2)
    return number(least_seen(round(statistics.median(map(sum, counts))), 0.1), 2)


def region_least(data, part):
    """The least and the greatest share of a region, %, of all solids, sizes and distances."""
    found = [e["mean"] for solid in SOLIDS for n in SIZES for e in region_shares(data, solid, n, int(part) - 1) if e]
    return f"{number(min(found), 1)} … {number(max(found), 1)}" if found else "–"


def hindrances_of(data, solid, particles):
    """Hindrance of every replicate nearest jamming."""
    entries = [(r.get("network", {}).get("neighbours") or [None])[-1] for r in data.counted(solid, particles)]
    return [made for entry in entries if entry and (made := hindrance(entry))]


def ratio_of(found):
    return estimate_of([f["q"] / f["p"] for f in found])


def rarer(data):
    """In how many solids and sizes q/p is below 1 by its interval, of all."""
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
    return table(["nearest jamming", "n", "p, of any contact", "q, given another", "q/p", "variance/mean of k",
                  "particles with k ≥ 2, %", "Poisson, %"], rows) if rows else "Not in these records.\n"


def order_parameter(data):
    """Z_ff against φ_J and order over replicates, crystals counted where it says so."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            without, crystals = order_replicates(data, solid, particles)
            if len(without) < 4:
                continue
            row = [f"{solid} {particles}", str(len(without))]
            row += [correlation_told(r, within) for r, within, _ in (
                order_correlation(without, key) for key in ORDERS)]
            row += [interval(z := estimate_of([value_near(r, "Z_ff") for r in without])), spread(z), str(len(crystals)),
                    ", ".join(number(v, 2) for r in crystals if (v := value_near(r, "Z_ff")) is not None) or "–"]
            rows.append(row)
        pairs = sum(len(order_replicates(data, solid, n)[0]) for n in SIZES)
        rows.append([f"{solid}, both sizes", str(pairs),
                     *(correlation_told(*pooled(data, solid, key)) for key in ORDERS), *["–"] * 4])
    return table(["solid, N", "n", "r(Z_ff, φ_J)", "r(Z_ff, Q6)", "r(Z_ff, S_l)", "Z_ff", "one packing", "crystals",
                  "their Z_ff"], rows)


def order_replicates(data, solid, particles):
    """(disordered replicates, crystals) that have a Z_ff."""
    every = [r for r in data.all_of(solid, particles) if r["status"] == "done" and r["states"].get("Z_ff")]
    return ([r for r in every if not LEFT_OUT & set(r["flags"])], [r for r in every if "crystalline" in r["flags"]])


def correlation_told(r, within):
    return f"{signed(r, 2)} ({signed(within[0], 2)} … {signed(within[1], 2)})" if within else "–"


def pooled(data, solid, key):
    """r of Z_ff and what key says, and its interval, that both sizes share."""
    found = [order_correlation(order_replicates(data, solid, n)[0], key) for n in SIZES]
    return pooled_correlation([(r, pairs) for r, _, pairs in found])


def pooled_value(data, *words):
    """Value of one solid and key, or the number of pooled intervals that exclude 0, out of all."""
    if words:
        return correlation_told(*pooled(data, *words))
    found = [within for s in SOLIDS for key in ORDERS if (within := pooled(data, s, key)[1])]
    return f"{sum(low * high > 0 for low, high in found)} of {len(found)}"


def correlation_value(data, solid, particles, key):
    return correlation_told(*order_correlation(order_replicates(data, solid, int(particles))[0], key)[:2])


def resolved(data, which):
    """The least |r| that leaves 0 out, of the fewest and of the most pairs of a row."""
    pairs = [n for s in SOLIDS for size in SIZES if (n := len(order_replicates(data, s, size)[0])) > 3]
    if not pairs:
        return "–"
    return number(math.tanh(NORMAL / math.sqrt((min(pairs) if which == "fewest" else max(pairs)) - 3)), 2)


def order_counts(data):
    """(intervals of correlations, those that leave 0 out, crystals, those whose Z_ff is not that of one disordered
    packing), over all solids and sizes."""
    intervals, excluded, crystals, told = 0, 0, 0, 0
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
            told += sum(abs(v - z["mean"]) > single_half_width(z) for v in values)
    return intervals, excluded, crystals, told


def order_correlation(replicates, key):
    """r of Z_ff and what key says, over replicates, its interval and the number of pairs."""
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
    "correlation": correlation_value,
    "hindrance": lambda data, solid, n: counted(ratio_of(hindrances_of(data, solid, int(n)))),
    "order": lambda data, what: str(order_counts(data)[("all", "excluded", "crystals", "told").index(what)])}
