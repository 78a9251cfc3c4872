"""Tables that the program exports, as CSV or as JSON lines."""

import csv
import json
import os
import pathlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import IO, Any

import numpy

from . import facts
from .errors import InputError
from .rows import Array, Rows, column_of

#: Types of columns. Values do not always show the type: 0 may be 0.0, and an empty cell is null for every type.
_TEXT = {"replicate", "solid", "class", "kind", "solid_a", "solid_b", "status", "stopped", "failed_in", "failure"}
_LISTS = {"flags", "reasons"}
_INTEGER = {"state", "a", "b", "image"}
_FLOAT = {"delta_phi", "phi", "volume", "area", "force", "attack", "normal", "torque_a", "torque_b", "theta_ef",
          "theta_ff", "depth", "energy_per_particle", "pressure", "residual"}
_FLOAT |= {quantity["name"] for quantity in facts.quantities}
_AXES = ("_x", "_y", "_z")
#: Separator of several values in one cell.
_BETWEEN = "; "
_TRUTH = {"true": True, "false": False}


def read_table(file: str | os.PathLike[str] | IO[str], name: str | None = None) -> Rows:
    """Reads a table that `isojam export` wrote in the format `contacts`, `replicates` or `states`. Returns Rows.

    file  path of the file, or an open text file
    name  name of an open file in error messages

    Columns NAME_x, NAME_y and NAME_z become one column NAME of shape (rows, 3). Null is NaN in a column of numbers,
    and "" in a column of text. Raises InputError with the file and the line if the file does not contain such a
    table."""
    if not isinstance(file, (str, os.PathLike)):
        return _read(file, name or str(getattr(file, "name", "the table")))
    try:
        with pathlib.Path(file).open(newline="", encoding="utf-8") as opened:
            return _read(opened, name or file)
    except OSError as error:
        raise InputError(file, "", f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise InputError(file, "", f"not a text file: {error.reason}", "UTF-8") from None


def _read(opened: Iterable[str], file: str | os.PathLike[str]) -> Rows:
    lines = iter(opened)
    first = next(lines, "")
    if not first.strip():
        raise InputError(file, "line 1", "there is no table", "names of columns, or a JSON object on every line")
    chained = (line for part in ([first], lines) for line in part)
    columns = _json_columns(chained, file) if first.startswith("{") else _csv_columns(chained, file)
    for name in _LISTS.intersection(columns):
        take = (lambda text: tuple(filter(None, text.split(_BETWEEN)))) if name == "flags" else _reasons(set(columns))
        columns[name] = column_of([take(str(text or "")) for text in columns[name]])
    return Rows(_with_vectors(columns))


def _reasons(names: set[str]) -> Callable[[str], Any]:
    """Returns a function that splits a text such as "Z_ff: no cut-off; S: …" into a dict by names of columns.

    A reason may contain the separator."""
    def take(text: str) -> dict[str, str]:
        found: dict[str, str] = {}
        name = None
        for part in text.split(_BETWEEN):
            head, colon, rest = part.partition(": ")
            if colon and head in names:
                name, found[head] = head, rest
            elif name is not None:
                found[name] += _BETWEEN + part
        return found

    return take


def _csv_columns(lines: Iterable[str], file: str | os.PathLike[str]) -> dict[str, Array]:
    reader = csv.reader(lines, strict=True)
    try:
        names = next(reader)
        rows = []
        for row in reader:
            if len(row) != len(names):
                raise InputError(file, f"line {reader.line_num}", f"has {len(row)} fields",
                                 f"{len(names)} as in line 1")
            rows.append(row)
    except csv.Error as error:
        raise InputError(file, f"line {reader.line_num}", f"not valid CSV: {error}") from None
    if len(set(names)) < len(names):
        raise InputError(file, "line 1", "contains a column twice", "different names")
    columns = zip(*rows) if rows else [()] * len(names)
    return {name: _parsed(name, column, file) for name, column in zip(names, columns)}


def _parsed(name: str, texts: Sequence[str], file: str | os.PathLike[str]) -> Array:
    """Converts the texts of a column to an array."""
    plain = _plain(name)
    if plain in _TEXT | _LISTS:
        return numpy.array(texts, dtype=str)
    if texts and _TRUTH.keys() >= set(texts):
        return numpy.array([_TRUTH[text] for text in texts])
    kinds: list[type] = [int] if plain in _INTEGER and "" not in texts else [float] if plain in _FLOAT else [int, float]
    for kind in kinds:
        try:
            return numpy.array([kind(text) if text else numpy.nan for text in texts], dtype=kind)
        except ValueError:
            continue
    if plain in _INTEGER | _FLOAT:
        place = next(i for i, text in enumerate(texts) if text and not _is(kinds[-1], text))
        raise InputError(file, f"row {place + 1} of {name}", f'"{texts[place]}" is not a number',
                         "a number, or nothing for null")
    return numpy.array(texts, dtype=str)


def _plain(name: str) -> str:
    """The name of a column without the suffix of an axis. The type of the column depends on this name."""
    return name[:-2] if name.endswith(_AXES) else name


def _is(kind: Callable[[str], object], text: str) -> bool:
    try:
        kind(text)
    except ValueError:
        return False
    return True


def _json_columns(lines: Iterable[str], file: str | os.PathLike[str]) -> dict[str, Array]:
    rows = []
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            row = json.loads(line)
        except ValueError as error:
            raise InputError(file, f"line {number}", f"not valid JSON: {error}",
                             "a JSON object on every line") from None
        if not isinstance(row, dict):
            raise InputError(file, f"line {number}", "not an object", "a JSON object on every line")
        rows.append(row)
    names = dict.fromkeys(key for row in rows for key in row)
    return {name: _gathered(name, [row.get(name) for row in rows]) for name in names}


def _gathered(name: str, values: list[Any]) -> Array:
    """Converts the JSON values of a column to an array."""
    if name in _TEXT | _LISTS and all(value is None for value in values):
        return numpy.array([""] * len(values))
    if _plain(name) in _FLOAT and all(value is None or isinstance(value, (int, float)) for value in values):
        return column_of([None if value is None else float(value) for value in values])
    return column_of(values)


def _with_vectors(columns: Mapping[str, Array]) -> dict[str, Array]:
    """Joins columns whose names end in _x, _y and _z to one column each."""
    merged = {}
    for name, values in columns.items():
        stem = name[:-2]
        triple = [stem + axis for axis in _AXES]
        if not (name.endswith(_AXES) and all(part in columns for part in triple)):
            merged[name] = values
        elif stem not in merged:
            merged[stem] = numpy.stack([columns[part] for part in triple], axis=1)
    return merged
