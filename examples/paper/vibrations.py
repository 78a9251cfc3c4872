"""Blocks about Figure 1: local exponents, the exponent of E, localisation of the stiffest modes."""

import math

from data import RATIO, SIZES, SOLIDS
from estimates import estimate_of
from scaling import free_exponent, jamming_density, line
from text import counted, interval, significant, table

EDGES = tuple(0.00025 * 2 ** i for i in range(11))  # … 0.256
MISSING = "These records lack the measure.\n"
# The paper's exponents of Δφ.
LAWS = {"omega_l": 2, "omega_h": 0, "E": 6, "K": 4}
NAMES = {"omega_l": "⟨ω_l⟩", "omega_h": "⟨ω_h⟩", "E": "E", "K": "K", RATIO: "⟨ω_l⟩/√K"}
SAID = {"omega_l": "exponent 2 in the paper", "omega_h": "exponent 0 near jamming in the paper",
        "E": "exponent 6 in the paper", "K": "exponent 4 in the paper",
        RATIO: "exponent 0 in the paper; the exponent of ⟨ω_l⟩ less half the exponent of K of each replicate"}
# Lower edges of bins: the largest and the smallest within the paper's range 0.01 … 0.16, and one nearer to jamming.
ENDS = (0.064, 0.016, 0.004)
DISTANCES = ((0.08, 0.256), (0.04, 0.08), (0.02, 0.04), (0.01, 0.02), (0.005, 0.01), (0.0025, 0.005), (0.0, 0.0025))


def bin_name(lower, upper):
    ends = [significant(x, 2).rstrip("0") for x in (lower, upper)]
    return " – ".join(ends) if lower else f"< {ends[1]}"


def shown_bins(data, columns):
    """Bins in which at least one solid has a value."""
    some = [data.slopes(s, n, c, EDGES) for s in SOLIDS for n in SIZES for c in columns]
    return [i for i in range(len(EDGES) - 1) if any(s[i] for s in some)]


def local_slopes(data):
    bins = shown_bins(data, LAWS)
    text = []
    for column, said in SAID.items():
        rows = []
        for solid in SOLIDS:
            for particles in SIZES:
                found = data.slopes(solid, particles, column, EDGES)
                if any(found):
                    rows.append([f"{solid} {particles}", *(counted(found[i]) for i in reversed(bins))])
        text.append(f"{NAMES[column]}, {said}:\n\n" + table(
            ["solid, N", *(bin_name(EDGES[i], EDGES[i + 1]) for i in reversed(bins))], rows))
    return "\n".join(text)


def bin_from(lower):
    """Index of the bin of EDGES with this lower edge."""
    return min(range(len(EDGES) - 1), key=lambda i: abs(EDGES[i] - float(lower)))


def exponents(data):
    """Exponents with N = 400, the size of the paper's figures, in the bins of ENDS."""
    bins = [bin_from(lower) for lower in ENDS]
    rows = [[f"{NAMES[column]}, {solid}", *(counted(data.slopes(solid, 400, column, EDGES)[i]) for i in bins),
             str(LAWS.get(column, 0))] for column in ("E", "K", "omega_l", RATIO) for solid in SOLIDS]
    return table(["exponent of, N = 400, Δφ =", *(bin_name(EDGES[i], EDGES[i + 1]) for i in bins), "paper"], rows)


def off_laws(data):
    """Bins of Δφ = 0.008 – 0.13, N = 400, all solids: the number whose exponent of ⟨ω_l⟩/√K exceeds 0 by both its
    errors, and the number of all."""
    found = [e for solid in SOLIDS for i, e in enumerate(data.slopes(solid, 400, RATIO, EDGES))
             if e and e["n"] > 2 and 0.007 < EDGES[i] < EDGES[i + 1] < 0.16]
    return f"{sum(e['mean'] > e['half_width'] + e.get('systematic', 0) for e in found)} of {len(found)}"


def free_energy(data, solid, particles, window):
    """Fit of E ∝ Δφ^x with free φ_J: estimates of x, and of the difference of this φ_J from ours, 10⁻⁴."""
    near = data.densities(solid, particles)
    found = [free_exponent(r["states"]["phi"], r["states"]["E"], n[0], window)
             for r, n in zip(data.counted(solid, particles), near)]
    return (estimate_of([f[1] if f else None for f in found]),
            estimate_of([1e4 * (f[0] - n[0]) if f else None for f, n in zip(found, near)]))


def exponent_of_energy(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            cells = []
            for window in ((0, 0.02), (0, 0.005)):
                x, moved = free_energy(data, solid, particles, window)
                cells += [counted(x), interval(moved)]
            if cells != ["–"] * 4:
                rows.append([f"{solid} {particles}", *cells])
    return table(["solid, N", "exponent, Δφ < 0.02", "shift of φ_J, 10⁻⁴", "exponent, Δφ < 0.005",
                  "shift of φ_J, 10⁻⁴"], rows)


FAR = (0.02, 0.12)


def apparent_exponent(data, solid, particles, column):
    """Exponent that results if φ_J is fitted over FAR and one exponent over the same states."""
    found = []
    for r in data.counted(solid, particles):
        values = r["states"].get(column)
        density = jamming_density(r["states"]["phi"], r["states"]["E"], r["phi_j"]["phi_j"], FAR)
        if values is None or density is None:
            continue
        some = [(math.log(x - density), math.log(y)) for x, y in zip(r["states"]["phi"], values)
                if FAR[0] <= x - density < FAR[1] and y]
        found.append(line(*zip(*some))[1] if len(some) > 2 else None)
    return estimate_of(found)


def apparent(data):
    rows = [[f"{solid} {particles}", *(counted(apparent_exponent(data, solid, particles, column)) for column in LAWS)]
            for solid in SOLIDS for particles in SIZES if data.counted(solid, particles)]
    return table(["exponent over Δφ = 0.02 … 0.12", *(NAMES[column] for column in LAWS)], rows)


def apparent_above(data, column, exponent):
    """Number of solids with N = 400 whose exponent is significantly above a value, and number of all."""
    found = [e for solid in SOLIDS if (e := apparent_exponent(data, solid, 400, column)) and e["n"] > 1]
    return f"{sum(e['mean'] - e['half_width'] > float(exponent) for e in found)} of {len(found)}"


def localisation(data):
    """Share of Σ|u|² of the fifty stiffest modes on particles with face-face contacts, beside the share of these."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            amplitude = data.nearest(solid, particles, "amplitude")
            if amplitude:
                rows.append([f"{solid} {particles}", str(amplitude["n"]), interval(amplitude),
                             interval(data.nearest(solid, particles, "members"))])
    return table(["solid, N", "n", "share of the squared amplitude", "share of the particles"],
                 rows) if rows else MISSING


BLOCKS = {f.__name__: f for f in (local_slopes, exponents, exponent_of_energy, apparent, localisation)}
VALUES = {"off_laws": off_laws, "apparent_above": apparent_above}
