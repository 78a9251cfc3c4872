"""Tests the pages: links, rendering, the site of `make docs`, files about the project. usage: pages_test.py SOURCE"""

import ast
import pathlib
import re
import sys
import tempfile
import tomllib
import unittest

import yaml

SOURCE, PROGRAM = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
sys.path.insert(0, str(SOURCE / "docs/site"))
from gather import gather, rewritten  # noqa: E402
from pages import anchors, code_lines, lines_of, links, pages, spans  # noqa: E402


def broken(root, page):
    """Descriptions of the broken links of a page, one line each."""
    wrong = []
    for number, target in links(page.read_text(encoding="utf-8")):
        if "://" in target or target.startswith("mailto:"):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.is_relative_to(root):
            wrong.append(f"{page}:{number}: {target} leaves the tree")
        elif not file.exists():
            wrong.append(f"{page}:{number}: there is no {target}")
        elif anchor and (file.suffix != ".md" or anchor not in anchors(file.read_text(encoding="utf-8"))):
            wrong.append(f"{page}:{number}: no heading has the anchor of {target} in both ways of naming it")
    return wrong


def breaking(text):
    """Numbers of lines that begin with an HTML comment, where renderers end the paragraph, and of lines inside a paragraph
    that a mark at their beginning makes a list or a quotation."""
    found, before = [], ""
    for number, is_code, line in lines_of(text):
        comment = re.match(r"\s*(?:[-*] |\d+\. )?<!-- (?!block|end)", line)
        mark = re.match(r"(?:[>+]|\d+\.) ", line) and re.match(r"(?![-*>+] |\d+\. )\S", before)
        found += [number] if not is_code and (comment or mark) else []
        before = "" if is_code else line
    return found


class Links(unittest.TestCase):
    def test_all_lead_somewhere(self):
        found = pages(SOURCE)
        self.assertGreater(len(found), 20)
        self.assertGreater(sum(len(links(page.read_text(encoding="utf-8"))) for page in found), 100)
        self.assertEqual([line for page in found for line in broken(SOURCE, page)], [])

    def test_no_line_breaks_its_paragraph(self):
        for page in pages(SOURCE):
            self.assertEqual(breaking(page.read_text(encoding="utf-8")), [], page)
        for text in ("The mean is\n<!-- = total -->5<!-- / --> today.", "One.\n\n- <!-- = total -->5<!-- / --> jam.\n",
                     "stiff if the ratio\n> 10 is reached", "would then be\n1. Its", "one\n+ two"):
            self.assertEqual(len(breaking(text)), 1, text)
        self.assertEqual(breaking("1. one\n   more\n2. two\n\n> a\n> b\n\n```\n<!-- c -->\nd\n> e\n```\n"), [])

    def test_tables_and_captions_are_short(self):
        for page in pages(SOURCE):
            text = re.sub(r"<!--.*?-->", "", page.read_text(encoding="utf-8"))
            for row in re.findall(r"^\|[-| :]+\|$", text, re.M):
                self.assertLessEqual(row.count("|") - 1, 7, page)
            for caption in re.findall(r"^\*\*(?:Figure|Table) \d.*?\n\n", text, re.M | re.S):
                self.assertLessEqual(len(caption.split()), 80, f"{page}: {caption}")

    def test_indexes_are_complete(self):
        def linked(page):
            return {(page.parent / target.partition("#")[0]).resolve() for _, target in
                    links(page.read_text(encoding="utf-8"))}

        docs = set((SOURCE / "docs").glob("*.md")) - {SOURCE / "docs/index.md"}
        self.assertEqual(docs - linked(SOURCE / "docs/index.md"), set())
        examples = set((SOURCE / "examples").glob("*/README.md"))
        self.assertEqual(examples - linked(SOURCE / "examples/README.md"), set())


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.build = pathlib.Path(folder.name).resolve()
        gather(SOURCE, cls.build, PROGRAM)
        cls.pages = sorted((cls.build / "source").rglob("*.md"))

    def test_links_go_along(self):
        self.assertEqual(len(self.pages), len(pages(SOURCE)) + 2)
        followed = 0
        for page in self.pages:
            for number, target in links(page.read_text(encoding="utf-8")):
                path = target.partition("#")[0]
                if path and "://" not in path and not path.startswith("api/"):
                    self.assertTrue((page.parent / path).is_file(), f"{page}:{number}: {target}")
                    followed += 1
        self.assertGreater(followed, 100)

    def test_comments_and_signs(self):
        with tempfile.TemporaryDirectory() as here:
            root, page = pathlib.Path(here).resolve(), pathlib.Path("a.md")
            (root / page).write_text("Of\n<!-- = n -->8<!-- / --> more\n\n<!-- end -->\n| `a\\|b` | 1 ± .2 ± < .3 (4) |\n",
                                     encoding="utf-8")
            self.assertEqual(rewritten(root, page, set()),
                             "Of\n8 more\n\n\n| `a|b` | 1\u00a0±\u00a0.2 ±\u00a0<\u00a0.3 (4) |\n")
        for page in self.pages:
            self.assertNotIn("<!--", page.read_text(encoding="utf-8"), page)

    def test_the_menu(self):
        menu = re.findall(r"^ +- [^:]+: (\S+)$|^  - [^:]+: (\S+)$", (self.build / "mkdocs.yml").read_text(), re.M)
        named = [self.build / "source" / (deep or top) for deep, top in menu]
        self.assertEqual(sorted(named), self.pages)


class Headers(unittest.TestCase):
    def test_public_headers_include_only_public_headers(self):
        text = (SOURCE / "engine/CMakeLists.txt").read_text(encoding="utf-8")
        public = {f"engine/{name}" for name in
                  re.search(r"FILE_SET HEADERS BASE_DIRS \S+ FILES\n(.*?)\)", text, re.S)[1].split()}
        self.assertGreater(len(public), 20)
        for source in [*(SOURCE / name for name in public), *SOURCE.glob("examples/**/*.cpp")]:
            included = set(re.findall(r'#include "(engine/[^"]+)"', source.read_text(encoding="utf-8")))
            self.assertLessEqual(included, public, source)


def text_of(name):
    return (SOURCE / name).read_text(encoding="utf-8")


def verbs_of(makefile):
    return set(re.findall(r"^([a-z][a-z0-9-]*):(?!=)", makefile, re.M))


class Project(unittest.TestCase):
    def test_the_citation(self):
        citation = yaml.safe_load(text_of("CITATION.cff"))
        self.assertLessEqual({"cff-version", "message", "title", "authors", "references"}, set(citation))
        self.assertEqual(citation["version"], re.search(r"project\(isojam VERSION (\S+)", text_of("CMakeLists.txt"))[1])
        self.assertEqual(citation["license"], "BSD-3-Clause")
        self.assertTrue(text_of("LICENSE").startswith("BSD 3-Clause License"))
        self.assertIn(f"https://doi.org/{citation['references'][0]['doi']}", text_of("README.md"))

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
