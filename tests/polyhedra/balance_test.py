"""Tests packings of ten user-defined solids, N = 32. usage: balance_test.py ISOJAM"""

import pathlib
import sys
import tempfile
import unittest

import numpy

import catalogue
import study

PROGRAM = sys.argv[1]
NAMES = ("O04", "P05", "A03", "A01", "C01", "C09", "A08", "C12", "A05", "C04")
#: Name, factor of the vertices, their origin, digits that are kept (17: all), value of `merge`.
VARIANTS = (("as_computed", 1, 0, 17, None), ("at_1e4", 1, 1e4, 17, None), ("at_1e6", 1, 1e6, 17, None),
            ("at_1e8", 1, 1e8, 17, None), ("nanometres", 1e-9, 0, 17, None), ("large", 3e8, 0, 17, None),
            ("digits_6", 1, 0, 6, 1e-4), ("digits_9", 1, 0, 9, 1e-7), ("digits_12", 1, 0, 12, 1e-10),
            ("digits_15", 1, 0, 15, 1e-13), ("digits_9_split", 1, 0, 9, None))
DIRECTION = numpy.array([1, -0.7, 0.4])


def definition(vertices, factor, origin, digits, merge):
    placed = (vertices * factor + origin * DIRECTION).tolist()
    solid = {"vertices": [[float(f"{x:.{digits - 1}e}") for x in vertex] for vertex in placed]}
    return solid if merge is None else {**solid, "merge": merge}


def definitions():
    """Two variants for each solid: every variant occurs, and with different solids."""
    random = numpy.random.default_rng(5)
    solids = {}
    for k, name in enumerate(NAMES):
        turn = numpy.linalg.qr(random.normal(size=(3, 3)))[0]
        for j in (k, k + 4):
            variant, *how = VARIANTS[j % len(VARIANTS)]
            solids[f"{name}_{variant}"] = definition(catalogue.polyhedra()[name] @ turn, *how)
    return solids


class Balance(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.directory = pathlib.Path(cls.folder.name, "results")
        manifest = study.manifest("balance", definitions(), 32, 1e-9, ()) | {"seed": 8}
        cls.manifest = study.write(cls.folder.name, manifest)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_variant_occurs(self):
        seen = {name.split("_", 1)[1] for name in definitions()}
        self.assertEqual(seen, {variant[0] for variant in VARIANTS})

    def test_forces_balance(self):
        code, _, messages = study.call(PROGRAM, "--quiet", "run", self.manifest, "-o", self.directory)
        self.assertEqual(code, 0, messages)
        radius = {name: study.gyration_radius(catalogue.polyhedra()[name]) for name in NAMES}
        exported = study.exported_residuals(PROGRAM, self.directory, lambda solid: radius[solid.split("_")[0]])
        records = study.records(self.directory)
        self.assertEqual(len(records), 2 * len(NAMES))
        self.assertEqual(set(exported), set(records))
        print("largest residual of exported forces:", max((value, name) for name, value in exported.items()))
        wrong = [f"{name}: {text}" for name, record in records.items()
                 if (text := study.unbalanced(record, exported[name]))]
        if wrong:
            self.fail("\n".join(wrong))

    def test_merged_solids_have_their_faces(self):
        code, output, messages = study.call(PROGRAM, "validate", self.manifest)
        self.assertEqual(code, 0, messages)
        printed = study.printed_solids(output)
        self.assertEqual(set(printed), set(definitions()))
        wrong = []
        for name, solid in printed.items():
            number = catalogue.published()[name.split("_")[0]][0]
            if name.endswith("_split"):  # into triangles
                number = (2 * number[2] - 4, 3 * number[2] - 6, number[2])
            if (solid["faces"], solid["edges"], solid["vertices"]) != number:
                wrong.append(f"{name}: {solid}")
        if wrong:
            self.fail("\n".join(wrong))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
