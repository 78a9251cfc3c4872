"""A results directory."""

import difflib
import pathlib
import warnings

from . import facts, program
from .errors import InputError
from .packing import Packing
from .record import as_columns, read_rows
from .seals import check_owner, read_sealed


def load(directory, program=None, check=True):
    """The results in a directory, as a Study. `program` is the path of isojam, which is asked for contacts and solids; by
    default it is looked for. With `check` every file that is read must have the checksum that it states.

    Raises InputError if there is no such directory or it holds no records."""
    return Study(directory, program, check)


class Study:
    """Results of `isojam run`; files are read when what they hold is first asked for.

    directory   a pathlib.Path
    names       of the replicates recorded, in order
    manifest    a dict, or None
    replicates  Rows, one of each replicate
    states      Rows, one of each state of each replicate"""

    def __init__(self, directory, program=None, check=True):
        self.directory, self._program, self._check = pathlib.Path(directory), program, check
        if not self.directory.is_dir():
            raise InputError(directory, "", "there is no such directory", "a directory that isojam run has made")
        self.names = sorted(file.stem for file in self.directory.glob("records/*.json") if file.name[0] != ".")
        if not self.names:
            raise InputError(directory, "", "holds no records", "a directory that isojam run has made")
        manifest = self.directory / "manifest.json"
        self.manifest = read_sealed(manifest, check=check) if manifest.exists() else None
        self._rows, self._solids = None, {}

    def __repr__(self):
        return f"<{self.directory}: {len(self.names)} replicates>"

    @property
    def excluding(self):
        """Flags whose replicates count in no mean, as the manifest says."""
        return tuple((self.manifest or {}).get("exclude", facts.usual_exclusions))

    @property
    def replicates(self):
        return self._read()[0]

    @property
    def states(self):
        return self._read()[1]

    def record(self, name):
        """The whole record of a replicate, a dict as schemas/replicate.schema.json has it."""
        file = self._file("records", name)
        record = read_sealed(file, facts.schemas["record"], self._check)
        spec = record.get("spec", {})
        if not (name.startswith(f"{spec.get('solid')}-N{spec.get('particles')}-")
                and name.endswith(f"-r{spec.get('replicate', -1):04}")):
            raise InputError(file, "/spec", "is not the replicate that the name of the file says", "")
        return record

    def packing(self, name):
        """The state of a replicate nearest jamming. Raises InputError for a replicate that failed."""
        file, record, document = self._companion("packings", "packing", name)
        return Packing(name, document, file, "", record["nearest"]["delta_phi"], lambda: self._shapes(name, record))

    def path(self, name):
        """All states of a replicate, in order of expansion: a list of Packings. Raises InputError for one that failed, and
        where expansions were not kept ("keep_path" in the manifest)."""
        file, record, document = self._companion("paths", "path", name)
        return [Packing(name, state, file, f"/states/{k}", state["delta_phi"], lambda: self._shapes(name, record))
                for k, state in enumerate(document["states"])]

    def contacts(self, name=None, path=False):
        """Rows, one of each contact: of the states nearest jamming of one or all replicates, or with `path` of all states.
        Asked of the program; what it warns of, such as replicates that failed, becomes a warning."""
        if name is not None:
            self._whole(name)
        return program.contacts(self._program, self.directory, "all" if name is None else name, path)

    def _file(self, folder, name):
        if name not in self.names:
            near = difflib.get_close_matches(str(name), self.names, 1)
            hint = f', such as "{near[0]}"' if near else ""
            raise InputError(self.directory, "", f'holds no replicate "{name}"', "one of its `names`" + hint)
        return self.directory / folder / f"{name}.json"

    def _whole(self, name):
        """The record of a replicate that did not fail."""
        record = self.record(name)
        if record["status"] == "failed":
            failure = record["failure"]
            raise InputError(self._file("records", name), "/status",
                             f"failed in {failure['where']}: {failure['why']}; it has no packing", "a replicate that is done")
        return record

    def _companion(self, folder, kind, name):
        """File, record and document of a packing or path, which is known to be its own."""
        record, file = self._whole(name), self._file(folder, name)
        if folder == "paths" and not file.exists():
            raise InputError(file, "", "is not there", 'expansions, which are kept if the manifest says "keep_path": true')
        document = read_sealed(file, facts.schemas[kind], self._check)
        check_owner(document, file, name, record)
        return file, record, document

    def _shapes(self, name, record):
        """Solids by name. Those of a name are the same in the whole directory: its manifest defines them."""
        spec = record["spec"]
        wanted = {kind["solid"] for kind in spec.get("mixture", [spec])}
        if not wanted <= self._solids.keys():
            self._solids.update(program.solids(self._program, self.directory, name))
        return self._solids

    def _read(self):
        if self._rows is None:
            replicates, states, digests, earlier = [], [], set(), set()
            for name in self.names:
                record = self.record(name)
                row, own = read_rows(name, record, self._file("records", name), self.excluding)
                replicates.append(row)
                states.extend(own)
                digests.add(row["manifest_digest"])
                added = record["provenance"].get("added", [])
                earlier.update(each["before"]["manifest_digest"] for each in added)
            # Records to which measures were added stand beside those that lack them.
            digests -= earlier
            if len(digests) > 1:
                warnings.warn(f"{self.directory} holds records of {len(digests)} manifests; the column manifest_digest "
                              "tells them apart", stacklevel=3)
            self._rows = as_columns(replicates), as_columns(states)
        return self._rows
