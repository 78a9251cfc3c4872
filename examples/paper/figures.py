"""Draws the figures of the page from data: python3 figures.py OUT DATA/records.json [...]"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))

import matplotlib  # noqa: E402
import numpy  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

import preparations  # noqa: E402
from data import SOLIDS, Data  # noqa: E402
from drawing import COLOURS, GRID, MARKERS, SETTINGS, WIDTH, curve, letter, mean_path, save, solid_legend  # noqa: E402
from comparison import DICE_DENSITY, drawn_size, figures_of  # noqa: E402
from tables import structure  # noqa: E402


def densities(data, out):
    """φ_J of all packings, beside the paper's values."""
    figure, panels = pyplot.subplots(1, len(SOLIDS), figsize=(WIDTH, 2.6), layout="constrained")
    for axes, solid, name in zip(panels, SOLIDS, "abcd"):
        below, above = (preparations.extreme(data, solid, end)["mean"] for end in (min, max))
        for place, particles in enumerate((100, 400)):
            values = [r["phi_j"] for r in data.kept(solid, particles)]
            mean = data.phi_j(solid, particles)
            if not mean:
                continue
            axes.add_patch(matplotlib.patches.Rectangle((place - 0.38, mean["mean"] + below), 0.76, above - below,
                                                        facecolor=COLOURS[solid], alpha=0.18, linewidth=0))
            shift = [place - 0.22 + 0.3 * ((7 * i) % 16) / 15 for i in range(len(values))]
            axes.plot(shift, values, MARKERS[solid], color=COLOURS[solid], markersize=3, alpha=0.75,
                      markeredgewidth=0)
            axes.errorbar([place + 0.18], [mean["mean"]], [mean["half_width"] or 0], fmt="_k", markersize=9,
                          capsize=3)
            paper = next(f for f in figures_of("Table I") if (f["solid"], f["particles"]) == (solid, particles))
            axes.errorbar([place + 0.33], [paper["value"]], [paper["error"]], fmt="*", color="black",
                          markerfacecolor="white", markersize=7, capsize=2)
        middle = data.phi_j(solid, 400)["mean"] if data.phi_j(solid, 400) else mean["mean"]
        dice = DICE_DENSITY[solid][0]
        if abs(dice - middle) < 0.035:
            axes.axhline(dice, color="0.55", linewidth=0.8, linestyle=":")
        axes.set(xlim=(-0.5, 1.5), xticks=(0, 1), xticklabels=("N = 100", "N = 400"),
                 ylim=(middle - 0.045, middle + 0.025))
        letter(axes, name, solid)
    panels[0].set_ylabel("jamming density φ$_J$")
    save(figure, out / "densities")


def constraints_panel(axes, data, solid, particles):
    colour = COLOURS[solid]
    grid = [d for d in GRID if d < 0.13]
    x, y, error = mean_path(data, solid, particles, "C", grid=grid)
    low, high = (mean_path(data, solid, particles, f"C_{of}", grid=grid) for of in ("half", "double"))
    common = [d for d in low[0] if d in high[0]]
    axes.fill_between(common, [low[1][low[0].index(d)] for d in common], [high[1][high[0].index(d)] for d in common],
                      color="0.6", alpha=0.3, linewidth=0, label="fit, cut-offs × ½ … × 2")
    axes.errorbar(x, y, error, fmt="o", color="0.35", markersize=3, markerfacecolor="white", elinewidth=0.8,
                  label="fit")
    points = [(data.nearest_distance(solid, particles)["mean"], data.constraints(solid, particles, "trough"))]
    points += [(d, data.constraints(solid, particles, "trough", d)) for d in data.trough_distances(solid, particles)]
    points = sorted((d, e) for d, e in points if e)
    if points:
        x, found = zip(*points)
        y, wide = [e["mean"] for e in found], [e["systematic"] for e in found]
        if len(x) > 1:
            axes.fill_between(x, [a - b for a, b in zip(y, wide)], [a + b for a, b in zip(y, wide)], color=colour,
                              alpha=0.3, linewidth=0)
        axes.errorbar(x, y, wide, fmt="none", color=colour, elinewidth=9, alpha=0.35)
        axes.errorbar(x, y, [e["half_width"] for e in found], marker=MARKERS[solid], color=colour, label="trough",
                      zorder=4)


def constraints(data, out):
    """C against Δφ by three classifications."""
    particles = drawn_size(data)
    figure, panels = pyplot.subplots(2, 2, figsize=(WIDTH, 4.6), sharex=True, sharey="row", layout="constrained")
    paper = next(f for f in figures_of("Table III, column 1") if f["column"] == "C")
    for axes, solid, name in zip(panels.flat, SOLIDS, "abcd"):
        constraints_panel(axes, data, solid, particles)
        axes.axhline(12 - 4 / particles, color="black", linewidth=0.8, linestyle=":")
        if solid == paper["solid"]:
            axes.plot([paper["delta_phi"]], [paper["value"]], "*k", markerfacecolor="white", markersize=9, zorder=5)
        axes.set(xscale="log", xlim=(2e-4, 0.14), ylim=(11.4, 15.2) if name in "ab" else (9.4, 13.2))
        letter(axes, name, f"{solid}, N = {particles}")
    panels[0, 0].legend(loc="upper left")
    figure.supxlabel("distance to jamming Δφ", fontsize=8.5)
    figure.supylabel("constraint number C per particle", fontsize=8.5)
    save(figure, out / "constraints")


