"""Writers of the files in which people keep solids."""

import struct

import numpy


def number(x):
    """As many digits as tell the number from its neighbours, in its own precision."""
    return str(x)


def off(vertices, loops):
    return "\n".join(["OFF", f"{len(vertices)} {len(loops)} 0", *(" ".join(map(number, v)) for v in vertices),
                      *(" ".join(map(str, [len(loop), *loop])) for loop in loops), ""])


def obj(vertices, loops):
    return "\n".join([*("v " + " ".join(map(number, v)) for v in vertices),
                      *("f " + " ".join(str(v + 1) for v in loop) for loop in loops), ""])


def triangles(vertices, loops):
    return [numpy.array(vertices)[[loop[0], a, b]] for loop in loops for a, b in zip(loop[1:], loop[2:])]


def text_stl(vertices, loops):
    facets = ["facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {' '.join(map(number, v))}\n" for v in triangle) +
              "endloop\nendfacet\n" for triangle in triangles(vertices, loops)]
    return "solid mine\n" + "".join(facets) + "endsolid mine\n"


def binary_stl(vertices, loops, head=b""):
    every = triangles(vertices, loops)
    return head.ljust(80, b"\0") + struct.pack("<I", len(every)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), 0) for triangle in every)
