"""Draws the figures of the page from DATA/records.json (see gather.py): python3 figures.py DATA OUT

spectra.png is the paper's Figure 1a, vibrations.png 1b, angles.png 2, and contacts.png 3a–c. They show N = 400 if it
was measured, and also N = 100 where the paper does.
"""

import sys
from pathlib import Path

# data.py finds what pages have in common.
from data import SIZES, SOLIDS, Data
from drawing import COLOURS, GRID, MARKERS, SETTINGS, matplotlib, mean_path, pyplot, save
from network import random_curves


FREQUENCY = "V$_p^{-1/3}$ (Y/ρ)$^{1/2}$"
PREFIX = {"edge_face": "ef", "face_face": "ff"}
TOPOLOGIES = {"vertex_face": "v", "edge_edge": "s", "edge_face": "o"}


def drawn(data, solid):
    """Curves of a solid at the largest size that was measured: (size, curves)."""
    for particles in reversed(SIZES):
        for study in data.studies.values():
            if f"{solid} {particles}" in study.get("drawn", {}):
                return particles, study["drawn"][f"{solid} {particles}"]
    return None, {}


def series(axes, data, column, sizes, label=True):
    for solid in SOLIDS:
        for particles in sizes:
            x, y, error = mean_path(data, solid, particles, column, column.startswith("omega"))
            if x:
                axes.errorbar(x, y, error, color=COLOURS[solid], marker=MARKERS[solid], markersize=4, linewidth=0.8,
                              fillstyle="full" if particles == 400 else "none",
                              label=f"{solid} {particles}" if label else None)


def spectra(data, out):
    """Softest and stiffest modes apart, by number: the spectrum between them is not in the data."""
    figure, both = pyplot.subplots(1, 2, figsize=(7.6, 3.2))
    for solid in SOLIDS:
        particles, curves = drawn(data, solid)
        if "spectrum" not in curves:
            continue
        for axes, modes in zip(both, curves["spectrum"]):
            axes.plot(range(1, len(modes) + 1), sorted(modes), MARKERS[solid], markersize=3, color=COLOURS[solid],
                      label=f"{solid} {particles}, Δφ = {curves['delta_phi']:.2g}")
    both[0].set(yscale="log", xlabel="mode, softest first", ylabel=f"ω  ({FREQUENCY})", title="fifty softest")
    both[1].set(ylim=(0, None), xlabel="mode, stiffest last", ylabel=f"ω  ({FREQUENCY})", title="fifty stiffest")
    both[0].legend(fontsize=8, loc="center right", bbox_to_anchor=(1.0, 0.55))
    save(figure, out / "spectra.png")


def vibrations(data, out):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.8))
    sizes = largest(data)
    series(axes, data, "omega_h", sizes, False)
    series(axes, data, "omega_l", sizes)
    axes.plot(GRID[4:], [3.0 * x ** 2 for x in GRID[4:]], "k:", linewidth=0.8, label="∝ Δφ$^2$")
    axes.set(xscale="log", yscale="log", xlabel="Δφ", ylabel=f"⟨ω$_l$⟩ (lower), ⟨ω$_h$⟩ (upper)  ({FREQUENCY})")
    axes.legend(fontsize=8)
    save(figure, out / "vibrations.png")


def largest(data):
    return (400,) if any(data.counted(solid, 400) for solid in SOLIDS) else (100,)


def angles(data, out):
    figure, rows = pyplot.subplots(2, len(SOLIDS), figsize=(9.6, 4.6), sharey=True)
    for panels, kind, name in zip(rows, ("edge_face", "face_face"), ("θ$_{ef}$", "θ$_{ff}$")):
        for axes, solid in zip(panels, SOLIDS):
            particles, curves = drawn(data, solid)
            if kind not in curves:
                continue
            x, free, constrained = random_curves(PREFIX[kind], data.critical[solid])
            axes.plot(x, free, "k--", linewidth=0.8, label="random")
            axes.plot(x, constrained, "k:", linewidth=0.8, label="edge in a face")
            share = [(i + 0.5) / len(curves[kind]) for i in range(len(curves[kind]))]
            axes.plot(curves[kind], share, color=COLOURS[solid], linewidth=1.2, label="packings")
            for topology, marker in TOPOLOGIES.items():
                angle = data.critical[solid].get(f"{PREFIX[kind]}_{topology}")
                if angle:
                    axes.plot([angle], [sum(a <= angle for a in curves[kind]) / len(curves[kind])], marker, zorder=3,
                              markersize=5, markerfacecolor="white", color=COLOURS[solid], linestyle="none",
                              label=topology.replace("_", "-"), clip_on=False)
            if kind == "face_face":
                axes.axvspan(0, 1, color="0.85", linewidth=0)
            axes.set(xlabel=f"{name} (degrees)", title=f"{solid} {particles}", xlim=(0, None), ylim=(0, 1.02))
        panels[0].set_ylabel(f"c({name})")
    handles = {label: handle for axes in rows.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    rows[0][0].legend(handles.values(), handles, fontsize=7, loc="lower right")
    save(figure, out / "angles.png", 75)


def contacts(data, out):
    figure, three = pyplot.subplots(1, 3, figsize=(10, 3.3))
    for axes, column, title, limit in zip(three, ("Z", "C", "Z_ff"), ("Z", "C", "Z$_{ff}$"),
                                          (12, 12, None)):
        series(axes, data, column, SIZES, axes is three[2])
        if limit:
            axes.axhline(limit, color="0.5", linewidth=0.8, linestyle=":")
        axes.set(xscale="log", xlabel="Δφ", ylabel=f"{title} (per particle)")
    three[2].legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    save(figure, out / "contacts.png", 80)


def main():
    data, out = Data(Path(sys.argv[1])), Path(sys.argv[2])
    with matplotlib.rc_context(SETTINGS):
        for draw in (spectra, vibrations, angles, contacts):
            draw(data, out)


if __name__ == "__main__":
    main()
