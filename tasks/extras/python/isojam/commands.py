"""Functions that call commands of the program. Each returns the results directory as a Study."""

import json
import os
import pathlib
import tempfile
import warnings
from collections.abc import Mapping
from typing import Any

from . import program as _program
from .errors import InputError, ManifestError
from .program import Ended, Path
from .progress import shown
from .study import Study

_SOME_FAILED, _BAD_INPUT, _INTERRUPTED = 1, 65, 75
#: Name of standard input in messages of the program.
_STANDARD_INPUT = "-"


def run(manifest: Mapping[str, Any] | Path, directory: Path, threads: int = 2, progress: bool = True, *,
        program: Path | None = None) -> Study:
    """Runs all replicates of a manifest that have no record yet. Returns a Study.

    manifest   a dict, in which paths are relative to the current directory, or the path of a manifest file
    directory  the results directory, which is created if it does not exist
    threads    number of threads
    progress   show the progress: as a bar if tqdm is installed, otherwise as text on stderr
    program    path of the program; without it, the module searches for the program

    Warns if replicates failed. Raises ManifestError if the manifest has errors, InputError if a file has errors, and
    ProgramError if the program reports another error. After a KeyboardInterrupt, repeat the call to resume."""
    words: list[Path] = ["-o", directory, "-j", str(threads)]
    file = _STANDARD_INPUT if isinstance(manifest, Mapping) else os.fspath(manifest)
    if "\0" in file or os.path.exists(file) and not os.path.isfile(file):  # a pipe can block for ever
        raise InputError(file, "", "not a regular file", "a manifest")
    with shown(progress) as show, tempfile.TemporaryFile("w+", encoding="utf-8") as stdin:
        if isinstance(manifest, Mapping):
            stdin.write(_text(manifest))
            stdin.seek(0)
        ended = _program.call(program, ["run", file, *words], stdin=stdin, show=show)
    for message in ended.errors:
        message.update({key: _renamed(message[key]) for key in ("text", "file") if key in message})
    ended.warnings = [_renamed(text) for text in ended.warnings]
    _refuse_manifest(ended, _renamed(file))
    return _study(ended, directory, program)


def measure(directory: Path, *measures: str, threads: int = 2, progress: bool = True,
            program: Path | None = None) -> Study:
    """Adds measures to the records of a study. Returns a Study.

    If the manifest does not have "keep_path": true, only the state nearest jamming is measured.

    directory  the results directory
    measures   names of measures; without them, the function completes an interrupted call

    The other arguments, the warnings and the errors are those of `run`."""
    words: list[Path] = ["measure", directory, "-j", str(threads), *(["--add", ",".join(measures)] if measures else [])]
    with shown(progress) as show:
        ended = _program.call(program, words, show=show)
    return _study(ended, directory, program)


def aggregate(directory: Path, *, program: Path | None = None) -> Study:
    """Writes the tables of a results directory to its file tables.json. Returns a Study.

    `run` also writes the tables, except for a shard: after the last shard has ended, call this function."""
    ended = _program.call(program, ["aggregate", directory, "-o", pathlib.Path(directory, "tables.json")])
    return _study(ended, directory, program)


def _text(manifest: Mapping[str, Any]) -> str:
    try:
        return json.dumps(manifest, default=_plain, allow_nan=False)
    except (RecursionError, TypeError, ValueError) as error:
        raise ManifestError([InputError("manifest", "", f"cannot be written as JSON: {error}",
                                        "dicts, lists, text, finite numbers, arrays, True, False and None")]) from None


def _plain(value: object) -> Any:
    """Converts a path to text, and an array or number of numpy to lists and numbers that JSON can contain."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return dict(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} has type {type(value).__name__}")


def _refuse_manifest(ended: Ended, file: str) -> None:
    """Raises ManifestError if the program ended with errors and all of them are errors of the manifest.

    An error of JSON syntax has "file:line:column" in place of the file name."""
    own = [error for error in ended.errors if f"{error.get('file')}:".startswith(f"{file}:")]
    if ended.code == _BAD_INPUT and own and own == ended.errors:
        raise ManifestError([InputError.reported(error) for error in own]) from None


def _renamed(text: str) -> str:
    """Replaces the name of standard input at the beginning of a message by "manifest"."""
    name, colon, rest = text.partition(":")
    return f"manifest{colon}{rest}" if name == _STANDARD_INPUT else text


def _study(ended: Ended, directory: Path, program: Path | None) -> Study:
    """The Study after a call of the program. Warnings refer to the line that called the function of the module."""
    ended.warn(stacklevel=3)
    if ended.code == _INTERRUPTED:
        raise KeyboardInterrupt(f"{directory}: the program was interrupted; repeat the call to resume")
    if ended.code == _SOME_FAILED and not ended.errors:
        warnings.warn(f'{directory}: some replicates failed; see the column "failure" of `replicates`', stacklevel=3)
    elif ended.code != 0:
        raise ended.error()
    return Study(directory, program)
