"""Numbers within sentences, by names such as `phi_j octahedron 100`: what is asked for, of which solid and size."""

from contacts import cutoff_range, limit_of, order_counts
from data import SIZES, SOLIDS
from densities import all_inside, both_sizes, is_base, levers_of, ranked, searched_solids
from estimates import estimate_of
from network import FACTORS, hindrance
from text import counted, interval, number, significant, signed
from vibrations import DISTANCES, EDGES, apparent_exponent, unstable_share


PLURALS = {"tetrahedron": "tetrahedra", "octahedron": "octahedra", "icosahedron": "icosahedra",
           "dodecahedron": "dodecahedra"}


class UnknownValue(Exception):
    """A name that the page uses and nothing answers to."""


def slope(data, column, solid, particles, lower):
    """Local exponent in the bin that begins there."""
    found = data.slopes(solid, particles, column, EDGES)
    return counted(found[min(range(len(EDGES) - 1), key=lambda i: abs(EDGES[i] - float(lower)))])


def total(data, what):
    """Counts over all replicates of disordered packings."""
    states = [(r, i) for s in SOLIDS for n in SIZES for r in data.counted(s, n) for i in range(len(r["states"]["phi"]))]
    if what == "states":
        return str(len(states))
    if what in ("far", "loose"):  # where double precision still tells a loose particle from a soft one
        far = [r["states"]["near_rattlers"][i] > 0 for s in SOLIDS for n in SIZES
               for r, x in zip(data.counted(s, n), data.distances(s, n)) for i in range(len(x)) if x[i] >= 0.0025]
        return str(len(far) if what == "far" else sum(far))
    if what == "negative":
        return str(sum((r["states"]["negative"][i] or 0) > 0 for r, i in states))
    return str(sum(r["states"][what][i] > 0 for r, i in states))


def emergence_total(data, what):
    pairs = [pair for s in SOLIDS for n in SIZES for (_, a), (_, b) in zip(
        data.network(s, n, "emerged"), data.network(s, n, "hyper_random")) for pair in zip(a, b)]
    kinds = {"alone": (1, 0), "neither": (0, 0), "second": (0, 1)}
    return str(len(pairs) if what == "states" else pairs.count(kinds[what]))


def search_value(data, what):
    entries = ranked(data)
    if not entries:
        return "–"
    best = entries[0]
    base = next((e for e in entries if is_base(e)), None)
    return {"best_chi": number(best[0], 2), "best_rms": number(best[1], 4), "count": str(len(entries)),
            "base_chi": number(base[0], 2) if base else "–", "base_rms": number(base[1], 4) if base else "–",
            "base_rank": str(entries.index(base) + 1) if base else "–",
            "least_rms": number(min(e[1] for e in entries), 4),
            "count_400": str(len(both_sizes(data))),
            "inside_400": str(sum(all_inside([a]) and all_inside([b]) for _, a, b in both_sizes(data))),
            "all_inside": str(all_inside(entries)), "solids": ", ".join(PLURALS[s] for s in searched_solids(data))}[what]


def value_of(data, name):
    what, *rest = name.split()
    if what == "total":
        return total(data, *rest)
    if what == "search":
        return search_value(data, *rest)
    if what == "order":
        return str(order_counts(data)[("all", "excluded", "crystals", "told").index(rest[0])])
    if what == "best_400":  # paper − ours of a solid in the setting that is best for both sizes
        entries = both_sizes(data)
        return f"{signed(entries[0][2][5][rest[0]], 4)} ± {number(entries[0][2][4][rest[0]]['half_width'], 4)}" \
            if entries else "–"
    if what == "lever":
        return levers_of(data, *rest)
    if what == "slope":
        column, solid, particles, lower = rest
        return slope(data, column, solid, int(particles), lower)
    if what == "unstable":
        study, solid, column, lower = rest
        where = next(d for d in DISTANCES if d[0] == float(lower))
        return counted(unstable_share(data, study, solid, column, where)) if study in data.studies else "–"
    if what == "apparent":
        column, solid, particles = rest
        return counted(apparent_exponent(data, solid, int(particles), column))
    if what == "emergence":
        return emergence_total(data, *rest)
    solid, particles = rest[0], int(rest[1])
    if what == "half":
        found = cutoff_range(data, solid, particles)[3]
        return number(found["mean"], 2) if found else "–"
    if what == "cut":
        solid, particles, where, factor = rest
        by_factor = cutoff_range(data, solid, int(particles), None if where == "nearest" else float(where))[0]
        return counted(by_factor[FACTORS.index(float(factor))])
    if what == "phi_j":
        return counted(data.phi_j(solid, particles))
    if what == "limit":
        return interval(limit_of(data, solid, particles)[1])
    if what == "distance":
        found = data.nearest_distance(solid, particles)
        return significant(found["mean"], 2) if found else "–"
    if what == "hindrance":
        entries = [hindrance(r["network"]["neighbours"][-1]) for r in data.counted(solid, particles)
                   if "network" in r and r["network"]["neighbours"][-1]]
        return counted(estimate_of([e["q"] / e["p"] for e in entries if e]))
    if what == "offset":
        theirs = next(f["value"] for f in data.figures if f["place"] == "Table I" and f["solid"] == solid
                      and f["particles"] == particles)
        ours = data.phi_j(solid, particles)
        return signed(theirs - ours["mean"], 4) if ours else "–"
    if what == "short":
        return counted(estimate_of([6 * particles - 3 - y[-1] for y in data.column(solid, particles, "rank")
                                    if y and y[-1] is not None]))
    if what in ("Z", "Z_ff", "C", "self_stress", "rows", "amplitude", "members"):
        found = data.nearest(solid, particles, what) if len(rest) == 2 else \
            data.at(solid, particles, what, float(rest[2]))
        return counted(found)
    raise UnknownValue(name)
