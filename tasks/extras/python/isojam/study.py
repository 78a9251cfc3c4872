"""Results of a study, read from a results directory."""

import difflib
import html
import pathlib
from typing import Any

import pandas  # type: ignore[import]

from . import facts, program
from .errors import InputError, ProgramError
from .files import read_document, reading
from .packing import Packing, Solid
from .program import Path
from .rows import Rows

_A_RECORD = "a record of schema " + facts.schemas["record"]
_HOW_TO_GET_RESULTS = "give a results directory of isojam run"
#: Quantities that a notebook shows, and its largest number of lines.
_SHOWN, _MOST_LINES = ("phi_j", "Z"), 30


def load(directory: Path, program: Path | None = None, check: bool = True) -> "Study":
    """Returns the results in a directory as a Study.

    directory  the results directory
    program    path of the program, which makes all tables; without it, the module searches for it
    check      compare each file with packings, and each file that `record` reads, with the checksum that it contains

    Raises InputError if the directory does not exist or contains no records."""
    return Study(directory, program, check)


class Study:
    """Results of `isojam run`. Each part is read when it is first needed.

    directory   path of the results directory (pathlib.Path)
    names       names of the replicates that were recorded when the Study was made, sorted
    manifest    the manifest as a dict; None if the directory has none
    replicates  Rows: one row for each replicate
    states      Rows: one row for each state of each replicate that did not fail"""

    def __init__(self, directory: Path, program: Path | None = None, check: bool = True) -> None:
        self.directory, self._program, self._check = pathlib.Path(directory), program, check
        if not self.directory.is_dir():
            raise InputError(directory, "", "no such directory", remedy=_HOW_TO_GET_RESULTS)
        self.names = sorted(file.stem for file in self.directory.glob("records/*.json") if file.name[0] != ".")
        if not self.names:
            raise InputError(directory, "", "contains no results", remedy=_HOW_TO_GET_RESULTS)
        manifest = self.directory / "manifest.json"
        self.manifest = read_document(manifest, check=check) if manifest.exists() else None
        self._known = set(self.names)
        self._tables: dict[tuple[Path, ...], Rows] = {}
        self._solids: dict[str, Solid] = {}

    def __repr__(self) -> str:
        return f"<{self.directory}: {len(self.names)} replicates>"

    def _repr_html_(self) -> str:
        """The table in a notebook. If the program cannot compute the table, its error."""
        try:
            table = self._table("aggregate", self.directory, "--format", "csv")
            wanted = [f"{name}_{part}" for name in _SHOWN for part in ("mean", "low", "high", "n")]
            columns = [*table.columns[:table.columns.get_loc("over")], *(name for name in wanted if name in table)]
            text = table.loc[table["over"] == "kept", columns].to_html(index=False, na_rep="", max_rows=_MOST_LINES)
        except (InputError, ProgramError) as error:
            text = html.escape(str(error))
        return f"<p>{html.escape(repr(self))}</p>{text}"

    @property
    def replicates(self) -> Rows:
        return self._table("export", self.directory, "all", "--format", "replicates")

    @property
    def states(self) -> Rows:
        return self._table("export", self.directory, "all", "--format", "states")

    def table(self, series: bool = False) -> pandas.DataFrame:
        """The table of `isojam aggregate --format csv`. With `series`, the quantities as functions of Δφ, as with the
        option --series."""
        words: list[Path] = ["aggregate", self.directory, "--format", "csv", *(["--series"] if series else [])]
        return pandas.DataFrame(self._table(*words)).copy()

    def record(self, name: str) -> dict[str, Any]:
        """The record of a replicate as a dict; `isojam fields record` explains its fields."""
        return read_document(self._file("records", name), facts.schemas["record"], self._check)

    def packing(self, name: str) -> Packing:
        """The nearest state of a replicate. Raises InputError if the replicate failed."""
        file, record, document = self._companion("packings", "packing", name)
        with reading(self._file("records", name), _A_RECORD):
            delta_phi = record["states"][record["nearest"]]["delta_phi"]
        return Packing(name, document, delta_phi, lambda: self._shapes(name, document), file)

    def path(self, name: str) -> list[Packing]:
        """All states of a replicate as a list of Packings, in the order of decompression.

        Raises InputError if the replicate failed, or if the manifest does not have "keep_path": true."""
        file, _, document = self._companion("paths", "path", name)
        with reading(file, "states of a packing"):
            return [Packing(name, state, state["delta_phi"], lambda: self._shapes(name, document["states"][0]), file,
                            f"/states/{k}") for k, state in enumerate(document["states"])]

    def contacts(self, name: str | None = None, path: bool = False) -> Rows:
        """Rows with one row for each contact of a replicate; without `name`, of all replicates.

        The contacts are those of the nearest states, or of all states if `path` is true. The program computes them. Its
        warnings, for example about failed replicates, become Python warnings."""
        if name is not None:
            self._file("records", name)
        words: list[Path] = ["export", self.directory, name or "all", "--format", "contacts"]
        return self._own(program.table(self._program, words + (["--path"] if path else [])))

    def _table(self, *words: Path) -> Rows:
        """A table of the program, which is called once for each."""
        if words not in self._tables:
            rows = program.table(self._program, words, stacklevel=4)
            self._tables[words] = self._own(rows) if "replicate" in rows else rows
        return self._tables[words]

    def _own(self, rows: Rows) -> Rows:
        """The rows without the replicates that were recorded after the Study was made."""
        return rows[rows["replicate"].isin(self._known)].reset_index(drop=True)

    def _file(self, folder: str, name: str) -> pathlib.Path:
        if name not in self._known:
            near = difflib.get_close_matches(str(name), self.names, 1)
            hint = f'did you mean "{near[0]}"?' if near else f'expected a name such as "{self.names[0]}"'
            raise InputError(self.directory, "", f'unknown replicate "{name}"', remedy=hint)
        return self.directory / folder / f"{name}.json"

    def _companion(self, folder: str, kind: str, name: str) -> tuple[pathlib.Path, dict[str, Any], dict[str, Any]]:
        """Path and content of a packing file or a path file, with the record to which it belongs.

        Raises InputError if the replicate failed, or if the file is missing, damaged or belongs to another record."""
        record, file = self.record(name), self._file(folder, name)
        with reading(self._file("records", name), _A_RECORD):
            if record["status"] == "failed":
                failure = record["failure"]
                raise InputError(self._file("records", name), "/status",
                                 f"failed in {failure['where']}: {failure['why']}; it has no packing")
            # Files of packings and paths do not change when measures are added to the record.
            provenance = record["provenance"]
            owners = [(one["spec_digest"], one["result_digest"]) for one in [
                {**record, **provenance}, *(addition["before"] for addition in provenance.get("added", []))]]
        if folder == "paths" and not file.exists():
            raise InputError(file, "", "the states of the decompression were not saved",
                             remedy='set "keep_path": true in the manifest and run it again')
        document = read_document(file, facts.schemas[kind], self._check)
        if (document.get("spec_digest"), document.get("result_digest")) not in owners:
            raise InputError(file, "/result_digest", f'"{document.get("result_digest")}" does not match the record',
                             f'"{record["result_digest"]}"')
        return file, record, document

    def _shapes(self, name: str, document: dict[str, Any]) -> dict[str, Solid]:
        """Solids by their names. The manifest defines them, so a name means the same solid in the whole directory."""
        if not {one["solid"] for one in document.get("kinds", [document])} <= self._solids.keys():
            self._solids.update(program.solids(self._program, self.directory, name))
        return self._solids
