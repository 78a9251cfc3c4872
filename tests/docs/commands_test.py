"""Tests the commands of isojam in the pages. usage: commands_test.py SOURCE PROGRAM"""

import json
import os
import pathlib
import pty
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

    def test_what_is_wrong_is_found(self):
        self.assertIn("no option", self.refusal("run MANIFEST --dry"))
        self.assertIn("knows no pdf", self.refusal("export DIR REPLICATE --format gsd|pdf -o FILE"))
        self.assertIn("no command", self.refusal("jam MANIFEST"))
        self.assertIn("exit 2", self.refusal("run examples/none/manifest.json"))
        self.assertIn("exit 2", self.refusal("export DIR REPLICATE --format pdf"))
        self.assertIn("exit 2", self.refusal("validate MANIFEST MANIFEST"))
        self.assertIsNone(self.refusal("run examples/01-four-solids/manifest.json"))
        self.assertEqual([line for _, line in shown("    build/isojam status DIR   # so\n\nBy `isojam run X -o Y`.\n")],
                         ["status DIR", "run X -o Y"])


class StoppingRule(unittest.TestCase):
    """A study with a stopping rule, run again in a terminal with more replicates."""

    def in_terminal(self, *arguments):
        """Output and messages of the command in a terminal of 80 columns."""
        master, slave = pty.openpty()
        subprocess.run(["stty", "cols", "80", "rows", "40"], stdin=slave, check=True)
        with subprocess.Popen([PROGRAM, *arguments], stdin=slave, stdout=slave, stderr=slave) as process:
            os.close(slave)
            out = b""
            try:
                while part := os.read(master, 65536):
                    out += part
            except OSError:  # the end of the output, in Linux
                pass
        os.close(master)
        self.assertEqual(process.returncode, 0)
        return out.decode().replace("\r\n", "\n")

    def test_states_its_goal_and_continues(self):
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)

            def command(most):
                rule = {"min": 2, "max": most, "quantity": "phi_j", "half_width": 1e-4}
                (here / "m.json").write_text(json.dumps({
                    "name": "mine", "seed": 11, "replicates": rule, "measure": ["contacts"],
                    "sweep": {"solid": ["dodecahedron"], "particles": [28]},
                    "protocol": {"initial_density": 0.5, "final_distance": 0.04}}), encoding="utf-8")
                return "run", str(here / "m.json"), "-o", str(here / "r")

            def records():
                return {path.name: path.read_bytes() for path in (here / "r/records").iterdir()}

            done = run(command(3), here)
            self.assertEqual(done.returncode, 0, done.stderr)
            goal = next(part for part in done.stdout.split("\n\n") if part.startswith("goal"))
            self.assertIn("1.0e-04", goal.replace("0.0001", "1.0e-04"))
            before = records()
            shown = self.in_terminal(*command(6))
            self.assertIn("confidence interval still too wide: running 2 more replicates", shown)
            bars = re.findall(r"\[([#.]*)\] (\d+) of (\d+) replicates?", shown)
            self.assertGreater(len(bars), 1, shown)
            self.assertTrue(all(len(bar) == 24 and int(finished) <= int(wanted) for bar, finished, wanted in bars), bars)
            self.assertEqual((len(before), len(records())), (3, 6))
            self.assertLessEqual(before.items(), records().items())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
