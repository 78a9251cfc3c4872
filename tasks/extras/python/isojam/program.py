"""Finds the program, runs it and reads its messages."""

import contextlib
import dataclasses
import functools
import json
import os
import shutil
import signal
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Iterable, Iterator
from typing import IO

import numpy

from . import facts
from .errors import InputError, ProgramError
from .files import reading
from .packing import Solid
from .progress import Message
from .rows import Rows, read_csv

#: Type of paths in arguments.
Path = str | os.PathLike[str]


def find(program: Path | None = None) -> str:
    """Returns the path of the program. Raises ProgramError if there is none.

    It is the first that is given or found: the argument `program`, the environment variable ISOJAM, the program that
    was built or installed with this module, the program on the PATH."""
    for asked, by in ((program, "the argument `program`"),
                      (os.environ.get("ISOJAM"), "the environment variable ISOJAM")):
        if asked:
            found = shutil.which(os.fspath(asked))
            if found is None:
                raise ProgramError([], f"{asked}: cannot be run; set {by} to the path of the program")
            return found
    found = shutil.which(os.fspath(facts.program)) or shutil.which("isojam")
    if found is None:
        raise ProgramError([], "the program isojam was not found; give its path in the argument `program` or in the "
                               "environment variable ISOJAM")
    return found


@functools.lru_cache(maxsize=None)
def _compare_versions(program: str) -> None:
    """Warns if the program and this module have different versions.

    Raises ProgramError if the program does not write the schemas that the module reads."""
    ended = subprocess.run([program, "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                           errors="replace", check=False)
    words = ended.stdout.split()
    if ended.returncode != 0 or len(words) < 2 or words[0] != "isojam":
        raise ProgramError([program, "--version"], ended.stderr.strip() or "this is not the program isojam")
    both = f"the program {program} has version {words[1]}, the Python module isojam has {facts.version}"
    other = [schema for schema in facts.schemas.values() if schema not in words]
    if other:
        raise ProgramError([], f"{both}: the program does not write {', '.join(other)}, which the module reads; install "
                               "both from one build, or give another program in the environment variable ISOJAM")
    if words[1] != facts.version:
        warnings.warn(f"{both}; install both from one build", stacklevel=2)


@dataclasses.dataclass
class Ended:
    """Result of a call of the program.

    errors    messages of kind "error"
    warnings  texts of warnings"""

    command: list[str]
    code: int = 0
    errors: list[Message] = dataclasses.field(default_factory=list)
    warnings: list[str] = dataclasses.field(default_factory=list)

    def error(self) -> InputError | ProgramError:
        """The errors as an exception: InputError if all are about files, with the place of the first one."""
        text = "\n".join(error["text"] for error in self.errors)
        if not self.errors or not all("file" in error for error in self.errors):
            return ProgramError(self.command, text or f"ended with exit code {self.code}")
        first = InputError.reported(self.errors[0])
        first.args = (text,)
        return first

    def warn(self, stacklevel: int) -> None:
        for text in self.warnings:
            warnings.warn(text, stacklevel=stacklevel + 1)


def call(program: Path | None, words: Iterable[Path], stdin: int | IO[str] = subprocess.DEVNULL,
         stdout: int | IO[bytes] = subprocess.DEVNULL, show: Callable[[Message], None] = lambda message: None) -> Ended:
    """Runs the program and waits until it ends. `show` is called with each message about the progress.

    If Python is interrupted, the program is requested to stop. When it has stopped, the exception is raised again."""
    found = find(program)
    _compare_versions(found)
    ended = Ended([found, "--messages", "json", *(os.fspath(word) for word in words)])
    plain = []
    # The program runs in its own session and does not get the Ctrl-C of a terminal. Otherwise the signal of _stop would be
    # its second one, which ends the program before it has saved its last step.
    with subprocess.Popen(ended.command, stdin=stdin, stdout=stdout, stderr=subprocess.PIPE, text=True, encoding="utf-8",
                          errors="replace", start_new_session=True) as process:
        try:
            for line in process.stderr or ():
                message = _message(line)
                if message["kind"] == "progress":
                    show(message)
                elif message["kind"] == "error":
                    ended.errors.append(message)
                elif message["kind"] == "warning":
                    ended.warnings.append(message["text"])
                elif message["kind"] == "plain" and message["text"]:
                    plain.append(message)
            ended.code = process.wait()
        except BaseException:
            _stop(process)
            raise
    if ended.code != 0:
        ended.errors += plain
    else:
        ended.warnings += [message["text"] for message in plain]
    return ended


def _message(line: str) -> Message:
    """Parses one line that the program wrote to stderr.

    A line that is not a message in JSON has the kind "plain". Libraries, and the program when it is out of memory,
    write such lines."""
    with contextlib.suppress(ValueError):
        message = json.loads(line)
        if isinstance(message, dict) and "kind" in message and "text" in message:
            return message
    return {"kind": "plain", "text": line.strip()}


def _stop(process: "subprocess.Popen[str]") -> None:
    """Requests the program to stop, and waits until it has ended. If Python is interrupted again, kills the program.

    The files of the program are complete in both cases. The signal is SIGTERM, because SIGINT may be ignored, for
    example in the background of a shell."""
    if process.poll() is None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGTERM)
    try:
        for _ in process.stderr or ():  # read on, because the program cannot stop while the pipe is full
            pass
        process.wait()
    except BaseException:
        process.kill()
        raise


def solids(program: Path | None, directory: Path, replicate: str) -> dict[str, Solid]:
    """The solids of a replicate, by their names."""
    with printed(program, ["export", directory, replicate, "--format", "solids"]) as output:
        return {name: Solid(name, numpy.array(solid["vertices"]), solid["faces"])
                for name, solid in json.load(output).items()}


def table(program: Path | None, words: Iterable[Path], stacklevel: int = 3) -> Rows:
    """The table that the program prints.

    Warnings refer to the line that called the function of the module. `stacklevel` counts the frames up to this line."""
    with printed(program, words, stacklevel + 2) as output:
        return read_csv(output)


@contextlib.contextmanager
def printed(program: Path | None, words: Iterable[Path], stacklevel: int = 5) -> Iterator[IO[bytes]]:
    """Calls the program and gives its standard output."""
    words = [os.fspath(word) for word in words]
    with tempfile.TemporaryFile() as output:
        ended = call(program, words, stdout=output)
        ended.warn(stacklevel)
        if ended.code != 0:
            raise ended.error()
        output.seek(0)
        with reading(f"isojam {' '.join(words)}", "the output of isojam"):
            yield output
