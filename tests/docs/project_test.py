"""Tests files that describe the project. usage: project_test.py SOURCE"""

import ast
import copy
import pathlib
import re
import sys
import tomllib
import unittest

import yaml

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "docs/site"))
from pages import code_lines, pages, spans  # noqa: E402

SOURCE = pathlib.Path(sys.argv[1])


def text_of(name):
    return (SOURCE / name).read_text(encoding="utf-8")


def faults(citation):
    """Errors of a citation file, according to https://citation-file-format.github.io, version 1.2.0."""
    wrong = [f"no {key}" for key in ("cff-version", "message", "title", "authors", "version", "license", "references")
             if not citation.get(key)]
    if citation.get("cff-version") != "1.2.0" or citation.get("type", "software") not in ("software", "dataset"):
        wrong.append("another form")
    version = re.search(r"project\(isojam VERSION (\S+)", text_of("CMakeLists.txt"))[1]
    if citation.get("version") != version:
        wrong.append("another version")
    others = [person for other in citation.get("references", []) for person in other["authors"]]
    for person in citation.get("authors", []) + others:
        if not ("name" in person or {"family-names", "given-names"} <= set(person)):
            wrong.append("an author without a name")
    for other in citation.get("references", []):
        wrong += [f"a reference without {key}" for key in ("type", "title", "authors") if not other.get(key)]
    return wrong


def verbs_of(makefile):
    return set(re.findall(r"^([a-z][a-z0-9-]*):(?!=)", makefile, re.M))


class Project(unittest.TestCase):
    def test_the_first_page(self):
        page = text_of("README.md")
        self.assertLessEqual(page.count("\n"), 100)
        self.assertRegex(page, r"!\[[^\]]+\]\(examples/[^)]+\.png\)")
        for word in ("make run", "make test", "CITATION.cff", "BSD-3-Clause", "docs/index.md"):
            self.assertIn(word, page)

    def test_the_citation(self):
        citation = yaml.safe_load(text_of("CITATION.cff"))
        self.assertEqual(faults(citation), [])
        self.assertEqual(citation["license"], "BSD-3-Clause")
        self.assertTrue(text_of("LICENSE").startswith("BSD 3-Clause License"))
        self.assertIn(f"https://doi.org/{citation['references'][0]['doi']}", text_of("README.md"))

    def test_a_bad_citation_is_refused(self):
        good = yaml.safe_load(text_of("CITATION.cff"))
        for key in ("cff-version", "message", "title", "authors", "version", "license"):
            bad = copy.deepcopy(good)
            del bad[key]
            self.assertIn(f"no {key}", faults(bad))
        self.assertEqual(faults({**good, "version": "0.0.9"}), ["another version"])
        self.assertEqual(faults({**good, "authors": [{"given-names": "Ada"}]}), ["an author without a name"])

    def test_the_changelog(self):
        page = text_of("CHANGELOG.md")
        self.assertTrue(page.startswith("# Changelog\n"))
        self.assertRegex(page, r"\n## \[(Unreleased|\d+\.\d+\.\d+\] - \d{4}-\d{2}-\d{2})")
        self.assertLessEqual(set(re.findall(r"^### (.*)$", page, re.M)),
                             {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"})

    def test_packages_have_the_names_that_cmake_prints(self):
        names = re.search(r"set\(isojam_package_names\n(.*?)\)", text_of("engine/packages.cmake"), re.S)[1]
        names = {line.split()[0]: line.split()[1:] for line in names.split("\n") if line.strip()}
        minimum = dict(re.findall(r"isojam_(?:require|miss)\((\S+) ([\d.]+) ",
                                  text_of("CMakeLists.txt") + text_of("engine/packages.cmake")))
        rows = [row.strip("|").split("|") for row in re.findall(r"^\|.*\|$", text_of("docs/install.md"), re.M)]
        rows = {row[0].strip(): [cell.strip() for cell in row[1:]] for row in rows}
        self.assertEqual(len(minimum), 9)
        for package, version in minimum.items():
            self.assertEqual(rows[package], [version, *names[package]], package)

    def test_packages(self):
        version = re.search(r"project\(isojam VERSION (\S+)", text_of("CMakeLists.txt"))[1]
        folder = "docs/packaging"
        # The recipe of conda-forge is YAML once the version is set in it.
        recipe = re.sub(r"\{%.*?%\}", "", text_of(f"{folder}/conda/meta.yaml")).replace("{{ version }}", version)
        recipe = yaml.safe_load(re.sub(r"\{\{ (\w+)\((.*?)\) \}\}", r"\1", recipe))
        self.assertEqual(recipe["package"], {"name": "isojam", "version": version})
        self.assertIn(f'set version = "{version}"', text_of(f"{folder}/conda/meta.yaml"))
        spack = text_of(f"{folder}/spack/package.py")
        ast.parse(spack)
        self.assertIn(f'version("{version}"', spack)
        wheel = tomllib.loads(text_of(f"{folder}/wheel/pyproject.toml"))
        self.assertEqual(wheel["project"]["version"], version)
        self.assertTrue(text_of(f"{folder}/debian/changelog").startswith(f"isojam ({version}-1) "))

    def test_verbs(self):
        verbs = verbs_of(text_of("Makefile"))
        self.assertLessEqual({"run", "test", "docs"}, verbs)
        shown = set()
        for page in pages(SOURCE):
            text = page.read_text(encoding="utf-8")
            for number, words in code_lines(text) + spans(text):
                match = re.match(r"(?:\S+=\S+ )*make ([a-z][a-z0-9-]*)", words)
                if match:
                    self.assertIn(match[1], verbs, f"{page}:{number}")
                    shown.add(match[1])
        not_typed = {"browser", "lint-sources"}
        self.assertEqual(verbs - shown - not_typed, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
