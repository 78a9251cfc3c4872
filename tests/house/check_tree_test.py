"""Tests check_tree.py: it accepts a small tree that follows all rules, and rejects the tree after each of the changes
below.

The message has the file, the line and the rule. A rule that check_tree.py does not check fails here."""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_tree

GOOD = {
    "engine/geometry/pose.hpp": "#pragma once\n#include <Eigen/Core>\n#include <vector>\n#include <immintrin.h>\n",
    "engine/parallel/parallel.cpp": '#include <tbb/parallel_for.h>\n#include "engine/random/stream.hpp"\n',
    "engine/packing/pair_loop.cpp": '#include "engine/parallel/parallel.hpp"\n#include "engine/geometry/pose.hpp"\n',
    "engine/solve/factor/ordering.cpp": "#include <metis.h>\n#include <Spectra/SymEigsSolver.h>\n"
                                        "#include <boost/math/tools/roots.hpp>\n#include <quadmath.h>\n",
    "engine/solve/jam.cpp": '#include "engine/packing/energy.hpp"\n// #include <chrono>\n',
    "tasks/run/graph.cpp": '#include <oneapi/tbb/flow_graph.h>\n#include <chrono>\n#include "engine/solve/jam.hpp"\n',
    "tasks/main.cpp": '#include "tasks/commands/command.hpp"\n',
    "tasks/commands/command_line.cpp": '#include <CLI/CLI.hpp>\n#include "tasks/commands/command.hpp"\n',
    "tasks/records/store.hpp": '#include "tasks/io/file.hpp"\n#include "tasks/io/json.hpp"\n',
    "tests/threads_test.cpp": "#include <tbb/global_control.h>\n",
}

FOREIGN = (
    ("engine/packing/energy.cpp", '#include "tasks/run/graph.hpp"'),
    ("engine/packing/energy.cpp", "#include <tasks/run/graph.hpp>"),
    ("engine/packing/energy.cpp", '#include "../../tasks/run/graph.hpp"'),
    ("engine/packing/energy.hpp", "#include <nlohmann/json.hpp>"),
    ("engine/packing/energy.hpp", "#include <nlohmann/json_fwd.hpp>"),
    ("engine/solve/jam.cpp", "#include <fmt/core.h>"),
    ("engine/solve/jam.cpp", "#include <CLI/CLI.hpp>"),
    ("engine/solve/jam.cpp", "#include <unistd.h>"),
    ("engine/solve/jam.cpp", "#include <sys/stat.h>"),
    ("engine/solve/jam.cpp", "#include <boost/multiprecision/float128.hpp>"),
    ("engine/solve/jam.cpp", '#include "jam.hpp"'),
    ("engine/solve/jam.cpp", '#include "quadmath.h"'),
    ("engine/solve/jam.cpp", '#include "vector"'),
)

OUTSIDE = (
    ("engine/geometry/pose.hpp", " #  include <chrono> // by the way"),
    ("engine/geometry/pose.hpp", "inline auto now() { return std::chrono::steady_clock::now(); }"),
    ("engine/solve/jam.cpp", 'const char* threads = std::getenv("THREADS");'),
    ("engine/solve/jam.cpp", "void say() { std::cerr << 1; }"),
    ("engine/random/stream.cpp", "std::random_device seed;"),
    ("engine/solve/jam.cpp", "#include_next <chrono>"),
    ("engine/solve/jam.cpp", "#import <chrono>"),
    *(("engine/solve/jam.cpp", f"#include <{header}>") for header in (
        "filesystem", "chrono", "ctime", "fstream", "iostream", "istream", "ostream", "sstream", "syncstream", "cstdio",
        "iomanip", "execution")),
    *(("engine/solve/jam.h", name) for name in (
        "std::filesystem::path", "std::cout", "std::clog", "getenv(", "std::fopen(", "printf(", "clock_gettime(")),
)

UPWARDS = (
    ("engine/random/stream.hpp", '#include "engine/geometry/pose.hpp"'),
    ("engine/parallel/parallel.cpp", '#include "engine/packing/packing.hpp"'),
    ("engine/geometry/overlap.cpp", '#include "engine/packing/packing.hpp"'),
    ("engine/packing/energy.cpp", '#include "engine/solve/jam.hpp"'),
    ("engine/solve/minimise/lbfgs.cpp", '#include "engine/analysis/contacts.hpp"'),
    ("tasks/records/store.hpp", '#include "tasks/run/graph.hpp"'),
    ("tasks/io/place.hpp", '#include "tasks/manifest/plan.hpp"'),
    ("tasks/io/file.hpp", '  # include "tasks/packings/solid_json.hpp"'),
)

TBB = (
    ("engine/parallel/parallel.hpp", "#include <tbb/parallel_for.h>"),
    ("engine/packing/pair_loop.cpp", "#include <tbb/parallel_for.h>"),
    ("engine/packing/energy.cpp", "#include <tbb/parallel_for.h>"),
    ("engine/solve/jam.cpp", "#include <oneapi/tbb/task_arena.h>"),
    ("engine/solve/jam.cpp", '#include "tbb/task_arena.h"'),
    ("tasks/run/graph.hpp", "#include <oneapi/tbb/flow_graph.h>"),
    ("tasks/records/store.cpp", "#include <tbb/global_control.h>"),
    ("tasks/records/store.cpp", "#include <execution>"),
)


