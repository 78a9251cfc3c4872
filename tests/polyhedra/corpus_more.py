"""The second part of the corpus: OBJ files, vertices in manifests, and files that are not files of solids."""

import json

import numpy

import files
from corpus import (BINARY_STL, BINARY_STL_WITH_KEYS, BOX, DENTED, FACES, OFF, OFF_WITH_KEYS, SPLIT_EDGE, SUBDIVIDED,
                    TEXT_STL, TEXT_STL_WITH_KEYS, TRIANGLES, TURN, TURNED, TWICE, VERTICES, VOLUME, WELD, Case, binary_stl,
                    chain, drop, either, every, insert, off, own_corners, placed, put, read, refused, same, text_stl)


# ---- OBJ: vertices in lines 1 to 10, faces in lines 11 to 17 ---------------------------------------------------------
def obj(vertices=VERTICES, loops=FACES):
    return files.obj(vertices, loops)


OBJ_VERTEX, OBJ_FACE = slice(0, 10), slice(10, 17)
OBJ = [
    ("plain", same, read()),
    ("returns_and_newlines", lambda text: text.replace("\n", "\r\n"), read()),
    ("byte_order_mark", lambda text: b"\xef\xbb\xbf" + text.encode(), read()),
    ("comment_first", insert(1, "# Blender v3.4\n# www.blender.org"), read()),
    ("comments_after_values", every("$", " # 1"), read()),
    ("blank_lines", every("$", "\n"), read()),
    ("tabs", every(" ", "\t"), read()),
    ("leading_blanks", every("^", "  "), read()),
    ("trailing_blanks", every("$", "  "), read()),
    ("plus_signs", every(r"\b(\d)\b", r"+\1", OBJ_VERTEX), read()),
    ("exponents", every(r"\b(\d)\b", r"\1e0", OBJ_VERTEX), read()),
    ("weights", every("$", " 1.0", OBJ_VERTEX), read()),
    ("colours", every("$", " 1.0 0.5 0.5", OBJ_VERTEX), read()),
    ("names_and_groups", insert(1, "mtllib house.mtl\no house\ng walls\ns off\nusemtl brick"), read()),
    ("normals", chain(insert(11, "vn 0 0 1"), every(r"(?<= )(\d+)", r"\1//1", slice(11, 18))), read()),
    ("textures", chain(insert(11, "vt 0 0"), every(r"(?<= )(\d+)", r"\1/1", slice(11, 18))), read()),
    ("textures_and_normals", chain(insert(11, "vt 0 0\nvn 0 0 1"), every(r"(?<= )(\d+)", r"\1/1/1", slice(12, 19))),
     read()),
    ("indices_from_the_end", every(r"(?<= )(\d+)", lambda m: str(int(m[0]) - 11), OBJ_FACE), read()),
    ("continued_lines", every("^f (.*)", r"f \\\n\1"), either()),
    ("lines_and_points", lambda text: text + "l 1 2\np 3\n", read()),
    ("two_groups", insert(14, "g roof"), read()),
    ("faces_first", lambda text: "\n".join(text.split("\n")[10:17] + text.split("\n")[:10]), either()),
    ("index_zero", put(13, "f 0 1 6 5"), refused(13)),
    ("index_too_large", put(13, "f 1 2 7 11"), refused(13)),
    ("index_too_negative", put(13, "f 1 2 7 -11"), refused(13)),
    ("fractional_index", put(13, "f 1 2 7 6.5"), refused(13)),
    ("word_in_face", put(13, "f 1 2 seven 6"), refused(13)),
    ("face_of_two", insert(18, "f 1 2"), either(18)),
    ("no_faces", drop(11, 7), refused()),
    ("no_vertices", drop(1, 10), refused(1)),
    ("word_in_vertex", put(3, "v 4 two 0"), refused(3, "number")),
    ("nan_in_vertex", put(3, "v 4 nan 0"), refused(3, "number")),
    ("two_coordinates", put(3, "v 4 2"), refused(3)),
    ("vertex_too_far", put(3, "v 4 1e300 0"), refused(3)),
    ("decimal_commas", every(r"\b(\d)\b", r"\1,0", OBJ_VERTEX), refused(1, "number")),
    ("face_missing", drop(14), refused(word="closed")),
    ("unknown_word", insert(1, "quad 1 2 3"), either(1)),
    ("free_form_surface", insert(18, "surf 0 1 0 1 1 2 3 4"), either(18)),
    ("triangles", lambda text: obj(loops=TRIANGLES), read()),
    ("corners_of_each_face", lambda text: obj(*own_corners(VERTICES, FACES)), read()),
    ("face_subdivided", lambda text: obj(*SUBDIVIDED), read()),
    ("edge_subdivided", lambda text: obj(*SPLIT_EDGE), read()),
    ("unused_vertex", insert(11, "v 9 9 9"), read()),
    ("dent", lambda text: obj(DENTED), refused(word="hull")),
    ("two_houses", lambda text: obj(*TWICE), refused()),
    ("far_from_origin", lambda text: obj(placed(origin=1e6)), read()),
    ("corners_apart", lambda text: obj(*own_corners(VERTICES, FACES, 1e-6)), refused(word="merge")),
]
OBJ_WITH_KEYS = [
    ("corners_welded", lambda text: obj(*own_corners(VERTICES, FACES, 1e-6)), read(), WELD),
    ("dent_filled", lambda text: obj(DENTED), BOX, {"hull": True}),
]


