"""The 45 uniform polyhedra and their duals among those of Damasceno, Engel and Glotzer, Science 337, 453 (2012), from
their definitions.

P: Platonic, A: Archimedean, C: Catalan, O: prisms and antiprisms. The numbers of this list are those of the data set
that its authors published with coxeter, science1220869.

`polyhedra()` returns all of them: a dictionary from names to vertices."""

import functools
import pathlib

from polyhedron import antiprism, dual, prism, snub, wythoff


def platonic():
    return [wythoff(3, 3, {0}), wythoff(3, 4, {0}), wythoff(4, 3, {0}), wythoff(3, 5, {0}), wythoff(5, 3, {0})]


def archimedean():
    return [wythoff(4, 3, {1}), wythoff(5, 3, {1}), wythoff(3, 3, {0, 1}), wythoff(3, 4, {0, 1}),
            wythoff(4, 3, {0, 1}), wythoff(3, 5, {0, 1}), wythoff(5, 3, {0, 1}), wythoff(4, 3, {0, 2}),
            wythoff(5, 3, {0, 2}), wythoff(4, 3, {0, 1, 2}), wythoff(5, 3, {0, 1, 2}), snub(4, 3), snub(5, 3)]


def catalan(uniform):
    """In the order of the list, whose pairs of duals have other numbers."""
    return [dual(uniform[k]) for k in range(13)]


@functools.lru_cache(1)
def polyhedra():
    uniform = archimedean()
    straight = [prism(n) for n in (3, 5, 6, 7, 8, 9, 10)] + [antiprism(n) for n in (4, 5, 6, 7, 8, 9, 10)]
    groups = {"P": platonic(), "A": uniform, "C": catalan(uniform), "O": straight}
    return {f"{letter}{number:02}": vertices for letter, group in groups.items()
            for number, vertices in enumerate(group, 1)}


def published():
    """For each name the published numbers of faces, edges and vertices, and the number of polygons of each kind."""
    rows = (line.split() for line in pathlib.Path(__file__).with_name("published.txt").read_text().splitlines())
    return {row[0]: (tuple(map(int, row[2:5])), {int(n): int(count) for n, count in (p.split(":") for p in row[5:])})
            for row in rows}
