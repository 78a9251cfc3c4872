"""Tests isojam.run, isojam.measure and isojam.aggregate."""

import json
import os
import pathlib
import subprocess
import tempfile
import types
import warnings
from unittest import mock

import numpy

import support
from support import isojam

from isojam import program

MANIFEST = {
    "name": "octahedra", "seed": 3,
    "sweep": {"solid": ["octahedron"], "particles": [48]},
    "replicates": 2,
    "protocol": {"initial_density": 0.3, "compression_step": 0.07, "target_energy": 3e-7, "longest_step": 0.03,
                 "step_fraction": 0.4, "final_distance": 0.03, "fit_window": 0.1},
    "minimiser": {"residual": 1e-3, "max_evaluations": 2000},
    "measure": ["contacts"],
    "keep_path": True,
}


def contents(directory):
    """The part of each file that must be equal in two runs: everything except times in records and dates of manifests."""
    found = {}
    for file in sorted(pathlib.Path(directory).rglob("*.json")):
        if file.parent.name == "manifests":
            continue
        document = json.loads(file.read_text())
        document.pop("checksum", None)
        if file.parent.name == "records":
            document.pop("timing")
        found[str(file.relative_to(directory))] = document
    return found


class Case(support.Case):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.here)

    def run_quietly(self, *arguments, **options):
        """Calls isojam.run and turns every warning into an error."""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return isojam.run(*arguments, progress=False, **options)


class Runs(Case):
    def test_a_run_from_python_gives_the_bytes_of_the_program(self):
        pathlib.Path("m.json").write_text(json.dumps(MANIFEST))
        subprocess.run([program.find(), "--quiet", "run", "m.json", "-o", "program"], check=True, capture_output=True)
        expected = contents("program")
        self.assertEqual(len([name for name in expected if name.startswith("records/")]), 2)
        in_memory = self.run_quietly(MANIFEST, "memory", threads=1)
        in_file = self.run_quietly(pathlib.Path("m.json"), pathlib.Path("file"))
        for study in (in_memory, in_file):
            self.assertIsInstance(study, isojam.Study)
            self.assertEqual(contents(study.directory), expected)
            self.assertEqual(list(study.replicates["status"]), ["done", "done"])
        # Recorded replicates are not run again.
        records = {file: file.stat().st_mtime_ns for file in pathlib.Path("memory/records").iterdir()}
        self.run_quietly(MANIFEST, "memory")
        self.assertEqual({file: file.stat().st_mtime_ns for file in pathlib.Path("memory/records").iterdir()}, records)

    def test_a_manifest_may_hold_arrays_of_numpy_and_paths(self):
        pathlib.Path("solids").mkdir()
        faces = [f"3 {x} {y} {z}" for x in (0, 1) for y in (2, 3) for z in (4, 5)]
        pathlib.Path("solids/block.off").write_text("\n".join(
            ["OFF", "6 8 0", "1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1", *faces, ""]))
        manifest = {**MANIFEST, "seed": numpy.int64(3), "replicates": 1,
                    "solids": {"block": {"file": pathlib.Path("solids/block.off")}},
                    "sweep": types.MappingProxyType({"solid": ("block",), "particles": numpy.array([48])})}
        study = self.run_quietly(manifest, "r")
        self.assertEqual(study.names, ["block-N48-r0000"])
        self.assertEqual(study.manifest["solids"]["block"]["vertices"][0][0].__class__, float)

    def test_measures_are_added_and_the_table_is_written_anew(self):
        study = self.run_quietly(MANIFEST, "r")
        self.assertNotIn("Q6", study.replicates)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            study = isojam.measure("r", "order", "clusters", progress=False)
        self.assertFalse(numpy.isnan(study.replicates["Q6"]).any())
        self.assertEqual(study.manifest["measure"], ["contacts", "order", "clusters"])

        written = pathlib.Path("r/tables.json").read_bytes()
        pathlib.Path("r/tables.json").unlink()
        table = isojam.aggregate("r").table()
        self.assertEqual(pathlib.Path("r/tables.json").read_bytes(), written)
        row, = json.loads(written)["rows"]
        self.assertEqual(list(table["phi_j_mean"]), [row["phi_j"]["mean"]])
        self.assertEqual(list(table["Q6_n"]), [2])
        # A Study that was loaded asks the program for its table.
        self.assertEqual(list(isojam.load("r").table()["phi_j_mean"]), [row["phi_j"]["mean"]])


