"""Updates the page that compares our results with the paper.

usage: python3 page.py PAGE [-o OUT] [--data DIR] [--check] [--some]

PAGE holds blocks and numbers within sentences (see ../page/marks.py). They are made again from DIR/records.json and
DIR/search.json (see gather.py; DIR is data by default) and from data/paper.json. All else is unchanged. Writes to OUT,
or to PAGE by default. With --check nothing is written, and a page that differs from its data is an error. With --some
PAGE may have only some of the blocks.
"""

import argparse
import shutil
import sys
from pathlib import Path

from blocks import BLOCKS, value_of
from data import COMMITTED, Data
from marks import PageError, renewed
from verdicts import overlap


def agreement(data, committed):
    """Number of our values whose 95 % confidence intervals overlap those of the committed ones, and the others."""
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
    head = f"{met} of {known} values agree with those in examples/paper: their 95 % confidence intervals overlap"
    return "\n".join([head, *lines])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--data", type=Path, default=COMMITTED)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--some", action="store_true")
    arguments = parser.parse_args()
    page, data = arguments.page.read_text(encoding="utf-8"), Data(arguments.data)
    try:
        made = renewed(page, BLOCKS, data, value_of, every=not arguments.some)
    except PageError as error:
        sys.exit(str(error))
    if arguments.check:
        sys.exit(0 if made == page else
                 f"{arguments.page}: differs from {arguments.data}; page.py without --check updates it")
    out = arguments.out or arguments.page
    out.write_text(made, encoding="utf-8")
    if out.parent.resolve() != arguments.page.parent.resolve():
        for image in sorted(arguments.page.parent.glob("*.png")):
            if not (out.parent / image.name).exists():
                shutil.copy(image, out.parent)
    if arguments.data.resolve() != COMMITTED:
        print(agreement(data, Data(COMMITTED)))


if __name__ == "__main__":
    main()
