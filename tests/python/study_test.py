"""Tests the rows of replicates and states, and the means."""

import csv
import json
import pathlib
import re
import subprocess
import tempfile

import pandas

import support
from support import ALL, CUBES, FREE, MIXED, isojam, numpy

from isojam import program


class Rows(support.Case):
    def test_values_and_types_are_those_of_the_program(self):
        """The JSON lines of the program have types: numbers, texts, truth values and nulls."""
        compared = 0
        for directory in ALL:
            for what in ("replicates", "states"):
                file = pathlib.Path(self.folder(), "rows.jsonl")
                subprocess.run([program.find(), "export", directory, "all", "--format", what, "-o", file], check=True,
                               stdout=subprocess.DEVNULL)
                lines = [json.loads(line) for line in file.read_text().splitlines()]
                rows = getattr(support.study(directory), what)
                self.assertEqual((len(rows), list(rows.columns)), (len(lines), list(lines[0])))
                for name in rows.columns:
                    texts = any(isinstance(line[name], str) for line in lines)
                    for value, line in zip(rows[name], lines):
                        expected = line[name]
                        if expected is None:
                            self.assertTrue(value == "" if name in isojam.facts.texts else numpy.isnan(value), name)
                        else:
                            self.assertEqual(value, expected, name)
                            self.assertEqual(isinstance(value, bool | numpy.bool_), isinstance(expected, bool), name)
                            compared += 1
                    self.assertLessEqual(texts, name in isojam.facts.texts, name)
        print(f"{compared} values compared")
        self.assertGreater(compared, 2000)

    def test_every_quantity_is_the_records(self):
        compared = nulls = 0
        for directory in ALL:
            study = support.study(directory)
            records = [support.document(directory, "records", name) for name in study.names]
            done = [record for record in records if record["status"] == "done"]
            pairs = [(record, state) for record in done for state in record["states"]]
            nearest = [(record, record["states"][record["nearest"]]) for record in done]
            of_done = study.replicates[study.replicates["status"] == "done"]
            for rows, expected in ((study.states, pairs), (of_done, nearest)):
                self.assertEqual(len(rows), len(expected))
                for (_, row), (record, state) in zip(rows.iterrows(), expected):
                    self.assertEqual(row["state"], record["states"].index(state))
                    self.assertEqual(row.get("nearest", True), state is record["states"][record["nearest"]])
                    self.assertEqual([row["density"], row["pressure"]], [state["density"], state["pressure"]])
                    for quantity in isojam.quantities:
                        if quantity["name"] not in row or quantity["name"] in state:
                            continue  # a number that every state has
                        document = state if quantity["of"] == "state" else record
                        value = support.at(document, quantity["pointer"])
                        if value is not None:
                            self.assertEqual(row[quantity["name"]], value)
                            compared += 1
                        else:
                            self.assertTrue(numpy.isnan(row[quantity["name"]]), quantity["name"])
                            reason = support.at(document, quantity["pointer"] + "_reason")
                            self.assertIn(f"{quantity['name']}: {reason}" if reason else "", row["reasons"])
                            nulls += reason is not None
        print(f"{compared} values compared, {nulls} reasons")
        self.assertGreater(min(compared, 20 * nulls), 300)

    def test_what_failed(self):
        replicates = support.study(MIXED).replicates
        failed = replicates[replicates["status"] == "failed"]
        self.assertEqual(len(failed), 6)
        for _, row in failed.iterrows():
            record = support.document(MIXED, "records", row["replicate"])
            self.assertEqual((row["failed_in"], row["failure"]), (record["failure"]["where"], record["failure"]["why"]))
            self.assertTrue(numpy.isnan([row["phi_j"], row["Z"], row["state"]]).all())
        self.assertEqual(set(replicates[replicates["status"] == "done"]["failed_in"]), {""})
        self.assertFalse(set(failed["replicate"]).intersection(support.study(MIXED).states["replicate"]))

    def test_a_study_of_failures_has_empty_tables(self):
        where = self.copy(MIXED)
        for name in support.done(MIXED):
            (where / f"records/{name}.json").unlink()
        study = isojam.load(where)
        self.assertEqual((len(study.states["Z"]), len(study.replicates), study.replicates["Z"].count()), (0, 6, 0))

    def test_flags_and_swept_parameters(self):
        study = support.study(MIXED)
        excluded = study.replicates[study.replicates["excluded"]]
        self.assertTrue(len(excluded) and excluded["flags"].str.contains("outside_fit_window").all())
        for rows in (study.replicates, study.states):
            self.assertEqual(set(rows["minimiser.residual"]), {1e-3})
            self.assertLess(rows["residual"].max(), 1e-3)

    def test_kept(self):
        excluded = 0
        for directory in ALL:
            study = support.study(directory)
            records = [support.document(directory, "records", name) for name in support.done(directory)]
            kept = {name for name, record in zip(support.done(directory), records)
                    if not {*record["flags"]}.intersection(study.manifest["exclude"])}
            for rows in (study.replicates, study.states):
                self.assertIsInstance(rows.kept, isojam.Rows)
                self.assertEqual(set(rows.kept["replicate"]), kept)
            excluded += len(study.replicates) - len(study.replicates.kept)
        self.assertGreater(excluded, 6)


