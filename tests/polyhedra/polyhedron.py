"""Convex polyhedra as arrays of vertices, and the operations that make one from another.

A polyhedron is an array of vertices, one in each row. `faces(vertices)` computes the faces of its convex hull. All
regular-faced polyhedra have edges of length 1."""

import itertools

import numpy

NEAR = 1e-9  # vertices of these polyhedra are at least 0.1 apart, and errors are below 1e-12


def cross(a, b):
    """numpy.cross of two vectors, which takes ten times as long."""
    return numpy.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def faces(vertices):
    """Faces of the hull: lists of vertices, counter-clockwise seen from outside, the smallest index first.

    Gift wrapping: the face beyond an edge is the one that the plane of a known face reaches first if it rotates about
    the edge."""
    corner = int(numpy.argmax(vertices @ [1, 0.1, 0.01]))  # no face has this normal
    todo = [face_at(vertices, corner)]
    found, wrapped = {}, set()
    while todo:
        normal, height = todo.pop()
        corners = tuple(numpy.flatnonzero(height < NEAR))
        if corners in found:
            continue
        found[corners] = wound(vertices, list(corners), normal)
        for tail, head in zip(found[corners], found[corners][1:] + found[corners][:1]):
            wrapped.add((tail, head))
            if (head, tail) in wrapped:
                continue
            along = vertices[head] - vertices[tail]
            inwards = (vertices - vertices[tail]) @ cross(normal, along)
            angle = numpy.arctan2(-height * numpy.linalg.norm(along), -inwards)
            angle[list(corners)] = -numpy.inf
            todo.append(plane(vertices, head, tail, int(numpy.argmax(angle))))
    return [found[corners] for corners in sorted(found)]


def plane(vertices, i, j, k):
    """Outward unit normal of a plane that supports the hull, and the depths of all vertices below it."""
    normal = cross(vertices[j] - vertices[i], vertices[k] - vertices[i])
    normal /= numpy.linalg.norm(normal)
    depth = (vertices[i] - vertices) @ normal
    return (normal, depth) if depth.sum() > 0 else (-normal, -depth)


def face_at(vertices, corner):
    """A face that contains this corner of the hull."""
    for j, k in itertools.combinations(numpy.argsort(numpy.linalg.norm(vertices - vertices[corner], axis=1))[1:], 2):
        if numpy.linalg.norm(cross(vertices[j] - vertices[corner], vertices[k] - vertices[corner])) > NEAR:
            normal, depth = plane(vertices, corner, j, k)
            if depth.min() > -NEAR:
                return normal, depth
    raise ValueError("the vertices span no volume")


def wound(vertices, corners, normal):
    """The corners of a face in counter-clockwise order."""
    centre = vertices[corners].mean(axis=0)
    x = vertices[corners[0]] - centre
    y = cross(normal, x)
    angle = [numpy.arctan2((vertices[c] - centre) @ y, (vertices[c] - centre) @ x) % (2 * numpy.pi) for c in corners]
    return [corners[k] for k in numpy.argsort(angle)]


def edges(loops):
    """Pairs of vertices, the smaller index first."""
    return sorted({tuple(sorted(pair)) for loop in loops for pair in zip(loop, loop[1:] + loop[:1])})


def normal_of(vertices, loop):
    """Outward unit normal of a face."""
    corner = vertices[loop]
    area = numpy.cross(corner - corner[0], numpy.roll(corner, -1, axis=0) - corner[0]).sum(axis=0)
    return area / numpy.linalg.norm(area)


def volume(vertices, loops):
    centre = vertices.mean(axis=0)
    return sum(numpy.linalg.det(vertices[[loop[0], a, b]] - centre)
               for loop in loops for a, b in zip(loop[1:], loop[2:])) / 6


def irregularity(vertices, loops):
    """Largest deviation of an edge from 1, and of a corner from the regular polygon with unit edges."""
    worst = 0
    for loop in loops:
        corner = vertices[loop]
        radius = numpy.linalg.norm(corner - corner.mean(axis=0), axis=1)
        length = numpy.linalg.norm(corner - numpy.roll(corner, 1, axis=0), axis=1)
        worst = max(worst, abs(length - 1).max(), abs(radius - 0.5 / numpy.sin(numpy.pi / len(loop))).max())
    return worst


