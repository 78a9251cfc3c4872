"""Blocks about stiffness and prestress: scaling of the softest modes, and contributions of the terms of H = ½ ggᵀ +
½ V ∇²V to the stiffness of modes."""

import statistics

from data import SOLIDS
from text import counted, number, significant, table

BINS = (0.0005, 0.002, 0.008, 0.032, 0.128)
GRID = (0.08, 0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)
SOFT = {"soft": "⟨ω_l⟩", "root_G": "√G", "root_K": "√K", "omega_over_root_G": "⟨ω_l⟩/√G",
        "omega_over_root_K": "⟨ω_l⟩/√K", "G_over_K": "G/K"}
SURE = (400, 0.008)  # size and smallest Δφ for which the page states the scaling of the softest modes


def bin_name(lower, upper):
    return " – ".join(significant(x, 3).rstrip("0") for x in (lower, upper))


def bins_falling():
    """Names of BINS as heads of columns, largest Δφ first."""
    return [bin_name(*b) for b in reversed(list(zip(BINS, BINS[1:])))]


def grid_name(distance):
    return f"Δφ = {significant(distance, 2).rstrip('0')}"


def is_known(estimate):
    """True if an exponent is known from three replicates or more, with an error of at most 1."""
    return bool(estimate) and estimate["n"] > 2 and estimate["half_width"] <= 1


def exponents(found):
    """Cells of exponents by bin, largest Δφ first; a dash where one is unknown."""
    return [counted(e) if is_known(e) else "–" for e in reversed(found)]


def over_grid(data, solid, particles, column, grid=GRID):
    """Values at distances from jamming; a dash with fewer than three replicates."""
    found = [data.at(solid, particles, column, distance) for distance in grid]
    return [counted(e) if e and e["n"] > 2 else "–" for e in found]


def by_grid(data, columns, sizes=None, grid=GRID):
    """A row for each solid, size and column with a value; columns is {column: its name on the page}."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            if sizes and particles not in sizes:
                continue
            for column, name in columns.items():
                cells = over_grid(data, solid, particles, column, grid)
                if any(cell != "–" for cell in cells):
                    rows.append([f"{solid} {particles}", *([name] if len(columns) > 1 else []), *cells])
    return table(["solid, N", *(["quantity"] if len(columns) > 1 else []), *(grid_name(d) for d in grid)], rows)


def slope_table(data, title, column, solids=SOLIDS, sizes=None):
    """Exponents of one column by bin, for solids and sizes with at least one known exponent."""
    rows = []
    for solid in solids:
        for particles in sizes or data.sizes(solid):
            found = exponents(data.slopes(solid, particles, column, BINS))
            if any(cell != "–" for cell in found):
                rows.append([f"{solid} {particles}", *found])
    return table([title, *bins_falling()], rows)


def softest(data):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            slopes = {column: exponents(data.slopes(solid, particles, column, BINS)) for column in SOFT}
            for i, name in enumerate(bins_falling()):
                cells = [slopes[column][i] for column in SOFT]
                if cells[0] != "–":
                    rows.append([f"{solid} {particles}", name, *cells])
    return table(["solid, N", "Δφ", *(f"exponent of {name}" for name in SOFT.values())], rows)


def sure_exponents(data, column):
    """Exponents in the columns of SURE, every solid and bin."""
    particles, least = SURE
    return [e for solid in SOLIDS for lower, e in zip(BINS, data.slopes(solid, particles, column, BINS))
            if lower >= least and is_known(e)]


def about_sure(data, column):
    """(number, number above 0 by more than their errors, smallest, largest) of the exponents of SURE."""
    found = sure_exponents(data, column)
    means = [e["mean"] for e in found]
    return (len(found), sum(e["mean"] > e["half_width"] + e["systematic"] for e in found),
            min(means, default=None), max(means, default=None))


def waves(data):
    return by_grid(data, {"wave": ""}, (100, 400))


def held(data):
    return by_grid(data, {"second_each": "normals < ½", "second_0.1_each": "normals < 0.1",
                          "prestress_each": "normals and stiff tilts < ½"}, (100,))


def by_threshold(data):
    """Modes to which normals and stiff tilts contribute less than half, by the threshold of stiff tilts."""
    return by_grid(data, {f"prestress_{t}_each": f"s > {t}" for t in (1, 3, 10, 30, 100)}, (100,))


def tilts_of_classes(data):
    names = {"ff": "face-face", "ef": "edge-face", "l": "lower-order"}
    return by_grid(data, {f"tilts_each_{key}": name for key, name in names.items()}, (100,))


def held_lambda(data):
    """Exponents of λ of the modes to which prestress contributes more than half."""
    return slope_table(data, "exponent of λ", "prestress_lambda")


def shares(data):
    columns = {"normal_share": "normals", "tilt_share": "stiff tilts", "prestress_share": "prestress"}
    return by_grid(data, columns, (100, 400), GRID[1:7])


def resolved(data):
    """Deviation of the sum of the shares from λ, and share of the modes that double precision does not resolve."""
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            states = []
            for r in data.counted(solid, particles):
                columns = [r["states"].get(c) for c in ("worst_sum", "unresolved", "looked_at")]
                if None not in columns:
                    states += [state for state in zip(*columns) if state[0] is not None]
            if states:
                middle = statistics.median_low(s[0] for s in states)
                rows.append([f"{solid} {particles}", str(len(states)), significant(middle, 1),
                             significant(max(s[0] for s in states), 1),
                             number(100 * sum(s[1] for s in states) / max(1, sum(s[2] for s in states)), 2)])
    return table(["solid, N", "states", "relative deviation, median over states", "largest relative deviation",
                  "unresolved modes, %"], rows)


BLOCKS = {f.__name__: f for f in (softest, waves, held, by_threshold, tilts_of_classes, held_lambda, shares, resolved)}