# ---- Vertices in a manifest ------------------------------------------------------------------------------------------
def listed(vertices):
    return numpy.asarray(vertices, dtype=float).tolist()


def with_vertex(*more):
    return [*listed(VERTICES), *map(list, more)]


def rounded(digits, vertices=TURNED, origin=0.0):
    """The digits that a person or a program writes."""
    return [[float(f"{x:.{digits - 1}e}") for x in v] for v in listed(vertices + origin)]


TWELVE = (12, 30, 20)
#: Name, value of "vertices", outcome, other keys.
MANIFEST = [
    ("plain", listed(VERTICES), read()),
    ("integers", VERTICES.tolist(), read()),
    ("nanometres", listed(placed(1e-9)), read(volume=50e-27)),
    ("large", listed(placed(1e8)), read(volume=50e24)),
    ("far_from_origin", listed(placed(origin=1e8)), read()),
    ("small_and_far", listed(placed(1e-3, 1.0)), read(volume=50e-9)),
    ("too_far", listed(VERTICES * 1e9), refused()),
    ("vertex_twice", with_vertex((4, 2, 0)), refused(word="twice")),
    ("vertex_nearly_twice", with_vertex((4, 2, 1e-12)), either()),
    ("vertex_inside", with_vertex((2, 1, 1)), refused(word="inside")),
    ("vertex_on_face", with_vertex((2, 1, 0)), refused(word="face")),
    ("vertex_on_edge", with_vertex((2, 0, 0)), refused(word="edge")),
    ("three_vertices", listed(VERTICES[:3]), refused()),
    ("no_vertices", [], refused()),
    ("flat", listed(VERTICES[:5]), refused(word="plane")),
    ("on_a_line", [[k, 2 * k, -k] for k in range(5)], refused()),
    ("in_a_point", [[1, 2, 3]] * 5, refused()),
    ("not_a_list", {"x": 1}, refused()),
    ("text", "0 0 0", refused()),
    ("two_coordinates", with_vertex()[:-1] + [[0, 2]], refused(word="three")),
    ("four_coordinates", with_vertex()[:-1] + [[0, 2, 5, 1]], refused(word="three")),
    ("text_in_vertex", with_vertex()[:-1] + [[0, 2, "5"]], refused(word="number")),
    ("null_in_vertex", with_vertex()[:-1] + [[0, 2, None]], refused(word="number")),
    ("true_in_vertex", with_vertex()[:-1] + [[0, 2, True]], refused(word="number")),
    ("needle", listed(VERTICES * (1, 1, 1e7)), refused()),
    ("sheet", listed(VERTICES * (1, 1, 1e-17)), refused()),
    ("many", [[k, k * k, k**3] for k in range(300)], refused()),
    ("full_digits", listed(TURNED), read(TWELVE, VOLUME)),
    ("inside_filled", with_vertex((2, 1, 1)), read(), {"hull": True}),
    ("on_face_filled", with_vertex((2, 1, 0)), read(), {"hull": True}),
    ("on_edge_filled", with_vertex((2, 0, 0)), read(), {"hull": True}),
    ("twice_filled", with_vertex((4, 2, 0)), read(), {"hull": True}),
    ("nearly_twice_welded", with_vertex((4, 2, 1e-6)), read(), WELD),
    ("three_digits", rounded(3), read(TWELVE, VOLUME), {"merge": 5e-3}),
    ("six_digits", rounded(6), read(TWELVE, VOLUME), {"merge": 1e-5}),
    ("nine_digits", rounded(9), read(TWELVE, VOLUME), {"merge": 1e-8}),
    ("twelve_digits", rounded(12), read(TWELVE, VOLUME), {"merge": 1e-11}),
    ("fifteen_digits_far_away", rounded(15, origin=1e6), read(TWELVE, VOLUME), {"merge": 1e-8}),
    ("merge_zero", listed(VERTICES), either(word="merge"), {"merge": 0}),
    ("merge_null", listed(VERTICES), refused(word="merge"), {"merge": None}),
    ("corners_not_whole", listed(VERTICES), refused(word="corners"), {"corners": 8.5}),
    ("hull_as_text", listed(VERTICES), refused(word="hull"), {"hull": "yes"}),
]


