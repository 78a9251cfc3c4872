"""Tests the communication between the module and the program. Small scripts replace the program."""

import os
import pathlib
import signal
import subprocess
import sys
import time
import types
import warnings
from unittest import mock

import support
from support import CUBES, isojam

from isojam import facts, program

PROGRESS = '{{"kind": "progress", "done": {}, "total": 2, "failed": {}, "text": "{} of 2 replicates"}}'


class Case(support.Case):
    def start(self, code, **environment):
        """Starts a Python process in which isojam.run can be interrupted in the usual way."""
        code = ("import signal, sys\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
                f"sys.path.insert(0, {str(support.MODULE)!r})\n{code}")
        return [sys.executable, "-B", "-s", "-c", code], {**os.environ, **environment}


class Signals(Case):
    PROGRAM = """
import signal, sys, time
came = []
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda number, _: came.append(number))
open({ready!r}, "w").close()
while not came:
    time.sleep(0.01)
time.sleep(0.5)  # for a signal too many
open({ended!r}, "w").write(str(len(came)))
sys.exit(75)
"""

    def test_the_program_gets_one_signal_and_is_waited_for(self):
        folder = pathlib.Path(self.folder())
        ready, ended = folder / "ready", folder / "ended"
        body = self.PROGRAM.format(ready=str(ready), ended=str(ended))
        stub = self.stub(f"exec {sys.executable} -c '{body.replace(chr(39), chr(34))}'\n")
        command, environment = self.start(
            "import isojam, pathlib\n"
            "try: isojam.run('m.json', 'r')\n"
            f"except KeyboardInterrupt: print('interrupted', pathlib.Path({str(ended)!r}).read_text())", ISOJAM=str(stub))
        for whole_group in (False, True):
            ready.unlink(missing_ok=True)
            ended.unlink(missing_ok=True)
            with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True,
                                  start_new_session=True) as python:
                while not ready.exists() and python.poll() is None:
                    time.sleep(0.01)
                (os.killpg if whole_group else os.kill)(python.pid, signal.SIGINT)
                self.assertEqual(python.communicate()[0], "interrupted 1\n")

    def test_a_program_that_was_interrupted_by_others_is_an_interruption(self):
        for start in (lambda stub: isojam.run("m.json", "r", program=stub), lambda stub: isojam.measure("r", program=stub)):
            self.assertRaisesRegex(KeyboardInterrupt, "to resume", start, self.stub("exit 75\n"))

    def test_a_plain_message_is_an_error_of_a_program_that_failed_and_else_a_warning(self):
        for code in (1, 2, 65, 134):
            stub = self.stub(f"echo 'isojam: error: out of memory' >&2; exit {code}\n")
            with self.assertRaisesRegex(isojam.ProgramError, "out of memory"):
                isojam.run("m.json", CUBES, program=stub, progress=False)
        with self.assertWarnsRegex(UserWarning, "a library says"):
            isojam.run("m.json", CUBES, program=self.stub("echo a library says >&2\n"), progress=False)
        with self.assertRaisesRegex(isojam.ProgramError, "exit code 3"):
            isojam.run("m.json", CUBES, program=self.stub("exit 3\n"), progress=False)


class Progress(Case):
    def setUp(self):
        lines = [PROGRESS.format(0, 0, 0), PROGRESS.format(1, 0, 1), PROGRESS.format(2, 1, 2)]
        self.program = self.stub("".join(f"echo '{line}' >&2\n" for line in lines))

    def test_without_tqdm_progress_is_text_if_it_is_wanted(self):
        for wanted, text in ((True, b"isojam: 2 of 2 replicates\n"), (False, b"")):
            command, environment = self.start(f"sys.modules['tqdm'] = None\nimport isojam\n"
                                              f"isojam.run('m.json', {str(CUBES)!r}, progress={wanted})",
                                              ISOJAM=str(self.program))
            said = subprocess.run(command, env=environment, stderr=subprocess.PIPE, check=True).stderr
            self.assertEqual(said, text)

    def test_with_tqdm_every_round_has_a_bar(self):
        bars = []

        def tqdm(total, unit):
            self.assertEqual(unit, " replicates")
            bars.append(mock.Mock(total=total, n=0))
            bars[-1].update = lambda done, bar=bars[-1]: setattr(bar, "n", bar.n + done)
            return bars[-1]

        with mock.patch.dict(sys.modules, {"tqdm": types.ModuleType("tqdm"), "tqdm.auto": types.SimpleNamespace(tqdm=tqdm)}):
            isojam.run("m.json", CUBES, program=self.program)
            self.assertEqual([(bar.total, bar.n) for bar in bars], [(2, 2)])
            bars[0].close.assert_called_once_with()
            bars[0].set_postfix_str.assert_called_with("1 failed", refresh=False)
            again = self.stub("".join(f"echo '{PROGRESS.format(done, 0, done)}' >&2\n" for done in (0, 2, 0, 1)))
            isojam.run("m.json", CUBES, program=again)
        self.assertEqual([bar.n for bar in bars], [2, 2, 1])


class Versions(Case):
    def versions(self, text):
        file = pathlib.Path(self.folder(), "version")
        file.write_text(text)
        return self.stub("", version=file)

    def test_another_version_is_a_warning_once_that_names_both(self):
        stub = self.versions(f"isojam 99.1.2 (abc)\nschemas: {' '.join(facts.schemas.values())} isojam.more.v1\n")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for _ in range(2):
                isojam.run("m.json", CUBES, program=stub, progress=False)
        warning, = caught
        for version in ("99.1.2", isojam.__version__, str(stub)):
            self.assertIn(version, str(warning.message))

    def test_another_form_of_files_is_an_error_that_names_both_versions(self):
        for schema in facts.schemas.values():
            written = [other for other in facts.schemas.values() if other != schema]
            stub = self.versions(f"isojam 99.1.2 (abc)\nschemas: {' '.join(written)}\n")
            with self.assertRaises(isojam.ProgramError) as caught:
                isojam.run("m.json", CUBES, program=stub)
            for word in ("99.1.2", isojam.__version__, str(stub), schema):
                self.assertIn(word, str(caught.exception))

    def test_another_program_is_refused(self):
        for text in ("", "jam 1.0\n", "isojam\n"):
            self.assertRaisesRegex(isojam.ProgramError, "not the program isojam", isojam.run, "m.json", CUBES,
                                   program=self.versions(text))

    def test_the_program_of_the_build_has_the_version_of_the_module(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            program._compare_versions.cache_clear()
            program._compare_versions(program.find())
        said = subprocess.run([program.find(), "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.split()[1], isojam.__version__)


if __name__ == "__main__":
    support.main()
