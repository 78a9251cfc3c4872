"""Blocks about Figure 1: local slopes, the exponent of E, what is unstable, where stiff modes live."""

import math

from data import SIZES, SOLIDS
from estimates import estimate_of
from scaling import free_exponent, jamming_density, line
from text import counted, interval, number, power, significant, table

EDGES = tuple(0.00025 * 2 ** i for i in range(11))  # … .256
MISSING = "Not in these records: filled when they have the measure.\n"
# The paper's, of Δφ.
LAWS = {"omega_l": 2, "omega_h": 0, "E": 6, "K": 4}
NAMES = {"omega_l": "⟨ω_l⟩", "omega_h": "⟨ω_h⟩", "E": "E", "K": "K"}
DISTANCES = ((0.08, 0.256), (0.04, 0.08), (0.02, 0.04), (0.01, 0.02), (0.005, 0.01), (0.0025, 0.005), (0.0, 0.0025))


def bin_name(lower, upper):
    return f"{significant(lower, 2)} – {significant(upper, 2)}" if lower else f"< {significant(upper, 2)}"


def shown_bins(data, columns):
    """Bins in which some solid has something."""
    some = [data.slopes(s, n, c, EDGES) for s in SOLIDS for n in SIZES for c in columns]
    return [i for i in range(len(EDGES) - 1) if any(s[i] for s in some)]


def local_slopes(data):
    bins = shown_bins(data, LAWS)
    text = []
    for column, law in LAWS.items():
        rows = []
        for solid in SOLIDS:
            for particles in SIZES:
                found = data.slopes(solid, particles, column, EDGES)
                if any(found):
                    rows.append([f"{solid} {particles}", *(counted(found[i]) for i in reversed(bins))])
        text.append(f"{NAMES[column]}, of which the paper has Δφ^{law}:\n\n" + table(
            ["", *(bin_name(EDGES[i], EDGES[i + 1]) for i in reversed(bins))], rows))
    return "\n".join(text)


