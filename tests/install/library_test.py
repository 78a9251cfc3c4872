"""Tests the installed C++ library. usage: library_test.py CMAKE BUILD SOURCE COMPILER"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE, COMPILER = sys.argv[1:5]
EXAMPLE = pathlib.Path(SOURCE) / "examples/12-library"
SANITIZED = re.search(r"^ISOJAM_SANITIZE:\w+=(.+)$", (pathlib.Path(BUILD) / "CMakeCache.txt").read_text(), re.M)
STRICT = "-O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror" + (
    f" -fsanitize={SANITIZED[1]}" if SANITIZED else "")


def run(*words, check=True):
    ended = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False)
    if check and ended.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, words))}\n{ended.stdout}{ended.stderr}")
    return ended


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = pathlib.Path(folder.name).resolve()
        cls.prefix = cls.here / "moved to/prefix"
        run(CMAKE, "--install", BUILD, "--prefix", cls.here / "prefix")
        cls.prefix.parent.mkdir()
        shutil.move(cls.here / "prefix", cls.prefix)

    def configure(self, name, *options, check=True):
        return run(CMAKE, "-S", EXAMPLE, "-B", self.here / name, "-G", "Ninja", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                   *options, check=check)

    def commands(self, name):
        return json.loads((self.here / name / "compile_commands.json").read_text(encoding="utf-8"))

    def printed(self, name, compiler):
        self.configure(name, f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_CXX_FLAGS={STRICT}",
                       f"-DCMAKE_CXX_COMPILER={compiler}")
        run(CMAKE, "--build", self.here / name)
        return run(self.here / name / "jam_octahedra").stdout

    def test_an_installed_engine(self):
        said = self.printed("found", COMPILER)
        self.assertRegex(said, r"^phi_J = 0\.6[789]\d+ ± 0\.00\d+, Z = [89]\.\d+ at phi - phi_J = 0\.00[5-9]\d\n$")
        clang = shutil.which("clang++") or shutil.which("clang++-14")
        if clang and not SANITIZED:
            self.assertEqual(self.printed("by-clang", clang), said)
        command = self.commands("found")[0]["command"]
        self.assertIn("-ffp-contract=off", command)
        self.assertIn("-DEIGEN_NO_CPUID", command)
        self.assertEqual(re.findall(r" (-O\S+|-W\S+)", command), [word for word in STRICT.split() if word[1] in "OW"])
        self.assertIn(f"-isystem '{self.prefix}/include/isojam'".replace("'", "\"" if '"' in command else "'"),
                      command.replace("\\ ", " ") if "'" not in command else command)

    def test_names_no_directory_of_the_build(self):
        texts = [path for path in (self.prefix / "lib/cmake").rglob("*.cmake")]
        self.assertGreaterEqual(len(texts), 5)
        for path in texts:
            for directory in (SOURCE, BUILD):
                named = rf"(?<![\w./}}-]){re.escape(directory)}(?![\w.-])"
                self.assertNotRegex(path.read_text(encoding="utf-8"), named, path)

    def test_installed_headers_include_only_installed_headers(self):
        folder = self.prefix / "include/isojam"
        installed = {str(path.relative_to(folder)) for path in folder.rglob("*.hpp")}
        self.assertTrue({"engine/packing/packing.hpp", "engine/solve/jam.hpp", "engine/analysis/contacts.hpp",
                         "engine/vibration/spectrum.hpp"} <= installed)
        for name in installed:
            included = set(re.findall(r'#include "(engine/[^"]+)"', (folder / name).read_text(encoding="utf-8")))
            self.assertLessEqual(included, installed, name)

    def test_a_part_of_another_project(self):
        self.configure("part", f"-DISOJAM_SOURCE={SOURCE}", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS=-Wall",
                       f"-DCMAKE_CXX_COMPILER={COMPILER}")
        commands = {entry["file"]: entry["command"] for entry in self.commands("part")}
        own = commands.pop(str(EXAMPLE / "jam_octahedra.cpp"))
        ours = {file for file in commands if "cmake_pch" not in file}
        self.assertTrue(ours and all(file.startswith(f"{SOURCE}/engine/") for file in ours), sorted(ours))
        for command in (own, *commands.values()):
            self.assertNotIn("-Werror", command)
            self.assertNotRegex(command, r" -O\d")
        self.assertNotIn("-Wshadow", own)
        self.assertIn("-ffp-contract=off", own)
        run(CMAKE, "--build", self.here / "part", "--target", "CMakeFiles/jam_octahedra.dir/jam_octahedra.cpp.o")

    def test_what_is_refused(self):
        version = self.prefix / "lib/cmake/isojam/isojam-config-version.cmake"
        text = version.read_text(encoding="utf-8")
        try:
            version.write_text(text.replace('"0.1.0"', '"0.2.0"'), encoding="utf-8")
            ended = self.configure("other", f"-DCMAKE_PREFIX_PATH={self.prefix}", check=False)
            self.assertNotEqual(ended.returncode, 0)
            self.assertIn("0.2.0", ended.stderr)
        finally:
            version.write_text(text, encoding="utf-8")
        ended = self.configure("bare", f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DISOJAM_METIS_LIBRARY=NOTFOUND",
                               "-DCMAKE_FIND_ROOT_PATH=/nowhere", "-DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY", check=False)
        self.assertNotEqual(ended.returncode, 0)
        self.assertIn("libmetis-dev", ended.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
