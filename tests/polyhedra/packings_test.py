"""Tests about 110 malformed and unusual files of packings (corpus_packings.py). usage: packings_test.py ISOJAM"""

import pathlib
import re
import sys
import tempfile
import unittest

import corpus_packings
import study

PROGRAM = sys.argv[1]


def manifest(file, keys):
    start = {"packing": str(file), **keys.get("start", {})}
    return {"name": "start", "seed": 1, "sweep": {"solid": ["octahedron"], "particles": [corpus_packings.N]},
            "replicates": 1, **{key: value for key, value in keys.items() if key != "start"}, "start": start}


def deviation(code, messages, outcome):
    if code == 0:
        return "" if outcome.may_read else "accepted"
    if not outcome.may_refuse:
        return f"exit code {code}: {messages}"
    line = study.LINE.search(messages)
    if code != 65 or "/start" not in messages or (outcome.line and (not line or int(line[1]) != outcome.line)) or \
            outcome.word.lower() not in messages.lower() or not re.search(r"; ?\S+ \S+", messages):
        return f"exit code 65, line {outcome.line}, \"{outcome.word}\" and a remedy expected in: {code} {messages}"
    return ""


class Packings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.cases = corpus_packings.write_all(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def results_of(self, cases, *command):
        for name, file, outcome, keys in cases:
            path = study.write(self.folder, manifest(file, keys))
            code, _, messages = study.call(PROGRAM, *command, path, seconds=60)
            yield name, outcome, code, messages

    def fail_with(self, found):
        if found:
            self.fail(f"{len(found)} files\n" + "\n".join(found))

    def test_validate(self):
        seen = [(name, deviation(code, messages, outcome), code)
                for name, outcome, code, messages in self.results_of(self.cases, "validate")]
        print(f"{len(seen)} files: {sum(code == 0 for *_, code in seen)} accepted")
        self.fail_with([f"{name}: {text}" for name, text, _ in seen if text])

    def test_dry_run_agrees(self):
        some = self.cases[::10]
        pairs = zip(self.results_of(some, "validate"), self.results_of(some, "run", "--dry-run"))
        self.fail_with([one[0] for one, other in pairs if one[2] != other[2]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
