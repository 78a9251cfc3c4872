"""Tests files that are damaged, replaced or not there yet: each is an InputError with file, place and remedy."""

import json
import pathlib
import subprocess
import time

import support
from support import CUBES, MIXED, isojam, numpy

from isojam import program

REPLACEMENTS = (None, {}, [{}], "x", -1, True, 10**400, float("nan"))
NOTHING = object()


def changed(document, path, value):
    """The document with another value at a path, or without this member. The objects that do not change are shared."""
    if not path:
        return value
    key, *rest = path
    other = document.copy()
    if rest or value is not NOTHING:
        other[key] = changed(document[key], rest, value)
    else:
        del other[key]
    return other


def paths_of(document, depth):
    """Paths of the members of a document, to this depth. A list gives only its first element."""
    if depth and isinstance(document, (dict, list)):
        for key in document if isinstance(document, dict) else range(len(document))[:1]:
            yield (key,)
            yield from ((key, *rest) for rest in paths_of(document[key], depth - 1))


def read_all(study):
    """Reads everything in a directory that does not need the program."""
    for name in study.names:
        path = (study.directory / f"paths/{name}.json").exists()
        for packing in (study.packing(name), *(study.path(name) if path else [])):
            packing.rotations(), repr(packing)


class Case(support.Case):
    def one_replicate(self, directory):
        """A copy of a results directory with one replicate that did not fail. Returns the directory and its files."""
        where, name = self.copy(directory), support.done(directory)[-1]
        for file in where.glob("*/*.json"):
            if file.stem != name:
                file.unlink()
        files = [where / "manifest.json", *(where / folder / f"{name}.json" for folder in ("records", "packings", "paths"))]
        return where, [file for file in files if file.exists()]


