"""Tests that Python gives the means of the program."""

import json
import pathlib
import re
import subprocess

import numpy

import support
from support import ALL, FREE, MIXED, isojam

from isojam import notebook, program

PARTS = {"mean": ("mean",), "sd": ("sd",), "n": ("n",), "ci95": ("low", "high"),
         "bootstrap95": ("bootstrap_low", "bootstrap_high")}


def estimates_of(place):
    return {name: value for name, value in place.items() if isinstance(value, dict) and "mean" in value}


def lines_of(document, series):
    """Lines of the table as pairs: a dict of the columns that identify the line, and an object with estimates."""
    for row in document["rows"]:
        head = {key: row[key] for key in ("solid", "particles", "replicates", "failed", "flagged", "excluded")}
        head.update({"minimiser.residual" if key == "residual" else key: v for key, v in row["parameters"].items()})
        points = [({**head, "delta_phi": each["delta_phi"]}, each) for each in row["series"]] if series else [(head, row)]
        for own, place in points:
            for over, place in (("kept", place), ("all", place.get("all")),
                                ("difference", None if series else place.get("differences"))):
                if place is not None:
                    yield {**own, "over": over}, place


class Tables(support.Case):
    def compare(self, study, options=()):
        """Compares the tables with the JSON of the program. Returns the number of compared values."""
        text = subprocess.run([program.find(), "aggregate", study.directory, "--format", "json", *options],
                              capture_output=True, text=True, check=True).stdout
        total = 0
        for series in (False, True):
            frame = study.table(series=series)
            lines = list(lines_of(json.loads(text), series))
            self.assertEqual(len(frame), len(lines))
            counts = [0, 0]
            for head, place in lines:
                line, = frame[(frame[list(head)] == list(head.values())).all(axis=1)].to_dict("records")
                for name, estimate in estimates_of(place).items():
                    counts[0] += self.compare_estimate(line, name, estimate)
                counts[1] += sum(value == value for key, value in line.items() if self.is_part(key) and key[-2:] != "_n")
            self.assertEqual(*counts)
            total += counts[0]
        return total

    def is_part(self, key):
        return any(key == f"{quantity['name']}_{part}" for quantity in isojam.quantities
                   for parts in PARTS.values() for part in parts)

    def compare_estimate(self, line, name, estimate):
        if f"{name}_n" not in line:
            self.assertEqual(estimate["n"], 0)
            return 0
        compared = 0
        for key, parts in PARTS.items():
            value = estimate[key]
            values = value if isinstance(value, list) else [value] * len(parts)
            for part, expected in zip(parts, values):
                own = line[f"{name}_{part}"]
                self.assertTrue(own == expected or (expected is None and own != own), f"{name}_{part}: {own}, {expected}")
                compared += expected is not None and key != "n"
        if estimate["half_width"] is not None:
            self.near((line[f"{name}_high"] - line[f"{name}_low"]) / 2, estimate["half_width"],
                      1e-15 * max(abs(line[f"{name}_low"]), abs(line[f"{name}_high"])), name)
        return compared

    def test_every_number_is_the_programs(self):
        compared = [self.compare(support.study(directory)) for directory in ALL]
        print(f"{compared} numbers compared")
        self.assertGreater(min(compared), 40)

    def test_differences_from_a_base(self):
        base = ("--base", "max_density=0.4")
        stub = self.stub(f'[ "$3" = aggregate ] && [ "$7" != --series ] && set -- "$@" {" ".join(base)}\n'
                         f'exec {program.find()} "$@"\n')
        study = isojam.load(MIXED, program=stub)
        self.compare(study, base)
        self.assertEqual(list(study.table()["over"]).count("difference"), 2)

    def test_warnings_refer_to_the_call(self):
        stub = self.stub(f'echo many are excluded >&2\nexec {program.find()} "$@" 2>&-\n')
        for read in (lambda study: study.table(), lambda study: study._repr_html_()):
            with self.assertWarnsRegex(UserWarning, "many are excluded") as warned:
                read(isojam.load(FREE, program=stub))
            self.assertEqual(pathlib.Path(warned.filename).name, "means_test.py")

    def test_the_program_is_called_once_for_each_table(self):
        calls = pathlib.Path(self.folder(), "calls")
        study = isojam.load(MIXED, program=self.stub(f'echo x >>{calls}\nexec {program.find()} "$@"\n'))
        study.table()["over"] = "changed"
        for series in (False, True, False, True):
            self.assertNotIn("changed", list(study.table(series)["over"]))
        self.assertEqual(calls.read_text(), "x\nx\n")


