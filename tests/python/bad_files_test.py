"""Tests that a bad file causes an InputError, and no other exception."""

import io
import json
import os
import pathlib
import signal
import subprocess
import tracemalloc
from unittest import mock

import numpy

import support
from support import CUBES, MIXED, isojam

from isojam import program, seals

DEEP = b'{"a":' + b"[" * 100000 + b"]" * 100000 + b"}"
REPLACEMENTS = (None, {}, [{}], "x", -1, True, 10**400)
NOTHING = object()
#: Seconds after which a read is taken to wait for ever.
PATIENCE = 300


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


def sealed(document):
    """The bytes of a file with the right checksum."""
    data = json.dumps({**document, "checksum": "0" * 16}).encode()
    return data.replace(b'"checksum": "' + b"0" * 16, b'"checksum": "%016x' % seals.fnv1a(data), 1)


def read_all(study):
    """Reads everything in a directory that does not need the program."""
    study.replicates, study.states
    for name in study.names:
        path = (study.directory / f"paths/{name}.json").exists()
        for packing in (study.packing(name), *(study.path(name) if path else [])):
            packing.rotations(), packing.positions_low, packing.orientations_low, packing.cell_low, repr(packing)


class Case(support.Case):
    def one_replicate(self, directory):
        """A copy of a results directory with one replicate that did not fail. Returns the directory and its files."""
        where, name = self.copy(directory), support.done(directory)[-1]
        for file in where.glob("*/*.json"):
            if file.stem != name:
                file.unlink()
        files = [where / "manifest.json", *(where / folder / f"{name}.json" for folder in ("records", "packings", "paths"))]
        return where, [file for file in files if file.exists()]


