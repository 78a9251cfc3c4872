"""Tests prose.py: it finds each kind of error in its description, and nothing in plain sentences."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import prose  # noqa: E402

LONG = "A sentence of a page " + "has one more word and " * 7 + "ends here."
BAD = (
    ("page.md", "# A page\n\nOf most modes normals support less than half.\n", "opens without a subject"),
    ("page.md", "| key | |\n|---|---|\n| `a` | What a replicate needs. |\n", "opens without a subject"),
    ("page.md", "The packing gave way twice.\n", "rearrange"),
    ("page.md", LONG + "\n", "words, at most"),
    ("page.md", "There are 1, 2, 3, 4 and 5 of them.\n", "numbers, at most"),
    ("page.md", "The mean is\n<!-- = total -->5<!-- / --> today.\n", "HTML comment"),
    ("page.md", "- <!-- = total -->5<!-- / --> packings jam.\n", "HTML comment"),
    ("page.md", "A tilt is stiff if the ratio\n> 10 is reached.\n", "list or a quotation"),
    ("page.md", "The ratio would then be\n1. Its interval is wide.\n", "list or a quotation"),
    ("source.cpp", "// Those of the last step.\nint a = 0;\n", "opens without a subject"),
    ("source.cpp", "int a = 0;  ///< what it stands for; whoever reckons it\n", "compute"),
    ("tasks/source.cpp", 'fail("the state is not certified in this file");\n', "minimum"),
    ("script.py", '"""Whether a file is there."""\n', "opens without a subject"),
    ("script.sh", "# A shortage of memory.\n", "resource failure"),
    ("one.schema.json", '{"description": "Those that failed."}\n', "opens without a subject"),
)
GOOD = (
    ("page.md", "# What it is\n\nThe density is 0.653 ± 0.003.\nWhat does it cost? One second.\n"),
    ("page.md", "```\nOf this listing nothing is checked: 1 2 3 4 5 6 7\n```\n"),
    ("page.md", "1. The first entry\n   has two lines.\n2. The second has one.\n\n> A quotation\n> has two.\n"),
    ("page.md", "| 1 | 2 | 3 | 4 | 5 | 6 |\n"),
    ("source.cpp", 'int a = 0;  ///< contacts of a particle\nconst char* b = "Of";\n'),
)


class Prose(unittest.TestCase):
    def findings(self, name, text):
        with tempfile.TemporaryDirectory() as root:
            path = pathlib.Path(root, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
            return [rule for _, rule, _ in prose.findings_of_file(path)]

    def test_each_fault_is_found(self):
        for name, text, rule in BAD:
            with self.subTest(text=text):
                self.assertTrue(any(rule in found for found in self.findings(name, text)), self.findings(name, text))

    def test_plain_texts_pass(self):
        for name, text in GOOD:
            with self.subTest(text=text):
                self.assertEqual(self.findings(name, text), [])


if __name__ == "__main__":
    unittest.main()
