"""Draws the figures of the page: python3 figures.py DATA OUT

spectra.png (the paper's Figure 1a), vibrations.png (1b), angles.png (2), contacts.png (3a–c), from DATA/records.json as
gather.py writes it. Of N = 400 where that was measured; N = 100 beside it where the paper has it so.
"""

import sys
from pathlib import Path

# data.py finds what pages have in common.
from data import SIZES, SOLIDS, Data
from drawing import COLOURS, GRID, MARKERS, SETTINGS, matplotlib, mean_path, pyplot, save


def drawn(data, solid):
    """What was drawn of a solid, of the larger size that is there: (size, curves)."""
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
    figure, axes = pyplot.subplots(figsize=(5.6, 3.4))
    for solid in SOLIDS:
        particles, curves = drawn(data, solid)
        if "spectrum" not in curves:
            continue
        low, high = curves["spectrum"]
        low = sorted(low)[-50:]
        total = 6 * particles - 3
        for start, part in ((0, low), (total - len(high), sorted(high))):
            label = None if start else f"{solid} {particles}, Δφ {curves['delta_phi']:.2g}"
            axes.plot([(start + i + 1) / total for i in range(len(part))], part, MARKERS[solid], markersize=3,
                      color=COLOURS[solid], label=label)
    axes.set(yscale="log", xlabel="rank / (6N − 3)", ylabel="ω  (V$_p^{-1/3}$ (Y/ρ)$^{1/2}$)")
    axes.legend(fontsize=8)
    save(figure, out / "spectra.png")


def vibrations(data, out):
    figure, axes = pyplot.subplots(figsize=(5.6, 3.8))
    sizes = largest(data)
    series(axes, data, "omega_h", sizes, False)
    series(axes, data, "omega_l", sizes)
    for power, scale in ((2, 3.0), (2.5, 12.0)):
        axes.plot(GRID[4:], [scale * x ** power for x in GRID[4:]], "k:" if power == 2 else "k--", linewidth=0.8,
                  label=f"Δφ$^{{{power}}}$")
    axes.set(xscale="log", yscale="log", xlabel="Δφ", ylabel="⟨ω$_l$⟩ (lower), ⟨ω$_h$⟩ (upper)")
    axes.legend(fontsize=8)
    save(figure, out / "vibrations.png")


def largest(data):
    return (400,) if any(data.counted(solid, 400) for solid in SOLIDS) else (100,)


def angles(data, out):
    figure, both = pyplot.subplots(1, 2, figsize=(7.6, 3.4), sharey=True)
    for axes, kind, title in zip(both, ("edge_face", "face_face"), ("(a) c(θ$_{ef}$)", "(b) c(θ$_{ff}$)")):
        for solid in SOLIDS:
            particles, curves = drawn(data, solid)
            if kind in curves:
                share = [(i + 0.5) / len(curves[kind]) for i in range(len(curves[kind]))]
                axes.plot(curves[kind], share, color=COLOURS[solid], linewidth=1.2, label=f"{solid} {particles}")
                prefix = "ef_" if kind == "edge_face" else "ff_"
                for name, angle in data.critical[solid].items():
                    below = [s for x, s in zip(curves[kind], share) if x <= angle]
                    if name.startswith(prefix) and below:
                        axes.plot([angle], [below[-1]], MARKERS[solid], color=COLOURS[solid], markersize=4)
        axes.set(xlabel="degrees", title=title, xlim=(0, None), ylim=(0, 1))
    both[1].axvspan(0, 1, color="0.85", linewidth=0)
    both[0].legend(fontsize=8)
    save(figure, out / "angles.png")


def contacts(data, out):
    figure, three = pyplot.subplots(1, 3, figsize=(10, 3.3))
    for axes, column, title, limit in zip(three, ("Z", "C", "Z_ff"), ("(a) Z", "(b) C", "(c) Z$_{ff}$"),
                                          (12, 12, None)):
        series(axes, data, column, SIZES, axes is three[2])
        if limit:
            axes.axhline(limit, color="0.5", linewidth=0.8, linestyle=":")
        axes.set(xscale="log", xlabel="Δφ", title=title)
    three[2].legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    save(figure, out / "contacts.png", 80)


def main():
    data, out = Data(Path(sys.argv[1])), Path(sys.argv[2])
    with matplotlib.rc_context(SETTINGS):
        for draw in (spectra, vibrations, angles, contacts):
            draw(data, out)


if __name__ == "__main__":
    main()
