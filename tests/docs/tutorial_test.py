"""Tests the tutorial. usage: tutorial_test.py SOURCE PROGRAM MODULE

A block that begins with ```console has commands after "$ ", and the lines that they print. In these lines, "…" stands
for any text, and also for omitted lines. Any number of blanks counts as one blank, and all durations and sizes count as
equal. "^C" interrupts the command when it has written a checkpoint. A block that begins with ```json or ```python is
the content of a file. Its name is the last one in the sentence before the block.
"""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE, PROGRAM, MODULE = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
BLOCK = re.compile(r"^```(console|json|python)\n(.*?)^```$", re.M | re.S)
MEASURED = re.compile(r"\b\d[\d.]* (min \d+ s|s|min|MB|GiB)\b")


def blocks(page):
    """Triples of the kind of a block, its text, and the last file name in the sentence before it."""
    for match in BLOCK.finditer(page):
        named = re.findall(r"`([\w-]+\.(?:json|py))`", page[:match.start()].rstrip().rpartition("\n\n")[2])
        yield match[1], match[2], named[-1] if named else None


def commands(text):
    """Triples of a command, the lines that it prints, and whether it is interrupted."""
    found = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append([line[2:], [], False])
        elif line == "^C":
            found[-1][2] = True
        elif line.strip():
            found[-1][1].append(line)
    return found


def pattern(line):
    parts = [re.escape(part) for part in re.sub(r"\s+", " ", MEASURED.sub("@", line)).strip().split("…")]
    return ".*".join(parts)


def missing(shown, printed):
    """The first line of a page that is missing in the output; None if the output has all lines in this order."""
    rest = [re.sub(r"\s+", " ", MEASURED.sub("@", line)).strip() for line in printed.splitlines()]
    for line in shown:
        at = next((at for at, other in enumerate(rest) if re.fullmatch(pattern(line), other)), None)
        if at is None:
            return line
        rest = rest[at + (line.strip() != "…"):]
    return None


def interrupted(process, here):
    while process.poll() is None and not list(here.glob("results/*/checkpoints/*.json")):
        time.sleep(0.01)
    if process.poll() is None:
        process.send_signal(signal.SIGINT)


def run(command, here, interrupt=False):
    """Runs a command, and returns its output and exit code."""
    command = command.replace("/usr/bin/python3", sys.executable)
    # The shell hands over to the command, so that a signal reaches it.
    with subprocess.Popen(["bash", "-c", f"exec {command}" if interrupt else command], cwd=here, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        if interrupt:
            interrupted(process, here)
        printed = process.communicate()[0]
    return printed, process.returncode


def follow(page, here):
    """Carries out the steps of the page. Returns a list of differences, one text for each command."""
    wrong = []
    for kind, text, file in blocks(page):
        if kind != "console":
            if file is None:
                return [f"no sentence names the file of: {text[:60]}"]
            (here / file).write_text(text, encoding="utf-8")
            continue
        for command, shown, interrupt in commands(text):
            if command.startswith("make "):
                continue
            printed, code = run(command, here, interrupt)
            line = missing(shown, printed)
            refused = any("error:" in line for line in shown)
            # A fast machine can finish before it is interrupted.
            if code not in ((0, 75) if interrupt else (65,) if refused else (0,)):
                wrong.append(f"{command}: exit code {code}: {printed}")
            elif line is not None and not (interrupt and code == 0):
                wrong.append(f"{command}: does not print: {line}\nbut: {printed}")
    return wrong


class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        (self.here / "build").mkdir()
        (self.here / "build/isojam").symlink_to(PROGRAM)
        (self.here / "build/python").symlink_to(MODULE)

    def test_the_page_is_followed(self):
        page = (SOURCE / "docs/tutorial.md").read_text(encoding="utf-8")
        lines = [command for kind, text, _ in blocks(page) if kind == "console" for command, _, _ in commands(text)]
        for word in ("validate", "--dry-run", "status", "aggregate", "report", "--format contacts", "measure", "--base"):
            self.assertTrue(any(word in line for line in lines), word)
        self.assertEqual(page.count("```"), 2 * len(list(blocks(page))), "a block is none of console, json and python")
        self.assertEqual(follow(page, self.here), [])


if __name__ == "__main__":
    os.environ.pop("ISOJAM", None)
    unittest.main(argv=sys.argv[:1])
