"""Tests extended XYZ and OBJ files with short readers that follow the formats."""

import re

import numpy

import check
import results


def read_frames(file):
    """Pairs of a dict with the values in the comment line, and a dict with the columns by name."""
    lines = file.read_text().splitlines()
    frames = []
    while lines:
        n = int(lines[0])
        values = {key: quoted or plain for key, quoted, plain in re.findall(r'(\w+)=(?:"([^"]*)"|(\S+))', lines[1])}
        words = [line.split() for line in lines[2:2 + n]]
        frames.append((values, columns(values["Properties"], words)))
        lines = lines[2 + n:]
    return frames


def columns(properties, words):
    kinds = {"S": str, "R": float, "I": int}
    fields = iter(properties.split(":"))
    first, result = 0, {}
    for name, kind, width in zip(fields, fields, fields):
        last = first + int(width)
        result[name] = numpy.array([[kinds[kind](word) for word in row[first:last]] for row in words]).squeeze()
        first = last
    assert {len(row) for row in words} == {first}, "a line has another number of columns"
    return result


class Xyz(check.RoundTrip):
    def frames(self):
        for stem, states, measured, _ in self.cases():
            frames = read_frames(stem.with_name(stem.name + ".xyz"))
            self.assertEqual(len(frames), len(states))
            for (values, columns_), state, record in zip(frames, states, measured):
                yield values, columns_, state, record

    def test_cell(self):
        for values, particles, state, _ in self.frames():
            lattice = numpy.array(values["Lattice"].split(), dtype=float).reshape(3, 3)
            numpy.testing.assert_array_equal(lattice, state.side * numpy.eye(3))
            self.assertEqual((values["pbc"], set(particles["species"]), set(particles["solid"])),
                             ("T T T", {"X"}, {state.solid}))
            self.assertEqual((float(values["density"]), float(values["delta_phi"])), (state.density, state.delta_phi))

    def test_particles(self):
        for _, particles, state, record in self.frames():
            self.assertEqual(len(particles["pos"]), state.n)
            self.assertGreaterEqual(particles["pos"].min(), 0)
            self.assertLess(particles["pos"].max(), state.side)
            tolerance = 8 * results.DOUBLE * state.side
            self.assert_near(results.distances(particles["pos"], state.side),
                             results.distances(state.positions, state.side), tolerance, "distances")
            self.assert_near(particles["orientation"], numpy.roll(state.quaternions, -1, axis=1), 4 * results.DOUBLE,
                             "quaternions")
            z = record["contacts"]["Z"]
            self.assert_near(particles["n_neighb"].mean(), z, 8 * results.DOUBLE * z, "Z")
            if "labels" in record["clusters"]:
                self.assertEqual(list(particles["cluster"]), list(results.clusters_of(record["clusters"]["labels"])))

    def test_ase_reads_the_frames(self):
        try:
            from ase.io import read
        except ImportError:
            self.skipTest("python3-ase is not installed")
        for stem, states, measured, _ in self.cases():
            frames = read(stem.with_name(stem.name + ".xyz"), index=":")
            self.assertEqual(len(frames), len(states))
            for atoms, state, record in zip(frames, states, measured):
                print(f"ASE: {len(atoms)} particles, symbols {set(atoms.symbols)}, columns {sorted(atoms.arrays)}")
                self.assertEqual((len(atoms), set(atoms.numbers), all(atoms.pbc)), (state.n, {0}, True))
                self.assertEqual(set(atoms.arrays["solid"]), {state.solid})
                self.assert_near(atoms.arrays["n_neighb"].mean(), record["contacts"]["Z"], 1e-12, "Z")

    def test_solid(self):
        for stem, states, _, _ in self.cases():
            vertices, faces = results.read_obj(stem.with_name(stem.name + ".obj"))
            self.assertEqual(len(vertices) - sum(map(len, faces)) / 2 + len(faces), 2, "Euler characteristic")
            volume, _ = results.moments(vertices, faces)
            self.assert_near(volume, 1, 100 * results.DOUBLE, "volume")
            self.assert_near(vertices.mean(axis=0), numpy.zeros(3), 100 * results.DOUBLE, "centroid")
            self.assertEqual(f"o {states[0].solid}", stem.with_name(stem.name + ".obj").read_text().splitlines()[1])


if __name__ == "__main__":
    check.main()
