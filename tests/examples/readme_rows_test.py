"""The rows that README.md shows are those that `isojam aggregate` prints.

usage: readme_rows_test.py README.md ISOJAM RESULTS"""

import pathlib
import re
import subprocess
import sys


def rows_of(text):
    """{solid: entries with ±} of the rows that begin with a solid."""
    return {match[1]: re.findall(r"[\d.]+ ± [\d.]+", match[2])
            for match in re.finditer(r"^ *([a-z]+hedron) {2,}(.*)$", text, re.MULTILINE)}


def main(readme, isojam, results):
    shown = rows_of(pathlib.Path(readme).read_text(encoding="utf-8"))
    printed = rows_of(subprocess.run([isojam, "aggregate", results], check=True, capture_output=True, text=True).stdout)
    # README.md leaves out columns, marked by an ellipsis.
    wrong = [solid for solid, entries in shown.items()
             if not entries or [e for e in printed[solid] if e in entries] != entries]
    for solid in shown:
        print(solid, shown[solid], "printed", printed.get(solid))
    if len(shown) < 2 or wrong:
        sys.exit(f"README.md shows other entries than isojam prints: {', '.join(wrong) or 'no rows'}")


if __name__ == "__main__":
    main(*sys.argv[1:])
