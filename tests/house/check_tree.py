"""Checks rules for the source tree. usage: check_tree.py ROOT

1. The tree has at most BUDGET lines, without data and schemas. The number of lines in each folder is printed. The budget
   falls with every removal; a commit that raises it says what a user gains.
2. engine/ includes only engine/, the standard library and LIBRARIES, and touches no files, clock, streams or environment.
3. Inside engine/, a file includes only files of its own folder and of folders before it in FOLDERS. For tasks/, the
   linker proves the order (tests/tasks/CMakeLists.txt).
4. No header includes oneTBB (or <execution>, which uses it), CLI11 or METIS.
5. No C++ source, shell script or CMake file in engine/, tasks/ or tests/ has more than 400 lines, and no C++ comment ends
   beyond column 120, since clang-format does not break comments.
6. The top folder has only the names in TOP, and build directories and results, which git ignores.

Prints one line for each breach: `file:line: why: text`. The exit code is 1 if a rule is broken, 2 if nothing was checked.
"""

import collections
import pathlib
import re
import subprocess
import sys

BUDGET = 99932
COUNTED = re.compile(r"(?!schemas/|.*/data/).*\.(cpp|hpp|h|py|js|css|sh|md|cmake|txt|in|json)")
MAX_LINES = 400
WIDE_COMMENT = re.compile(r'[^"]*//(?!.*NOLINT)')
FOLDERS = "names arithmetic random parallel geometry packing solve analysis vibration shear rigidity".split()
TOP = set("engine tasks schemas tests examples docs CMakeLists.txt Containerfile Makefile README.md "
          "LICENSE CITATION.cff CHANGELOG.md CONTRIBUTING.md .ci .git .gitignore .clang-format .clang-tidy".split())
NOT_IN_HEADERS = re.compile(r'[<"](tbb|oneapi|CLI)/|<execution>|<metis\.h>')
LIBRARIES = re.compile(r"<(Eigen|Spectra|boost/math|tbb|oneapi)/|<(metis|immintrin|arm_neon)\.h>|"
                       r"<boost/multiprecision/cpp_bin_float\.hpp>")
BANNED_HEADERS = set("filesystem chrono ctime fstream iostream istream ostream sstream syncstream cstdio iomanip "
                     "execution".split())
# Another header may include the banned ones.
BANNED_NAMES = re.compile(r"std::(chrono|filesystem|cout|cerr|clog|random_device)\b"
                          r"|\b(std::)?(getenv|fopen|printf|clock_gettime)\(", re.ASCII)
DIRECTIVE = re.compile(r"\s*#\s*(?:include|include_next|import)\b(?:.*?(<[^>]*>|\"[^\"]*\"))?", re.ASCII)


def engine_breach(file, header):
    """The reason why a file of engine/ may not include a header; None if it may."""
    if header.startswith('"engine/'):
        own, theirs = (name.split("/")[1] for name in (file, header))
        if own not in FOLDERS or theirs not in FOLDERS:
            return "folder of engine/ without a place in the order"
        return "include points upwards" if FOLDERS.index(theirs) > FOLDERS.index(own) else None
    if LIBRARIES.match(header):
        return None
    if header.startswith('"') or re.search("[/.]", header):
        return "engine/ includes what is not engine/"
    return "engine/ touches files, clock or streams" if header[1:-1] in BANNED_HEADERS else None


def breaches_of_line(file, text):
    directive = DIRECTIVE.match(text)
    if directive:
        header = directive[1]
        if not header:
            yield "include that cannot be read"
        elif file.startswith("engine/") and (why := engine_breach(file, header)):
            yield why
        if header and file.endswith((".hpp", ".h")) and NOT_IN_HEADERS.match(header):
            yield "oneTBB, CLI11 or METIS in a header"
    if file.startswith("engine/") and BANNED_NAMES.search(text):
        yield "engine/ touches files, clock, streams or environment"


def sources(root):
    """Sorted paths of the sources and scripts, relative to the root."""
    for half in ("engine", "tasks", "tests"):
        for path in sorted((root / half).rglob("*")):
            if path.suffix in (".cpp", ".hpp", ".h", ".sh", ".cmake") or path.name == "CMakeLists.txt":
                if not path.is_symlink():
                    yield path.relative_to(root).as_posix()


def breaches_of(root):
    """Lines that each describe a breach of the rules 2 to 6."""
    for path in sorted(root.iterdir()):
        if path.name not in TOP and not path.name.startswith("build") and path.name != "results":
            yield f"{path.name}:1: not at the top: {path.name}"
    for file in sources(root):
        lines = (root / file).read_bytes().decode(errors="replace").split("\n")
        if len(lines) - 1 > MAX_LINES:
            yield f"{file}:{len(lines) - 1}: more than {MAX_LINES} lines: {len(lines) - 1}"
        if file.endswith(("pp", ".h")):
            yield from (f"{file}:{number}: wide comment: {text.strip()}" for number, text in enumerate(lines, 1)
                        if len(text) > 120 and WIDE_COMMENT.match(text))
        if file.endswith(("pp", ".h")) and not file.startswith("tests/"):
            for number, text in enumerate(lines, 1):
                yield from (f"{file}:{number}: {why}: {text.strip()}" for why in breaches_of_line(file, text))


def lines_by_folder(root):
    """The number of lines in the files that git knows, for each folder of the first two levels. Empty without git."""
    listed = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False).stdout
    count = collections.Counter()
    for name in filter(COUNTED.fullmatch, listed.split("\n")):
        if (root / name).is_file():
            count["/".join(name.split("/")[:-1][:2]) or "."] += (root / name).read_bytes().count(b"\n")
    return count


def main(arguments):
    root = pathlib.Path(arguments[0])
    files = list(sources(root))
    if not any(file.startswith("engine/") for file in files):
        print(f"no source in {root}/engine: nothing was checked")
        return 2
    breaches, count = list(breaches_of(root)), lines_by_folder(root)
    total = sum(count.values())
    if total > BUDGET:
        breaches.append(f"tests/house/check_tree.py:1: {total} lines, more than the budget: {BUDGET}")
    print(*(f"{lines:7} {folder}" for folder, lines in sorted(count.items())), *breaches, sep="\n")
    print(f"{len(files)} files, {len(breaches)} breaches, {total} lines of {BUDGET}"
          + " (no git repository: the lines were not counted)" * (not count))
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
