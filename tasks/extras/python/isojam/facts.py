"""Facts about the files of the program: schemas, quantities, and flags that exclude replicates by default.

The build writes them to facts.json."""

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
#: Values of the key "schema" in files that this version writes.
schemas: dict[str, str] = _FACTS["schemas"]
#: Flags that exclude a replicate if a directory has no manifest.
usual_exclusions: tuple[str, ...] = tuple(_FACTS["exclude"])
#: All quantities in the order of tables. Each is a dict with the keys name, pointer (in a record or a state), of
#: ("replicate" or "state"), unit and group.
quantities: list[dict[str, str]] = _FACTS["quantities"]
#: Path of the program that was built or installed with this module.
program = (_HERE / _FACTS["program"]).resolve()


def names(of: str) -> dict[tuple[str, ...], str]:
    """Names of columns, by the path of a quantity in a record (`of` is "replicate") or in a state (`of` is "state").

    A path is a tuple of keys, such as ("clusters", "S")."""
    return {tuple(q["pointer"].split("/")[1:]): q["name"] for q in quantities if q["of"] == of}
