"""Exceptions of the module. Each states what is wrong, where, and how to correct it."""

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any


class InputError(ValueError):
    """An error in a file or in an argument.

    file     path of the file
    place    JSON pointer of the error; "" for the whole file
    why      the problem
    allowed  the allowed values, or an instruction; "" if `why` is sufficient"""

    def __init__(self, file: str | os.PathLike[str], place: str, why: str, allowed: str = "", remedy: str = "") -> None:
        """`allowed` gives the allowed values, `remedy` an instruction. Give only one of the two."""
        self.file, self.place, self.why, self.allowed = str(file), place, why, allowed or remedy
        text = f"{self.file}: {place}: {why}" if place else f"{self.file}: {why}"
        super().__init__(text + (f"; expected {allowed}" if allowed else f"; {remedy}" if remedy else ""))

    @classmethod
    def reported(cls, message: Mapping[str, Any]) -> "InputError":
        """The error in a message of the program."""
        near = message["suggestion"]
        error = cls(message["file"], message["pointer"], message["problem"],
                    remedy=f'did you mean "{near}"?' if near else message["allowed"])
        error.args = (message["text"],)
        return error


class ManifestError(InputError):
    """A manifest has errors.

    errors   all errors of the manifest: InputErrors whose place is a JSON pointer

    file, place, why and allowed are those of the first error."""

    def __init__(self, errors: Sequence[InputError]) -> None:
        self.errors = tuple(errors)
        first = self.errors[0]
        super().__init__(first.file, first.place, first.why, first.allowed)
        self.args = ("\n".join(map(str, self.errors)),)


class ProgramError(RuntimeError):
    """The program isojam was not found, or it ended with an error.

    command  the command line as a list of arguments
    message  the error that the program reported"""

    def __init__(self, command: Iterable[object], message: str) -> None:
        self.command, self.message = [str(word) for word in command], message
        super().__init__(f"{' '.join(self.command)}: {message}" if self.command else message)
