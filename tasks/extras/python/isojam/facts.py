"""Facts about the program and its files, which the build writes to facts.json."""

import json
import pathlib
from typing import Any

_HERE = pathlib.Path(__file__).absolute().parent

try:
    _FACTS: dict[str, Any] = json.loads((_HERE / "facts.json").read_text())
except FileNotFoundError:
    raise ImportError(f"{_HERE}: facts.json is missing, which the build creates; import isojam from python/ in the build "
                      "directory or from an installed module") from None

#: Version of the program that this module was built with.
version: str = _FACTS["version"]
#: Values of the key "schema" in files that this version writes.
schemas: dict[str, str] = _FACTS["schemas"]
#: Names of the columns of tables that have texts.
texts: list[str] = _FACTS["texts"]
#: All quantities in the order of tables. Each is a dict with the keys name, pointer (in a record or a state), of
#: ("replicate" or "state"), unit and group.
quantities: list[dict[str, str]] = _FACTS["quantities"]
#: Path of the program that was built or installed with this module.
program = (_HERE / _FACTS["program"]).resolve()
