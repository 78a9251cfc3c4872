"""Tests a build without optional packages. usage: without_pages_test.py CMAKE SOURCE PROGRAM"""

import subprocess
import sys
import tempfile
import unittest

CMAKE, SOURCE, PROGRAM = sys.argv[1:4]


def run(*words):
    return subprocess.run(list(words), capture_output=True, text=True, check=False)


class WithoutPages(unittest.TestCase):
    def test_configures(self):
        with tempfile.TemporaryDirectory() as here:
            ended = run(CMAKE, "-S", SOURCE, "-B", here, "-G", "Ninja", "-DISOJAM_JAVASCRIPT=/nowhere",
                        "-DCMAKE_DISABLE_FIND_PACKAGE_valijson=ON")
            self.assertEqual(ended.returncode, 0, ended.stderr)
            for words in ("libjs-vega", "libjs-three", "/nowhere", "\n  files checked against schemas/: ",
                          "\n  report and chart in a browser: "):
                self.assertIn(words, ended.stderr)
            targets = run("ninja", "-C", here, "-t", "targets", "all").stdout
            for built in ("isojam", "solve_tests", "packing_tests", "tasks_tests"):
                self.assertIn(f"\n{built}: ", targets)
            for left_out in ("isojam_chart", "isojam_schema_check", "atlas_tests"):
                self.assertNotIn(left_out, targets)

    def test_says_what_it_lacks(self):
        for words in (["report", "results"], ["chart", "-o", "x"], ["chart", "--full", "-o", "x"]):
            ended = run(PROGRAM, *words)
            self.assertEqual((ended.returncode, ended.stdout), (2, ""), words)
            for word in ("libjs-vega", "libjs-three", "-DISOJAM_PAGES=ON"):
                self.assertIn(word, ended.stderr, words)
        listed = run(PROGRAM, "--help").stdout
        for command in ("run", "report", "chart", "export"):
            self.assertRegex(listed, rf"(?m)^  {command} ")
        self.assertEqual(run(PROGRAM, "validate", "/nowhere").returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
