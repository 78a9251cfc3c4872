"""Tests tables in files, and the calls of the program for tables."""

import io
import json
import os
import subprocess
import tempfile

import numpy

import support
from support import CUBES, isojam

from isojam import program

HEAD = ("replicate,state,delta_phi,a,b,image_x,image_y,image_z,volume,area,force_x,force_y,force_z,attack_x,attack_y,"
        "attack_z,normal_x,normal_y,normal_z,torque_a_x,torque_a_y,torque_a_z,torque_b_x,torque_b_y,torque_b_z,class,kind,"
        "theta_ef,theta_ff,depth,solid_a,solid_b")
LINES = ("r-r0000,3,0.01,0,1,0,-1,0,1e-300,0.1,0.30000000000000004,0,-5,1,2,3,0,0,1,0,0,0,0,0,0,face_face,compound,"
         "0.1,,1,cube,\"a \"\"b\"\", c\"",
         "r-r0000,3,,2,3,1,0,0,5e-324,0.1,1.7976931348623157e308,0,-5,1,2,3,0,0,1,0,0,0,0,0,0,,edge_edge,,,0,cube,cube")


def table(*lines):
    return isojam.read_table(io.StringIO("\n".join(lines) + "\n"))


class Tables(support.Case):
    def test_contacts(self):
        rows = table(HEAD, *LINES)
        vectors = ["image", "force", "attack", "normal", "torque_a", "torque_b"]
        self.assertEqual([name for name in rows.columns if rows[name].ndim == 2], vectors)
        self.assertEqual({name: rows[name].dtype.kind for name in ("state", "a", "image", "force", "depth", "theta_ff",
                                                                   "class", "solid_a")},
                         {"state": "i", "a": "i", "image": "i", "force": "f", "depth": "f", "theta_ff": "f", "class": "U",
                          "solid_a": "U"})
        self.assertEqual(list(rows["volume"]), [1e-300, 5e-324])
        self.assertEqual(list(rows["force"][:, 0]), [.1 + .2, 1.7976931348623157e308])
        self.assertEqual((list(rows["class"]), rows["solid_b"][0]), (["face_face", ""], 'a "b", c'))
        self.assertEqual(list(numpy.isnan(rows["delta_phi"])), [False, True])
        self.assertTrue(numpy.isnan(rows["theta_ff"]).all())

    def test_no_rows(self):
        rows = table(HEAD)
        self.assertEqual((len(rows), rows["force"].shape, rows["class"].dtype.kind), (0, (0, 3), "U"))

    def test_lists_and_truth(self):
        rows = table("flags,excluded,Z_ff,S,reasons", 'a; b,true,,,"Z_ff: no cut-off; S: this; that: it"', ",false,1,2,")
        self.assertEqual((list(rows["flags"]), list(rows["excluded"])), ([("a", "b"), ()], [True, False]))
        self.assertEqual(list(rows["reasons"]), [{"Z_ff": "no cut-off", "S": "this; that: it"}, {}])

    def test_columns_unheard_of(self):
        rows = table("n,x,text,mixed,none", "1,1,a,1,", "2,2.5,b,c,")
        self.assertEqual([rows[name].dtype.kind for name in rows.columns], ["i", "f", "U", "U", "f"])
        quantities = table("Z,omega_l,particles", "10,1,64")
        self.assertEqual([quantities[name].dtype.kind for name in quantities.columns], ["f", "f", "i"])

    def test_objects_on_lines(self):
        plain = table(HEAD, *LINES)
        whole = []
        for row in plain:
            flat = {name: value for name, value in row.items() if numpy.ndim(value) == 0}
            for name in row.keys() - flat:
                flat.update(zip((name + "_x", name + "_y", name + "_z"), row[name].tolist()))
            whole.append({name: None if flat.get(name) == "" or flat[name] != flat[name] else flat[name]
                          for name in HEAD.split(",")})
        rows = table(*(json.dumps(row, default=lambda number: number.item()) for row in whole))
        self.assertEqual(rows.columns, plain.columns)
        for name in plain.columns:
            numpy.testing.assert_array_equal(rows[name], plain[name], name)

    def test_replicates_and_states(self):
        """The tables of replicates and states that the program writes have the columns, values and reasons of a
        Study."""
        for directory in support.ALL:
            for what in ("replicates", "states"):
                text = subprocess.run([program.find(), "export", directory, "all", "--format", what], check=True,
                                      capture_output=True, text=True).stdout
                rows, own = table(*text.splitlines()), getattr(support.study(directory), what)
                for name in rows.columns:
                    if name in own:
                        self.compare(name, rows, own)
                    else:  # Of kinds that no mixture has.
                        self.assertTrue(numpy.isnan(rows[name]).all(), name)
                self.assertGreater(len(set(rows.columns).intersection(own.columns)), 25)

    def compare(self, name, rows, own):
        if name != "reasons":
            return numpy.testing.assert_array_equal(rows[name], own[name], name)
        quantities = set(rows.columns) - {"flags"}
        for value, others in zip(rows["reasons"], own["reasons"]):
            self.assertEqual(value, {key: why for key, why in others.items() if key in quantities})
        return None

    def test_refusals(self):
        self.refused(lambda: isojam.read_table("/no/such.csv"), "/no/such.csv", "No such file")
        for lines, place in (([""], "line 1"), ([HEAD, LINES[1][:-5]], "line 2"), ([HEAD, LINES[0], "1,2"], "line 3"),
                             (["a,b,a", "1,2,3"], "line 1"), ([HEAD, LINES[0].replace("1e-300", "much")], "row 1 of volume"),
                             ([HEAD, LINES[0], LINES[1].replace(",3,,2,", ",3,,two,")], "row 2 of a"),
                             (['{"a": 1}', "[1]"], "line 2"), (['{"a": 1}', "{"], "line 2")):
            self.assertEqual(self.refused(lambda: table(*lines)).place, place, lines)
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"\xff\xfe\x00")
            file.flush()
            self.refused(lambda: isojam.read_table(file.name), file.name)


class Program(support.Case):
    def test_the_words(self):
        name = support.done(CUBES)[0]
        expected = f"--messages json export {CUBES} {{}} --format contacts"
        lines = "\n".join([HEAD, *LINES])
        for arguments, words in (((), expected.format("all")), ((name,), expected.format(name)),
                                 ((name, True), expected.format(name) + " --path")):
            stub = self.stub(f'[ "$*" = "{words}" ] || {{ echo "got $*" >&2; exit 2; }}\ncat <<\'END\'\n{lines}\nEND\n')
            rows = isojam.load(CUBES, program=stub).contacts(*arguments)
            self.assertEqual(list(rows["b"]), [1, 3])

    def test_errors_and_warnings(self):
        with self.assertRaisesRegex(isojam.ProgramError, "no such format") as caught:
            isojam.load(CUBES, program=self.stub("echo no such format >&2; exit 2\n")).contacts()
        self.assertEqual(caught.exception.message, "no such format")
        with self.assertWarnsRegex(UserWarning, "undecided") as warned:
            isojam.load(CUBES, program=self.stub(f"echo classes undecided >&2; echo {HEAD}\n")).contacts()
        self.assertEqual(os.path.basename(warned.filename), "table_test.py")
        short = self.stub(f"echo {HEAD}; echo 1\n")
        self.refused(lambda: isojam.load(CUBES, program=short).contacts(), "isojam export", "line 2")


if __name__ == "__main__":
    support.main()
