"""Facts proved here: without_pages_test.py CMAKE SOURCE PROGRAM

- without Vega and three.js, configuring warns with the names of their packages and goes on;
- the program that is built then has every command; `report` and `chart` end with exit 2, name the packages and say how to
  configure; the others work.
"""

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
            ended = run(CMAKE, "-S", SOURCE, "-B", here, "-G", "Ninja", "-DISOJAM_TESTS=OFF",
                        "-DISOJAM_JAVASCRIPT=/nowhere")
            self.assertEqual(ended.returncode, 0, ended.stderr)
            for word in ("libjs-vega", "libjs-three", "/nowhere"):
                self.assertIn(word, ended.stderr)
            targets = run("ninja", "-C", here, "-t", "targets", "all").stdout
            self.assertIn("\nisojam: ", targets)
            self.assertNotIn("isojam_chart", targets)

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