# ---- Surfaces of many faces ------------------------------------------------------------------------------------------
def pitted_cube(width, depth, sides=12):
    """A unit cube with a conical pit in its upper face."""
    corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    angles = numpy.pi / 4 + 2 * numpy.pi * numpy.arange(sides) / sides
    rim = [(0.5 + width / 2 * numpy.cos(a), 0.5 + width / 2 * numpy.sin(a), 1) for a in angles]
    loops = [[3, 2, 1, 0], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    corner = [6, 7, 4, 5]  # of the upper face, beginning near the first point of the rim
    for k in range(sides):
        here, there, near = 8 + k, 8 + (k + 1) % sides, corner[4 * k // sides]
        loops += [[here, near, there], [here, there, 8 + sides]]
        if 4 * (k + 1) // sides > 4 * k // sides:
            loops.append([near, corner[(4 * k // sides + 1) % 4], there])
    return [*corners, *rim, (0.5, 0.5, 1 - depth)], loops


def sphere(rows, columns, bump=0.0):
    """A sphere with vertices on circles of latitude; every other one is moved inwards by `bump`."""
    points, loops = [(0, 0, 1.0)], []
    for r in range(1, rows):
        for c in range(columns):
            u, v = numpy.pi * r / rows, 2 * numpy.pi * c / columns
            length = 1 - bump * ((r + c) % 2)
            points.append((length * numpy.sin(u) * numpy.cos(v), length * numpy.sin(u) * numpy.sin(v),
                           length * numpy.cos(u)))
    points.append((0, 0, -1.0))
    at = lambda r, c: 1 + (r - 1) * columns + c % columns
    for c in range(columns):
        loops += [[0, at(1, c), at(1, c + 1)], [len(points) - 1, at(rows - 1, c + 1), at(rows - 1, c)]]
        for r in range(1, rows - 1):
            loops += [[at(r, c), at(r + 1, c), at(r + 1, c + 1)], [at(r, c), at(r + 1, c + 1), at(r, c + 1)]]
    return points, loops


def with_point_facet(text):
    """A facet with three equal corners at the origin, as some writers add it."""
    return text.replace("endsolid", "facet normal 0 0 0\nouter loop\n" + 3 * "vertex 0 0 0\n" +
                        "endloop\nendfacet\nendsolid")


FAR = 5e5  # 1e5 diameters of the house
CUBE = numpy.array(pitted_cube(0.1, 0)[0][:8]) @ TURN
CENTRES = numpy.array([CUBE[loop].mean(axis=0) for loop in pitted_cube(0.1, 0)[1][:5]])
OUTWARDS = CENTRES - CUBE.mean(axis=0)
#: Name, suffix, content, outcome, other keys.
SURFACES = [
    ("far_facet_without_area", "stl", with_point_facet(text_stl(placed(origin=FAR))), read()),
    ("far_facet_and_dent", "stl", with_point_facet(text_stl(placed(origin=FAR, vertices=DENTED))),
     refused(word="hull")),
    ("far_facet_and_dent_filled", "stl", with_point_facet(text_stl(placed(origin=FAR, vertices=DENTED))), BOX,
     {"hull": True}),
    ("small_pit", "off", off(*pitted_cube(0.01, 0.004)), refused(word="hull")),
    ("pit", "off", off(*pitted_cube(0.3, 0.04)), refused(word="hull")),
    ("pit_merged", "off", off(*pitted_cube(0.3, 0.04)), refused(word="hull"), {"merge": 0.01}),
    ("no_pit", "off", off(*pitted_cube(0.3, 0)), read((6, 12, 8), 1.0)),
    ("dents_merged", "off", off(*sphere(12, 14, 0.1)), refused(word="hull"), {"merge": 0.01}),
    ("sphere_of_3542_points", "off", off(*sphere(60, 60)), refused(word="corners")),
    ("sphere_of_3542_points_merged", "off", off(rounded(7, numpy.array(sphere(60, 60)[0])), sphere(60, 60)[1]),
     refused(word="corners"), {"merge": 1e-5}),
    ("centres_of_faces_outside", None,
     rounded(6, CUBE) + listed(CENTRES + 1e-6 * OUTWARDS), read((6, 12, 8), 1.0), {"merge": 1e-5}),
]


# ---- Other files -----------------------------------------------------------------------------------------------------
#: Name, suffix, content, outcome.
OTHER = [
    ("empty", "off", "", refused()),
    ("zero_bytes", "stl", b"\0" * 2000, refused()),
    ("random_bytes", "stl", numpy.random.default_rng(13).bytes(3000), refused()),
    ("json", "off", json.dumps({"vertices": listed(VERTICES)}), refused()),
    ("ply", "ply", "ply\nformat ascii 1.0\nelement vertex 10\n", refused()),
    ("html", "stl", "<!DOCTYPE html>\n<html><body>404 solid not found</body></html>\n", refused()),
    ("stl_with_suffix_off", "off", text_stl(), read()),
    ("off_with_suffix_stl", "stl", off(), read()),
    ("obj_with_suffix_off", "off", obj(), either()),
    ("binary_with_suffix_obj", "obj", binary_stl(), read()),
    ("long_line", "off", "OFF " + "1 " * 500000, refused()),
    ("many_facets", "stl", text_stl() * 2000, refused()),
    ("vertices_times_faces", "off", "OFF\n100000 100000 0\n" +
     "".join(f"{k} {k * k % 97} {k % 89}\n" for k in range(100000)) + "3 0 1 2\n" * 100000, refused()),
]


def cases():
    """All cases; names are unique and usable as names of solids."""
    text = {"off": (off, OFF, OFF_WITH_KEYS), "stl": (text_stl, TEXT_STL, TEXT_STL_WITH_KEYS),
            "bin": (binary_stl, BINARY_STL, BINARY_STL_WITH_KEYS), "obj": (obj, OBJ, OBJ_WITH_KEYS)}
    result = []
    for kind, (base, plain, with_keys) in text.items():
        suffix = "stl" if kind == "bin" else kind
        for name, change, outcome, *keys in plain + with_keys:
            result.append(Case(f"{kind}_{name}", suffix, change(base()), outcome, *(keys or [{}])))
    for name, suffix, content, outcome, *keys in SURFACES:
        result.append(Case(f"surface_{name}", suffix, content, outcome, *(keys or [{}])))
    for name, vertices, outcome, *keys in MANIFEST:
        result.append(Case(f"list_{name}", None, vertices, outcome, *(keys or [{}])))
    for name, suffix, content, outcome in OTHER:
        result.append(Case(f"other_{name}", suffix, content, outcome, {}))
    return result
