"""Rows of `Study.replicates` and `Study.states`: the numbers and texts of records, with the names of columns."""

import functools
from collections.abc import Collection, Iterator
from typing import Any

from . import facts
from .rows import Rows, column_of

_REASON = "_reason"
#: Keys of a record that are left out: they are not measured, or other functions make their columns.
_APART = {"schema", "checksum", "result_digest", "provenance", "spec", "status", "flags", "failure", "nearest", "states",
          "path"}
#: Keys of the last columns: the cost of a replicate, and its origin.
_COST = ("evaluations", "work", "pairs")
_ORIGIN = ("version", "git", "compiler", "manifest_digest", "seed")
#: Numbers that every state has. A quantity with the same name is the same number.
_FIGURES = {"step", "phi", "delta_phi", "energy_per_particle", "pressure", "deviator", "residual", "residual_floor",
            "stopped", "descents"}
#: Names of quantities, by their paths in a record and in a state.
_NAMES: dict[str, dict[tuple[str, ...], str]] = {of: facts.names(of) for of in ("replicate", "state")}
_QUANTITIES = {name for names in _NAMES.values() for name in names.values()} - _FIGURES


@functools.lru_cache(maxsize=None)
def _names_of(path: tuple[str, ...], of: str) -> list[str]:
    """Names of the columns for a path in a record or in a state.

    If the path belongs to a quantity, or to an object with quantities, these are the names of the quantities in tables.
    Otherwise the name is the path with dots, as in "clusters.largest". It has a prefix, as in "state.Q6", if it would
    be the name of another quantity."""
    known = [name for place, name in _NAMES[of].items() if place[:len(path)] == path]
    if known:
        return known
    dotted = ".".join(path)
    return [f"{of}.{dotted}" if dotted in _QUANTITIES else dotted]


def flat(document: dict[str, Any], of: str, apart: Collection[str] = ()) -> tuple[dict[str, Any], dict[str, str]]:
    """Two dicts by column name: the numbers, texts and nulls of a record or a state, and the reasons for nulls.

    Lists and the keys in `apart` are left out."""
    values: dict[str, Any] = {}
    reasons: dict[str, str] = {}

    def visit(node: dict[str, Any], path: tuple[str, ...]) -> None:
        for key, value in node.items():
            if isinstance(value, dict):
                visit(value, (*path, key))
            elif not isinstance(value, list) and not (key.endswith(_REASON) and key[:-len(_REASON)] in node):
                for name in _names_of((*path, key), of):
                    if path and name in _FIGURES and name in values:
                        continue
                    values[name] = value
                    if value is None and key + _REASON in node:
                        reasons[name] = node[key + _REASON]

    visit({key: value for key, value in document.items() if key.removesuffix(_REASON) not in apart}, ())
    return values, reasons


def _parameters(spec: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """Swept parameters with the names of their columns. `residual` has a prefix, because another column is called
    residual."""
    for name, value in spec["parameters"].items():
        group = next((group for group in ("protocol", "minimiser") if name in spec[group]), "parameters")
        yield (f"{group}.{name}" if name == "residual" else name), value


def head_of(name: str, record: dict[str, Any], excluding: Collection[str]) -> dict[str, Any]:
    """The first columns of a row. `excluding` are the flags that exclude a replicate from means."""
    spec, flags = record["spec"], tuple(record.get("flags") or ())
    head = {"replicate": name, "solid": spec["solid"], "particles": spec["particles"], **dict(_parameters(spec))}
    return {**head, "number": spec["replicate"], "status": record["status"], "flags": flags,
            "excluded": any(flag in excluding for flag in flags)}


def replicate_row(head: dict[str, Any], record: dict[str, Any]) -> dict[str, Any]:
    """The row of a replicate, with its own values and those of its nearest state."""
    failure, provenance = record.get("failure") or {}, record["provenance"]
    values, reasons = flat(record, "replicate", _APART.union(_COST, ("timing",)))
    near, near_reasons = flat(record.get("nearest") or {}, "state")
    cost, _ = flat({**{key: record[key] for key in _COST}, **record["timing"]}, "replicate")
    for key in ("flags", "nearest"):
        if record.get(key) is None:
            reasons[key] = record.get(key + _REASON, "the replicate failed")
    return {**head, "failed_in": failure.get("where", ""), "failure": failure.get("why", ""), **values,
            "state": _index_of_nearest(record), **near, **cost, **{key: provenance[key] for key in _ORIGIN},
            "reasons": {**reasons, **near_reasons}}


def _index_of_nearest(record: dict[str, Any]) -> int | None:
    """Index of the nearest state, which is found by its strain step; None for a failed replicate."""
    step = (record.get("nearest") or {}).get("step")
    return next((k for k, state in enumerate(record["states"]) if state["step"] == step), None)


def state_rows(head: dict[str, Any], record: dict[str, Any]) -> list[dict[str, Any]]:
    """One row for each state of a replicate; an empty list if the replicate failed.

    `state` is the index of the state in the decompression, and `nearest` is true for the nearest state."""
    if record["status"] == "failed":
        return []
    nearest, rows = _index_of_nearest(record), []
    for index, state in enumerate(record["states"]):
        values, reasons = flat(state, "state")
        rows.append({**head, "state": index, "nearest": index == nearest, **values, "reasons": reasons})
    return rows


def read_rows(name: str, record: dict[str, Any],
              excluding: Collection[str]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """The row of a replicate, and the rows of its states. Raises an exception that `reading` converts."""
    head = head_of(name, record, excluding)
    row, states = replicate_row(head, record), state_rows(head, record)
    for each in (row, *states):
        _check_numbers(each)
    return row, states


def _check_numbers(row: dict[str, Any]) -> None:
    """Each quantity is a number or null, and a double can represent each integer."""
    for name, value in row.items():
        if isinstance(value, int):
            float(value)
        elif name in _QUANTITIES and not (value is None or isinstance(value, float)):
            raise TypeError(f"{name} is not a number")


def as_columns(rows: list[dict[str, Any]]) -> Rows:
    """Converts rows (dicts) to Rows. A missing value is null.

    Columns have the order of the row with most columns; `reasons` is the last one."""
    fullest = sorted(rows, key=len, reverse=True)
    names = dict.fromkeys(key for row in fullest for key in row if key != "reasons")
    columns = {name: column_of([row.get(name) for row in rows]) for name in names}
    if rows:
        columns["reasons"] = column_of([row["reasons"] for row in rows])
    return Rows(columns)