class Kept(support.Case):
    def test_means(self):
        compared = 0
        for directory in ALL:
            study = support.study(directory)
            lines = [line for line in json.loads((directory / "tables.json").read_text())["rows"] if line["phi_j"]["n"]]
            for quantity in ("phi_j", "Z"):
                means = study.replicates.kept.groupby("solid")[quantity].mean()
                self.assertEqual(set(means.index), {line["solid"] for line in lines})
                for line in lines:
                    self.near(means[line["solid"]], line[quantity]["mean"], 1e-15 * abs(line[quantity]["mean"]), quantity)
                    compared += 1
        self.assertGreater(compared, 9)
        replicates = support.study(MIXED).replicates
        all_means, kept_means = replicates.groupby("solid").phi_j.mean(), replicates.kept.groupby("solid").phi_j.mean()
        self.assertGreater(all_means["cubes_and_tetrahedra"] - kept_means["cubes_and_tetrahedra"], 1e-3)
        self.assertEqual(list(all_means.index), ["brick", "cubes_and_tetrahedra"])
        rows = json.loads((MIXED / "tables.json").read_text())["rows"]
        self.assertEqual(list(kept_means.index), sorted({row["solid"] for row in rows if row["phi_j"]["n"]}))

    def test_replicates(self):
        excluded = 0
        for directory in ALL:
            study = support.study(directory)
            text = subprocess.run([program.find(), "export", directory, "all", "--format", "replicates"], check=True,
                                  capture_output=True, text=True).stdout
            lines = [dict(zip(text.split("\n", 1)[0].split(","), line.split(","))) for line in text.splitlines()[1:]]
            expected = {line["replicate"] for line in lines if (line["status"], line["excluded"]) == ("done", "false")}
            self.assertEqual(set(study.replicates.kept["replicate"]), expected)
            self.assertEqual(set(study.states.kept["replicate"]), expected)
            excluded += len(study.replicates) - len(study.replicates.kept)
        self.assertGreater(excluded, 6)
        with self.assertRaisesRegex(KeyError, "status"):
            isojam.Rows({"a": [1]}).kept


class Notebook(support.Case):
    def cells(self, text):
        return [re.findall("<t[hd]>(.*?)</t[hd]>", line) for line in re.findall("<tr>(.*?)</tr>", text)]

    def test_the_table(self):
        for directory in ALL:
            study = support.study(directory)
            head, *lines = self.cells(study._repr_html_())
            table = study._table()
            kept = table[table["over"] == "kept"]
            self.assertEqual(head[0], "solid")
            self.assertEqual([line[0] for line in lines], list(kept["solid"]))
            for line, row in zip(lines, kept):
                cells = dict(zip(head, line))
                self.assertEqual(cells["n of phi_j"], str(row["phi_j_n"]))
                self.assertEqual(cells["excluded"], str(row["excluded"]))
                shown = cells["phi_j [95 % confidence interval]"]
                numbers = [float(number) for number in re.findall(r"-?\d+\.\d+", shown)]
                expected = [row[f"phi_j_{part}"] for part in ("mean", "low", "high")]
                expected = [value for value in expected if not numpy.isnan(value)]
                width = expected[2] - expected[1] if len(expected) == 3 else 1e-4 * max(map(abs, expected), default=0)
                self.near(numbers, expected, 0.05 * width, shown)

    def test_texts_are_escaped(self):
        name = '<script>"&amp;'
        where = pathlib.Path(self.folder(), name)
        where.symlink_to(FREE.resolve())
        rows = isojam.Rows({"solid": [name], "over": ["kept"]})
        for text in (isojam.Study(where, table=rows)._repr_html_(), notebook.html_of(name, rows)):
            self.assertNotIn("<script>", text)
            self.assertEqual(self.cells(text)[1][0], "&lt;script&gt;&quot;&amp;amp;")

    def test_long_tables_and_errors(self):
        rows = isojam.Rows({"solid": ["cube"] * 70, "over": ["kept"] * 70})
        text = notebook.html_of("study", rows)
        self.assertEqual(len(self.cells(text)), 31)
        self.assertIn("40 more rows", text)
        for other in ("/no/such", self.stub("echo 'no <tables>' >&2; exit 1\n")):
            text = isojam.load(FREE, program=other)._repr_html_()
            self.assertIn(str(FREE), text)
            self.assertNotIn("<tables>", text)


if __name__ == "__main__":
    support.main()
