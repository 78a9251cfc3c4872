"""Draws the figures of the page from DATA/records.json (see gather.py): python3 figures.py DATA OUT

soft.png and held.png show stiffness and prestress, bands.png and angles.png counting, missing.png the rank, and
forces.png forces and gaps.
"""

import sys
from pathlib import Path

# data.py finds what pages have in common.
from data import SOLIDS, Data
from drawing import COLOURS, MARKERS, SETTINGS, matplotlib, mean_path, pyplot, save
from forces import STEPS_OF_FORCE, STEPS_OF_GAP, cumulative
from gather import CURVE, DRAWN, FORCES, GAPS, NORMAL_BOUNDARIES, POWERS, TILT_BOUNDARY

FILLS = {50: "none", 64: "none", 100: "none", 200: "right", 400: "full", 800: "left"}
SIZE_COLOURS = {50: "#9ecae1", 100: "#6baed6", 200: "#3182bd", 400: "#08519c", 800: "#000000"}


def series(axes, data, column, sizes, logarithmic=False, scale=None, label=True):
    for solid in SOLIDS:
        for particles in sizes:
            x, y, error = mean_path(data, solid, particles, column, logarithmic)
            if not x:
                continue
            unit = scale(y) if scale else 1
            axes.errorbar(x, [v / unit for v in y], [[e / unit for e in side] for side in error], color=COLOURS[solid],
                          marker=MARKERS[solid], markersize=4, linewidth=0.8, fillstyle=FILLS[particles],
                          label=f"{solid} {particles}" if label else None)


def soft(data, out):
    figure, two = pyplot.subplots(1, 2, figsize=(8.4, 3.2), sharey=True)
    for axes, column, title in zip(two, ("omega_over_root_G", "omega_over_root_K"), ("⟨ω_l⟩/√G", "⟨ω_l⟩/√K")):
        series(axes, data, column, (400,), True, scale=lambda y: y[0], label=axes is two[0])
        axes.set(xscale="log", yscale="log", xlabel="Δφ", title=f"{title}, N = 400, relative to the largest Δφ")
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("{x:g}")
        axes.tick_params(which="minor", labelsize=7)
    two[0].set_ylabel("ratio")
    two[0].legend(fontsize=7)
    save(figure, out / "soft.png", 80)


def held(data, out):
    figure, two = pyplot.subplots(1, 2, figsize=(8.4, 3.2))
    for axes, column, title in zip(two, ("second_each", "prestress_each"),
                                   ("normals", "normals and stiff tilts (s > 10)")):
        series(axes, data, column, (100,), label=axes is two[1])
        axes.set(xscale="log", xlabel="Δφ", title=f"Modes to which {title}\ncontribute less than half")
    two[0].set(ylim=(0, 6), ylabel="modes per particle (of 6)")
    two[1].set(yscale="log", ylim=(1e-4, 6))
    two[1].legend(fontsize=7)
    save(figure, out / "held.png", 80)


def bands(data, out):
    figure, axes = pyplot.subplots(2, 4, figsize=(11, 4.4), sharex=True)
    centres = [(a + b) / 2 for a, b in zip(POWERS, POWERS[1:])]
    for row, kind, expected in zip(axes, ("s_normal", "s_tilt"), ((1, 5 / 3, 5), (0, 5 / 3, 5))):
        for panel, solid in zip(row, SOLIDS):
            for i, place in enumerate(("0.02", "0.005", "nearest")):
                found = [c for s in data.studies.values() if (c := s.get("powers", {}).get(f"{solid} {place} {kind}"))]
                if found:
                    every = sum(found[0])
                    panel.step(centres, [n / every for n in found[0]], where="mid", linewidth=0.9,
                               color=pyplot.get_cmap("viridis")(i / 3),
                               label="smallest Δφ" if place == "nearest" else f"Δφ = {place}")
            for x in expected:
                panel.axvline(x, color="0.7", linewidth=0.6, zorder=0)
            for x in NORMAL_BOUNDARIES if kind == "s_normal" else (TILT_BOUNDARY,):
                panel.axvline(x, color="0.7", linewidth=0.6, linestyle=":", zorder=0)
            panel.set_title(f"{solid}s, {'normals' if kind == 's_normal' else 'tilts'}".replace("drons", "dra"))
    for panel in axes[1]:
        panel.set(xlabel="x for s = Δφ$^{-x}$", xlim=(-0.5, 6))
    for row in axes:
        row[0].set_ylabel("share")
    axes[0][0].legend(fontsize=7)
    save(figure, out / "bands.png", 70)


