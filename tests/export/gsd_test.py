"""Tests GSD files with both readers of python3-gsd, the one in C and the one in Python."""

import gsd.fl
import gsd.hoomd
import gsd.pygsd
import numpy

import check
import results


def hull_faces(vertices):
    """Faces of a convex hull: planes through three or more vertices with all others on one side. Faces are oriented
    outwards."""
    faces = {}
    for i, j, k in numpy.ndindex(3 * (len(vertices),)):
        if not i < j < k:
            continue
        normal = numpy.cross(vertices[j] - vertices[i], vertices[k] - vertices[i])
        heights = (vertices - vertices[i]) @ normal / numpy.linalg.norm(normal)
        if heights.min() < -1e-6 < 1e-6 < heights.max():
            continue
        on_plane = tuple(numpy.flatnonzero(numpy.abs(heights) < 1e-6))
        faces[on_plane] = normal if heights.max() < 1e-6 else -normal
    return [wound(vertices, list(corners), normal) for corners, normal in faces.items()]


def wound(vertices, corners, normal):
    centre = vertices[corners].mean(axis=0)
    x = vertices[corners[0]] - centre
    y = numpy.cross(normal, x)
    y *= numpy.linalg.norm(x) / numpy.linalg.norm(y)
    return sorted(corners, key=lambda c: numpy.arctan2((vertices[c] - centre) @ y, (vertices[c] - centre) @ x))


class Gsd(check.RoundTrip):
    def frames(self):
        for stem, states, measured, _ in self.cases():
            with gsd.hoomd.open(str(stem) + ".gsd") as trajectory:
                self.assertEqual(len(trajectory), len(states))
                for k, (state, values) in enumerate(zip(states, measured)):
                    yield k, trajectory[k], state, values

    def test_file_and_frames(self):
        for k, snapshot, state, _ in self.frames():
            snapshot.validate()
            self.assertEqual(snapshot.configuration.step, k)
            self.assertEqual(snapshot.configuration.dimensions, 3)
            self.assertEqual(snapshot.particles.N, state.n)
            self.assertEqual(snapshot.particles.types, [state.solid])
            self.assertEqual(set(snapshot.particles.typeid), {0})
            side = numpy.float32(state.side)
            self.assertEqual(list(snapshot.configuration.box), [side, side, side, 0, 0, 0])

    def test_positions(self):
        for _, snapshot, state, _ in self.frames():
            side = float(snapshot.configuration.box[0])
            positions = snapshot.particles.position.astype(float)
            self.assertGreaterEqual(positions.min(), -side / 2)
            self.assertLess(positions.max(), side / 2)
            # A component rounds to half of L/2 in the last place; a distance takes six, and the side.
            tolerance = 4 * results.FLOAT * side
            self.assert_near(results.distances(positions, side), results.distances(state.positions, state.side),
                             tolerance, "distances")
            images = snapshot.particles.image
            self.assert_near(positions + state.side * images, state.positions,
                             tolerance * (1 + numpy.abs(images).max()), "unwrapped positions")

    def test_shapes_and_orientations(self):
        for k, snapshot, state, _ in self.frames():
            shape = snapshot.particles.type_shapes[0]
            self.assertEqual((shape["type"], shape["rounding_radius"]), ("ConvexPolyhedron", 0))
            vertices = numpy.array(shape["vertices"])
            orientations = snapshot.particles.orientation.astype(float)
            self.assert_near(numpy.linalg.norm(orientations, axis=1), numpy.ones(state.n), 4 * results.FLOAT, "norms")
            reach = numpy.linalg.norm(vertices, axis=1).max()
            self.assert_near(results.rotation(orientations) @ vertices.T,
                             results.rotation(state.quaternions) @ vertices.T, 8 * results.FLOAT * reach, "vertices")
            if k > 0:
                continue
            volume, second = results.moments(vertices, hull_faces(vertices))
            self.assert_near(volume, 1, 100 * results.DOUBLE, "volume")
            self.assertEqual(set(snapshot.particles.mass), {1})
            self.assert_near(snapshot.particles.moment_inertia, numpy.full((state.n, 3), 2 / 3 * second),
                             results.FLOAT, "moments of inertia")

    def test_logged_quantities(self):
        seen = set()
        for _, snapshot, state, values in self.frames():
            log = snapshot.log
            self.assertEqual(log["isojam/density"][0], state.density)
            self.assertEqual(log["isojam/side"][0], state.side)
            self.assertEqual(log["isojam/delta_phi"][0], state.delta_phi)
            self.assert_near(log["particles/isojam/Z"].mean(), values["contacts"]["Z"], 8 * results.DOUBLE * values["contacts"]["Z"], "Z")
            cluster = log["particles/isojam/cluster"]
            seen.update(cluster < 0)
            if values["clusters"]["S"] is None:
                self.assertEqual(set(cluster), {-2})
            elif "labels" in values["clusters"]:
                self.assertEqual(list(cluster), list(results.clusters_of(values["clusters"]["labels"])))
        self.assertEqual(seen, {True, False}, "particles with and without face-face contacts")


if __name__ == "__main__":
    check.main()
