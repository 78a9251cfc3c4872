"""Tests the 45 polyhedra of catalogue.py. The published numbers of features are the reference."""

import itertools
import sys
import unittest

import numpy

import catalogue
from polyhedron import edges, faces, irregularity, normal_of

ROUNDING = 1e-14  # about 20 ulp of the largest solid
SOLIDS = catalogue.polyhedra()
FACES = {name: faces(vertices) for name, vertices in SOLIDS.items()}


def spread(values):
    values = numpy.asarray(values)
    return values.max() - values.min()


class Catalogue(unittest.TestCase):
    def small(self, value, name):
        self.assertLess(value, ROUNDING, name)

    def test_published_numbers(self):
        published = catalogue.published()
        self.assertEqual(len(published), 45)
        self.assertEqual(list(published), list(SOLIDS))
        for name, (number, polygons) in published.items():
            loops = FACES[name]
            sides = [len(loop) for loop in loops]
            self.assertEqual((len(loops), len(edges(loops)), len(SOLIDS[name])), number, name)
            self.assertEqual({n: sides.count(n) for n in sorted(set(sides))}, polygons, name)
            self.assertEqual(number[0] - number[1] + number[2], 2, name)
            self.assertEqual(sum(sides), 2 * number[1], name)

    def test_corners(self):
        for name, vertices in SOLIDS.items():
            self.assertEqual({v for loop in FACES[name] for v in loop}, set(range(len(vertices))), name)
            for loop in FACES[name]:
                normal = normal_of(vertices, loop)
                self.small(spread(vertices[loop] @ normal), name)
                others = numpy.delete(vertices, loop, axis=0)
                self.assertLess((others @ normal).max(), (vertices[loop] @ normal).min() - 1e-3, name)

    def test_regular_faces(self):
        regular = [name for name in SOLIDS if name[0] in "PAO"]
        self.assertEqual(len(regular), 5 + 13 + 14)
        for name in regular:
            self.small(irregularity(SOLIDS[name], FACES[name]), name)

    def test_spheres(self):
        for name, vertices in SOLIDS.items():
            centred = vertices - vertices.mean(axis=0)
            if name[0] in "PA":
                self.small(spread(numpy.linalg.norm(centred, axis=1)), name)
            if name[0] in "PC":
                normals = numpy.array([normal_of(vertices, loop) for loop in FACES[name]])
                depths = [centred[loop[0]] @ normal for loop, normal in zip(FACES[name], normals)]
                self.small(spread(depths), name)
                area = [numpy.cross(centred[loop], numpy.roll(centred[loop], -1, axis=0)).sum(axis=0) @ normal
                        for loop, normal in zip(FACES[name], normals)]
                self.small(spread(area) / max(area), name)

    def test_no_two_are_similar(self):
        known = {}
        for name, vertices in SOLIDS.items():
            gaps = numpy.sort([numpy.linalg.norm(a - b) for a, b in itertools.combinations(vertices, 2)])
            for other, theirs in known.items():
                self.assertFalse(len(theirs) == len(gaps) and max(abs(theirs - gaps / gaps[-1])) < 1e-9,
                                 f"{name} is {other}")
            known[name] = gaps / gaps[-1]


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
