"""Tests the links in the pages, and that no line breaks its paragraph. usage: links_test.py SOURCE"""

import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "docs/site"))
from pages import anchors, lines_of, links, pages  # noqa: E402

SOURCE = pathlib.Path(sys.argv[1]).resolve()


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

    def test_what_is_broken_is_found(self):
        with tempfile.TemporaryDirectory() as here:
            root = pathlib.Path(here).resolve()
            (root / "other.md").write_text("# A `b`, c\n\n## a - b\n\n## twice\n\n## twice\n", encoding="utf-8")
            page = root / "page.md"

            def wrong(text):
                page.write_text(text, encoding="utf-8")
                return len(broken(root, page))

            good = "[x](other.md) ![y](other.md) [z](other.md#a-b-c) [t](other.md#twice)\n\n[r]: other.md\n"
            self.assertEqual(wrong(good), 0)
            self.assertEqual(wrong("`[x](none.md)`\n\n    [x](none.md)\n\n```\n[x](none.md)\n```\n"), 0)
            for text in ("[x](none.md)", "![x](none.png)", "[x](other.md#none)", "[x](#none)", "[x](../out.md)",
                         "[x](other.md#a---b)", "[x](other.md#twice-1)", "text\n\n[r]: none.md"):
                self.assertEqual(wrong(text), 1, text)

    def test_no_line_breaks_its_paragraph(self):
        for page in pages(SOURCE):
            self.assertEqual(breaking(page.read_text(encoding="utf-8")), [], page)
        for text in ("The mean is\n<!-- = total -->5<!-- / --> today.", "One.\n\n- <!-- = total -->5<!-- / --> jam.\n",
                     "stiff if the ratio\n> 10 is reached", "would then be\n1. Its", "one\n+ two"):
            self.assertEqual(len(breaking(text)), 1, text)
        self.assertEqual(breaking("1. one\n   more\n2. two\n\n> a\n> b\n\n```\n<!-- c -->\nd\n> e\n```\n"), [])

    def test_indexes_are_complete(self):
        def linked(page):
            return {(page.parent / target.partition("#")[0]).resolve() for _, target in
                    links(page.read_text(encoding="utf-8"))}

        docs = set((SOURCE / "docs").glob("*.md")) - {SOURCE / "docs/index.md"}
        self.assertEqual(docs - linked(SOURCE / "docs/index.md"), set())
        examples = set((SOURCE / "examples").glob("*/README.md"))
        self.assertEqual(examples - linked(SOURCE / "examples/README.md"), set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
