"""Tests check_tree.py: it accepts a small tree that follows all rules, and rejects the tree after each change below.

The message has the file, the line and the rule. A rule that check_tree.py does not check fails here."""

import contextlib
import io
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import check_tree

GOOD = {
    "engine/geometry/pose.hpp": "#pragma once\n#include <Eigen/Core>\n#include <vector>\n#include <immintrin.h>\n",
    "engine/parallel/parallel.cpp": '#include <tbb/parallel_for.h>\n#include "engine/random/stream.hpp"\n',
    "engine/solve/factor/ordering.cpp": "#include <metis.h>\n#include <Spectra/SymEigsSolver.h>\n"
                                        "#include <boost/math/tools/roots.hpp>\n#include <arm_neon.h>\n",
    "engine/solve/jam.cpp": '#include "engine/packing/energy.hpp"\n// #include <chrono>\n',
    "engine/CMakeLists.txt": "# include\n",
    "tasks/run/graph.cpp": '#include <oneapi/tbb/flow_graph.h>\n#include <chrono>\n#include "engine/solve/jam.hpp"\n',
    "tasks/commands/command_line.cpp": '#include <CLI/CLI.hpp>\n#include "tasks/commands/command.hpp"\n',
    "tests/threads_test.hpp": "#include <tbb/global_control.h>\n",
}
FOREIGN = "engine/ includes what is not engine/"
TOUCHES = "engine/ touches files, clock"
UPWARDS = "include points upwards"
IN_HEADER = "oneTBB, CLI11 or METIS in a header"
NO_PLACE = "folder of engine/ without a place in the order"
BAD = (
    *(("engine/solve/jam.cpp", f"#include {header}", FOREIGN) for header in (
        '"tasks/run/graph.hpp"', "<tasks/run/graph.hpp>", '"../../tasks/run/graph.hpp"', "<nlohmann/json.hpp>",
        "<fmt/core.h>", "<CLI/CLI.hpp>", "<unistd.h>", "<sys/stat.h>", "<boost/multiprecision/float128.hpp>",
        '"jam.hpp"', '"vector"')),
    *(("engine/solve/jam.cpp", f"#include <{header}>", TOUCHES) for header in sorted(check_tree.BANNED_HEADERS)),
    *(("engine/solve/jam.hpp", name, TOUCHES) for name in (
        "auto t = std::chrono::steady_clock::now();", 'std::getenv("THREADS")', "std::cerr << 1;", "std::cout",
        "std::clog", "std::random_device seed;", "std::filesystem::path", "std::fopen(", "printf(", "clock_gettime(",
        " #  include <chrono> // by the way", "#include_next <chrono>", "#import <chrono>")),
    ("engine/solve/jam.cpp", "#include HEADER", "include that cannot be read"),
    *((f"engine/{below}/a.hpp", f'#include "engine/{above}/b.hpp"', UPWARDS)
      for below, above in zip(check_tree.FOLDERS, check_tree.FOLDERS[1:])),
    ("engine/solve/minimise/lbfgs.cpp", '#include "engine/analysis/contacts.hpp"', UPWARDS),
    ("engine/extra/thing.cpp", '#include "engine/geometry/pose.hpp"', NO_PLACE),
    ("engine/solve/thing.cpp", '#include "engine/extra/pose.hpp"', NO_PLACE),
    *((file, f"#include {header}", IN_HEADER) for file in ("tasks/run/graph.hpp", "tasks/run/graph.h")
      for header in ("<tbb/parallel_for.h>", '"oneapi/tbb/task_arena.h"', "<execution>", "<CLI/App.hpp>", "<metis.h>")),
    ("engine/parallel/parallel.hpp", "#include <tbb/parallel_for.h>", IN_HEADER),
    *((file, "// line\n" * check_tree.MAX_LINES, "more than 400 lines") for file in (
        "engine/solve/long.hpp", "tasks/run/long.h", "tests/long.cpp", "tests/run.sh", "tasks/a.cmake",
        "tests/CMakeLists.txt")),
    ("tests/wide.cpp", "// " + "φ" * 118, "wide comment"),
    ("ratios.json", "{}", "not at the top"),
    ("resultsx", "{}", "not at the top"),
)


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

    def run_check(self):
        """Exit code and output of check_tree.py."""
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            return check_tree.main([str(self.root)]), output.getvalue()

    def test_a_tree_that_keeps_every_rule_is_accepted(self):
        for name in ("build-asan/a", "results/a", ".git/a", "README.md"):
            self.write(name, "#include <tbb/tbb.h>\n" * 401)
        self.write("engine/rigidity/a.hpp", '#include "engine/names/b.hpp"\n')
        self.assertEqual(self.run_check()[0], 0, self.run_check()[1])

    def test_each_breach_is_found(self):
        for file, line, why in BAD:
            before = GOOD.get(file, "")
            self.write(file, f"{before}{line}\n")
            status, output = self.run_check()
            self.assertTrue(status == 1 and "1 breaches" in output, f"{file}: {line[:80]}\n{output}")
            self.assertRegex(output, rf"(?m)^{file}:{(before + line).count(chr(10)) + 1}: {why}")
            self.write(file, before) if before else (self.root / file).unlink()

    def test_the_budget_counts_what_git_knows(self):
        self.write("examples/a/data/long.json", "\n" * 99)
        self.write("schemas/a.json", "\n" * 99)
        subprocess.run(["git", "init", "-q"], cwd=self.root, check=True)
        subprocess.run(["git", "add", "."], cwd=self.root, check=True)
        self.write("tasks/new.hpp", "\n")
        lines = sum(text.count("\n") for text in GOOD.values())
        with mock.patch.object(check_tree, "BUDGET", lines):
            self.assertEqual(self.run_check()[0], 0)
            self.assertRegex(self.run_check()[1], r"(?m)^ +6 engine/solve$")
            subprocess.run(["git", "add", "."], cwd=self.root, check=True)
            self.assertIn(f"{lines + 1} lines, more than the budget: {lines}", self.run_check()[1])

    def test_without_an_engine_nothing_is_checked(self):
        (self.root / "engine").rename(self.root / "tests/engine")
        self.assertEqual(self.run_check()[0], 2)


if __name__ == "__main__":
    unittest.main()
