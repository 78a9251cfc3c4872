"""Checks rules for the source tree. usage: check_tree.py ROOT

1. engine/ includes only engine/, the standard library, Eigen, Spectra, Boost.Math and METIS. It includes nothing from
   tasks/, no library for JSON, text output or command lines, and no header for files, clocks, streams or the environment.
   It does not use names from these headers either, because another header may include them.
2. Inside engine/ and inside tasks/, a file includes only files of its own folder and of folders before it in FOLDERS.
   Every source that includes another one of its half (engine/ or tasks/) is in one of these folders, except tasks/main.cpp.
3. oneTBB (and <execution>, which uses it) is included only in engine/parallel/parallel.cpp and tasks/run/graph.cpp, CLI11
   only in tasks/commands/command_line.cpp, and METIS only in engine/solve/factor/ordering.cpp.
4. No C++ source, shell script or CMake file in engine/, tasks/ or tests/ has more than 400 lines.
5. The top folder has only the names in TOP, and build directories and results, which git ignores.

Prints one line for each breach of a rule: `file:line: why: text`. The exit code is 1 if a rule is broken, and 2 if
nothing could be checked.
"""

import os
import pathlib
import re
import sys

MAX_LINES = 400
FOLDERS = {
    "engine": "names arithmetic random parallel geometry packing solve analysis vibration shear rigidity".split(),
    "tasks": "io packings measure manifest records tables run commands extras/page extras/report extras/export "
             "extras/chart extras/commands extras/python".split(),
}
TOP = set("engine tasks schemas tests examples docs CMakeLists.txt CMakePresets.json Containerfile Makefile README.md "
          "LICENSE CITATION.cff CHANGELOG.md CONTRIBUTING.md .ci .git .gitignore .clang-format .clang-tidy".split())
ONLY_IN = (  # headers, the sources that may include them, the breach
    (re.compile(r'[<"](tbb|oneapi)/|<execution>'), {"engine/parallel/parallel.cpp", "tasks/run/graph.cpp"},
     "oneTBB outside its two sources"),
    (re.compile(r'[<"]CLI/'), {"tasks/commands/command_line.cpp"}, "CLI11 outside its source"),
    (re.compile(r'[<"]metis\.h[>"]'), {"engine/solve/factor/ordering.cpp"}, "METIS outside its source"),
)
LIBRARIES = re.compile(r"<(Eigen|Spectra|boost/math|tbb|oneapi)/|<(metis|quadmath|immintrin)\.h>|"
                       r"<boost/multiprecision/cpp_bin_float\.hpp>")
BANNED_HEADERS = set("filesystem chrono ctime fstream iostream istream ostream sstream syncstream cstdio iomanip "
                     "execution".split())
BANNED_NAMES = re.compile(r"std::(chrono|filesystem|cout|cerr|clog|random_device)\b"
                          r"|\b(std::)?(getenv|fopen|printf|clock_gettime)\(", re.ASCII)
DIRECTIVE = re.compile(r"\s*#\s*(include|include_next|import)\b", re.ASCII)
HEADER = re.compile(r'<[^>]*>|"[^"]*"')


def sources(root):
    """Sorted paths of the sources and scripts, relative to the root."""
    for half in ("engine", "tasks", "tests"):
        for where, folders, names in os.walk(root / half):
            folders.sort()
            for name in sorted(names):
                path, cpp = pathlib.Path(where, name), name.endswith((".cpp", ".hpp", ".h"))
                if (cpp or name.endswith((".sh", ".cmake")) or name == "CMakeLists.txt") and not path.is_symlink():
                    yield path.relative_to(root).as_posix(), cpp


def rank(path):
    """Position of the folder of a path in FOLDERS; None if FOLDERS does not contain it."""
    half, *folders = path.split("/")[:-1]
    for depth in (1, 2):
        folder = "/".join(folders[:depth])
        if folder in FOLDERS[half]:
            return FOLDERS[half].index(folder)
    return None


def order_breach(file, header):
    """The reason why a source may not include a header of its own half (engine/ or tasks/); None if it may."""
    if file == "tasks/main.cpp":
        return None
    own, theirs = rank(file), rank(header)
    if own is None or theirs is None:
        return f"folder of {file.split('/')[0]}/ without a place in the order"
    return "include points upwards" if theirs > own else None


def engine_breach(header):
    """The reason why engine/ may not include a header from outside; None if it may."""
    if LIBRARIES.match(header):
        return None
    if header.startswith('"') or re.search("[/.]", header):
        return "engine/ includes what is not engine/"
    return "engine/ touches files, clock or streams" if header[1:-1] in BANNED_HEADERS else None


def include_breaches(file, header):
    """The rules that an include breaks."""
    half = file.split("/")[0]
    if header.startswith(f'"{half}/'):
        yield order_breach(file, header[1:-1])
    elif half == "engine":
        yield engine_breach(header)
    for headers, allowed, why in ONLY_IN:
        if headers.match(header) and file not in allowed:
            yield why


class Tree:
    """The breaches in a tree, and the number of files that were read."""

    def __init__(self, root):
        self.includes = self.files = 0
        self.breaches = []
        for name in sorted(os.listdir(root)):
            if name not in TOP and not name.startswith("build") and name != "results":
                self.breach(name, 1, "not at the top", name)
        for file, cpp in sources(root):
            lines = (root / file).read_bytes().decode(errors="replace").split("\n")
            if not file.startswith("tests/house/bad/"):
                self.files += 1
                if len(lines) - 1 > MAX_LINES:
                    self.breach(file, len(lines) - 1, f"more than {MAX_LINES} lines", len(lines) - 1)
            if cpp and not file.startswith("tests/"):
                for number, text in enumerate(lines, 1):
                    self.check_line(file, number, text)

    def check_line(self, file, number, text):
        if DIRECTIVE.match(text):
            self.includes += 1
            header = HEADER.search(text)
            whys = include_breaches(file, header[0]) if header else ["include that cannot be read"]
            for why in filter(None, whys):
                self.breach(file, number, why, header[0] if header else text)
        if file.startswith("engine/") and BANNED_NAMES.search(text):
            self.breach(file, number, "engine/ touches files, clock, streams or environment", text)

    def breach(self, file, line, why, text):
        self.breaches.append(f"{file}:{line}: {why}: {text}")


def main(arguments):
    if len(arguments) != 1:
        print("usage: check_tree.py ROOT", file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    if not (root / "engine").is_dir():
        print(f"no engine/ in {root}: nothing to check", file=sys.stderr)
        return 2
    tree = Tree(root)
    print(*tree.breaches, sep="\n", end="\n" if tree.breaches else "")
    if tree.includes == 0:
        print(f"no include found in {root}: nothing was checked", file=sys.stderr)
        return 2
    print(f"{tree.includes} includes, {tree.files} files, {len(tree.breaches)} breaches")
    return 1 if tree.breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