class Documents(Case):
    def test_text_that_is_no_document(self):
        where, files = self.one_replicate(CUBES)
        self.assertEqual(len(files), 4)
        for file in files:
            whole = file.read_bytes()
            with_number = [whole.replace(b"{", b'{"number": ' + number + b",", 1)
                           for number in (b"NaN", b"-Infinity", b"1e999", b"-1" + b"0" * 400 + b".5", b"1" * 5000)]
            for data in (b"", whole[:len(whole) // 2], whole[:-2], DEEP, b"\xff" * 300, whole.replace(b'"', b'"\xff', 1),
                         b"[]", b'"text"', b"null", b"{}{}", *with_number):
                file.write_bytes(data)
                error = self.refused(lambda: read_all(isojam.load(where, check=False)), file.name)
                self.assertEqual(error.file, str(file))
            file.write_bytes(whole)
        read_all(isojam.load(where, check=False))

    def test_members_that_are_missing_or_of_another_type(self):
        read = refused = 0
        for directory in (CUBES, MIXED):
            where, files = self.one_replicate(directory)
            for file in files if directory == MIXED else files[-1:]:
                whole = file.read_bytes()
                document = json.loads(whole)
                for path in paths_of(document, 3):
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
        self.assertGreater(min(read, refused), 300)

    def test_members_without_which_there_is_no_result(self):
        where, files = self.one_replicate(MIXED)
        cases = {"manifest": [("exclude", 5), ("exclude", [5])],
                 "records": [("spec", None), ("spec", {}), ("status", NOTHING), ("phi_j", "x"), ("phi_j", 10**400),
                             ("nearest", {}), ("nearest", None), ("states", NOTHING), ("states", 1), ("flags", 3),
                             ("provenance", {}), ("timing", None), ("work", NOTHING)],
                 "packings": [("positions", True), ("positions", []), ("side", "x"), ("phi", None), ("kind", [7] * 52),
                              ("kind", [-1] * 52), ("kinds", [{}]), ("size", [10**400] * 52)]}
        for file in files:
            whole = file.read_bytes()
            for key, value in cases[file.stem if file.stem == "manifest" else file.parent.name]:
                other = {**json.loads(whole), key: value}
                if value is NOTHING:
                    del other[key]
                file.write_bytes(sealed(other))
                with self.subTest(f"{file.name} {key} = {value!r:.40}"):
                    self.assertEqual(self.refused(lambda: read_all(isojam.load(where))).file, str(file))
            file.write_bytes(whole)
        read_all(isojam.load(where))

    def test_out_of_memory(self):
        where, files = self.one_replicate(CUBES)
        with mock.patch.object(json, "loads", side_effect=MemoryError):
            self.refused(lambda: isojam.load(where), str(files[0]), "memory")
            self.refused(lambda: isojam.read_table(io.StringIO('{"a": 1}\n'), "rows.jsonl"), "rows.jsonl", "memory")


class Tables(Case):
    def test_numbers_and_lines(self):
        digits = "9" * 400
        for text, place in (("state\n9223372036854775808", "row 1 of state"), ("phi\n0.5\n1e999", "row 2 of phi"),
                            ("phi\nnan", "row 1 of phi"), ("phi\n-inf", "row 1 of phi"), (f"phi\n{digits}", "row 1 of phi"),
                            (f"state\n{digits}0000", "row 1 of state"), ('{"phi": ' + digits + "}", "row 1 of phi"),
                            ('{"x": 1}\n{"x": ' + digits + "}", "row 2 of x"), ('{"phi": NaN}', "line 1"),
                            ('{"phi": 1}\n{"phi": 1e999}', "line 2"), ('{"state": ' + "9" * 5000 + "}", "line 1"),
                            ('{"phi": "x"}', "row 1 of phi"), ('{"phi": [1]}', "row 1 of phi"),
                            ('{"state": 1.5}', "row 1 of state"), ('{"a": 0}\n{"a": {}}', "row 2 of a"),
                            (DEEP.decode(), "line 1"), ('{"phi": 1}\n' + DEEP.decode(), "line 2"),
                            ('{"replicate": 3}', "row 1 of replicate"),
                            ("x\n" + "y" * 200000, "line 2"), ('x\n"y', "line 2"), ("a,b\n1", "line 2")):
            with self.subTest(text[:40]):
                error = self.refused(lambda: isojam.read_table(io.StringIO(text + "\n"), "rows"), "rows")
                self.assertEqual(error.place, place)

    def test_integers_beyond_64_bits_of_an_unknown_column_are_doubles(self):
        rows = isojam.read_table(io.StringIO("number\n18446744073709551616\n1\n"))
        self.assertEqual(list(rows["number"]), [2.0**64, 1])

    def test_bytes_changed_at_random(self):
        random = numpy.random.default_rng(44)
        counts = [0, 0]
        for name in ("contacts", "replicates", "states"):
            for ending in ("csv", "jsonl"):
                file = pathlib.Path(self.folder(), f"table.{ending}")
                subprocess.run([program.find(), "export", MIXED, "all", "--format", name, "-o", file], check=True,
                               capture_output=True)
                data = b"".join(file.read_bytes().splitlines(keepends=True)[:12])
                for _ in range(300):
                    changed = bytearray(data)
                    for at in random.integers(0, len(data), random.integers(1, 4)):
                        changed[at:at + random.integers(0, 3)] = random.choice(list(b'",\n0e9-[{}\xff\x00'), 1).tobytes()[:1]
                    file.write_bytes(changed)
                    try:
                        isojam.read_table(file)
                        counts[0] += 1
                    except isojam.InputError:
                        counts[1] += 1
        print("{} tables read, {} refused".format(*counts))
        self.assertGreater(min(counts), 100)

    def test_memory_of_a_column_with_one_long_text(self):
        lines = "replicate,failure\n" + "r,\n" * 2000 + "r," + "x" * 100000 + "\n"
        objects = "\n".join(['{"failure": ""}'] * 2000 + [json.dumps({"failure": "x" * 100000})]) + "\n"
        for text in (lines, objects):
            tracemalloc.start()
            self.addCleanup(tracemalloc.stop)
            column = isojam.read_table(io.StringIO(text))["failure"]
            peak = tracemalloc.get_traced_memory()[1]
            print(f"{len(text)} characters need {peak / 1e6:.3g} MB")
            self.assertLess(peak, 50 * len(text))
            self.assertEqual((column[0], len(column[2000]), int((column == "").sum())), ("", 100000, 2000))


class Irregular(Case):
    def setUp(self):
        """Ends the test if a read waits for ever."""
        def give_up(*_):
            raise AssertionError("reading does not end")
        before = signal.signal(signal.SIGALRM, give_up)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        self.addCleanup(signal.alarm, 0)
        signal.alarm(PATIENCE)

    def test_tables(self):
        folder = pathlib.Path(self.folder())
        os.mkfifo(folder / "pipe")
        for file, why in ((folder / "pipe", "pipe"), ("/dev/null", "device"), (folder, "directory"),
                          (folder / "none", "No such file"), ("a\0b", "null")):
            self.refused(lambda: isojam.read_table(file), str(file), why)
        (folder / "bytes").write_bytes(b"\xff\xfe\x00")
        self.refused(lambda: isojam.read_table(folder / "bytes"), "bytes", "UTF-8")
        with (folder / "bytes").open(encoding="utf-8") as opened:
            self.refused(lambda: isojam.read_table(opened), "bytes", "UTF-8")

    def test_files_of_a_results_directory(self):
        where, files = self.one_replicate(CUBES)
        for file in files:
            whole = file.read_bytes()
            for make, why in ((os.mkfifo, "pipe"), (os.mkdir, "directory"), (lambda f: f.symlink_to("/dev/null"), "device")):
                file.unlink()
                make(file)
                self.refused(lambda: read_all(isojam.load(where)), str(file), why)
                (file.rmdir if file.is_dir() else file.unlink)()
                file.write_bytes(whole)
        for file, read in zip(files[1:], (lambda study: study, lambda study: study.packing(study.names[0]),
                                          lambda study: study.path(study.names[0]))):
            file.rename(file.with_suffix(".away"))
            self.refused(lambda: read(isojam.load(where)))
            file.with_suffix(".away").rename(file)
        self.refused(lambda: isojam.load(files[0]), "no such directory")

    def test_manifests(self):
        folder = pathlib.Path(self.folder())
        os.mkfifo(folder / "pipe")
        for file in (folder / "pipe", "/dev/null", folder, "a\0b"):
            self.refused(lambda: isojam.run(file, folder / "r", progress=False), str(file))
        nested = {}
        for _ in range(100000):
            nested = {"a": nested}
        self.assertRaises(isojam.ManifestError, isojam.run, nested, folder / "r")
        self.assertFalse((folder / "r").exists())


if __name__ == "__main__":
    support.main()
