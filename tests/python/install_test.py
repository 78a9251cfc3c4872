"""Tests the installed module. usage: install_test.py CMAKE BUILD MODULE_DIR RESULTS"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, MODULE_DIR, RESULTS = sys.argv[1:5]

READ = """
import isojam, isojam.program
study = isojam.load(sys.argv[1], program=sys.argv[2] or None)
print(isojam.program.find(sys.argv[2] or None))
print(len(study.names), [solid.name for name in study.names if "0.85" in name for solid in study.packing(name).solids])
"""


def python(text, module, *arguments, **environment):
    code = f"import sys; sys.path.insert(0, {str(module)!r})\n{text}"
    return subprocess.run([sys.executable, "-B", "-E", "-s", "-c", code, *map(str, arguments)], env=environment,
                          capture_output=True, text=True, check=False)


class Install(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix = pathlib.Path(folder.name).resolve()
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", self.prefix], check=True, stdout=subprocess.DEVNULL)
        self.module, self.program = self.prefix / MODULE_DIR, self.prefix / "bin/isojam"

    def found(self, argument="", **environment):
        ended = python(READ, self.module, RESULTS, argument, **environment)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        program, read = ended.stdout.splitlines()
        self.assertEqual(read, "12 ['brick', 'brick', 'brick'" + 3 * ", 'cube', 'tetrahedron'" + "]")
        return program

    def test_what_is_installed(self):
        self.assertEqual(os.path.realpath(self.found()), str(self.program))
        said = subprocess.run([self.program, "--version"], capture_output=True, text=True, check=True).stdout
        self.assertIn("isojam", said)

    def test_where_the_program_is_looked_for(self):
        names = [self.prefix / name / "isojam" for name in ("argument", "environment", "path")]
        for name in names:
            name.parent.mkdir()
            name.symlink_to(f"{BUILD}/isojam")
        argument, environment, path = map(str, names)
        self.program.unlink()
        self.assertEqual(self.found(argument, ISOJAM=environment, PATH=os.path.dirname(path)), argument)
        self.assertEqual(self.found(ISOJAM=environment, PATH=os.path.dirname(path)), environment)
        self.assertEqual(self.found(PATH=os.path.dirname(path)), path)
        self.assertIn("ISOJAM", python(READ, self.module, RESULTS, "").stderr)
        self.assertIn("/no/such", python(READ, self.module, RESULTS, "", ISOJAM="/no/such").stderr)

    def test_without_pandas(self):
        ended = python("sys.modules['pandas'] = None\nimport isojam", self.module)
        self.assertIn("pandas", ended.stderr)

    def test_the_sources_alone(self):
        (self.module / "isojam/facts.json").unlink()
        self.assertIn("python/ in the build directory", python("import isojam", self.module).stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
