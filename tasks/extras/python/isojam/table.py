"""Tables that the program exports, as CSV or as JSON lines."""

import contextlib
import csv
import operator
import os
from collections.abc import Callable, Iterable, Mapping
from typing import IO, Any

import numpy

from . import facts
from .errors import InputError
from .files import open_file, parse_json, reading
from .rows import Array, Rows, column_of, text_array

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
_A_TABLE = "a table written by isojam export"
_TRUTH = {"true": True, "false": False}


def read_table(file: str | os.PathLike[str] | IO[str], name: str | None = None) -> Rows:
    """Reads a table that `isojam export` wrote in the format `contacts`, `replicates` or `states`. Returns Rows.

    file  path of the file, or an open text file
    name  name of an open file in error messages

    Columns NAME_x, NAME_y and NAME_z become one column NAME of shape (rows, 3). Null is NaN in a column of numbers,
    and "" in a column of text. Raises InputError with the file and the line if the file does not contain such a
    table."""
    if not isinstance(file, (str, os.PathLike)):
        name = name or str(getattr(file, "name", "the table"))
        with reading(name, _A_TABLE):
            return _read(file, name)
    name = name or os.fspath(file)
    with reading(name, _A_TABLE), open_file(file, text=True) as opened:
        return _read(opened, name)


def _read(opened: Iterable[str], file: str) -> Rows:
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


def _csv_columns(lines: Iterable[str], file: str) -> dict[str, Array]:
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
    return {name: _parsed(name, [text or None for text in column], file) for name, column in zip(names, columns)}


def _parsed(name: str, cells: list[Any], file: str) -> Array:
    """Converts the texts of CSV or the values of JSON in a column to an array. None is null."""
    plain = _plain(name)
    if plain in _TEXT | _LISTS:
        converters = [_texts]
    elif plain in _INTEGER | _FLOAT:
        converters = [_integers if plain in _INTEGER else _floats]
    else:
        converters = [_truths, _integers, _floats, _texts, _scalars]
    for converter in converters:
        with contextlib.suppress(*_MISFITS):
            return converter(cells)
    row = next(i for i, cell in enumerate(cells) if not _fits(converters[-1], cell))
    raise InputError(file, f"row {row + 1} of {name}", f"{cells[row]!r:.60} cannot be read",
                     f"{_EXPECTED[converters[-1]]}, or null")


def _fits(converter: Callable[[list[Any]], Array], cell: object) -> bool:
    try:
        converter([cell])
    except _MISFITS:
        return False
    return True


def _truths(cells: list[Any]) -> Array:
    if not cells:
        raise ValueError("without values, the type is unknown")
    return numpy.array([cell if isinstance(cell, bool) else _TRUTH[cell] for cell in cells])


def _integers(cells: list[Any]) -> Array:
    values = [None if cell is None else int(cell) if isinstance(cell, str) else operator.index(cell) for cell in cells]
    return _floats(values) if None in values else numpy.array(values, dtype=numpy.int64)


def _floats(cells: list[Any]) -> Array:
    values = numpy.array([numpy.nan if cell is None else float(cell) for cell in cells], dtype=float)
    if numpy.count_nonzero(numpy.isfinite(values)) + cells.count(None) != len(cells):
        raise ValueError("not finite")
    return values


def _texts(cells: list[Any]) -> Array:
    if not all(cell is None or isinstance(cell, str) for cell in cells):
        raise TypeError("not a text")
    return text_array([cell or "" for cell in cells])


def _plain(name: str) -> str:
    """The name of a column without the suffix of an axis. The type of the column depends on this name."""
    return name[:-2] if name.endswith(_AXES) else name


def _scalars(cells: list[Any]) -> Array:
    """Numbers and texts in one column of JSON."""
    if not all(cell is None or isinstance(cell, str) or _fits(_floats, cell) for cell in cells):
        raise TypeError("neither a number nor a text")
    return column_of(cells)


#: Exceptions of a converter if a value has another type.
_MISFITS = (KeyError, OverflowError, TypeError, ValueError)
_EXPECTED = {_texts: "a text", _integers: "a 64-bit integer", _floats: "a finite number", _scalars: "a number or a text"}


def _json_columns(lines: Iterable[str], file: str) -> dict[str, Array]:
    rows = []
    for number, line in enumerate(lines, 1):
        if line.strip():
            with reading(file, "a JSON object on every line", f"line {number}"):
                rows.append(parse_json(line))
    names = dict.fromkeys(key for row in rows for key in row)
    return {name: _parsed(name, [row.get(name) for row in rows], file) for name in names}


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
