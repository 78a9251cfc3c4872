"""Draws the figures of the page from data: python3 figures.py OUT DATA/records.json [...]"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

import matplotlib  # noqa: E402
from matplotlib import pyplot  # noqa: E402

import preparations  # noqa: E402
import verdict  # noqa: E402
from data import SOLIDS, SOLIDS_64, Data  # noqa: E402
from drawing import COLOURS, MARKERS, PALETTE, SETTINGS, WIDTH, curve, letter, mean_path, save, solid_legend  # noqa: E402
from estimates import estimate_of  # noqa: E402
from tables import EDGES, drawn_size, other_solids  # noqa: E402
from troughs import density  # noqa: E402

DRAWN = (0.02, 0.01, 0.005, 0.001)  # Δφ of the densities of angles, beside the nearest


def shades(colour, count):
    """Colours from light to full."""
    full = matplotlib.colors.to_rgb(colour)
    depths = [1 - 0.65 * (count - 1 - i) / max(1, count - 1) for i in range(count)]
    return [tuple(1 - (1 - c) * depth for c in full) for depth in depths]


def angles(data, out):
    """Density of log θ_ef, with the trough and the fitted cut-off."""
    particles = drawn_size(data)
    figure, panels = pyplot.subplots(2, 2, figsize=(WIDTH, 4.6), sharex=True, sharey=True, layout="constrained")
    for axes, solid, name in zip(panels.flat, SOLIDS, "abcd"):
        places = [d for d in DRAWN if data.trough(solid, particles, d)]+ [None]
        for distance, colour in zip(places, shades(COLOURS[solid], len(places))):
            entry = data.trough(solid, particles, distance)
            if not entry or "theta_ef" not in entry:
                continue
            x, y, error = density(entry, "theta_ef")
            shown = [i for i, value in enumerate(y) if value > 0]
            at = distance or data.nearest_distance(solid, particles)["mean"]
            axes.errorbar([x[i] for i in shown], [y[i] for i in shown], [error[i] for i in shown], color=colour,
                          linewidth=1.6 if distance is None else 1, elinewidth=0.6, marker=MARKERS[solid] if distance is None else "",
                          markersize=3, label=f"Δφ = {at:.2g}")
            if distance is None and entry["edge_face"].get("cutoff"):
                trough = entry["edge_face"]
                axes.axvspan(trough["low"], trough["high"], color="0.85", linewidth=0)
                axes.axvline(trough["cutoff"], color="0.4", linewidth=0.8, linestyle=":")
        fitted = data.nearest(solid, particles, "cut_ef")
        if fitted:
            axes.annotate("", (fitted["mean"], 0.05), (fitted["mean"], 0.02), arrowprops={"arrowstyle": "-|>"})
        axes.set(xscale="log", yscale="log", xlim=(3e-8, 2), ylim=(0.02, 300))
        axes.legend(loc="upper left", handlelength=1.4)
        letter(axes, name, f"{solid}, N = {particles}")
    figure.supxlabel("alignment angle θ$_{ef}$ (rad)", fontsize=8.5)
    figure.supylabel("dn/d log$_{10}$ θ$_{ef}$ per particle", fontsize=8.5)
    save(figure, out / "angles")


def band(axes, data, solid, particles, column):
    low, high = (mean_path(data, solid, particles, f"{column}_{of}") for of in ("half", "double"))
    common = [d for d in low[0] if d in high[0]]
    if common:
        axes.fill_between(common, [low[1][low[0].index(d)] for d in common], [high[1][high[0].index(d)] for d in common],
                          color=COLOURS[solid], alpha=0.2, linewidth=0)


def counting(data, out):
    """Missing and redundant constraints, and C against 1/N."""
    figure, (left, middle, right) = pyplot.subplots(1, 3, figsize=(WIDTH, 2.8), layout="constrained")
    for solid in SOLIDS:
        for axes, column in ((left, "missing"), (middle, "redundant")):
            band(axes, data, solid, 100, column)
            curve(axes, mean_path(data, solid, 100, column), solid)
        points = [(1 / n, verdict.mean(data, solid, n, "m_x")) for n in verdict.sizes(data, solid)]
        for x, e in (*points, (0, verdict.limit(data, solid, "m_x"))):
            filled, x = x > 0, x + 0.0002 * (SOLIDS.index(solid) - 1)
            right.errorbar([x], [e["mean"]], e["systematic"], fmt="none", color=COLOURS[solid], elinewidth=5, alpha=0.3)
            right.errorbar([x], [e["mean"]], e["half_width"], color=COLOURS[solid], elinewidth=0.8, marker=MARKERS[solid],
                           markerfacecolor=None if filled else "white", linestyle="none")
    left.set(xscale="log", xlabel="Δφ", ylabel="missing constraints m", ylim=(-0.03, 2.1))
    middle.set(xscale="log", xlabel="Δφ", ylabel="states of self-stress S/N", ylim=(-0.03, 1.6))
    right.axhline(0, color="black", linewidth=0.8, linestyle=":")
    right.set(xlabel="1/N", ylabel="missing constraints m by exponents", xlim=(-0.001, 0.0175))
    solid_legend(left, loc="upper left")
    for axes, name in zip((left, middle, right), "abc"):
        letter(axes, name)
    save(figure, out / "counting")


def line(data, out):
    """m, C and S by exponents against φ_J, of packings by all preparations."""
    figure, panels = pyplot.subplots(1, 3, figsize=(WIDTH, 2.8), layout="constrained")
    groups = ((preparations.ENERGIES, "-", None), (("removed",), "", "white"), (("cycles",), "", "0.75"))
    for axes, name, column, label in zip(panels, "abc", ("m_x", "C_x", "self_stress_x"), (
            "missing constraints m", "constraint number C", "states of self-stress S")):
        for solid in SOLIDS:
            for chosen, style, face in groups:
                known = [p for p in chosen if len(preparations.values(data, solid, p, column)) > 1]
                x, y = ([estimate_of(preparations.values(data, solid, p, c)) for p in known] for c in ("phi_j", column))
                axes.errorbar([e["mean"] for e in x], [e["mean"] for e in y], [e["half_width"] for e in y],
                              [e["half_width"] for e in x], color=COLOURS[solid], marker=MARKERS[solid], linestyle=style,
                              markerfacecolor=face, elinewidth=0.6)
        axes.set(xlabel="jamming density φ$_J$", ylabel=label, yscale="log" if name == "c" else "linear")
        letter(axes, name)
    panels[2].set_ylim(0.5, 300)
    solid_legend(panels[2], loc="upper right")
    save(figure, out / "line")


def frequencies(data, out):
    """ω_l against the square roots of the moduli, and local exponents of E, K and ω_l."""
    figure = pyplot.figure(figsize=(WIDTH, 4.8), layout="constrained")
    grid = figure.add_gridspec(2, 6)
    for place, (column, name) in enumerate((("root_G", "√G"), ("root_K", "√K"))):
        axes = figure.add_subplot(grid[0, 3 * place:3 * place + 3])
        for solid in SOLIDS:
            x, soft, error = mean_path(data, solid, 400, "omega_l", logarithmic=True)
            modulus = dict(zip(*mean_path(data, solid, 400, column, logarithmic=True)[:2]))
            both = [i for i, d in enumerate(x) if d in modulus]
            axes.errorbar([modulus[x[i]] for i in both], [soft[i] for i in both],
                          [[side[i] for i in both] for side in error] if both else None, color=COLOURS[solid],
                          marker=MARKERS[solid], elinewidth=0.8)
        ends = {"root_G": (1e-6, 0.1), "root_K": (1e-5, 0.3)}[column]
        axes.plot(ends, [0.13 * (2.5 if column == "root_G" else 0.3) * x for x in ends], "k--", linewidth=0.8)
        axes.set(xscale="log", yscale="log", xlabel=f"{name}  (Y$^{{1/2}}$)", xlim=ends,
                 ylabel="⟨ω$_l$⟩  (V$_p^{-1/3}$ (Y/ρ)$^{1/2}$)")
        letter(axes, "ab"[place])
        if not place:
            solid_legend(axes, loc="lower right")
    for place, (column, title, expected) in enumerate((("E", "E", 6), ("K", "K", 4), ("omega_l", "⟨ω$_l$⟩", 2))):
        axes = figure.add_subplot(grid[1, 2 * place:2 * place + 2])
        axes.axhline(expected, color="black", linewidth=0.8, linestyle=":")
        for solid in SOLIDS:
            found = [((a * b) ** 0.5, e) for a, b, e in zip(EDGES, EDGES[1:], data.exponents(solid, 400, column, EDGES))
                     if e and e["n"] > 2 and e["half_width"] < 1]
            if found:
                x, y = [d for d, _ in found], [e["mean"] for _, e in found]
                wide = [e["systematic"] for _, e in found]
                axes.fill_between(x, [a - b for a, b in zip(y, wide)], [a + b for a, b in zip(y, wide)],
                                  color=COLOURS[solid], alpha=0.25, linewidth=0)
                axes.errorbar(x, y, [e["half_width"] for _, e in found], color=COLOURS[solid], marker=MARKERS[solid],
                              elinewidth=0.8)
        axes.set(xscale="log", xlabel="Δφ", ylabel=f"d ln {title} / d ln Δφ")
        letter(axes, "cde"[place])
    save(figure, out / "frequencies")


def solids(data, out):
    """Stiff tilts per contact of each class, and C_s, for many solids."""
    figure, (upper, lower) = pyplot.subplots(2, 1, figsize=(WIDTH, 3.9), sharex=True, layout="constrained",
                                             height_ratios=(3, 2))
    names = [solid for solid in other_solids(data) if len(data.kept_of(SOLIDS_64, solid)) > 2]
    colours = list(PALETTE["colours"].values())
    for i, (name, label, expected) in enumerate((("ff", "face-face", 2), ("ef", "edge-face", 1), ("l", "others", 0))):
        upper.axhline(expected, color="0.6", linewidth=0.8, linestyle=":")
        found = [data.nearest_of(SOLIDS_64, solid, f"stiff_tilts_{name}") for solid in names]
        upper.errorbar(range(len(names)), [e["mean"] for e in found], [e["half_width"] for e in found], fmt="os^"[i],
                       color=colours[i], elinewidth=0.8, label=label)
    lower.axhline(12, color="0.6", linewidth=0.8, linestyle=":")
    for column, shift, colour, label in (("C_s", -0.1, "black", "C$_s$"), ("C", 0.1, "white", "C by fit")):
        found = [data.nearest_of(SOLIDS_64, solid, column) for solid in names]
        lower.errorbar([i + shift for i in range(len(names))], [e["mean"] for e in found],
                       [e["half_width"] for e in found], fmt="D", color="black", markerfacecolor=colour, elinewidth=0.8,
                       label=label)
    upper.set(ylabel="stiff tilts per contact", ylim=(-0.2, 2.4))
    lower.set(ylabel="constraints", xlim=(-0.5, len(names) - 0.5), ylim=(11.1, 13.3))
    lower.set_xticks(range(len(names)), [name.replace("_", " ") for name in names], rotation=35, ha="right")
    upper.legend(ncols=3, loc="center", bbox_to_anchor=(0.5, 0.27))
    lower.legend(ncols=2, loc="upper right")
    letter(upper, "a")
    letter(lower, "b")
    save(figure, out / "solids")


def main():
    out, data = Path(sys.argv[1]), Data(*sys.argv[2:])
    out.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context(SETTINGS):
        for draw in (angles, counting, line, frequencies, solids):
            draw(data, out)


if __name__ == "__main__":
    main()