def vibrations(data, out):
    """Spectra, and mean frequencies against Δφ."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(WIDTH, 2.9), layout="constrained")
    for solid in SOLIDS:
        for particles in (400, 100):
            spectra = [s["spectra"][f"{solid} {particles}"] for s in data.main()
                       if f"{solid} {particles}" in s.get("spectra", ())]
            if spectra:
                break
        if spectra:
            lowest, highest = spectra[0]["lowest"], spectra[0]["highest"]
            label = f"{solid}, Δφ = {spectra[0]['delta_phi']:.2g}"
            left.semilogy(range(1, len(lowest) + 1), lowest, color=COLOURS[solid], marker=MARKERS[solid], markevery=7,
                          label=label)
            left.semilogy(range(56, 56 + len(highest)), highest, color=COLOURS[solid], marker=MARKERS[solid], markevery=7)
        for column in ("omega_l", "omega_h"):
            curve(right, mean_path(data, solid, 400, column, logarithmic=True), solid, linestyle="-")
    guide = [4e-4, 0.1]
    right.plot(guide, [3 * d ** 2 for d in guide], "k--", linewidth=0.8)
    right.text(1.1e-3, 2e-5, "∝ Δφ²", fontsize=8)
    left.axvspan(51.5, 54.5, color="0.9", linewidth=0)
    left.set(xlabel="50 lowest modes | 50 highest modes", ylabel="ω  (V$_p^{-1/3}$ (Y/ρ)$^{1/2}$)", ylim=(1e-10, 8))
    left.legend(fontsize=8, loc="lower right")
    letter(left, "a")
    right.set(xscale="log", yscale="log", xlabel="distance to jamming Δφ", ylabel="⟨ω$_l$⟩ (below), ⟨ω$_h$⟩ (above)",
              ylim=(1e-10, 8))
    solid_legend(right, loc="lower right")
    letter(right, "b")
    save(figure, out / "vibrations")


def rotated(vertices, quaternion):
    """Vertices, rotated by a quaternion (w, x, y, z)."""
    w, x, y, z = numpy.array(quaternion) / numpy.linalg.norm(quaternion)
    rotation = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return numpy.array(vertices) @ rotation.T


def bodies(cluster):
    """Vertices of each particle of a cluster, shape (particles, vertices, 3). The longest extent is along x, and the
    shortest along z."""
    centres = numpy.array([particle[:3] for particle in cluster["particles"]])
    axes = numpy.linalg.svd(centres - centres.mean(axis=0))[2]
    axes[2] *= numpy.linalg.det(axes)  # a rotation, not a reflection
    corners = numpy.array([(rotated(cluster["vertices"], particle[3:]) + particle[:3]) @ axes.T
                           for particle in cluster["particles"]])
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    return corners - (low + high) / 2


def draw_cluster(axes, cluster, colour, reach):
    """Draws the particles of a cluster, seen along its shortest extent, in a panel of the width 2·reach."""
    light, faces, colours = numpy.array([0.3, 0.5, 0.81]), [], []
    for corners in bodies(cluster):
        for face in cluster["faces"]:
            points = corners[face]
            normal = numpy.cross(points[1] - points[0], points[2] - points[0])
            shade = 0.55 + 0.45 * normal @ light / numpy.linalg.norm(normal)
            faces.append(points)
            colours.append(1 - (1 - numpy.array(matplotlib.colors.to_rgb(colour))) * 0.9 if shade > 0.95 else
                           max(0.3, shade) * numpy.array(matplotlib.colors.to_rgb(colour)))
    axes.add_collection3d(Poly3DCollection(faces, facecolors=colours, edgecolors="0.15", linewidths=0.4))
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
    axes.set_proj_type("ortho")
    axes.set_box_aspect((1, 1, 1), zoom=1.7)
    axes.view_init(elev=90, azim=-90)
    axes.set_axis_off()


def clusters(data, out):
    """The face-face cluster with the largest extent of each solid."""
    figure = pyplot.figure(figsize=(WIDTH, 1.95))
    found = {solid: one for solid in SOLIDS if (one := data.cluster(solid))}
    reach = max((numpy.abs(bodies(cluster)).max() for _, cluster in found.values()), default=1.0)
    for place, (solid, name) in enumerate(zip(SOLIDS, "abcd")):
        if solid in found:
            axes = figure.add_axes((place / 4, 0, 0.25, 0.9), projection="3d")
            draw_cluster(axes, found[solid][1], COLOURS[solid], reach)
        figure.text(place / 4 + 0.01, 0.9, f"({name})  {solid}", fontsize=8.5)
    save(figure, out / "clusters")


def fluctuations(data, out):
    """Structure factors of packings with N = 400, and of octahedra with N = 400 and 4000."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(WIDTH, 2.9), sharey=True, layout="constrained")
    for axes, solid, particles, filled in (*((left, s, 400, True) for s in SOLIDS), (right, "octahedron", 400, True),
                                           (right, "octahedron", 4000, False)):
        shells = structure(data, solid, particles)
        axes.errorbar([k for k, _ in shells], [e["mean"] for _, e in shells], [e["half_width"] for _, e in shells],
                      color=COLOURS[solid], marker=MARKERS[solid], markerfacecolor=None if filled else "white",
                      elinewidth=0.8, linestyle="none", label=solid if axes is left else f"N = {particles}")
    for axes, name in ((left, "a"), (right, "b")):
        axes.set(yscale="log", xlabel="k  (V$_p^{-1/3}$)", xlim=(0, 4.6))
        axes.legend(loc="upper left")
        letter(axes, name)
    left.set_ylabel("structure factor S(k)")
    save(figure, out / "structure")


def main():
    out, data = Path(sys.argv[1]), Data(*sys.argv[2:])
    out.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context(SETTINGS):
        for draw in (densities, constraints, vibrations, clusters, fluctuations):
            draw(data, out)


if __name__ == "__main__":
    main()