class Failures(Case):
    def test_all_errors_of_a_manifest_come_with_pointer_reason_and_remedy(self):
        manifest = {**MANIFEST, "seed": -1, "protocol": {"target_energi": 1e-5}}
        pathlib.Path("m.json").write_text(json.dumps(manifest))
        for given, name in ((manifest, "manifest"), ("m.json", "m.json")):
            with self.assertRaises(isojam.ManifestError) as caught:
                isojam.run(given, "r")
            self.assertIsInstance(caught.exception, isojam.InputError)
            seed, unknown = caught.exception.errors
            self.assertEqual([seed.place, unknown.place], ["/seed", "/protocol/target_energi"])
            self.assertEqual((caught.exception.place, caught.exception.why), (seed.place, seed.why))
            for error in (seed, unknown):
                self.assertEqual(error.file, name)
                self.assertTrue(error.why and error.allowed, error)
            self.assertIn("target_energy", unknown.allowed)
            self.assertEqual(str(caught.exception), f"{seed}\n{unknown}")
            self.assertFalse(pathlib.Path("r").exists())

    def test_a_manifest_that_is_no_json_is_refused(self):
        pathlib.Path("m.json").write_text('{"name": "x",\n}')
        with self.assertRaises(isojam.ManifestError) as caught:
            isojam.run("m.json", "r")
        self.assertEqual(caught.exception.file, "m.json:2:1")
        for value in (float("nan"), {1, 2}, object()):
            self.assertRaises(isojam.ManifestError, isojam.run, {**MANIFEST, "seed": value}, "r")

    def test_failed_replicates_are_a_warning(self):
        with self.assertWarnsRegex(UserWarning, "some replicates failed") as warned:
            study = isojam.run({**MANIFEST, "minimiser": {"max_evaluations": 1}}, "r", progress=False)
        self.assertEqual(os.path.basename(warned.filename), "running_test.py")
        self.assertEqual(set(study.replicates["status"]), {"failed"})
        texts = [str(warning.message) for warning in warned.warnings]
        for name in study.names:
            self.assertEqual(len([text for text in texts if text.startswith(f"{name} failed: ")]), 1, texts)

    def test_other_failures_are_errors_of_the_program(self):
        self.run_quietly(MANIFEST, "r")
        pathlib.Path("file").touch()
        for start, says in ((lambda: isojam.run(MANIFEST, "file/r"), "file"),
                            (lambda: isojam.run("none.json", "r"), "none.json"),
                            (lambda: isojam.measure("r", "colour"), 'unknown measure "colour"'),
                            (lambda: isojam.measure("none", "order"), "none"),
                            (lambda: isojam.aggregate("none"), "none")):
            with self.assertRaisesRegex(isojam.ProgramError, says) as caught:
                start()
            self.assertIn("isojam", caught.exception.command[0])
        taken = self.refused(lambda: isojam.run({**MANIFEST, "seed": 4}, "r"), "3 in the record, 4 in this manifest")
        self.assertEqual((taken.file, taken.place), ("r/records/octahedron-N48-r0000.json", "/provenance/seed"))
        with mock.patch.dict(os.environ, ISOJAM="/no/such"):
            self.assertRaisesRegex(isojam.ProgramError, "/no/such", isojam.run, MANIFEST, "r")


if __name__ == "__main__":
    support.main()