def exponent_of_energy(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            cells = []
            for window in ((0, 0.02), (0, 0.005)):
                found = [free_exponent(r["states"]["phi"], r["states"]["E"], near[0], window) for r, near in zip(
                    data.counted(solid, particles), data.densities(solid, particles))]
                cells.append(counted(estimate_of([f[1] if f else None for f in found])))
                cells.append(interval(estimate_of([1e4 * (f[0] - near[0]) if f else None for f, near in zip(
                    found, data.densities(solid, particles))])))
            if cells != ["–"] * 4:
                rows.append([f"{solid} {particles}", *cells])
    return table(["", "x_E, Δφ < .02", "its φ_J − ours, 10⁻⁴", "x_E, Δφ < .005", "its φ_J − ours, 10⁻⁴"], rows)


FAR = (0.02, 0.12)


def apparent_exponent(data, solid, particles, column):
    """Of one who fits φ_J over FAR and one exponent over the same states."""
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
    return table(["fits over Δφ = .02 … .12", *NAMES.values()], rows)


def by_distance(data, solid, particles, value):
    """Per bin of DISTANCES [states, sum of value(state columns, i)]."""
    bins = [[0, 0] for _ in DISTANCES]
    for r, distances in zip(data.counted(solid, particles), data.distances(solid, particles)):
        for i, x in enumerate(distances):
            for b, (lower, upper) in zip(bins, DISTANCES):
                if lower <= max(x, 0) < upper:
                    b[0] += 1
                    b[1] += value(r["states"], i)
    return bins


def descents(data):
    """Saddles that were followed down before modes were counted, and what is negative after."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            down = by_distance(data, solid, particles, lambda s, i: s["descents"][i] > 0)
            left = by_distance(data, solid, particles, lambda s, i: (s["negative"][i] or 0) > 0)
            rows.append([f"{solid} {particles}", *(
                f"{d[1]} of {d[0]}" + (f", {n[1]} left" if n[1] else "") if d[0] else "–" for d, n in zip(down, left))])
    return table(["", *(bin_name(*d) for d in DISTANCES)], rows)


def zeros(data):
    """Zero modes beyond three: of states with a near-rattler, and of states without, whose softest modes double
    precision does not tell from zero."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not data.counted(solid, particles):
                continue
            loose = by_distance(data, solid, particles, lambda s, i: s["near_rattlers"][i] > 0)
            soft = by_distance(data, solid, particles,
                               lambda s, i: not s["near_rattlers"][i] and (s["zero"][i] or 0) > 3)
            rows.append([f"{solid} {particles}", *(f"{a[1]}, {b[1]} of {a[0]}" if a[0] else "–"
                                                  for a, b in zip(loose, soft))])
    return table(["with a near-rattler, unresolved, of all", *(bin_name(*d) for d in DISTANCES)], rows)


def unstable_share(data, study, solid, column, where):
    """Negative modes of 6N, %, in states of a bin of Δφ; a replicate counts once."""
    means = []
    for r in data.studies[study]["replicates"]:
        if r["solid"] != solid or r["status"] != "done":
            continue
        here = [v for x, v in zip(r["states"]["delta_phi"], r["states"].get(column) or [])
                if where[0] <= x < where[1] and v is not None]
        if here:
            means.append(100 * sum(here) / len(here))
    return estimate_of(means)


def unstable(data):
    """Shares of negative modes by central differences, beside the exact count."""
    columns = ("unstable_exact", "unstable_h4", "unstable_h6", "unstable_h8")
    rows = []
    for name in data.studies:
        for solid in SOLIDS:
            for where in DISTANCES:
                found = [unstable_share(data, name, solid, column, where) for column in columns]
                if any(found):
                    rows.append([name.removeprefix("paper-"), solid, bin_name(*where), str(max(e["n"] for e in found if e)),
                                 *(interval(e) for e in found)])
    if not rows:
        return MISSING
    return table(["study", "", "Δφ", "n", "exact, %", "h = 10⁻⁴", "h = 10⁻⁶", "h = 10⁻⁸"], rows)


def backbone(data):
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            if not any(data.column(solid, particles, "backbone_removed")):
                continue
            columns = ("backbone_removed", "backbone_Z", "Z", "backbone_zero", "backbone_negative", "backbone_missing")
            cells = [counted(data.at(solid, particles, column, 0.005)) for column in columns]
            slopes = [data.slopes(solid, particles, c, (0.005, 0.02))[0] for c in ("backbone_omega_l", "backbone_K")]
            rows.append([f"{solid} {particles}", *cells, *(counted(s) for s in slopes)])
    if not rows:
        return MISSING
    return table(["Δφ = .005", "removed", "Z of the rest", "Z of all", "zero modes", "negative",
                  "short of full rank", "slope of ⟨ω_l⟩, Δφ = .005 – .02", "of K"], rows)


def localisation(data):
    """Share of the amplitude of the fifty stiffest modes on particles with face-face contacts, beside their share."""
    rows = []
    for solid in SOLIDS:
        for particles in SIZES:
            amplitude = data.nearest(solid, particles, "amplitude")
            if amplitude:
                rows.append([f"{solid} {particles}", str(amplitude["n"]), interval(amplitude),
                             interval(data.nearest(solid, particles, "members"))])
    return table(["nearest jamming", "n", "amplitude on particles with a face-face contact",
                  "share of such particles"], rows) if rows else MISSING


def stability(data):
    rows = []
    for name, study in data.studies.items():
        for solid in (*SOLIDS, "cube"):
            every = [r for r in study["replicates"] if r["solid"] == solid]
            done = [r for r in every if r["status"] == "done"]
            if not done or "zero" not in done[0]["states"]:
                continue
            states = [(s["zero"][i], s["negative"][i], s["near_rattlers"][i], s["descents"][i], s["residual"][i])
                      for s in (r["states"] for r in done) for i in range(len(s["phi"]))]
            ends = [r["states"] for r in done]
            rows.append([name.removeprefix("paper-"), solid, str(len(every)), str(len(every) - len(done)),
                         *(str(sum(flag in r["flags"] for r in done)) for flag in ("goal_not_reached", "crystalline")),
                         *(str(sum(bool(s[key][-1]) for s in ends)) for key in ("percolates", "spans")),
                         str(len(states)),
                         str(sum(z == 3 and n == 0 for z, n, *_ in states)),
                         str(sum((n or 0) > 0 for _, n, *_ in states)), str(sum(r > 0 for _, _, r, *_ in states)),
                         str(sum(d > 0 for *_, d, _ in states)), power(max(r for *_, r in states))])
    return table(["study", "", "replicates", "failed", "short of goal", "crystalline", "percolate", "span", "states",
                  "minima with three zero modes", "with negative modes", "with near-rattlers", "followed down",
                  "worst residual"], rows)


def minimisations(data):
    """The paper's rule and ours, state by state."""
    rows, edges = [], (1, 0.1, 0.06, 0.04, 0.028, 0.018)
    for solid in SOLIDS:
        for upper, lower in zip(edges, edges[1:]):
            cells = []
            for study in ("paper-rule", "paper-rule-base"):
                some = [(e, s) for r in data.studies.get(study, {"replicates": []})["replicates"]
                        if r["solid"] == solid and r["status"] == "done"
                        for x, e, s in zip(r["states"]["delta_phi"], r["evaluations"], r["states"]["residual"])
                        if lower <= x < upper]
                if some:
                    ordered = sorted(e for e, _ in some)
                    cells += [str(len(some)), str(ordered[len(ordered) // 2]), power(max(s for _, s in some))]
                else:
                    cells += ["0", "–", "–"]
            if cells[0] != "0" or cells[3] != "0":
                rows.append([solid, f"{number(lower, 3)} … {number(upper, 3)}", *cells])
    if not rows:
        return "Not in these records.\n"
    return table(["", "Δφ", "states, rule", "evaluations", "worst residual", "states, ours", "evaluations",
                  "worst residual"], rows)


BLOCKS = {f.__name__: f for f in (local_slopes, exponent_of_energy, apparent, descents, zeros, unstable, backbone,
                                  localisation, stability, minimisations)}