# ---- Simple families ---------------------------------------------------------------------------------------------
def polygon(n, turn=0, height=0):
    """A regular polygon with unit edges; its first vertex is at the angle `turn`, in units of half of its step."""
    angle = numpy.pi / n * (2 * numpy.arange(n) + turn)
    radius = 0.5 / numpy.sin(numpy.pi / n)
    return numpy.column_stack([radius * numpy.cos(angle), radius * numpy.sin(angle), numpy.full(n, float(height))])


def prism(n):
    return numpy.vstack([polygon(n), polygon(n, height=1)])


def antiprism(n):
    below, above = polygon(n), polygon(n, turn=1)
    across = numpy.linalg.norm(below[0] - above[0])
    return numpy.vstack([below, polygon(n, turn=1, height=numpy.sqrt(1 - across**2))])


# ---- Wythoff's construction --------------------------------------------------------------------------------------
# Products of many reflections are computed with longer numbers, so that their rounding errors vanish in a double.
LONG = numpy.longdouble
PI = 4 * numpy.arctan(LONG(1))


def mirrors(p, q):
    """Unit normals of three mirrors at the angles pi/p, pi/q and pi/2: a lower triangular matrix."""
    x, y = -numpy.cos(PI / p), numpy.sin(PI / p)
    z = -numpy.cos(PI / q) / y
    return numpy.array([[1, 0, 0], [x, y, 0], [0, z, numpy.sqrt(1 - z * z)]], dtype=LONG)


def at_distances(normals, distance):
    """The point at these distances from the mirrors."""
    point = numpy.zeros(3, dtype=LONG)
    for k in range(3):
        point[k] = (distance[k] - normals[k, :k] @ point[:k]) / normals[k, k]
    return point


def orbit(point, moves):
    """All images of a point under the group that the matrices `moves` generate."""
    points = [numpy.array(point, dtype=LONG)]
    for p in points:  # grows in the loop
        for move in moves:
            if (numpy.abs(numpy.array(points) - move @ p).max(axis=1) > NEAR).all():
                points.append(move @ p)
    return numpy.array(points, dtype=float)


def reflections(normals):
    return [numpy.eye(3, dtype=LONG) - 2 * numpy.outer(n, n) for n in numpy.array(normals, dtype=LONG)]


def wythoff(p, q, rings):
    """The images of a point at the distance 1/2 from the mirrors in `rings`, and on the other mirrors."""
    normals = mirrors(p, q)
    return orbit(at_distances(normals, [0.5 if k in rings else 0 for k in range(3)]), reflections(normals))


def snub(p, q):
    """The images under rotations of a point that has the distance 1 from its images in three of them."""
    a, b, c = reflections(mirrors(p, q))
    turns = [a @ b, b @ c, a @ c]
    point = at_distances(mirrors(p, q), [0.4] * 3)
    for _ in range(60):
        gaps = [point - turn @ point for turn in turns]
        slopes = [2 * gap @ (numpy.eye(3) - turn) for gap, turn in zip(gaps, turns)]
        miss = numpy.array([gap @ gap - 1 for gap in gaps], dtype=float)
        point = point - numpy.linalg.solve(numpy.array(slopes, dtype=float), miss)
    return orbit(point, turns)


# ---- One polyhedron from another ---------------------------------------------------------------------------------
def dual(vertices):
    """The polar reciprocal about the centre, with a shortest edge of length 1."""
    centred = vertices - vertices.mean(axis=0)
    loops = faces(centred)
    normals = [normal_of(centred, loop) for loop in loops]
    polar = numpy.array([n / (centred[loop] @ n).mean() for n, loop in zip(normals, loops)])
    return polar / min(numpy.linalg.norm(polar[i] - polar[j]) for i, j in edges(faces(polar)))