class Means(support.Case):
    def test_the_table_is_that_of_the_program(self):
        for directory in ALL:
            for series in (False, True):
                words = ["aggregate", directory, "--format", "csv", *(["--series"] if series else [])]
                text = subprocess.run([program.find(), *words], capture_output=True, text=True, check=True).stdout
                frame = support.study(directory).table(series)
                self.assertIs(type(frame), pandas.DataFrame)
                for (_, own), line in zip(frame.iterrows(), csv.DictReader(text.splitlines()), strict=True):
                    for name, value in line.items():
                        self.assertTrue(own[name] == type(own[name])(value) if value else numpy.isnan(own[name]), name)

    def test_notebook(self):
        table = support.study(FREE).table()
        head, *lines = [re.findall("<t[hd]>(.*?)</t[hd]>", line)
                        for line in re.findall("<tr.*?>(.*?)</tr>", support.study(FREE)._repr_html_(), re.DOTALL)]
        self.assertEqual([line[head.index("solid")] for line in lines], list(table[table["over"] == "kept"]["solid"]))
        for name in ("phi_j_mean", "phi_j_low", "Z_n"):
            numbers = [float(line[head.index(name)] or "nan") for line in lines]
            numpy.testing.assert_allclose(numbers, table[table["over"] == "kept"][name], 1e-5)
        name = "<script>"
        where = pathlib.Path(self.folder(), name)
        where.symlink_to(FREE.resolve())
        for other in (None, self.stub("echo 'no <script>' >&2; exit 1\n")):
            self.assertNotIn("<script>", isojam.load(where, program=other)._repr_html_())


class Directories(support.Case):
    def test_what_holds_no_results(self):
        with tempfile.TemporaryDirectory() as folder:
            self.refused(lambda: isojam.load(folder), folder, "contains no results")
            self.refused(lambda: isojam.load(folder + "/none"), "/none", "no such directory")

    def test_names(self):
        study = support.study(CUBES)
        self.refused(lambda: study.packing("tetrahedron-N64-r0001"), "tetrahedron-N64-r0000")
        self.refused(lambda: study.record("../records/tetrahedron-N64-r0000"), "unknown replicate")
        failed = next(name for name in support.study(MIXED).names if name not in support.done(MIXED))
        self.assertEqual(self.refused(lambda: support.study(MIXED).packing(failed), "max_density").place, "/status")
        self.refused(lambda: support.study(MIXED).path(support.done(MIXED)[0]), "keep_path")

    def test_a_directory_without_a_manifest(self):
        where = self.copy(MIXED)
        for manifest in (where / "manifest.json", *where.glob("manifests/*")):
            manifest.unlink()
        study = isojam.load(where)
        self.assertIsNone(study.manifest)
        self.assertFalse(study.replicates["excluded"].any())


if __name__ == "__main__":
    support.main()
