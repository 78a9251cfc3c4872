"""Results of a study, read from a results directory."""

import difflib
import pathlib
import warnings
from typing import Any

from . import facts, program
from .errors import InputError, ProgramError
from .files import reading
from .notebook import html_of
from .packing import Packing
from .program import Path
from .record import as_columns, read_rows
from .rows import Rows
from .seals import check_owner, read_sealed
from .solid import Solid


_A_RECORD = "a record of schema " + facts.schemas["record"]
_A_PACKING = "a packing written by isojam"
_HOW_TO_GET_RESULTS = "give a results directory of isojam run"


def load(directory: Path, program: Path | None = None, check: bool = True) -> "Study":
    """Returns the results in a directory as a Study.

    directory  the results directory
    program    path of the program, which computes contacts, solids and the table; without it, the module searches for it
    check      compare each file with the checksum that it contains

    Raises InputError if the directory does not exist or contains no records."""
    return Study(directory, program, check)


class Study:
    """Results of `isojam run`. Each file is read when its content is first needed.

    directory   path of the results directory (pathlib.Path)
    names       names of the recorded replicates, sorted
    manifest    the manifest as a dict; None if the directory has none
    replicates  Rows: one row for each replicate
    states      Rows: one row for each state of each replicate that did not fail
    excluding   flags that exclude a replicate from means, as in the manifest"""

    def __init__(self, directory: Path, program: Path | None = None, check: bool = True, table: Rows | None = None) -> None:
        self.directory, self._program, self._check = pathlib.Path(directory), program, check
        if not self.directory.is_dir():
            raise InputError(directory, "", "no such directory", remedy=_HOW_TO_GET_RESULTS)
        self.names = sorted(file.stem for file in self.directory.glob("records/*.json") if file.name[0] != ".")
        if not self.names:
            raise InputError(directory, "", "contains no results", remedy=_HOW_TO_GET_RESULTS)
        manifest = self.directory / "manifest.json"
        self.manifest = read_sealed(manifest, check=check) if manifest.exists() else None
        exclude = (self.manifest or {}).get("exclude", list(facts.usual_exclusions))
        if not (isinstance(exclude, list) and all(isinstance(flag, str) for flag in exclude)):
            raise InputError(manifest, "/exclude", "is not a list of flags", "names of flags, such as crystalline")
        self.excluding = tuple(exclude)
        self._rows: tuple[Rows, Rows] | None = None
        self._solids: dict[str, Solid] = {}
        self._tables = {} if table is None else {False: table}

    def __repr__(self) -> str:
        return f"<{self.directory}: {len(self.names)} replicates>"

    def _repr_html_(self) -> str:
        """The table in a notebook. If the program cannot compute the table, its error."""
        try:
            return html_of(repr(self), self._table())
        except (InputError, ProgramError) as error:
            return html_of(f"{self!r}: {error}")

    @property
    def replicates(self) -> Rows:
        return self._read()[0]

    @property
    def states(self) -> Rows:
        return self._read()[1]

    def table(self, series: bool = False) -> Any:
        """The table of `isojam aggregate --format csv` as a pandas DataFrame. With `series`, the quantities as functions
        of Δφ, as with the option --series.

        The first call runs the program, whose warnings become Python warnings."""
        return self._table(series).frame()

    def _table(self, series: bool = False) -> Rows:
        if series not in self._tables:
            words: list[Path] = ["aggregate", self.directory, "--format", "csv"]
            self._tables[series] = program.table(self._program, words + (["--series"] if series else []), stacklevel=4)
        return self._tables[series]

    def record(self, name: str) -> dict[str, Any]:
        """The record of a replicate as a dict, see schemas/record.schema.json."""
        file = self._file("records", name)
        record = read_sealed(file, facts.schemas["record"], self._check)
        with reading(file, _A_RECORD):
            spec = record["spec"]
            if not (name.startswith(f"{spec['solid']}-N{spec['particles']}-")
                    and name.endswith(f"-r{spec['replicate']:04}")):
                raise InputError(file, "/spec", "the file name does not match the replicate")
            if record["status"] != "failed" and not isinstance(record["nearest"]["delta_phi"], float):
                raise InputError(file, "/nearest/delta_phi", "is not a number", "the distance to jamming")
        return record

    def packing(self, name: str) -> Packing:
        """The nearest state of a replicate. Raises InputError if the replicate failed."""
        file, record, document = self._companion("packings", "packing", name)
        with reading(file, _A_PACKING):
            return Packing(name, document, file, "", lambda: self._shapes(name, record), record["nearest"]["delta_phi"])

    def path(self, name: str) -> list[Packing]:
        """All states of a replicate as a list of Packings, in the order of decompression.

        Raises InputError if the replicate failed, or if the manifest does not have "keep_path": true."""
        file, record, document = self._companion("paths", "path", name)
        with reading(file, _A_PACKING):
            return [Packing(name, state, file, f"/states/{k}", lambda: self._shapes(name, record))
                    for k, state in enumerate(document["states"])]

    def contacts(self, name: str | None = None, path: bool = False) -> Rows:
        """Rows with one row for each contact of a replicate; without `name`, of all replicates.

        The contacts are those of the nearest states, or of all states if `path` is true. The program computes them. Its
        warnings, for example about failed replicates, become Python warnings."""
        if name is not None:
            self._whole(name)
        words: list[Path] = ["export", self.directory, "all" if name is None else name, "--format", "contacts"]
        return program.table(self._program, words + (["--path"] if path else []))

    def _file(self, folder: str, name: str) -> pathlib.Path:
        if name not in self.names:
            near = difflib.get_close_matches(str(name), self.names, 1)
            hint = f'did you mean "{near[0]}"?' if near else f'expected a name such as "{self.names[0]}"'
            raise InputError(self.directory, "", f'unknown replicate "{name}"', remedy=hint)
        return self.directory / folder / f"{name}.json"

    def _whole(self, name: str) -> dict[str, Any]:
        """The record of a replicate. Raises InputError if the replicate failed."""
        record = self.record(name)
        file = self._file("records", name)
        with reading(file, _A_RECORD):
            if record["status"] == "failed":
                failure = record["failure"]
                raise InputError(file, "/status", f"failed in {failure['where']}: {failure['why']}; it has no packing")
        return record

    def _companion(self, folder: str, kind: str, name: str) -> tuple[pathlib.Path, dict[str, Any], dict[str, Any]]:
        """Path and content of a packing file or a path file, with the record to which it belongs.

        Raises InputError if the replicate failed, or if the file is missing, damaged or belongs to another record."""
        record, file = self._whole(name), self._file(folder, name)
        if folder == "paths" and not file.exists():
            raise InputError(file, "", "the states of the decompression were not saved",
                             remedy='set "keep_path": true in the manifest and run it again')
        document = read_sealed(file, facts.schemas[kind], self._check)
        with reading(self._file("records", name), _A_RECORD):
            check_owner(document, file, name, record)
        return file, record, document

    def _shapes(self, name: str, record: dict[str, Any]) -> dict[str, Solid]:
        """Solids by their names. The manifest defines them, so a name means the same solid in the whole directory."""
        spec = record["spec"]
        wanted = {kind["solid"] for kind in spec.get("mixture", [spec])}
        if not wanted <= self._solids.keys():
            self._solids.update(program.solids(self._program, self.directory, name))
        return self._solids

    def _read(self) -> tuple[Rows, Rows]:
        if self._rows is None:
            replicates: list[dict[str, Any]] = []
            states: list[dict[str, Any]] = []
            digests: set[str] = set()
            earlier: set[str] = set()
            for name in self.names:
                record = self.record(name)
                with reading(self._file("records", name), _A_RECORD):
                    row, own = read_rows(name, record, self.excluding)
                    replicates.append(row)
                    states.extend(own)
                    digests.add(row["manifest_digest"])
                    added = record["provenance"].get("added", [])
                    earlier.update(each["before"]["manifest_digest"] for each in added)
            # Some records may have additional measures, and others may not have them yet.
            digests -= earlier
            if len(digests) > 1:
                warnings.warn(f"{self.directory}: contains records of {len(digests)} manifests; distinguish them by "
                              "the column manifest_digest", stacklevel=3)
            self._rows = as_columns(replicates), as_columns(states)
        return self._rows
