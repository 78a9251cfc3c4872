"""Opens and parses files. A bad file causes an InputError, and no other exception."""

import contextlib
import json
import math
import os
import stat
from collections.abc import Iterator
from typing import IO, Any

from .errors import InputError

_KINDS = {stat.S_IFDIR: "a directory", stat.S_IFIFO: "a named pipe", stat.S_IFSOCK: "a socket", stat.S_IFCHR: "a device",
          stat.S_IFBLK: "a device"}


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
    except RecursionError:
        raise InputError(file, place, "lists or objects are nested too deeply", expected) from None
    except UnicodeDecodeError as error:
        raise InputError(file, place, f"not a text file: {error.reason}", "UTF-8") from None
    except json.JSONDecodeError as error:
        raise InputError(file, place, f"not valid JSON: {error}", expected) from None
    except KeyError as error:
        raise InputError(file, place, f"the key {error} is missing", expected) from error
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(file, place, f"cannot be read: {error}", expected) from error


def open_file(file: str | os.PathLike[str], text: bool = False) -> IO[Any]:
    """Opens a regular file for reading, as bytes or as text.

    Anything else is an OSError: a pipe can block for ever, and a device may never end."""
    if text:
        return open(file, encoding="utf-8", newline="", opener=_open_regular)
    return open(file, "rb", opener=_open_regular)


def _open_regular(path: str, flags: int) -> int:
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    kind = stat.S_IFMT(os.fstat(descriptor).st_mode)
    if kind == stat.S_IFREG:
        return descriptor
    os.close(descriptor)
    raise OSError(0, f"it is {_KINDS.get(kind, 'a special file')}, not a regular file")


def parse_json(text: str | bytes) -> dict[str, Any]:
    """Parses a JSON object. Raises an exception that `reading` converts. The numbers must be finite."""
    document = json.loads(text, parse_float=_finite, parse_constant=_finite)
    if not isinstance(document, dict):
        raise ValueError("not an object")
    return document


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text:.20} is not a finite number")
    return value
