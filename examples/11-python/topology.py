"""usage: /usr/bin/python3 topology.py DIR [CONTACTS.csv STATES.csv]

Draws results of 04-contact-topology: the distribution of contact forces, the joint distribution of alignment angles,
and the constraint number C against Δφ. Reads the results directory DIR with the module isojam, and writes forces.png,
angles.png and constraints.png. If the exported tables are given, it also draws the same figures from the tables,
which it reads with pandas only: forces-csv.png, angles-csv.png and constraints-csv.png. Needs Debian's
python3-matplotlib. The module isojam is in build/python."""

# %% Forces: distribution of f divided by the mean f of its packing
import sys

import matplotlib
import numpy
import pandas

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
def draw_all(ending, states, contacts, force):
    states = states[~states["excluded"]]
    kept = contacts["replicate"].isin(states["replicate"])
    contacts, force = contacts[kept], force[kept]
    solid = contacts["solid_a"].to_numpy(str)
    draw_forces(f"forces{ending}.png", solid, contacts["replicate"].to_numpy(str), force)
    draw_angles(f"angles{ending}.png", solid, contacts["class"], contacts["theta_ef"], contacts["theta_ff"])
    draw_constraints(f"constraints{ending}.png", states["solid"].to_numpy(str), states["delta_phi"].to_numpy(),
                     states["C"].to_numpy())


study = isojam.load(sys.argv[1])
contacts = study.contacts()
draw_all("", study.states, contacts, contacts.vectors("force"))

# %% From the exported tables
if len(sys.argv) == 4:
    contacts, states = (pandas.read_csv(file, float_precision="round_trip") for file in sys.argv[2:])
    draw_all("-csv", states, contacts, contacts[["force_x", "force_y", "force_z"]].to_numpy())
