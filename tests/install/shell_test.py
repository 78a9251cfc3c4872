"""Tests the manual page and the shell completions. usage: shell_test.py CMAKE BUILD

The test of a shell that is not installed is skipped, with a message.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD = sys.argv[1:3]


def run(*words, cwd=None, text=None):
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, cwd=cwd, input=text)


class Shell(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = pathlib.Path(folder.name).resolve()
        cls.prefix = cls.here / "prefix"
        ended = run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        assert ended.returncode == 0, ended.stderr
        cls.program = cls.prefix / "bin/isojam"
        cls.commands = re.findall(r"^  (\w+) {2,}\S", run(cls.program, "--help").stdout.split("Subcommands:")[1], re.M)
        cls.work = cls.here / "work"
        (cls.work / "results").mkdir(parents=True)
        (cls.work / "manifest.json").write_text("{}")

    def options_of(self, *command):
        said = run(self.program, *command, "--help").stdout
        return set(re.findall(r"(?<![\w-])(--?[a-z][a-z-]*)", said.split("Options:")[1].split("Exit codes")[0]
                              .split("Subcommands:")[0]))

    def test_the_manual(self):
        page = self.prefix / "share/man/man1/isojam.1"
        text = page.read_text(encoding="utf-8").replace("\\-", "-")
        self.assertGreater(len(self.commands), 10)
        for command in self.commands:
            section = text.split(f"\n.SS {command}\n")[1].split("\n.S")[0]
            for option in self.options_of(command) - {"-h", "--help"}:
                self.assertIn(option, section, command)
        for option in self.options_of():
            self.assertIn(option, text.split(".SH GENERAL OPTIONS")[1])
        for code in (0, 1, 2, 65, 75):
            self.assertRegex(text.split(".SH EXIT STATUS")[1], rf"\n\.TP\n\\fB{code}\\fR\n\w")
        synopsis = text.split(".SH SYNOPSIS")[1].split(".SH")[0]
        self.assertRegex(synopsis, r"isojam aggregate\n.*DIR\\fR \.\.\.\n")
        self.assertRegex(synopsis, r"isojam status\n.*DIR\\fR\n")
        if not shutil.which("groff"):
            self.skipTest("no groff")
        shown = run("groff", "-man", "-Tutf8", "-ww", page)
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))

    def bash(self, *words):
        script = (f"source {self.prefix}/share/bash-completion/completions/isojam; COMP_WORDS=(isojam \"$@\"); "
                  "COMP_CWORD=$#; _isojam 2>/dev/null; printf '%s\\n' \"${COMPREPLY[@]}\"")
        ended = run("bash", "-c", script, "bash", *words, cwd=self.work)
        return set(ended.stdout.split())

    def fish(self, *words):
        line = " ".join(("isojam", *words))
        ended = run("fish", "--no-config", "-c",
                    f"source {self.prefix}/share/fish/vendor_completions.d/isojam.fish; complete -C '{line}'", cwd=self.work)
        self.assertEqual(ended.stderr, "")
        return {given.split("\t")[0].rstrip("/") for given in ended.stdout.splitlines()}

    def zsh(self, *words):
        """The words on the screen after two tabs: the list of zsh, and the command line."""
        line = " ".join(("isojam", *words))
        script = f"""
            zmodload zsh/zpty; zpty z 'zsh -f -i'
            zpty -w z 'PS1=; unsetopt beep list_ambiguous; setopt auto_list; LISTMAX=1000; stty cols 300 -echo'
            zpty -w z 'fpath=({self.prefix}/share/zsh/site-functions $fpath); autoload -Uz compinit; compinit -u -D'
            zpty -w z 'cd {self.work}; echo re''ady'
            zpty -r z before $'*ready\r\n*'
            zpty -w z 'list() {{ print -r -- "<$BUFFER>"; }}; zle -N list; bindkey "^X" list'
            zpty -n -w z "$1"$'\t\t\x18'
            zpty -r z shown $'*<isojam*>*'
            print -r -- $shown; zpty -d z"""
        shown = subprocess.run(["zsh", "-f", "-c", script, "zsh", line], cwd=self.work, capture_output=True, text=True,
                               check=False, timeout=60).stdout
        shown = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", shown)
        return set(re.findall(r"[\w.-]+", shown))

    def completes(self, complete):
        self.assertEqual({word for word in complete("") if not word.startswith("-")}, set(self.commands))
        self.assertEqual(complete("re"), {word for word in self.commands if word.startswith("re")})
        self.assertEqual(complete("completions", "z"), {"zsh"})
        self.assertTrue({"gsd", "vtp", "xyz", "contacts"} <= complete("export", "--format", ""))
        self.assertEqual(complete("export", "--format", "g"), {"gsd"})
        self.assertTrue({"--shard", "--dry-run"} <= complete("run", "--"))
        self.assertNotIn("--shard", complete("status", "--"))
        self.assertIn("results", complete("status", ""))
        self.assertNotIn("manifest.json", complete("status", ""))
        self.assertIn("manifest.json", complete("run", "m"))
        self.assertEqual(complete("run", "-o", "r"), {"results"})
        self.assertNotIn("manifest.json", complete("run", "-j", ""))
        self.assertIn("never", complete("--color", ""))
        self.assertIn("results", complete("aggregate", "results", ""))
        self.assertTrue({"--shard", "--dry-run"} <= complete("--quiet", "run", "--"))

    def test_bash(self):
        self.completes(self.bash)

    def test_fish(self):
        if not shutil.which("fish"):
            self.skipTest("no fish")
        self.completes(self.fish)

    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("no zsh")
        script = self.prefix / "share/zsh/site-functions/_isojam"
        self.assertTrue(script.read_text(encoding="utf-8").startswith("#compdef isojam\n"))
        ended = run("zsh", "-f", "-n", script)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        # A bracket or a colon in the wrong place is an error of _arguments.
        ended = run("zsh", "-f", "-c", f"autoload -U compinit && compinit -u -d {self.here}/dump && "
                    f"fpath=({script.parent} $fpath) && autoload -Uz _isojam && whence -v _isojam")
        self.assertEqual(ended.stderr, "")
        for line in re.findall(r"^ +'(.*)'(?: \\| ;;)$", script.read_text(encoding="utf-8"), re.M):
            self.assertRegex(line, r"^(--?[a-z-]+\[[^][]*\](:[^:]*:.*)?|[1*]?::?[\w ]+:.*)$")
        for before in ((), ("--quiet",), ("--color", "never")):
            self.assertLessEqual(set(self.commands), self.zsh(*before, ""), before)
            self.assertIn("run", self.zsh(*before, "ru"))
            self.assertIn("manifest.json", self.zsh(*before, "run", ""))
            self.assertLessEqual({"--shard", "--dry-run", "--quiet"}, self.zsh(*before, "run", "--"))
        self.assertIn("results", self.zsh("aggregate", "results", ""))
        self.assertNotIn("manifest.json", self.zsh("aggregate", "results", ""))
        self.assertLessEqual({"gsd", "vtp", "xyz", "contacts"}, self.zsh("export", "--format", ""))
        self.assertNotIn("--shard", self.zsh("status", "--"))

    def test_into_a_file(self):
        for words in (("completions", "bash"), ("manual",)):
            printed = run(self.program, *words)
            self.assertEqual(printed.returncode, 0)
            run(self.program, *words, "-o", self.here / "file")
            self.assertEqual((self.here / "file").read_text(encoding="utf-8"), printed.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
