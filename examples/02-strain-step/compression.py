"""Chart of the compression: φ_J, Z, C, m and CPU time for its settings.

    python3 compression.py REPLICATES.csv...    reads exported replicates, and writes data/compression.csv
    python3 compression.py [--check]            updates the table of README.md and the figure from this file, or
                                                compares the table
"""

import sys
from pathlib import Path

import pandas

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

from marks import renewed  # noqa: E402
from text import interval, number, table  # noqa: E402

DATA = HERE / "data/compression.csv"
SOLIDS = ["tetrahedron", "octahedron", "icosahedron", "dodecahedron"]
SETTINGS = ["compression_step", "compression_evaluations", "initial_density"]
EFFECTS = [(SETTINGS[0], 0.02, 0.04), (SETTINGS[0], 0.02, 0.08), (SETTINGS[0], 0.01, 0.04), (SETTINGS[1], 500, 100),
           (SETTINGS[1], 500, 200), (SETTINGS[1], 500, 2000), (SETTINGS[2], 0.05, 0.3)]
QUANTITIES = {"phi_j": "φ_J", "Z": "Z", "C_x": "C", "m": "m"}


def means_of(files):
    """Means and their variances for each solid and its settings, without crystals."""
    rows = pandas.concat(map(pandas.read_csv, files))
    rows = rows[(rows.status == "done") & ~rows["flags"].fillna("").str.contains("crystalline")]
    groups = rows.groupby(["solid", *SETTINGS])[[*QUANTITIES, "cpu_seconds"]]
    return groups.mean().join(groups.var() / groups.count(), rsuffix=" variance").join(groups.size().rename("packings"))


def change(means, setting, before, after):
    """Rows that differ only in this setting: those with the value `before`, and those with `after`."""
    old, new = (means.xs(value, level=setting) for value in (before, after))
    both = old.index.intersection(new.index)
    return old.loc[both], new.loc[both]


def effect_table(means):
    """Mean change by each setting over all values of the others, ± 1.96 standard errors, and the ratio of CPU times."""
    lines, others = [], []
    for effect in EFFECTS:
        setting, before, after = effect
        old, new = change(means, *effect)
        solids = ((new - old).groupby("solid").mean(), (new + old).groupby("solid").sum(), old.groupby("solid").size())
        difference, variance, pairs = (part.reindex(SOLIDS) for part in solids)
        width = {name: 1.96 * variance[f"{name} variance"] ** 0.5 / pairs for name in QUANTITIES}
        ratio = new.cpu_seconds.groupby("solid").sum() / old.cpu_seconds.groupby("solid").sum()
        for name, symbol in QUANTITIES.items():
            if name == "phi_j" or effect in (EFFECTS[0], EFFECTS[4]):
                cells = [interval({"mean": difference[name][s], "half_width": width[name][s]}) for s in SOLIDS]
                times = f"{number(ratio.min(), 2)} to {number(ratio.max(), 2)}" if name == "phi_j" else ""
                (lines if times else others).append([f"`{setting}` {after} instead of {before}", symbol, *cells, times])
    return table(["change", "of", *SOLIDS, "CPU time"], lines + others)


def draw(means, path):
    """φ_J against CPU time, one curve for each number of evaluations."""
    from matplotlib import pyplot

    import drawing
    pyplot.rcParams.update(drawing.SETTINGS)
    figure, panels = pyplot.subplots(2, 2, figsize=(drawing.WIDTH, 4.6), layout="constrained")
    for axes, solid, name in zip(panels.flat, SOLIDS, "abcd"):
        for evaluations, marker in zip((100, 200, 500, 2000), "os^D"):
            line = means.loc[solid].xs((evaluations, 0.05), level=SETTINGS[1:]).query("compression_step > 0.01")
            axes.errorbar(line.cpu_seconds, line.phi_j, 1.96 * line["phi_j variance"] ** 0.5, marker=marker,
                          elinewidth=0.8, label=f"{evaluations} evaluations")
            for step, time, phi_j in zip(line.index, line.cpu_seconds, line.phi_j):
                axes.annotate(f"{step:g}", (time, phi_j), (3, 3), textcoords="offset points", fontsize=6)
        axes.set(xlabel="CPU time of a replicate (s)", ylabel="φ$_J$")
        drawing.letter(axes, name, solid)
    panels.flat[0].legend(loc="lower right")
    drawing.save(figure, path)


def main():
    if files := [name for name in sys.argv[1:] if not name.startswith("-")]:
        DATA.parent.mkdir(exist_ok=True)
        means_of(files).to_csv(DATA, float_format="%.6g")
    means = pandas.read_csv(DATA, index_col=["solid", *SETTINGS])
    page = HERE / "README.md"
    text = page.read_text(encoding="utf-8")
    made = renewed(text, {"effects": effect_table}, means)
    if "--check" in sys.argv:
        sys.exit(0 if made == text else f"{page}: differs from the data; compression.py without --check updates it")
    page.write_text(made, encoding="utf-8")
    draw(means, HERE / "compression")


if __name__ == "__main__":
    main()