class Checksums(Case):
    def test_a_changed_byte_is_found_in_every_file(self):
        where, (manifest, record, *packings) = self.one_replicate(CUBES)
        read_all(isojam.load(where))
        self.assertEqual(len(packings), 2)
        for file in (manifest, record, *packings):
            whole = bytearray(file.read_bytes())
            whole[len(whole) // 2] ^= 1
            file.write_bytes(whole)
            error = self.refused(lambda: read_all(isojam.load(where)), "damaged")
            self.assertEqual((error.file, error.place), (str(file), "/checksum"))
            if file != manifest:
                study = isojam.load(where)
                read = study.contacts if file != record else lambda path: study.states
                own = self.refused(lambda: read(path=file.parent.name == "paths"), "damaged")
                self.assertEqual((own.file, own.place), (str(file), "/checksum"))
                self.assertIn("run the manifest again", own.allowed)
            whole[len(whole) // 2] ^= 1
            file.write_bytes(whole)
        read_all(isojam.load(where))


class Documents(Case):
    def test_text_that_is_no_document(self):
        where, files = self.one_replicate(CUBES)
        for file in files:
            whole = file.read_bytes()
            for data in (b"", whole[:len(whole) // 2], b'{"a":' + b"[" * 100000, b"\xff" * 300, b"[]", b"null", b"{}{}"):
                file.write_bytes(data)
                error = self.refused(lambda: read_all(isojam.load(where, check=False)), file.name)
                self.assertEqual(error.file, str(file))
            file.write_bytes(whole)

    def test_members_that_are_missing_or_of_another_type(self):
        read = refused = 0
        for directory in (CUBES, MIXED):
            where, files = self.one_replicate(directory)
            for file in files[1:]:
                whole = file.read_bytes()
                document = json.loads(whole)
                for path in paths_of(document, 1 if file.parent.name == "records" else 3):
                    for value in (NOTHING, *REPLACEMENTS):
                        file.write_text(json.dumps(changed(document, path, value)))
                        try:
                            read_all(isojam.load(where, check=False))
                            read += 1
                        except isojam.InputError as error:
                            self.assertTrue(error.why, error)
                            refused += 1
                        except Exception as error:
                            raise AssertionError(f"{file.name}: {path} = {value!r:.40}") from error
                file.write_bytes(whole)
        print(f"{read} files read, {refused} refused")
        self.assertGreater(min(read, refused), 100)


class Unfinished(Case):
    def test_a_study_that_is_interrupted_resumed_and_grows_while_it_is_read(self):
        where = pathlib.Path(self.folder(), "results")
        manifest = {"name": "growing", "seed": 3, "sweep": {"solid": ["dodecahedron"], "particles": [24]}, "replicates": 400,
                    "protocol": {"initial_density": 0.3, "compression_step": 0.07, "target_energy": 3e-7,
                                 "longest_step": 0.03, "step_fraction": 0.4, "final_distance": 0.03, "fit_window": 0.1},
                    "minimiser": {"residual": 1e-3}, "measure": ["contacts"]}
        file = where.with_suffix(".manifest")
        file.write_text(json.dumps(manifest))
        with subprocess.Popen([program.find(), "--quiet", "run", file, "-o", where, "-j", "2"],
                              stdout=subprocess.DEVNULL) as run:
            try:
                seen = []
                while len(seen) < 3 and run.poll() is None:
                    if len(list(where.glob("records/*.json"))) <= (seen[-1] if seen else 0):
                        time.sleep(0.02)
                        continue
                    study = isojam.load(where)
                    numbers = {*study.replicates["number"]}
                    self.assertEqual(list(study.replicates["replicate"]), study.names)
                    self.assertEqual(len(study.packing(study.names[-1])), 24)
                    self.assertEqual({*study.states["replicate"]}, {*study.names})
                    self.assertEqual({*study.contacts()["replicate"]}, {*study.names})
                    seen.append(len(numbers))
            finally:
                run.terminate()
        print(f"{seen} replicates seen while the study ran")
        self.assertEqual((run.returncode, len(seen)), (75, 3))
        interrupted = isojam.load(where)
        self.assertEqual(len(interrupted.replicates), len(interrupted.names))
        table = interrupted.table()
        self.assertEqual(list(table[table["over"] == "kept"]["replicates"]), [len(interrupted.names)])

    def test_records_of_later_runs_are_left_out_until_the_study_is_loaded_again(self):
        where, names = self.copy(CUBES), support.done(CUBES)
        later = where / f"records/{names[0]}.json"
        later.rename(where / "later")
        study = isojam.load(where)
        (where / "later").rename(later)
        for rows in (study.replicates, study.states, study.contacts()):
            self.assertEqual({*rows["replicate"]}, {*names[1:]})
            self.assertEqual(list(rows.index), [*range(len(rows))])


class WithoutJamming(Case):
    def test_cohesion_until_the_end(self):
        """At zero pressure there is no φ_J; the density is φ_0."""
        where = pathlib.Path(self.folder(), "results")
        study = isojam.run({
            "name": "cohesive", "seed": 1, "sweep": {"solid": ["dodecahedron"], "particles": [32]}, "replicates": 1,
            "protocol": {"initial_density": 0.3, "compression_step": 0.07, "target_energy": 3e-7, "final_distance": 0.03,
                         "fit_window": 0.1, "cohesion": {"strength": 1e-4, "range": 0.1, "until": "end"},
                         "max_density": 0.82},
            "minimiser": {"residual": 1e-3}, "measure": ["contacts"], "keep_path": True}, where, progress=False)
        name, = study.names
        row = study.replicates.iloc[0]
        self.assertEqual((row["status"], row["phi_0"]), ("done", study.record(name)["phi_0"]))
        self.assertTrue(numpy.isnan(row["phi_j"]) and numpy.isnan(study.packing(name).delta_phi))
        self.assertEqual(len(study.path(name)), len(study.states))
        self.assertGreater(len(study.contacts()), 32)
        self.assertIn("cohesive", isojam.load(where).manifest["name"])


if __name__ == "__main__":
    support.main()
