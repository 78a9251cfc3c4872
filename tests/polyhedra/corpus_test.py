"""Tests about 300 malformed and unusual files of solids (corpus.py, corpus_more.py). usage: corpus_test.py ISOJAM"""

import os
import pathlib
import re
import sys
import tempfile
import unittest

import corpus_more
import study

PROGRAM = sys.argv[1]
CASES = {case.name: case for case in corpus_more.cases()}


def definition(folder, case):
    """The entry of the manifest for a case, whose file is written."""
    if case.suffix is None:
        return {"vertices": case.content, **case.keys}
    content = case.content if isinstance(case.content, bytes) else case.content.encode()
    pathlib.Path(folder, f"{case.name}.{case.suffix}").write_bytes(content)
    return {"file": f"{case.name}.{case.suffix}", **case.keys}


def refusals(messages):
    """For each solid the text of its error, from its JSON pointer on."""
    found = {}
    for part in re.split(r"^isojam: error: \S+: (?=/)", messages, flags=re.M):
        at = re.match(r"/solids/(\w+)", part)
        if at:
            found.setdefault(at[1], part.strip())
    return found


class Corpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """One manifest for each kind of file, since at most 100 errors are reported: all its cases, then those that
        were not refused."""
        cls.refused, cls.printed, cls.late = {}, {}, []
        for kind in sorted({name.split("_")[0] for name in CASES}):
            with tempfile.TemporaryDirectory() as folder:
                left = {name: definition(folder, case) for name, case in CASES.items() if name.startswith(kind + "_")}
                cls.validate(kind, folder, left)
        print(f"{len(CASES)} files: {len(cls.printed)} read, {len(cls.refused)} refused")

    @classmethod
    def validate(cls, kind, folder, left):
        for attempt in range(9):
            code, output, messages = study.call(
                PROGRAM, "validate", study.write(folder, study.manifest(kind, left, 100000)), seconds=60)
            if code == 0:
                cls.printed.update(study.printed_solids(output))
                return
            found = {name: text for name, text in refusals(messages).items() if name in left}
            if code != 65 or not found:
                raise AssertionError(f"exit code {code}: {messages[-2000:]}")
            cls.refused.update(found)
            cls.late += [name for name in found if attempt > 0]
            left = {name: value for name, value in left.items() if name not in found}

    def check(self, deviation):
        """`deviation` gives for a name and its outcome an empty text, or a text that is reported."""
        found = [f"{name}: {text}" for name, case in CASES.items() if (text := deviation(name, case.outcome))]
        if found:
            self.fail(f"{len(found)} cases\n" + "\n".join(found))

    def test_one_manifest_reports_all_refusals(self):
        self.assertEqual(self.late, [])

    def test_files_that_mean_a_solid_are_read(self):
        self.check(lambda name, outcome: not outcome.may_refuse and self.refused.get(name))

    def test_files_that_mean_no_solid_are_refused(self):
        self.check(lambda name, outcome: not outcome.may_read and name not in self.refused and
                   str(self.printed.get(name, "read")))

    def test_what_is_read_is_the_solid(self):
        def deviation(name, outcome):
            if name in self.refused or not outcome.may_read:
                return ""
            solid = self.printed.get(name)
            if not solid:
                return "no line"
            close = abs(solid["volume"] / outcome.volume - 1) < (1e-2 if "three_digits" in name else 1e-5)
            right = (solid["faces"], solid["edges"], solid["vertices"]) == outcome.number
            return "" if close and right else str(solid)
        self.check(deviation)

    def test_refusals_name_line_and_remedy(self):
        def deviation(name, outcome):
            text = self.refused.get(name)
            if not text or not outcome.may_refuse:
                return ""
            line = study.LINE.search(text)
            right = outcome.line is None or line and int(line[1]) == outcome.line
            has_remedy = re.search(r"; ?\S+ \S+", text)
            return "" if right and has_remedy and outcome.word.lower() in text.lower() else \
                f"line {outcome.line}, \"{outcome.word}\" expected in: {text}"
        self.check(deviation)

    def test_other_than_files(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkfifo(pathlib.Path(folder, "pipe"))
            os.symlink("loop", pathlib.Path(folder, "loop"))
            names = {"pipe": "pipe", "device": "/dev/zero", "folder": ".", "loop": "loop", "missing": "missing.off",
                     "below_file": "m.json/x.off"}
            document = study.manifest("m", {name: {"file": file} for name, file in names.items()}, 300)
            code, _, messages = study.call(PROGRAM, "validate", study.write(folder, document), seconds=60)
        self.assertEqual(code, 65, messages)
        self.assertEqual(set(refusals(messages)), set(names))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
