"""Facts about the files of the program, stored when it is built: schemas, names of quantities, usual exclusions."""

import json
import pathlib
from typing import Any

_HERE = pathlib.Path(__file__).absolute().parent


def _read() -> dict[str, Any]:
    try:
        facts: dict[str, Any] = json.loads((_HERE / "facts.json").read_text())
    except FileNotFoundError:
        raise ImportError(f"{_HERE}: facts.json is missing, which the build creates; import isojam from python/ in the "
                          "build directory or from an installed module") from None
    return facts


_FACTS = _read()

#: Version of the program that this module was built with.
version: str = _FACTS["version"]
#: Names that files of this version have under "schema".
schemas: dict[str, str] = _FACTS["schemas"]
#: The schema of records of an earlier version, which are read as well.
earlier_record: str = _FACTS["earlier_record"]
#: Flags that exclude a replicate where a directory has no manifest.
usual_exclusions: tuple[str, ...] = tuple(_FACTS["exclude"])
#: Every quantity of tables, in their order: dicts of name, pointer (in a record or a state), of ("replicate" or "state"),
#: unit and group.
quantities: list[dict[str, str]] = _FACTS["quantities"]
#: Where the program lies, from here.
program = (_HERE / _FACTS["program"]).resolve()


def names(of: str) -> dict[tuple[str, ...], str]:
    """Column names by the path in a record ("of" = "replicate") or a state, as ("clusters", "S")."""
    return {tuple(q["pointer"].split("/")[1:]): q["name"] for q in quantities if q["of"] == of}
