"""The 145 polyhedra of Damasceno, Engel and Glotzer, Science 337, 453 (2012), from their definitions.

P: Platonic, A: Archimedean, C: Catalan, J: Johnson's solids in his order, O: prisms, antiprisms and eight others. The
numbers of this list are those of the data set that its authors published with coxeter, science1220869. O22 is the
pyramid whose height is half of its edge, as that list's remark states; its coordinates there are those of J01.

`polyhedra()` returns all of them: a dictionary from names to vertices."""

import functools
import itertools
import pathlib

import numpy

from polyhedron import (antiprism, augmented, cupola, dual, faces, is_regular_faced, normal_of, orbit, polygon, prism,
                        pyramid, reflections, snub, unit_edges, with_sides, wythoff, zonotope)

GOLDEN = (1 + 5**0.5) / 2
META = -1 / 5**0.5  # cosine between two axes of order five that are neither neighbours nor opposite


# ---- Choice of faces ---------------------------------------------------------------------------------------------
def chosen(vertices, sides, number, cosine):
    """Faces with this many sides; the cosine between each two of their normals is the given one."""
    candidates = with_sides(faces(vertices), sides)
    normals = [normal_of(vertices, loop) for loop in candidates]
    for some in itertools.combinations(range(len(candidates)), number):
        if all(abs(normals[i] @ normals[j] - cosine) < 1e-9 for i, j in itertools.combinations(some, 2)):
            return [candidates[k] for k in some]
    raise ValueError("there are no such faces")


def capped(vertices, sides, cap, number=1, cosine=0.0):
    """The same cap on several faces."""
    for loop in chosen(vertices, sides, number, cosine):
        vertices = augmented(vertices, loop, cap)
    return vertices


