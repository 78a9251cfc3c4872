"""usage: /usr/bin/python3 topology.py DIR [CONTACTS.csv STATES.csv]

Draws results of 04-contact-topology: the distribution of contact forces, the joint distribution of alignment angles,
and the constraint number C against Δφ. Reads the results directory DIR with the module isojam, and writes forces.png,
angles.png and constraints.png. If the exported tables are given, it also draws the same figures from the tables,
which it reads without the module: forces-csv.png, angles-csv.png and constraints-csv.png. Needs Debian's
python3-matplotlib. The module isojam is in build/python."""

# %% Forces: distribution of f divided by the mean f of its packing
import csv
import sys

import matplotlib
import numpy

import isojam

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def draw_forces(file, solid, replicate, force):
    size = numpy.linalg.norm(force, axis=1)
    for name in numpy.unique(replicate):
        size[replicate == name] /= size[replicate == name].mean()
    figure, axes = pyplot.subplots(layout="constrained")
    for name in numpy.unique(solid):
        density, edges = numpy.histogram(size[solid == name], bins=30, range=(0, 9), density=True)
        middle = (edges[1:] + edges[:-1]) / 2
        axes.plot(middle[density > 0], density[density > 0], markersize=3, label=name,
                  **isojam.palette.styles([name])[name])
    axes.set(xlabel=r"$f/\langle f\rangle$", ylabel=r"$P$", yscale="log")
    axes.legend()
    figure.savefig(file, metadata={"Software": None})


# %% Angles: θ_ff against θ_ef of each contact, coloured by its class
def draw_angles(file, solid, contact_class, theta_ef, theta_ff):
    names = numpy.unique(solid)
    figure, panels = pyplot.subplots(2, 2, sharex=True, sharey=True, figsize=(9, 8), layout="constrained")
    for axes, name in zip(panels.flat, names):
        for what, colour in zip(("lower_order", "edge_face", "face_face"), isojam.palette.series):
            mask = (solid == name) & (contact_class == what)
            axes.loglog(numpy.degrees(theta_ef[mask]), numpy.degrees(theta_ff[mask]), ".", markersize=2, label=what,
                        color=colour)
        axes.set(title=name)
    panels[0, 0].legend(markerscale=5)
    figure.supxlabel(r"$\theta_{ef}$ (degrees)")
    figure.supylabel(r"$\theta_{ff}$ (degrees)")
    figure.savefig(file, metadata={"Software": None})


# %% Constraints: C against Δφ, of every state, and means over intervals of Δφ
def draw_constraints(file, solid, delta_phi, constraints):
    figure, axes = pyplot.subplots(layout="constrained")
    known = ~numpy.isnan(constraints)
    for name in numpy.unique(solid):
        x, y = delta_phi[known & (solid == name)], constraints[known & (solid == name)]
        colour = isojam.palette.styles([name])[name]["color"]
        axes.semilogx(x, y, ".", markersize=4, alpha=0.5, color=colour)
        ends = numpy.geomspace(x.min(), x.max() * (1 + 1e-9), 7)
        bins = numpy.digitize(x, ends)
        means = [(numpy.exp(numpy.log(x[bins == k]).mean()), y[bins == k].mean()) for k in numpy.unique(bins)]
        axes.plot(*numpy.transpose(means), color=colour, label=name)
    axes.axhline(12, color="black", linewidth=0.8, label="isostatic")
    axes.set(xlabel=r"$\Delta\phi$", ylabel=r"$C$")
    axes.legend()
    figure.savefig(file, metadata={"Software": None})


# %% From the results directory
study = isojam.load(sys.argv[1])
states = study.states[~study.states["excluded"]]
contacts = study.contacts()
contacts = contacts[numpy.isin(contacts["replicate"], states["replicate"])]

draw_forces("forces.png", contacts["solid_a"], contacts["replicate"], contacts["force"])
draw_angles("angles.png", contacts["solid_a"], contacts["class"], contacts["theta_ef"], contacts["theta_ff"])
draw_constraints("constraints.png", states["solid"], states["delta_phi"], states["C"])

# %% From the exported tables
if len(sys.argv) < 4:
    sys.exit()


def read(file):
    """The columns of a table as {name: array of texts}."""
    with open(file, newline="", encoding="utf-8") as lines:
        names, *rows = csv.reader(lines)
    return dict(zip(names, numpy.array(rows).T))


def numbers(*columns):
    """Arrays of numbers from columns of text; an empty text becomes NaN."""
    values = [[float(text or "nan") for text in column] for column in columns]
    return numpy.array(values).T if len(columns) > 1 else numpy.array(values[0])


states = read(sys.argv[3])
states = {name: column[states["excluded"] == "false"] for name, column in states.items()}
contacts = read(sys.argv[2])
contacts = {name: column[numpy.isin(contacts["replicate"], states["replicate"])] for name, column in contacts.items()}
force = numbers(contacts["force_x"], contacts["force_y"], contacts["force_z"])

draw_forces("forces-csv.png", contacts["solid_a"], contacts["replicate"], force)
draw_angles("angles-csv.png", contacts["solid_a"], contacts["class"], numbers(contacts["theta_ef"]),
            numbers(contacts["theta_ff"]))
draw_constraints("constraints-csv.png", states["solid"], numbers(states["delta_phi"]), numbers(states["C"]))
