"""Reads JSON files of isojam. A bad file causes an InputError, and no other exception."""

import contextlib
import json
import os
import pathlib
from collections.abc import Iterator
from typing import Any

from .errors import InputError

_BEFORE, _BLANK = b'"checksum": "', b"0" * 16
#: The checksum begins before this position: it is the second member, and names of schemas are short.
_FARTHEST = 200
_WHOLE = "a complete file written by isojam"


@contextlib.contextmanager
def reading(file: str | os.PathLike[str], expected: str = "", place: str = "") -> Iterator[None]:
    """Converts every exception that a bad file can cause to an InputError.

    file, place  the file, and the place that is read; "" for the whole file
    expected     the expected content"""
    try:
        yield
    except InputError:
        raise
    except OSError as error:
        raise InputError(file, place, f"cannot be read: {error.strerror}") from None
    except MemoryError:
        raise InputError(file, place, "out of memory", remedy="use a smaller file, or more memory") from None
    except KeyError as error:
        raise InputError(file, place, f"the key {error} is missing", expected) from error
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError) as error:
        raise InputError(file, place, f"cannot be read: {error}", expected) from error


def fnv1a(data: bytes) -> int:
    """The 64-bit FNV-1a hash of `data`."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def _check_sum(data: bytes, file: pathlib.Path) -> None:
    """The second key, "checksum", is the hash of the file with zeros in place of its sixteen digits."""
    start = data.find(_BEFORE, 0, _FARTHEST) + len(_BEFORE)
    end = start + len(_BLANK)
    if start < len(_BEFORE):
        raise InputError(file, "/checksum", "the file has no checksum", _WHOLE)
    if b"%016x" % fnv1a(data[:start] + _BLANK + data[end:]) != data[start:end]:
        raise InputError(file, "/checksum", "the file is damaged: its content does not match its checksum",
                         "an unchanged file written by isojam")


def read_document(file: pathlib.Path, schema: str = "", check: bool = True) -> dict[str, Any]:
    """The document in a file that isojam wrote.

    Raises InputError if the file cannot be read, or has another schema than `schema`. If `check` is true, also raises it
    if the checksum does not match."""
    with reading(file, _WHOLE):
        if file.exists() and not file.is_file():  # a pipe can block for ever, and a device may never end
            raise InputError(file, "", "not a regular file", _WHOLE)
        data = file.read_bytes()
        if check:
            _check_sum(data, file)
        document = json.loads(data)
        if not isinstance(document, dict):
            raise InputError(file, "", "not a JSON object", _WHOLE)
        if schema and document.get("schema") != schema:
            raise InputError(file, "/schema", f"unknown value {json.dumps(document.get('schema'))}", f'"{schema}"')
    return document