def stacked(middle, sides, *caps, aligned=None):
    """One cap on each of two opposite faces of `middle`, or on one face. If `aligned` is not None, it states whether
    the faces opposite to the caps' bases have the same direction."""
    loops = chosen(middle, sides, 2, -1.0) if len(caps) == 2 else with_sides(faces(middle), sides)[:1]
    result = augmented(middle, loops[0], caps[0])
    if len(caps) == 1:
        return result
    return augmented(result, loops[1], caps[1], regular_with_tops(normal_of(middle, loops[0]), sides // 2, aligned))


def glued(first, second, sides, aligned=None):
    """Two caps, base on base."""
    base = with_sides(faces(first), sides)[0]
    return augmented(first, base, second, regular_with_tops(normal_of(first, base), sides // 2, aligned))


def regular_with_tops(axis, sides, aligned):
    """A condition for augmented(): all faces are regular, and the tops are aligned or not. None: either will do."""
    return lambda whole: (is_regular_faced(whole) and
                          (aligned is None or aligned == tops_are_aligned(whole, axis, sides)))


def tops_are_aligned(vertices, axis, sides):
    """Tests if the first and last faces along an axis, which have `sides` sides, are shifted copies of each other."""
    height = vertices @ axis
    ends = [vertices[abs(height - end) < 1e-9] for end in (height.min(), height.max())]
    assert [len(end) for end in ends] == [sides, sides]
    flat = [end - end.mean(axis=0) for end in ends]
    return numpy.linalg.norm(flat[0] - flat[1][0], axis=1).min() < 1e-9


def without_vertices(vertices, corners):
    return numpy.delete(vertices, corners, axis=0)


def gyrated(vertices, loop):
    """A pentagon of a rhombicosidodecahedron, rotated by a tenth of a full rotation with the cupola below it."""
    vertices = vertices.copy()
    centre, axis = vertices[loop].mean(axis=0), normal_of(vertices, loop)
    arm = vertices[loop] - centre
    angle = numpy.pi / 5
    vertices[loop] = centre + numpy.cos(angle) * arm + numpy.sin(angle) * numpy.cross(axis, arm)
    return vertices


def changed(ball, gyrations, diminutions, cosine):
    """A rhombicosidodecahedron: some cupolas rotated, others removed."""
    loops = chosen(ball, 5, gyrations + diminutions, cosine)
    for loop in loops[:gyrations]:
        ball = gyrated(ball, loop)
    return without_vertices(ball, [v for loop in loops[gyrations:] for v in loop])


# ---- Families ----------------------------------------------------------------------------------------------------
def platonic():
    return [wythoff(3, 3, {0}), wythoff(3, 4, {0}), wythoff(4, 3, {0}), wythoff(3, 5, {0}), wythoff(5, 3, {0})]


def archimedean():
    return [wythoff(4, 3, {1}), wythoff(5, 3, {1}), wythoff(3, 3, {0, 1}), wythoff(3, 4, {0, 1}),
            wythoff(4, 3, {0, 1}), wythoff(3, 5, {0, 1}), wythoff(5, 3, {0, 1}), wythoff(4, 3, {0, 2}),
            wythoff(5, 3, {0, 2}), wythoff(4, 3, {0, 1, 2}), wythoff(5, 3, {0, 1, 2}), snub(4, 3), snub(5, 3)]


def catalan(uniform):
    """In the order of the list, whose pairs of duals have other numbers."""
    return [dual(uniform[k]) for k in range(13)]


def rotunda():
    """Half of an icosidodecahedron."""
    whole = wythoff(5, 3, {1})
    axis = normal_of(whole, with_sides(faces(whole), 5)[0])
    return whole[whole @ axis > -1e-9]


def by_symmetry(*points, also=None):
    """Images of rough points under these mirrors and the matrix `also`; Newton's method then makes edges equal."""
    moves = reflections(numpy.eye(3)[:2]) + ([] if also is None else [numpy.array(also, dtype=float)])
    return unit_edges(numpy.vstack([orbit(point, moves) for point in points]))


def hebesphenorotunda():
    """The first twelve vertices of an icosidodecahedron along an axis of order three, over a hexagon."""
    whole = wythoff(5, 3, {1})
    axis = normal_of(whole, with_sides(faces(whole), 3)[0])
    height = whole @ axis
    top = whole[numpy.argsort(-height)[:12]]
    x = top[numpy.argsort(-top @ axis)[9]]  # a vertex of the lowest three
    x = x - (x @ axis) * axis
    x /= numpy.linalg.norm(x)
    local = top @ numpy.column_stack([x, numpy.cross(axis, x), axis])
    base = polygon(6, turn=1)
    across = numpy.linalg.norm(local[:, None, :2] - base[None, :, :2], axis=2).min()
    lowest = local[numpy.linalg.norm(local[:, :2] - base[0, :2], axis=1).argmin()]
    return numpy.vstack([local, base + [0, 0, lowest[2] - numpy.sqrt(1 - across**2)]])


def elementary():
    """J84 to J92: no cut along edges divides these into smaller solids with regular faces."""
    quarter, eighth = [[0, 1, 0], [-1, 0, 0], [0, 0, -1]], numpy.sqrt(0.5) * numpy.array([[1, -1, 0], [1, 1, 0],
                                                                                         [0, 0, -(2**0.5)]])
    corona = by_symmetry((0, .5, .52), (.85, .5, 0), (0, .79, -.43), (.5, 0, -.79))
    square = with_sides(faces(corona), 4)[0]
    return [by_symmetry((.5, 0, .78), (0, .64, .21), also=quarter),
            by_symmetry((.5, .5, .68), (1.2, 0, .2), also=eighth),
            corona,
            augmented(corona, square, pyramid(4)),
            by_symmetry((0, .5, .8), (.59, .5, 0), (0, 1.28, .18), (.5, 0, -.86), (0, .86, -.72)),
            by_symmetry((.5, .5, .98), (.72, .5, 0), (0, 1.1, .35), (.5, 0, -.84), (0, .84, -.61)),
            by_symmetry((0, .5, 1.1), (.77, .5, .46), (0, 1.13, .33), also=quarter),
            bilunabirotunda(),
            hebesphenorotunda()]


def bilunabirotunda():
    g = GOLDEN - 1
    points = [(0, 0, 1), (g, 1, g), (GOLDEN, g, 0)]
    return numpy.vstack([orbit(p, reflections(numpy.eye(3))) for p in points]) / (2 * g)


def johnson(uniform):
    """In Johnson's order."""
    drum = rotunda()
    yield from (pyramid(4), pyramid(5), cupola(3), cupola(4), cupola(5), drum)
    yield from (stacked(prism(n), n, pyramid(n)) for n in (3, 4, 5))
    yield from (stacked(antiprism(n), n, pyramid(n)) for n in (4, 5))
    yield from (glued(pyramid(n), pyramid(n), n) for n in (3, 5))
    yield from (stacked(prism(n), n, pyramid(n), pyramid(n)) for n in (3, 4, 5))
    yield stacked(antiprism(4), 4, pyramid(4), pyramid(4))
    for body in (prism, antiprism):
        yield from (stacked(body(2 * n), 2 * n, cupola(n)) for n in (3, 4, 5))
        yield stacked(body(10), 10, drum)
    yield augmented(prism(3), with_sides(faces(prism(3)), 4)[0], prism(3))
    yield glued(cupola(3), cupola(3), 6, True)
    for pair, n in (((cupola(4), cupola(4)), 4), ((cupola(5), cupola(5)), 5), ((cupola(5), drum), 5)):
        yield from (glued(*pair, 2 * n, aligned) for aligned in (True, False))
    yield glued(drum, drum, 10, True)
    yield from (stacked(prism(6), 6, cupola(3), cupola(3), aligned=aligned) for aligned in (True, False))
    yield stacked(prism(8), 8, cupola(4), cupola(4), aligned=False)
    for pair in ((cupola(5), cupola(5)), (cupola(5), drum), (drum, drum)):
        yield from (stacked(prism(10), 10, *pair, aligned=aligned) for aligned in (True, False))
    yield from (stacked(antiprism(2 * n), 2 * n, cupola(n), cupola(n)) for n in (3, 4, 5))
    yield from (stacked(antiprism(10), 10, *pair) for pair in ((cupola(5), drum), (drum, drum)))
    yield from (capped(prism(3), 4, pyramid(4), number, -0.5) for number in (1, 2, 3))
    yield from (capped(prism(5), 4, pyramid(4), number, -GOLDEN / 2) for number in (1, 2))
    yield capped(prism(6), 4, pyramid(4))
    yield capped(prism(6), 4, pyramid(4), 2, -1)
    yield from (capped(prism(6), 4, pyramid(4), number, -0.5) for number in (2, 3))
    yield from on_axes_of_order_five(wythoff(5, 3, {0}), 5, pyramid(5))
    ball = wythoff(3, 5, {0})
    direction = ball / numpy.linalg.norm(ball, axis=1)[:, None]
    apart = next(some for some in itertools.combinations(range(12), 3)
                 if all(abs(direction[i] @ direction[j] - META) < 1e-9 for i, j in itertools.combinations(some, 2)))
    yield without_vertices(ball, apart[:2])
    cut = without_vertices(ball, apart)
    yield cut
    pentagons = with_sides(faces(cut), 5)
    triangle = next(loop for loop in with_sides(faces(cut), 3) if all(len({*loop} & {*p}) == 2 for p in pentagons))
    yield augmented(cut, triangle, pyramid(3))
    yield capped(wythoff(3, 3, {0, 1}), 6, cupola(3))
    yield from (capped(wythoff(4, 3, {0, 1}), 8, cupola(4), number, -1) for number in (1, 2))
    yield from on_axes_of_order_five(wythoff(5, 3, {0, 1}), 10, cupola(5))
    ball = wythoff(5, 3, {0, 2})
    for gyrations, diminutions, cosine in ((1, 0, 0), (2, 0, -1), (2, 0, META), (3, 0, META), (0, 1, 0), (1, 1, -1),
                                           (1, 1, META), (2, 1, META), (0, 2, -1), (0, 2, META), (1, 2, META),
                                           (0, 3, META)):
        yield changed(ball, gyrations, diminutions, cosine)
    yield from elementary()


def on_axes_of_order_five(body, sides, cap):
    yield capped(body, sides, cap)
    yield capped(body, sides, cap, 2, -1)
    yield from (capped(body, sides, cap, number, META) for number in (2, 3))


def others(orthobicupola):
    """Prisms and antiprisms up to ten sides, then eight solids; edges have length 1 if they are all equal."""
    five = wythoff(3, 5, {0})
    axes = numpy.array([v for k, v in enumerate(five) if v[2] > 1e-9 or abs(v[2]) < 1e-9 and v[1] > 0])
    axes /= numpy.linalg.norm(axes[0])
    axes *= numpy.where(axes @ axes[0] < 0, -1.0, 1.0)[:, None]  # all in the half-space about the first one
    three = wythoff(5, 3, {0})
    three = three[three @ numpy.array([0.1, 0.2, 1]) > 0]
    obtuse = numpy.array([axes[1], next(a for a in axes[2:] if a @ axes[1] > 0), axes[0]])
    yield from (prism(n) for n in (3, 5, 6, 7, 8, 9, 10))
    yield from (antiprism(n) for n in (4, 5, 6, 7, 8, 9, 10))
    yield dual(orthobicupola)  # the Voronoi cell of hexagonal close packing
    yield zonotope(axes[1:])
    yield zonotope(three / numpy.linalg.norm(three[0]))
    flat = next(some for some in itertools.combinations(axes[1:], 3) if numpy.prod(pairs(some)) < 0)
    yield zonotope(numpy.array(flat))
    yield zonotope(obtuse)
    yield durer()
    s = numpy.sqrt(3 / 8)
    yield zonotope(numpy.array([(0, 0, 1), (s, s, .5), (s, -s, .5), (-s, s, .5), (-s, -s, .5)]))
    yield numpy.vstack([polygon(4), [0, 0, 0.5]])


def pairs(axes):
    return [a @ b for a, b in itertools.combinations(axes, 2)]


def durer():
    """A rhombohedron with face angles of 72 degrees, cut at two corners so that all vertices lie on a sphere."""
    angle = 2 * numpy.pi / 5
    radius = 2 / 3**0.5 * numpy.sin(angle / 2)
    g = numpy.column_stack([radius * numpy.cos(2 * numpy.pi / 3 * numpy.arange(3)),
                            radius * numpy.sin(2 * numpy.pi / 3 * numpy.arange(3)),
                            numpy.full(3, numpy.sqrt(1 - radius**2))])
    cut = 2 * numpy.cos(angle)
    whole = g.sum(axis=0)
    return numpy.vstack([g, whole - g, cut * g, whole - cut * g])


@functools.lru_cache(1)
def polyhedra():
    uniform = archimedean()
    solids = list(johnson(uniform))
    groups = {"P": platonic(), "A": uniform, "C": catalan(uniform), "J": solids, "O": list(others(solids[26]))}
    return {f"{letter}{number:02}": vertices for letter, group in groups.items()
            for number, vertices in enumerate(group, 1)}


def published():
    """For each name the published numbers of faces, edges and vertices, and the number of polygons of each kind."""
    rows = (line.split() for line in pathlib.Path(__file__).with_name("published.txt").read_text().splitlines())
    return {row[0]: (tuple(map(int, row[2:5])), {int(n): int(count) for n, count in (p.split(":") for p in row[5:])})
            for row in rows}
