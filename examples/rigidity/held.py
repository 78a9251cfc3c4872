"""Blocks about stiffness and prestress: what the softest modes follow, and which term of H = ½ ggᵀ + ½ V ∇²V holds
modes."""

import statistics

from data import SOLIDS
from text import counted, number, significant, table

BINS = (0.0005, 0.002, 0.008, 0.032, 0.128)
GRID = (0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)
SOFT = {"omega_l": "⟨ω_l⟩", "root_G": "√G", "root_K": "√K", "omega_over_root_G": "⟨ω_l⟩/√G",
        "omega_over_root_K": "⟨ω_l⟩/√K", "G_over_K": "G/K"}


def bin_name(lower, upper):
    return f"{significant(lower, 1)} – {significant(upper, 3).rstrip('0')}"


def bins_falling():
    """Names of BINS as heads of columns, largest Δφ first."""
    return [bin_name(*b) for b in reversed(list(zip(BINS, BINS[1:])))]


def grid_name(distance):
    return f"Δφ = {significant(distance, 2).rstrip('0')}"


def over_grid(data, solid, particles, column, grid=GRID):
    return [counted(data.at(solid, particles, column, distance)) for distance in grid]


def by_grid(data, columns, sizes=None, grid=GRID):
    """A row for each solid, size and column that have something: {column: its name on the page}."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            if sizes and particles not in sizes:
                continue
            for column, name in columns.items():
                cells = over_grid(data, solid, particles, column, grid)
                if any(cell != "–" for cell in cells):
                    rows.append([f"{solid} {particles}", *([name] if len(columns) > 1 else []), *cells])
    return table(["", *([""] if len(columns) > 1 else []), *(grid_name(d) for d in grid)], rows)


def softest(data):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 200, 400):
            slopes = {column: data.slopes(solid, particles, column, BINS) for column in SOFT}
            for i in reversed(range(len(BINS) - 1)):
                cells = [counted(slopes[column][i]) for column in SOFT]
                if cells[0] != "–" and slopes["omega_l"][i]["n"] > 2:
                    rows.append([f"{solid} {particles}", bin_name(BINS[i], BINS[i + 1]), *cells])
    return table(["exponents", "Δφ", *SOFT.values()], rows)


def nearer_zero(data):
    """Of bins with both, in how many the exponent of ⟨ω_l⟩/√G, and of ⟨ω_l⟩/√K, is 0 within its errors."""
    count = {"omega_over_root_G": 0, "omega_over_root_K": 0}
    bins = 0
    for solid in SOLIDS:
        for particles in (100, 200, 400):
            found = {column: data.slopes(solid, particles, column, BINS) for column in count}
            for pair in zip(*found.values()):
                if any(e is None or e["n"] < 4 for e in pair):
                    continue
                bins += 1
                for column, estimate in zip(count, pair):
                    count[column] += abs(estimate["mean"]) <= estimate["half_width"] + estimate["systematic"]
    return bins, count["omega_over_root_G"], count["omega_over_root_K"]


def median_size(data, column):
    """Median of the exponents, without sign, over the bins that nearer_zero counts."""
    found = [e for solid in SOLIDS for n in (100, 200, 400) for e in data.slopes(solid, n, column, BINS)
             if e and e["n"] > 3]
    return statistics.median(abs(e["mean"]) for e in found)


def held(data):
    return by_grid(data, {"second_each": "second term", "prestress_each": "prestress"}, (50, 64, 100))


def held_lambda(data):
    """Exponents of λ of the modes that prestress holds."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            found = data.slopes(solid, particles, "prestress_lambda", BINS)
            if any(e and e["n"] > 3 for e in found):
                rows.append([f"{solid} {particles}", *(counted(e) for e in reversed(found))])
    return table(["exponent of λ", *bins_falling()], rows)


def shares(data):
    columns = {"normal_share": "normals", "tilt_share": "stiff tilts", "prestress_share": "prestress"}
    return by_grid(data, columns, (100, 400), GRID[1:7])


def resolved(data):
    """How well shares add up, and how many modes double precision leaves out."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            states = []
            for r in data.counted(solid, particles):
                columns = [r["states"].get(c) for c in ("worst_sum", "unresolved", "looked_at")]
                if None not in columns:
                    states += [state for state in zip(*columns) if state[0] is not None]
            if states:
                middle = sorted(s[0] for s in states)[len(states) // 2]
                rows.append([f"{solid} {particles}", str(len(states)), significant(middle, 1),
                             significant(max(s[0] for s in states), 1),
                             number(100 * sum(s[1] for s in states) / max(1, sum(s[2] for s in states)), 2)])
    return table(["", "states", "median of the worst relative sum", "worst", "modes left out, %"], rows)


BLOCKS = {f.__name__: f for f in (softest, held, held_lambda, shares, resolved)}
