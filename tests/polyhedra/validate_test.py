"""Compares `isojam validate` with the published features of 45 polyhedra. usage: validate_test.py ISOJAM"""

import pathlib
import sys
import tempfile
import unittest

import numpy

import catalogue
import files
import study
from polyhedron import faces, volume

PROGRAM = sys.argv[1]
SOLIDS = catalogue.polyhedra()
FACES = {name: faces(vertices) for name, vertices in SOLIDS.items()}
#: Larger than the rounding errors of single precision, and smaller than what separates features of these solids.
MERGE = 1e-5
#: The volume is printed with six digits.
SIX_DIGITS = 1e-5


class Validate(unittest.TestCase):
    def reported(self, kind, single):
        """The numbers that the program prints for each solid, if all of them are given in files of this kind."""
        with tempfile.TemporaryDirectory() as folder:
            definitions = {}
            for name, exact in SOLIDS.items():
                vertices = exact.astype(numpy.float32) if single else exact
                if kind == "vertices":
                    definitions[name] = {"vertices": vertices.astype(float).tolist()}
                else:
                    text = getattr(files, kind)(vertices, FACES[name])
                    pathlib.Path(folder, f"{name}.{kind}").write_text(text)
                    definitions[name] = {"file": f"{name}.{kind}"}
                if single:
                    definitions[name]["merge"] = MERGE
            document = study.manifest(kind, definitions, 300)
            code, output, messages = study.call(PROGRAM, "validate", study.write(folder, document))
        self.assertEqual(code, 0, messages[:3000])
        return study.printed_solids(output)

    def check(self, kind, single):
        printed = self.reported(kind, single)
        self.assertEqual(sorted(printed), sorted(SOLIDS), "one line for each solid")
        wrong = [f"{name}: {printed[name]} instead of {number}" for name, (number, _) in catalogue.published().items()
                 if tuple(printed[name][key] for key in ("faces", "edges", "vertices")) != number
                 or abs(printed[name]["volume"] / volume(SOLIDS[name], FACES[name]) - 1) > SIX_DIGITS]
        if wrong:
            self.fail(f"{len(wrong)} solids\n" + "\n".join(wrong))
        worst = max(max(solid["distance"], solid["move"]) for solid in printed.values())
        print(f"{kind}, {'single' if single else 'double'} precision: corners move by up to {worst:.1e} diameters")
        rounding = numpy.finfo(numpy.float32 if single else float).eps
        self.assertLess(worst, 100 * rounding)
        self.assertGreater(worst, rounding / 100)

    def test_vertices_in_double_precision(self):
        self.check("vertices", False)

    def test_off_files_in_double_precision(self):
        self.check("off", False)

    def test_obj_files_in_double_precision(self):
        self.check("obj", False)

    def test_vertices_in_single_precision(self):
        self.check("vertices", True)

    def test_off_files_in_single_precision(self):
        self.check("off", True)

    def test_obj_files_in_single_precision(self):
        self.check("obj", True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
