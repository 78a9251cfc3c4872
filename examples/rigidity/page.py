"""Updates the page from data: python3 page.py PAGE [-o OUT] [--data DIR] [--check]

PAGE holds blocks and numbers within sentences (see ../page/marks.py). They are made again from DIR/records.json (see
gather.py; DIR is data by default). All else is unchanged. Writes to OUT, or to PAGE by default. With --check nothing is
written, and a page that differs from its data is an error.
"""

import argparse
import shutil
import sys
from pathlib import Path

# data.py finds what pages have in common.
from data import COMMITTED, Data
from blocks import BLOCKS, value_of
from marks import PageError, renewed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("-o", "--out", type=Path)
    parser.add_argument("--data", type=Path, default=COMMITTED)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    page = arguments.page.read_text(encoding="utf-8")
    try:
        made = renewed(page, BLOCKS, Data(arguments.data), value_of)
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


if __name__ == "__main__":
    main()
