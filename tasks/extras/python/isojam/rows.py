"""Tables in memory: named columns of equal length."""

import difflib
from collections.abc import Iterator, Mapping
from typing import Any, overload

import numpy
from numpy.typing import ArrayLike, NDArray

#: An array of numbers, text, truth values or objects.
Array = NDArray[Any]
#: Texts up to this length are always in an array of fixed width.
_SHORT = 64


class Rows:
    """Named numpy arrays of equal length. rows["phi_j"] or rows.phi_j is a column; rows[rows["Z"] > 8] are some of the rows.

    The values of a column are numbers (null is NaN), texts (null is ""), truth values, or objects: tuples of flags, or
    dicts of reasons. A vector is one column of shape (rows, 3). A column is the array itself, not a copy."""

    def __init__(self, columns: Mapping[str, ArrayLike]) -> None:
        self._columns = {name: numpy.asarray(values) for name, values in columns.items()}
        lengths = {name: len(values) for name, values in self._columns.items()}
        if len(set(lengths.values())) > 1:
            raise ValueError(f"the columns have different lengths: {lengths}")

    @property
    def columns(self) -> list[str]:
        """Names of the columns, in order."""
        return list(self._columns)

    def __len__(self) -> int:
        """Number of rows."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    @overload
    def __getitem__(self, which: str) -> Array: ...

    @overload
    def __getitem__(self, which: int) -> dict[str, Any]: ...

    @overload
    def __getitem__(self, which: slice | list[int] | Array) -> "Rows": ...

    def __getitem__(self, which: str | int | slice | list[int] | Array) -> Any:
        """A column by its name, one row as a dict by its index, or Rows by a mask, a slice or a list of indices."""
        if isinstance(which, str):
            return self._column(which)
        if isinstance(which, (int, numpy.integer)):
            return {name: values[which] for name, values in self._columns.items()}
        chosen: Any = which if isinstance(which, slice) else numpy.asarray(which)
        if not isinstance(chosen, slice) and chosen.size == 0:
            chosen = chosen.astype(int)
        return Rows({name: values[chosen] for name, values in self._columns.items()})

    def __getattr__(self, name: str) -> Array:
        """rows.phi_j is rows["phi_j"], unless Rows has a member of this name."""
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self._column(name)
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Iterates over the rows; each is a dict."""
        return (self[i] for i in range(len(self)))

    @property
    def kept(self) -> "Rows":
        """The rows of replicates that the program uses for means: those that neither failed nor are excluded."""
        kept: Array = (self["status"] == "done") & ~self["excluded"]
        return self[kept]

    def by(self, name: str) -> list[tuple[Any, "Rows"]]:
        """Pairs of a value of this column and the Rows with this value, sorted by value. Null is left out."""
        places: dict[Any, list[int]] = {}
        for i, value in enumerate(self._column(name).tolist()):
            places.setdefault(value, []).append(i)
        return [(value, self[places[value]]) for value in sorted(value for value in places if value == value)]

    def frame(self) -> Any:
        """The rows as a pandas DataFrame. A vector becomes three columns: "force_x", "force_y", "force_z"."""
        import pandas  # type: ignore[import]

        flat = {}
        for name, values in self._columns.items():
            if values.ndim == 1:
                flat[name] = values
            else:
                flat.update({f"{name}_{axis}": values[:, c] for c, axis in enumerate("xyz")})
        return pandas.DataFrame(flat)

    def groupby(self, names: str | list[str]) -> Any:
        """The groups of the pandas DataFrame by one or several columns."""
        return self.frame().groupby(names)

    def __repr__(self) -> str:
        first = ", ".join(self.columns[:12]) + (", …" if len(self._columns) > 12 else "")
        return f"<{len(self)} rows of {len(self._columns)} columns: {first}>"

    def _column(self, name: str) -> Array:
        try:
            return self._columns[name]
        except KeyError:
            near = difflib.get_close_matches(name, self._columns, 1)
            hint = f'did you mean "{near[0]}"?' if near else f"expected one of {', '.join(self._columns)}"
            raise KeyError(f'unknown column "{name}"; {hint}') from None


def column_of(values: list[Any]) -> Array:
    """Converts a list of values to an array; None stands for null.

    The array contains truth values, integers, floats (null is NaN) or texts (null is ""). If the values have other or
    different types, it contains objects."""
    kinds = {type(value) for value in values if value is not None}
    missing = any(value is None for value in values)
    if kinds == {bool} and not missing:
        return numpy.array(values, dtype=bool)
    if kinds == {int} and not missing and max(abs(value) for value in values) < 2**63:
        return numpy.array(values, dtype=numpy.int64)
    if kinds <= {int, float, bool}:
        return numpy.array([numpy.nan if value is None else value for value in values], dtype=float)
    if kinds == {str}:
        return text_array(["" if value is None else value for value in values])
    return _object_array(values)


def text_array(texts: list[str]) -> Array:
    """An array of texts.

    numpy gives each text the length of the longest one. If the longest is much longer than the mean, the array contains
    objects, so that it needs about as much memory as the texts."""
    longest, total = max(map(len, texts), default=0), sum(map(len, texts))
    if longest * len(texts) > _SHORT * len(texts) + 4 * total:
        return _object_array(texts)
    return numpy.array(texts, dtype=str)


def _object_array(values: list[Any]) -> Array:
    array = numpy.empty(len(values), dtype=object)
    for i, value in enumerate(values):
        array[i] = value
    return array
