"""usage: /usr/bin/python3 packing.py DIR SOLID [--check PICTURE]

Draws a packing of a results directory beside the energies that give φ_J, and writes packing.png. In the packing, the
largest clusters of particles that face-face contacts connect have a colour each; all other particles are grey. The
energies leave out the excluded replicates. The picture contains a text with the numbers that it shows, and with
--check, nothing is drawn: the text of PICTURE must be that of DIR. Needs Debian's python3-matplotlib. The module isojam
is in build/python."""

# %% Clusters: particles that face-face contacts connect
import sys

import matplotlib
import numpy
from PIL import Image

import isojam

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

# The edges of black particles would be invisible.
CLUSTERS = [isojam.palette.colours["yellow"] if colour == isojam.palette.colours["black"] else colour
            for colour in isojam.palette.series]


def clusters(count, pairs):
    label = numpy.arange(count)
    for _ in range(count):
        before = label.copy()
        for a, b in pairs:
            label[a] = label[b] = min(label[a], label[b])
        if (label == before).all():
            return label
    return label


# %% Packing: faces with a light from the upper left
def draw_packing(axes, packing, label):
    sizes = numpy.bincount(label, minlength=len(packing))
    large = [k for k in numpy.argsort(-sizes, kind="stable") if sizes[k] > 1][:len(CLUSTERS)]
    faces, colours = [], []
    light = numpy.array([0.35, -0.6, 0.72])
    for particle, kind in enumerate(packing.kind):
        solid = packing.solids[kind]
        corners = packing.corners(particle)
        centre = corners.mean(axis=0)
        corners = corners + packing.cell @ -numpy.floor(numpy.linalg.solve(packing.cell, centre))
        rank = large.index(label[particle]) if label[particle] in large else None
        colour = numpy.array(matplotlib.colors.to_rgb("#d9d9d9" if rank is None else CLUSTERS[rank]))
        for face in solid.faces:
            points = corners[list(face)]
            normal = numpy.cross(points[1] - points[0], points[2] - points[0])
            shade = 0.72 + 0.28 * normal @ light / numpy.linalg.norm(normal)
            faces.append(points)
            colours.append(shade * colour)
    axes.add_collection3d(Poly3DCollection(faces, facecolors=colours, edgecolors="#303030", linewidths=0.3))
    side = numpy.diag(packing.cell).copy()
    axes.set(xlim=(0, side[0]), ylim=(0, side[1]), zlim=(0, side[2]))
    axes.set_box_aspect(side, zoom=0.92)
    axes.view_init(elev=22, azim=-60)
    axes.set_axis_off()


# %% Energies: (E/N)^(1/6) of each state vanishes at φ_J
def draw_energies(axes, study):
    for solid, style in isojam.palette.styles(numpy.unique(study.states["solid"])).items():
        colour = style["color"]
        states = study.states.kept[study.states.kept["solid"] == solid]
        names = numpy.unique(states["replicate"])
        for name in names:
            of = states["replicate"] == name
            axes.plot(states["density"][of], states["energy_per_particle"][of] ** (1 / 6), ".-", color=colour, markersize=4,
                      linewidth=0.8, label=solid if name == names[0] else None)
        kept = study.replicates.kept[study.replicates.kept["solid"] == solid]
        axes.plot(kept["phi_j"], 0 * kept["phi_j"], "|", color=colour, markersize=12)
    axes.set(xlabel=r"density $\phi$", ylabel=r"$(E/N)^{1/6}$", ylim=(0, None))
    axes.legend(frameon=False)


# %% The numbers that the figure shows
def text_of(study, packing, label):
    kept = study.replicates.kept
    return (f"{packing.name}, clusters {sorted(numpy.bincount(label).tolist(), reverse=True)[:len(CLUSTERS)]}; phi_j "
            + ", ".join(f"{name} {phi_j:.6f}" for name, phi_j in zip(kept["replicate"], kept["phi_j"])))


# %% One figure of both
if __name__ == "__main__":
    study = isojam.load(sys.argv[1])
    name = next(iter(study.replicates[study.replicates["solid"] == sys.argv[2]]["replicate"]))
    contacts = study.contacts(name)
    flat = contacts[contacts["class"] == "face_face"]
    packing = study.packing(name)
    label = clusters(len(packing), zip(flat["a"], flat["b"]))
    text = text_of(study, packing, label)
    if "--check" in sys.argv:
        drawn = Image.open(sys.argv[-1]).text.get("Description")
        print(f"{sys.argv[-1]}: {drawn}")
        sys.exit(0 if drawn == text else f"{sys.argv[1]} has: {text}; draw the picture again")
    figure = pyplot.figure(figsize=(11, 5))
    draw_packing(figure.add_axes((-0.04, -0.12, 0.56, 1.24), projection="3d"), packing, label)
    draw_energies(figure.add_axes((0.58, 0.13, 0.40, 0.82)), study)
    figure.savefig("packing.png", dpi=110, metadata={"Software": None, "Description": text})
