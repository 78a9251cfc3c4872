"""Tests the rows of replicates and states."""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import support
from support import ALL, CUBES, MIXED, isojam, numpy


def rows_of_tables(directory):
    return json.loads(pathlib.Path(directory, "tables.json").read_text())["rows"]


def rows_like(rows, line):
    """The rows of the sweep point of a line in a table."""
    mask = (rows["solid"] == line["solid"]) & (rows["particles"] == line["particles"])
    for name, value in line["parameters"].items():
        mask &= rows["minimiser.residual" if name == "residual" else name] == value
    return rows[mask]


class Replicates(support.Case):
    def test_means_are_those_of_the_tables(self):
        compared = 0
        for directory in ALL:
            replicates = support.study(directory).replicates
            for line in rows_of_tables(directory):
                of = rows_like(replicates, line)
                counts = [len(of), (of["status"] == "failed").sum(), sum(map(bool, of["flags"])), of["excluded"].sum()]
                self.assertEqual(counts, [line[key] for key in ("replicates", "failed", "flagged", "excluded")])
                for place, rows in ((line, of[~of["excluded"]]), (line.get("all"), of)):
                    compared += self.compare(rows, place) if place is not None else 0
        print(f"{compared} means compared")
        self.assertGreater(compared, 100)

    def compare(self, rows, line):
        """Compares a line of a table with rows. Returns the number of compared quantities."""
        compared = 0
        for quantity in isojam.quantities:
            expected = line.get(quantity["name"])
            if expected is None or (expected["n"] == 0 and quantity["name"] not in rows):
                continue
            values = rows[quantity["name"]].astype(float)
            values = values[~numpy.isnan(values)]
            self.assertEqual(len(values), expected["n"], quantity)
            if len(values):
                self.near(values.mean(), expected["mean"], 1e-14 * numpy.abs(values).max(), quantity["name"])
                compared += 1
        return compared

    def test_what_failed(self):
        replicates = support.study(MIXED).replicates
        failed = replicates[replicates["status"] == "failed"]
        self.assertEqual(len(failed), 6)
        for row in failed:
            record = support.document(MIXED, "records", row["replicate"])
            self.assertEqual((row["failed_in"], row["failure"]), (record["failure"]["where"], record["failure"]["why"]))
            self.assertTrue(numpy.isnan([row["phi_j"], row["Z"], row["rearrangements"]]).all())
            for name in ("phi_j", "rearrangements", "nearest", "flags"):
                self.assertEqual(row["reasons"][name], "the replicate failed")
        self.assertEqual(set(replicates[replicates["status"] == "done"]["failed_in"]), {""})

    def test_flags(self):
        flags = [row["flags"] for row in support.study(MIXED).replicates if row["excluded"]]
        self.assertEqual(set(flags), {("outside_fit_window",)})
        self.assertEqual(support.study(MIXED).excluding, ("outside_fit_window",))

    def test_swept_parameters(self):
        for rows in (support.study(MIXED).replicates, support.study(MIXED).states):
            self.assertEqual(set(rows["minimiser.residual"]), {1e-3})
            self.assertLess(numpy.nanmax(rows["residual"]), 1e-3)
        self.assertEqual([value for value, _ in support.study(MIXED).replicates.by("max_density")], [.4, .85])


