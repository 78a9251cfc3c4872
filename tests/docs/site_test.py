"""Tests the site that `make docs` makes. usage: site_test.py SOURCE"""

import pathlib
import re
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "docs/site"))

from doxygen_filter import filtered  # noqa: E402
from gather import gather, rewritten  # noqa: E402
from pages import links, pages  # noqa: E402


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.build = pathlib.Path(folder.name).resolve()
        gather(SOURCE, cls.build)
        cls.pages = sorted((cls.build / "source").rglob("*.md"))

    def test_links_go_along(self):
        self.assertEqual(len(self.pages), len(pages(SOURCE)) + 1)
        followed = 0
        for page in self.pages:
            for number, target in links(page.read_text(encoding="utf-8")):
                path = target.partition("#")[0]
                if path and "://" not in path and not path.startswith("api/"):
                    self.assertTrue((page.parent / path).is_file(), f"{page}:{number}: {target}")
                    followed += 1
        self.assertGreater(followed, 100)

    def test_code_stays(self):
        with tempfile.TemporaryDirectory() as here:
            root = pathlib.Path(here).resolve()
            (root / "docs").mkdir()
            page = pathlib.Path("docs/a.md")
            text = "[b](../README.md#x)\n\n```json\n[b](../README.md) <!-- c -->\n```\n\n    `a\\|b` 1 ± 2\n"
            (root / page).write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(SystemExit, "there is no ../README.md"):
                rewritten(root, page, set())
            (root / "README.md").write_text("# A\n", encoding="utf-8")
            self.assertEqual(rewritten(root, page, set()), text.replace("[b](../README.md#x)", "[b](index.md#x)"))

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
    def test_each_declaration_has_the_comment(self):
        header = "\n".join((
            "/// Two numbers.", "struct A {", "  double x = 0, y[2] = {0, 0};  ///< V_p", "  /// Both, of",
            "  /// each.", "  std::map<int, int> p, q{};", "  int bare = 0, alone = 0;",
            "  bool operator==(const A& other) const = default;", "};", "template <>",
            "inline constexpr std::array enum_names<A>{EnumName{A::x, \"x\"},", "    EnumName{A::y, \"y\"}};",
            "/// Of a.", "int f(int a, int b);", "int f(double a);", "int g(double a);", ""))
        lines = filtered(header).split("\n")
        self.assertEqual(len(lines), header.count("\n") + 1)
        self.assertEqual(lines[2], "  double x = 0; /**< V_p */ double y[2] = {0, 0}; /**< V_p */")
        self.assertEqual(lines[5], "  std::map<int, int> p; /** Both, of each. */ std::map<int, int> q{};")
        self.assertEqual(lines[6], "  int bare = 0, alone = 0;")
        self.assertEqual(lines[7:12], ["", "};", "", "", ""])
        self.assertEqual(lines[13:16], ["int f(int a, int b);", "/** Of a. */ int f(double a);", "int g(double a);"])

    def test_public_headers_include_only_public_headers(self):
        text = (SOURCE / "engine/CMakeLists.txt").read_text(encoding="utf-8")
        public = {f"engine/{name}" for name in
                  re.search(r"FILE_SET HEADERS BASE_DIRS \S+ FILES\n(.*?)\)", text, re.S)[1].split()}
        self.assertGreater(len(public), 20)
        for source in [*(SOURCE / name for name in public), *SOURCE.glob("examples/**/*.cpp")]:
            included = set(re.findall(r'#include "(engine/[^"]+)"', source.read_text(encoding="utf-8")))
            self.assertLessEqual(included, public, source)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