def run(root):
    """Exit code and output of check_tree.py."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        status = check_tree.main([str(root)])
    return status, said.getvalue()


class CheckTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for file, text in GOOD.items():
            self.write(file, text)

    def write(self, file, text):
        path = self.root / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def accept(self, what):
        status, said = run(self.root)
        self.assertEqual(status, 0, f"{what}:\n{said}")

    def reject(self, file, line, why):
        """The tree is rejected with an additional line in a file, at this line. Without the line it is accepted
        again."""
        path, before = self.root / file, GOOD.get(file, "")
        self.write(file, before + line + "\n")
        status, said = run(self.root)
        expected = f"{file}:{(before + line).count(chr(10)) + 1}: {why}"
        self.assertTrue(status == 1 and expected in said, f"not rejected as {expected}: {line[:80]}\n{said}")
        if before:
            self.write(file, before)
        else:
            path.unlink()

    def reject_all(self, cases, why):
        for file, line in cases:
            self.reject(file, line, why)

    def test_accepts_a_tree_that_keeps_every_rule(self):
        self.accept("good tree")
        program = [sys.executable, "-B", check_tree.__file__, str(self.root)]
        self.assertEqual(subprocess.run(program, capture_output=True, check=False).returncode, 0)
        self.write("ratios.json", "{}")
        self.assertEqual(subprocess.run(program, capture_output=True, check=False).returncode, 1)

    def test_engine_includes_the_engine_alone(self):
        self.reject_all(FOREIGN, "engine/ includes what is not engine/")

    def test_engine_has_no_files_clock_streams_or_environment(self):
        self.reject_all(OUTSIDE, "engine/ touches files, clock")
        self.reject("engine/solve/jam.cpp", "#include HEADER", "include that cannot be read")

    def test_includes_point_downwards(self):
        self.reject_all(UPWARDS, "include points upwards")
        for half, folders in check_tree.FOLDERS.items():
            self.assertGreater(len(folders), 9)
            for below, above in zip(folders, folders[1:]):
                self.reject(f"{half}/{below}/a.hpp", f'#include "{half}/{above}/b.hpp"', "include points upwards")
                self.write(f"{half}/{above}/b.hpp", f'#include "{half}/{below}/a.hpp"\n')
        self.accept("every folder includes the one below it")

    def test_sources_stand_in_a_folder_of_the_order(self):
        for file, header in (("tasks/odds/ends.cpp", "tasks/io/json.hpp"), ("tasks/loose.cpp", "tasks/io/json.hpp"),
                             ("tasks/io/json.cpp", "tasks/odds/ends.hpp")):
            self.reject(file, f'#include "{header}"', "folder of tasks/ without a place in the order")
        self.reject("engine/extra/thing.cpp", '#include "engine/geometry/pose.hpp"',
                    "folder of engine/ without a place in the order")

    def test_libraries_stay_in_their_sources(self):
        self.reject_all(TBB, "oneTBB outside its two sources")
        for file in ("engine/solve/factor/elimination.cpp", "tasks/run/graph.cpp"):
            self.reject(file, "#include <metis.h>", "METIS outside its source")
        self.reject("tasks/commands/run.cpp", "#include <CLI/App.hpp>", "CLI11 outside its source")

    def test_top_level(self):
        for name in ("ratios.json", "resultsx"):
            self.reject(name, "{}", "not at the top")
        for name in ("build/a", "build-asan/a", "results/a", ".git/a", "Makefile", "README.md", ".clang-tidy"):
            self.write(name, "")
        self.accept("agreed names at the top")

    def test_length_of_files(self):
        for file in ("engine/solve/long.cpp", "engine/solve/long.hpp", "engine/solve/long.h", "tasks/run/long.cpp",
                     "tests/long.cpp", "tests/house/run.sh", "tasks/extras/page/embed.cmake", "tests/CMakeLists.txt"):
            self.write(file, "// line\n" * 401)
            status, said = run(self.root)
            self.assertEqual(status, 1)
            self.assertIn(f"{file}:401: more than 400 lines: 401\n", said)
            self.write(file, "// line\n" * 400)
        self.write("tests/house/bad/tidy.cpp", "// line\n" * 401)
        self.accept("400 lines, and a longer file among those that linters reject")

    def test_says_when_nothing_was_checked(self):
        for file in GOOD:
            self.write(file, "")
        self.assertEqual(run(self.root)[0], 2)
        for file in GOOD:
            if file.startswith("engine/"):
                (self.root / file).unlink()
        (self.root / "engine").rename(self.root / "tests/engine")
        status, said = run(self.root)
        self.assertEqual(status, 2)
        self.assertIn("no engine/", said)


if __name__ == "__main__":
    unittest.main()