class States(support.Case):
    def test_every_quantity_is_the_records(self):
        compared = nulls = 0
        for directory in ALL:
            study = support.study(directory)
            records = [support.document(directory, "records", name) for name in study.names]
            states = [(record, state) for record in records for state in record["states"] if record["nearest"]]
            self.assertEqual(len(study.states), len(states))
            for row, (record, state) in zip(study.states, states):
                self.assertEqual(row["nearest"], record["nearest"]["phi"] == state["phi"])
                for quantity in (q for q in isojam.quantities if q["of"] == "state"):
                    parent, _, key = quantity["pointer"].rpartition("/")
                    value, name = support.at(state, quantity["pointer"]), quantity["name"]
                    if value is not None:
                        self.assertEqual(row[name], value, name)
                        compared += 1
                    elif key in (support.at(state, parent) or {}):
                        self.assertTrue(numpy.isnan(row[name]), name)
                        self.assertEqual(row["reasons"][name], support.at(state, parent)[key + "_reason"])
                        nulls += 1
        print(f"{compared} values compared, {nulls} nulls")
        self.assertGreater(min(compared, 20 * nulls), 300)

    def test_what_failed_later_has_no_states(self):
        """If a replicate failed in a measure, its record has states."""
        where, name = self.copy(CUBES), support.done(CUBES)[0]
        record = support.document(where, "records", name)
        self.assertGreater(len(record["states"]), 1)
        record.update(status="failed", failure={"where": "modes", "why": "no reason"}, nearest=None, flags=None, phi_j=None)
        (where / f"records/{name}.json").write_text(json.dumps(record))
        study = isojam.load(where, check=False)
        self.assertEqual(set(study.states["replicate"]), set(study.names) - {name})
        self.assertEqual(study.replicates[0]["failed_in"], "modes")

    def test_names_that_clash(self):
        """The Q6 of `contacts` is not the quantity Q6, whose pointer is /order/Q6."""
        states = support.study(CUBES).states
        records = [support.document(CUBES, "records", name) for name in support.done(CUBES)]
        expected = [state["contacts"]["Q6"] for record in records for state in record["states"]]
        self.assertEqual(list(states["contacts.Q6"]), expected)
        self.assertNotIn("Q6", states)


class Columns(support.Case):
    def test_pandas_is_not_needed(self):
        read = ("import isojam; study = isojam.load(sys.argv[1]); study.states; study._repr_html_(); print(len(study.replicates))\n"
                "try: study.replicates.frame()\nexcept ImportError: print('no frame')")
        for before in ("import sys; sys.modules['pandas'] = None", "import sys"):
            code = f"{before}; sys.path.insert(0, sys.argv[2]); {read}"
            said = subprocess.run([sys.executable, "-B", "-E", "-s", "-c", code, MIXED, support.MODULE],
                                  capture_output=True, text=True, check=True).stdout.split("\n", 1)
            self.assertEqual(said[0], "12")
            self.assertEqual("no frame" in said[1], "pandas" in before)

    def test_frames(self):
        for rows in (support.study(MIXED).replicates, support.study(MIXED).states):
            frame = rows.frame()
            self.assertEqual(type(frame).__name__, "DataFrame")
            self.assertEqual(list(frame.columns), rows.columns)
            for name in rows.columns:
                values, others = frame[name].to_numpy(), rows[name]
                same = [a == b or (a != a and b != b) for a, b in zip(values, others)]
                self.assertTrue(all(same), name)
        vectors = isojam.Rows({"n": [1, 2], "force": [[1., 2, 3], [4, 5, 6]]}).frame()
        self.assertEqual(list(vectors.columns), ["n", "force_x", "force_y", "force_z"])
        self.assertEqual(list(vectors["force_y"]), [2, 5])

    def test_choosing(self):
        rows = isojam.Rows({"solid": numpy.array(["b", "a", "b"]), "x": [1., numpy.nan, 3],
                            "flags": isojam.rows.column_of([(), ("f",), ()])})
        self.assertEqual([(value, list(of["x"])) for value, of in rows[[0, 2]].by("solid")], [("b", [1, 3])])
        self.assertEqual([value for value, _ in rows.by("x")], [1, 3])
        self.assertEqual([len(of) for _, of in rows.by("flags")], [2, 1])
        self.assertEqual((len(rows[rows["x"] > 5]), len(rows[[]]), rows[-1]["x"], len(rows[1:])), (0, 0, 3, 2))
        with self.assertRaisesRegex(KeyError, 'did you mean "solid"'):
            rows["solids"]
        self.assertIs(rows.x, rows["x"])
        self.assertEqual(copy.copy(rows).columns, rows.columns)
        with self.assertRaisesRegex(AttributeError, 'unknown column "y"; expected one of solid'):
            rows.y


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
        (where / "manifest.json").unlink()
        study = isojam.load(where)
        self.assertEqual((study.manifest, set(study.excluding)), (None, {"crystalline", "not_balanced"}))
        self.assertFalse(study.replicates["excluded"].any())


if __name__ == "__main__":
    support.main()