def angles(data, out):
    figure, four = pyplot.subplots(1, 4, figsize=(11, 3), sharey=True)
    for axes, solid in zip(four, SOLIDS):
        for i, distance in enumerate(DRAWN):
            curves = [c for s in data.studies.values() if (c := s.get("collapsed", {}).get(f"{solid} {distance}"))]
            if curves:
                axes.plot(curves[0], CURVE, color=pyplot.get_cmap("viridis")(i / len(DRAWN)), linewidth=0.9,
                          label=f"Δφ = {distance:g}")
        axes.set(xscale="log", xlabel="θ$_{ef}$/Δφ$^{5/3}$", title=f"{solid}, N = 100", xlim=(1e-2, 1e5),
                 ylim=(0, 1))
    four[0].set_ylabel("c(θ$_{ef}$)")
    four[1].legend(fontsize=7, loc="upper left")
    save(figure, out / "angles.png", 72)


def missing(data, out):
    figure, two = pyplot.subplots(1, 2, figsize=(8.4, 3.2), sharey=True)
    for axes, solid in zip(two, ("icosahedron", "dodecahedron")):
        for particles, colour in SIZE_COLOURS.items():
            x, y, error = mean_path(data, solid, particles, "missing")
            if x:
                axes.errorbar(x, y, error, color=colour, marker=MARKERS[solid], markersize=3, linewidth=0.8,
                              label=f"N = {particles}")
        axes.set(xscale="log", yscale="log", xlabel="Δφ", ylim=(0.03, 2),
                 title=f"{solid}: missing constraints per particle")
    two[0].set_ylabel("m")
    two[0].legend(fontsize=7)
    save(figure, out / "missing.png", 80)


def below(axes, data, names, steps, title, xlabel):
    for solid in SOLIDS:
        rows = [(cumulative(r["bins"], names, steps), sum(sum(r["bins"][n][1]) for n in names))
                for r in data.counted(solid, 400) if set(names) <= set(r.get("bins") or {})]
        if rows:
            every = sum(total for _, total in rows)
            points = [(10 ** s, n / every, n ** 0.5 / every)
                      for s, n in zip(steps, map(sum, zip(*(row for row, _ in rows)))) if n]
            x, y, error = zip(*points)
            axes.errorbar(x, y, error, marker=MARKERS[solid], color=COLOURS[solid], markersize=4, linewidth=0.8,
                          label=f"{solid} 400")
    axes.set(xscale="log", yscale="log", title=title, xlabel=xlabel, ylabel="cumulative share")


def forces(data, out):
    figure, two = pyplot.subplots(1, 2, figsize=(8.4, 3.2))
    below(two[0], data, FORCES, STEPS_OF_FORCE, "Forces at the smallest Δφ", "f/⟨f⟩")
    below(two[1], data, GAPS, STEPS_OF_GAP, "Gaps below 0.1 between faces and edges", "h, V$_p^{1/3}$")
    two[0].legend(fontsize=7)
    save(figure, out / "forces.png", 80)


def main():
    data, out = Data(Path(sys.argv[1])), Path(sys.argv[2])
    with matplotlib.rc_context(SETTINGS):
        for draw in (soft, held, bands, angles, missing, forces):
            draw(data, out)


if __name__ == "__main__":
    main()
