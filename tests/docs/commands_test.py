"""Tests the commands of isojam in the pages. usage: commands_test.py SOURCE PROGRAM"""

import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "docs/site"))
from pages import code_lines, pages, spans  # noqa: E402

SOURCE, PROGRAM = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
LINE = re.compile(r"(?:^|[\s(])(?:build/)?isojam ((?:-{1,2}[a-z-]+ )*[a-z]+\b.*)$")
# Placeholders of values in usage lines.
STANDS_FOR = {"MANIFEST": "manifest.json", "DIR": "results", "DIR...": "results", "N": "1", "I/N": "1/2",
              "K/200": "1/200", "GIB": "1", "FLAG,...": "crystalline", "PARAMETER=VALUE,...": "step_fraction=0.35",
              "MEASURE,...": "clusters", "MEASURES": "order", "YYYY-MM-DD": "2026-01-31",
              "L": "CC-BY-4.0", "NAME": "record",
              "examples/NAME/manifest.json": "examples/01-four-solids/manifest.json"}


def run(words, cwd):
    return subprocess.run([str(PROGRAM), *words], cwd=cwd, capture_output=True, text=True, check=False)


def help_of(*command):
    return subprocess.run([str(PROGRAM), *command, "--help"], capture_output=True, text=True, check=True).stdout


def options_in(text):
    return set(re.findall(r"(?<![\w-])(--?[a-z][a-z-]*)", text.split("Options:")[1].split("Subcommands:")[0]
                          .split("Exit codes:")[0]))


COMMANDS = {name: options_in(help_of(name)) for name in
            re.findall(r"^  (\w+) {2,}\S", help_of().split("Subcommands:")[1], re.M)}


def shown(text):
    """Command lines of a page that are complete, with their line numbers."""
    found = []
    for number, line in code_lines(text):
        match = LINE.search(re.split(r"\s#|\s>|\)$", line)[0])
        if match:
            found.append((number, match[1].strip()))
    for number, span in spans(text):
        match = re.match(r"(?:build/)?isojam ([a-z]+\b.*)$", span)
        if match:
            found.append((number, match[1]))
    return found


class Refused(Exception):
    pass


def words_of(line, replicate):
    """The arguments of a command line. Placeholders are replaced by values, and a list of choices by the first
    choice."""
    try:
        words = shlex.split(line.replace("[", "").replace("]", ""))
    except ValueError as error:
        raise Refused(str(error)) from error
    filled = []
    for word in words:
        option = word.startswith("-")
        word = word if option else word.split("|")[0]
        if word in ("REPLICATE", "replicate") or re.fullmatch(r"[\w.]+-N\d+-r\d{4}", word):
            word = replicate
        elif re.fullmatch(r"results/[\w.-]+", word):
            word = "results"
        elif word == "FILE" or re.fullmatch(r"[\w-]+\.(csv|jsonl|gsd)", word):
            word = "out." + (word.rpartition(".")[2] if "." in word else "file")
        filled.append(STANDS_FOR.get(word, word))
    return filled


def check(line, here, replicate):
    """Runs a command line. Raises Refused if the program does not accept it."""
    words = words_of(line, replicate)
    command = next((word for word in words if not word.startswith("-")), "")
    if command not in COMMANDS:
        raise Refused(f"no command {command}")
    for word in words[words.index(command):]:
        if re.match(r"--?[a-z]", word) and word.split("=")[0] not in COMMANDS[command]:
            raise Refused(f"{command} has no option {word}")
    for choice in re.findall(r"\S+\|\S+", line):
        for word in choice.strip("[]").split("|"):
            if word.islower() and word != "none" and not re.search(rf"\b{word}\b", help_of(command)):
                raise Refused(f"{command} knows no {word}")
    # "isojam chart" as a name, not a line: nothing follows that could be run.
    if command == "chart" or words == [command] and command not in ("manual",):
        return
    if command == "export" and "…" in words:
        return
    words += ["--dry-run"] if command == "run" and "--dry-run" not in words else []
    if command == "export" and words[words.index("--format") + 1] in ("gsd", "vtp", "xyz") and "all" in words:
        shutil.rmtree(here / words[words.index("-o") + 1], ignore_errors=True)
    ended = run(words, here)
    if ended.returncode != 0:
        raise Refused(f"exit {ended.returncode}: {ended.stderr.strip()}")


class CommandLines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = pathlib.Path(folder.name)
        shutil.copy(SOURCE / "tests/docs/manifest.json", cls.here)
        (cls.here / "examples").symlink_to(SOURCE / "examples")
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        (cls.here / "two-solids.json").write_text(re.search(r"```json\n(.*?)```", readme, re.S)[1], encoding="utf-8")
        ended = run(["run", "manifest.json", "-o", "results"], cls.here)
        assert ended.returncode == 0, ended.stderr
        cls.replicate = sorted(path.stem for path in (cls.here / "results/records").iterdir())[0]

    def refusal(self, line):
        try:
            check(line, self.here, self.replicate)
        except Refused as why:
            return str(why)
        return None

    def test_all_are_taken(self):
        lines = {}
        for page in (page for page in pages(SOURCE) if page.name != "tutorial.md"):
            for number, line in shown(page.read_text(encoding="utf-8")):
                lines.setdefault(line, f"{page.relative_to(SOURCE)}:{number}")
        self.assertGreater(len(lines), 40)
        self.assertEqual(set(COMMANDS) - {words_of(line, "")[0] for line in lines}, set())
        refused = {place: f"isojam {line}: {why}" for line, place in lines.items() if (why := self.refusal(line))}
        self.assertEqual(refused, {})

    def test_the_page_is_complete(self):
        page = (SOURCE / "docs/commands.md").read_text(encoding="utf-8")
        lines = [line for _, line in shown(page)]
        for command, options in COMMANDS.items():
            said = " ".join(line for line in lines if line.split()[0] == command)
            self.assertTrue(said, command)
            for option in options - {"-h", "--help", "--output", "--threads"}:
                self.assertRegex(said, rf"(?<![\w-]){option}(?![\w-])", command)
        for option in options_in(help_of()) - {"-h", "--help", "--version", "--verbose"}:
            self.assertIn(option, page)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
