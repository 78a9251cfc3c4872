"""Sets our tables beside the paper's: python3 page.py PAGE [-o OUT] [--data DIR] [--check]

PAGE holds blocks, `<!-- block NAME -->` ... `<!-- end -->`, that are made anew from DIR/tables.json, DIR/records.json
(see gather.py), data by default, and data/paper.json; what stands between the blocks is left as it is. Writes to OUT,
PAGE itself by default; with --check writes nothing and fails if a block is not what the data say.
"""

import argparse
import json
import re
import shutil
import sys
from pathlib import Path

from blocks import BLOCKS
from verdicts import overlap

COMMITTED = Path(__file__).resolve().parent / "data"
BLOCK = re.compile(r"(<!-- block (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class Data:
    """What the blocks are made from, of the directory and of the paper."""

    def __init__(self, directory):
        self.rows = {(study, row["solid"], row["particles"]): row
                     for study, rows in read(directory / "tables.json").items() for row in rows}
        self.records = read(directory / "records.json")
        self.extents = {name: values for found in self.records["studies"].values()
                        for name, values in found["extents"].items()}
        self.figures = read(COMMITTED / "paper.json")["figures"]

    def estimate(self, solid, particles, column, delta_phi=None, study="main"):
        """At Δφ, or nearest jamming; None if it was not measured."""
        if column == "body_l_max":
            return self.extents.get(f"{solid} {particles}", {}).get(column)
        source = self.rows.get((study, solid, particles))
        if source and delta_phi is not None:
            source = next((p for p in source["series"] if p["delta_phi"] == delta_phi), None)
        if not source:
            return None
        return source.get(column)

    def of(self, figure):
        return self.estimate(figure["solid"], figure["particles"], figure["column"], figure.get("delta_phi"),
                             figure.get("study", "main"))


def renewed(page, data):
    def block(match):
        return match.group(1) + BLOCKS[match.group(2)](data) + match.group(3)

    names = [match.group(2) for match in BLOCK.finditer(page)]
    if sorted(names) != sorted(BLOCKS):
        sys.exit(f"the page must have every block once: {', '.join(sorted(BLOCKS))}")
    return BLOCK.sub(block, page)


def agreement(data, committed):
    """How many of our figures have 95 % intervals that overlap those of the committed ones."""
    lines, met, known = [], 0, 0
    for figure in data.figures:
        if figure["place"] == "Table II":
            continue
        ours, theirs = data.of(figure), committed.of(figure)
        together = overlap(ours, theirs)
        if together is None:
            continue
        known += 1
        met += together
        if not together:
            lines.append(f"  {figure['place']}, {figure['solid']} N = {figure['particles']}, {figure['column']}: "
                         f"{ours['mean']:.5g} ± {ours['half_width']:.2g}, committed "
                         f"{theirs['mean']:.5g} ± {theirs['half_width']:.2g}")
    head = f"{met} of {known} figures agree with those in examples/paper: their 95 % intervals overlap"
    return "\n".join([head, *lines])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--data", type=Path, default=COMMITTED)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    page, data = arguments.page.read_text(encoding="utf-8"), Data(arguments.data)
    made = renewed(page, data)
    if arguments.check:
        sys.exit(0 if made == page else f"{arguments.page}: a block is not what {arguments.data} says")
    out = arguments.out or arguments.page
    out.write_text(made, encoding="utf-8")
    if out.parent.resolve() != arguments.page.parent.resolve():
        for image in sorted(arguments.page.parent.glob("*.png")):
            shutil.copy(image, out.parent)
    if arguments.data.resolve() != COMMITTED:
        print(agreement(data, Data(COMMITTED)))


if __name__ == "__main__":
    main()
