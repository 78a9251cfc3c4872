"""Malformed and unusual files of solids, each with its expected outcome, from short tables of changes to correct files.

Every file means the same solid, a house: a prism over a pentagon, with 7 faces, 15 edges, 10 vertices and the volume
50. An outcome follows from the meaning of the format:
- read(): the file is read as this solid, or as another one that its entry names;
- refused(line, word): the message names this line, if the format has lines, and contains the word;
- either(line): the format leaves it open, and both of these are right. The file must not become another solid."""

import collections
import re
import struct

import numpy

import files
import polyhedron

Outcome = collections.namedtuple("Outcome", "may_read may_refuse line word number volume")
Case = collections.namedtuple("Case", "name suffix content outcome keys")
HOUSE = (7, 15, 10)


def read(number=HOUSE, volume=50.0):
    return Outcome(True, False, None, "", number, volume)


def refused(line=None, word=""):
    return Outcome(False, True, line, word, None, None)


def either(line=None, word=""):
    return Outcome(True, True, line, word, HOUSE, 50.0)


GABLE = [(0, 0), (4, 0), (4, 2), (2, 3), (0, 2)]
VERTICES = numpy.array([(x, y, z) for z in (0, 5) for x, y in GABLE])
FACES = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], [0, 1, 6, 5], [1, 2, 7, 6], [2, 3, 8, 7], [3, 4, 9, 8], [4, 0, 5, 9]]
DENTED = VERTICES.copy()
DENTED[[3, 8], 1] = 1  # the ridge is below the eaves; the hull is a box
BOX = read((6, 12, 8), 40.0)
WELD = {"merge": 1e-4}


# ---- Changes of a text ---------------------------------------------------------------------------------------------
def put(number, line):
    """Another line in place of this one; the first line has the number 1."""
    return lambda text: "\n".join([*text.split("\n")[:number - 1], line, *text.split("\n")[number:]])


def insert(number, line):
    """A line before this one."""
    return lambda text: "\n".join([*text.split("\n")[:number - 1], line, *text.split("\n")[number - 1:]])


def drop(number, count=1):
    return lambda text: "\n".join([*text.split("\n")[:number - 1], *text.split("\n")[number - 1 + count:]])


def every(pattern, text_of, lines=slice(None)):
    """A replacement by a regular expression, in all lines or in some."""
    def change(text):
        all_lines = text.split("\n")
        all_lines[lines] = [re.sub(pattern, text_of, line) for line in all_lines[lines]]
        return "\n".join(all_lines)
    return change


def chain(*changes):
    def change(text):
        for one in changes:
            text = one(text)
        return text
    return change


def same(text):
    return text


def encoded(encoding):
    return lambda text: text.encode(encoding)


def placed(scale=1.0, origin=0.0, vertices=VERTICES):
    return vertices * scale + origin


def own_corners(vertices, loops, jitter=0.0):
    """Each face with vertices of its own; they differ by up to `jitter` from those of other faces."""
    random = numpy.random.default_rng(11)
    corners = numpy.vstack([vertices[loop] for loop in loops]).astype(float)
    corners += jitter * random.uniform(-1, 1, corners.shape)
    first = numpy.cumsum([0] + [len(loop) for loop in loops])
    return corners, [list(range(a, b)) for a, b in zip(first, first[1:])]


def shifted(distance):
    """The house with one corner moved out of its faces."""
    vertices = VERTICES.astype(float)
    vertices[2] += distance * numpy.array([1, 0.3, -0.7])
    return vertices


# ---- OFF: keyword in line 1, numbers in line 2, vertices in lines 3 to 12, faces in lines 13 to 19 -------------------
def off(vertices=VERTICES, loops=FACES):
    return files.off(vertices, loops)


PLAIN_VERTEX, PLAIN_FACE = slice(2, 12), slice(12, 19)
SUBDIVIDED = ([*map(tuple, VERTICES), (2, 0, 2.5)],
              [loop for loop in FACES if loop != [0, 1, 6, 5]] + [[0, 1, 10], [1, 6, 10], [6, 5, 10], [5, 0, 10]])
SPLIT_EDGE = ([*map(tuple, VERTICES), (2, 0, 0)],
              [[4, 3, 2, 1, 10, 0], *FACES[1:2], [0, 10, 1, 6, 5], *FACES[3:]])
TRIANGLES = [[loop[0], a, b] for loop in FACES for a, b in zip(loop[1:], loop[2:])]
TWICE = (numpy.vstack([VERTICES, VERTICES + 10]), FACES + [[v + 10 for v in loop] for loop in FACES])

OFF = [
    ("plain", same, read()),
    ("returns_and_newlines", lambda text: text.replace("\n", "\r\n"), read()),
    ("returns_only", lambda text: text.replace("\n", "\r"), read()),
    ("byte_order_mark", lambda text: b"\xef\xbb\xbf" + text.encode(), read()),
    ("utf16", encoded("utf-16"), refused(word="text")),
    ("comment_first", insert(1, "# written by a script"), read()),
    ("comments_after_values", every("$", " # 1 2 3"), read()),
    ("blank_lines", every("$", "\n"), read()),
    ("tabs", every(" ", "\t"), read()),
    ("trailing_blanks", every("$", "  "), read()),
    ("leading_blanks", every("^", "   "), read()),
    ("no_newline_at_end", str.rstrip, read()),
    ("counts_on_first_line", lambda text: text.replace("OFF\n", "OFF ", 1), read()),
    ("no_keyword", drop(1), either()),
    ("small_keyword", put(1, "off"), either()),
    ("other_keyword", put(1, "PLY"), refused(word="OFF")),
    ("edge_count_zero", put(2, "10 7 0"), read()),
    ("edge_count_wrong", put(2, "10 7 99"), read()),
    ("no_edge_count", put(2, "10 7"), either(2)),
    ("no_counts", drop(2), refused()),
    ("letter_in_counts", put(2, "10 f7 15"), either(2)),
    ("fraction_in_counts", put(2, "10.5 7 15"), refused(2)),
    ("negative_count", put(2, "-10 7 15"), refused(2)),
    ("huge_counts", put(2, "4000000000 7 15"), refused(2)),
    ("too_many_faces", put(2, "10 99999999999999999999 15"), refused(2)),
    ("one_vertex_less", put(2, "9 7 15"), refused()),
    ("one_vertex_more", put(2, "11 7 15"), refused()),
    ("one_face_less", put(2, "10 6 15"), refused(19, "continues")),
    ("one_face_more", put(2, "10 8 15"), refused()),
    ("face_missing", chain(put(2, "10 6 15"), drop(16)), refused(word="closed")),
    ("cut_in_faces", drop(17, 4), refused()),
    ("cut_in_vertices", drop(9, 12), refused()),
    ("only_keyword", lambda text: "OFF\n", refused()),
    ("plus_signs", every(r"\b(\d)\b", r"+\1", PLAIN_VERTEX), read()),
    ("exponents", every(r"\b(\d)\b", r"\1.0E+00", PLAIN_VERTEX), read()),
    ("points_without_digits", every(r"\b(\d)\b", r"\1.", PLAIN_VERTEX), read()),
    ("fortran_exponents", every(r"\b(\d)\b", r"\1.0D+00", PLAIN_VERTEX), refused(3, "number")),
    ("decimal_commas", every(r"\b(\d)\b", r"\1,0", PLAIN_VERTEX), refused(3, "number")),
    ("commas_between", every(" ", ", ", PLAIN_VERTEX), refused(3, "number")),
    ("hexadecimal", put(4, "0x4 0 0"), refused(4, "number")),
    ("word_in_vertex", put(5, "4 two 0"), refused(5, "number")),
    ("nan_in_vertex", put(5, "4 nan 0"), refused(5, "number")),
    ("infinite_vertex", put(6, "2 3 inf"), refused(6, "number")),
    ("vertex_too_far", put(6, "2 3 1e300"), refused(6)),
    ("two_coordinates", put(5, "4 2"), refused()),
    ("four_coordinates", every("$", " 1", PLAIN_VERTEX), either()),
    ("colours_of_vertices", chain(put(1, "COFF"), every("$", " 255 128 0 255", PLAIN_VERTEX)), read()),
    ("colours_without_header", every("$", " 0.5 0.5 0.5", PLAIN_VERTEX), either(3)),
    ("normals", chain(put(1, "NOFF"), every("$", " 0 0 1", PLAIN_VERTEX)), read()),
    ("normals_and_colours", chain(put(1, "CNOFF"), every("$", " 0 0 1 1 0 0 1", PLAIN_VERTEX)), read()),
    ("textures", chain(put(1, "STOFF"), every("$", " 0.5 0.5", PLAIN_VERTEX)), read()),
    ("four_dimensions", chain(put(1, "4OFF"), every("$", " 1", PLAIN_VERTEX)), refused(1)),
    ("binary_off", put(1, "OFF BINARY"), refused(1)),
    ("colours_of_faces", every("$", " 255 0 0", PLAIN_FACE), read()),
    ("fractional_colours_of_faces", every("$", " 0.9 0.1 0.1 1.0", PLAIN_FACE), read()),
    ("colour_index_of_faces", every("$", " 3", PLAIN_FACE), read()),
    ("index_from_one", every(r"(?<= )\d+", lambda m: str(int(m[0]) + 1), PLAIN_FACE), refused(14, "vertex")),
    ("index_too_large", put(15, "4 0 1 6 10"), refused(15, "vertex")),
    ("negative_index", put(15, "4 0 1 6 -5"), refused(15)),
    ("fractional_index", put(15, "4 0 1 6 5.0"), either(15)),
    ("face_too_short", put(15, "4 0 1 6"), refused()),
    ("face_of_two", chain(put(2, "10 8 15"), insert(20, "2 0 1")), either()),
    ("face_of_none", chain(put(2, "10 8 15"), insert(20, "0")), either()),
    ("colon_after_count", put(13, "5: 4 3 2 1 0"), refused(13)),
    ("vertex_twice_in_face", put(13, "6 4 3 2 1 1 0"), either(13)),
    ("face_in_wrong_order", put(13, "5 4 2 3 1 0"), refused()),
    ("face_twice", chain(put(2, "10 8 15"), insert(20, "5 5 6 7 8 9")), either()),
    ("one_face_inverted", put(13, "5 0 1 2 3 4"), either()),
    ("all_faces_inverted", lambda text: off(loops=[loop[::-1] for loop in FACES]), read()),
    ("text_after_end", lambda text: text + "written by a script\n", either(20)),
    ("triangles", lambda text: off(loops=TRIANGLES), read()),
    ("corners_of_each_face", lambda text: off(*own_corners(VERTICES, FACES)), read()),
    ("face_subdivided", lambda text: off(*SUBDIVIDED), read()),
    ("edge_subdivided", lambda text: off(*SPLIT_EDGE), read()),
    ("unused_vertex", chain(put(2, "11 7 15"), insert(13, "9 9 9")), read()),
    ("unused_vertex_inside", chain(put(2, "11 7 15"), insert(13, "2 1 1")), read()),
    ("two_houses", lambda text: off(*TWICE), refused()),
    ("dent", lambda text: off(DENTED), refused(word="hull")),
    ("flat", lambda text: off(VERTICES * (1, 1, 0)), refused()),
    ("on_a_line", lambda text: off(VERTICES * (1, 0, 0)), refused()),
    ("in_a_point", lambda text: off(VERTICES * 0), refused()),
    ("face_bent", lambda text: off(shifted(0.1)), refused()),
    ("nanometres", lambda text: off(placed(1e-9)), read(volume=50e-27)),
    ("large", lambda text: off(placed(1e8)), read(volume=50e24)),
    ("far_from_origin", lambda text: off(placed(origin=1e6)), read()),
    ("many_digits", every(r"\b(\d)\b", r"\1.00000000000000000000000000", PLAIN_VERTEX), read()),
    ("corners_apart", lambda text: off(*own_corners(VERTICES, FACES, 1e-6)), refused(word="merge")),
]
OFF_WITH_KEYS = [
    ("corners_welded", lambda text: off(*own_corners(VERTICES, FACES, 1e-6)), read(), WELD),
    ("corner_shifted_and_merged", lambda text: off(shifted(1e-6)), read(), WELD),
    ("dent_filled", lambda text: off(DENTED), BOX, {"hull": True}),
    ("face_missing_from_hull", chain(put(2, "10 6 15"), drop(16)), read(), {"hull": True}),
    ("two_houses_far_apart_welded", lambda text: off(*TWICE), refused(), WELD),
    ("plain_with_merge", same, read(), WELD),
    ("merge_too_large", same, refused(word="merge"), {"merge": 0.7}),
    ("merge_negative", same, refused(word="merge"), {"merge": -1e-5}),
    ("merge_as_text", same, refused(word="merge"), {"merge": "1e-5"}),
    ("hull_as_number", same, refused(word="hull"), {"hull": 1}),
    ("corners_as_many", same, read(), {"corners": 10}),
    ("corners_too_few", same, refused(word="corners"), {"corners": 3}),
    ("unknown_key", same, refused(word="weld"), {"weld": 1e-5}),
]


# ---- Text STL: facets of seven lines, from line 2 on; vertices in their lines 3 to 5 --------------------------------
def text_stl(vertices=VERTICES, loops=FACES):
    return files.text_stl(vertices, loops)


def apart(jitter):
    return own_corners(VERTICES.astype(float), TRIANGLES, jitter)


FIRST_VERTEX = 4
TEXT_STL = [
    ("plain", same, read()),
    ("upper_case", str.upper, read()),
    ("leading_blanks", every("^", "   "), read()),
    ("leading_tabs", every("^", "\t"), read()),
    ("blank_lines", every("$", "\n"), read()),
    ("returns_and_newlines", lambda text: text.replace("\n", "\r\n"), read()),
    ("returns_only", lambda text: text.replace("\n", "\r"), read()),
    ("byte_order_mark", lambda text: b"\xef\xbb\xbf" + text.encode(), read()),
    ("utf16", encoded("utf-16"), refused()),
    ("plus_signs", every(r"\b(\d)\b", r"+\1"), read()),
    ("exponents", every(r"\b(\d)\b", r"\1.000000e+00"), read()),
    ("fortran_exponents", every(r"\b(\d)\b", r"\1.0D+00"), refused(word="number")),
    ("decimal_commas", every(r"\b(\d)\b", r"\1,0"), refused(word="number")),
    ("name_with_vertex", put(1, "solid vertex 1 2 3"), read()),
    ("name_with_facet", put(1, "solid facet normal 0 0 1"), read()),
    ("name_with_endsolid", put(1, "solid endsolid"), read()),
    ("no_name", put(1, "solid"), read()),
    ("name_in_utf8", put(1, "solid Häuschen"), read()),
    ("no_endsolid", lambda text: text.replace("endsolid mine\n", ""), read()),
    ("other_name_at_end", lambda text: text.replace("endsolid mine", "endsolid yours"), read()),
    ("text_after_end", lambda text: text + "\n\n# made with care\n", either()),
    ("zero_bytes_after_end", lambda text: text + "\0\0\0\0", either()),
    ("words_on_one_line", lambda text: "solid mine\n" + " ".join(text.split("\n")[1:]), either()),
    ("nan_normals", every("normal 0 0 0", "normal nan nan nan"), read()),
    ("wrong_normals", every("normal 0 0 0", "normal 1 0 0"), read()),
    ("no_normals", every("facet normal 0 0 0", "facet"), either(2)),
    ("short_normals", every("normal 0 0 0", "normal 0 0"), either(3)),
    ("two_solids", lambda text: text.replace("endloop\nendfacet\n", "endloop\nendfacet\nendsolid a\nsolid b\n", 1),
     either()),
    ("facet_missing", drop(9, 7), refused(word="closed")),
    ("facet_twice", lambda text: text.replace("endsolid", "\n".join(text.split("\n")[1:8]) + "\nendsolid"), either()),
    ("facet_inverted", lambda text: text_stl(loops=[FACES[0][::-1], *FACES[1:]]), either()),
    ("facet_without_area", insert(9, "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 4 0 0\n"
                                     "endloop\nendfacet"), read()),
    ("two_vertices", drop(FIRST_VERTEX), refused()),
    ("four_vertices", insert(FIRST_VERTEX, "vertex 0 0 1"), refused()),
    ("two_coordinates", put(FIRST_VERTEX, "vertex 0 2"), refused(FIRST_VERTEX + 1, "number")),
    ("four_coordinates", every("(vertex .*)$", r"\1 1"), either(FIRST_VERTEX)),
    ("word_in_vertex", put(FIRST_VERTEX, "vertex 0 two 0"), refused(FIRST_VERTEX, "number")),
    ("nan_in_vertex", put(FIRST_VERTEX, "vertex 0 nan 0"), refused(FIRST_VERTEX, "number")),
    ("infinite_vertex", put(FIRST_VERTEX, "vertex 0 -inf 0"), refused(FIRST_VERTEX, "number")),
    ("vertex_too_far", put(FIRST_VERTEX, "vertex 0 1e300 0"), refused(FIRST_VERTEX)),
    ("cut_in_facet", lambda text: "\n".join(text.split("\n")[:60]), refused()),
    ("only_first_line", lambda text: "solid mine\n", refused()),
    ("no_facets", lambda text: "solid mine\nendsolid mine\n", refused()),
    ("empty", lambda text: "", refused()),
    ("blanks", lambda text: " \n \n", refused()),
    ("misspelt_vertex", every("vertex", "vertx", slice(3, 4)), refused()),
    ("no_endfacet", drop(8), either()),
    ("dent", lambda text: text_stl(DENTED), refused(word="hull")),
    ("two_houses", lambda text: text_stl(*TWICE), refused()),
    ("flat", lambda text: text_stl(VERTICES * (1, 1, 0)), refused()),
    ("large", lambda text: text_stl(placed(1e8)), read(volume=50e24)),
    ("nanometres", lambda text: text_stl(placed(1e-9)), read(volume=50e-27)),
    ("far_from_origin", lambda text: text_stl(placed(origin=1e6)), read()),
    ("corners_apart", lambda text: text_stl(*apart(1e-6)), refused(word="merge")),
    ("corners_far_apart", lambda text: text_stl(*apart(0.05)), refused()),
]
TEXT_STL_WITH_KEYS = [
    ("corners_welded", lambda text: text_stl(*apart(1e-6)), read(), WELD),
    ("dent_filled", lambda text: text_stl(DENTED), BOX, {"hull": True}),
]


# ---- Binary STL: 80 bytes, the number of triangles, 50 bytes for each -----------------------------------------------
TRIANGLE, HEAD = 50, 84


def binary_stl(vertices=VERTICES, loops=FACES, head=b""):
    return files.binary_stl(vertices, loops, head)


def count(number):
    return lambda data: data[:80] + struct.pack("<I", number) + data[84:]


def floats(at, *values):
    """Other numbers in the first triangle; its normal is at 0, its first corner at 3."""
    begin = HEAD + 4 * at
    return lambda data: data[:begin] + struct.pack(f"<{len(values)}f", *values) + data[begin + 4 * len(values):]


def attribute(data):
    return data[:HEAD] + b"".join(data[k:k + 48] + b"\xff\x7f" for k in range(HEAD, len(data), TRIANGLE))


DODECAHEDRON = polyhedron.wythoff(5, 3, {0})
DODECAHEDRON_FACES = polyhedron.faces(DODECAHEDRON)
TURN = numpy.linalg.qr(numpy.random.default_rng(12).normal(size=(3, 3)))[0]
TURNED = DODECAHEDRON @ TURN
BINARY_STL = [
    ("plain", same, read()),
    ("head_solid", lambda data: binary_stl(head=b"solid mine"), read()),
    ("head_solid_and_lines", lambda data: binary_stl(head=b"solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n"),
     read()),
    ("head_colour", lambda data: binary_stl(head=b"COLOR=\xff\xff\xff\xff"), read()),
    ("head_off", lambda data: binary_stl(head=b"OFF"), read()),
    ("head_blanks", lambda data: binary_stl(head=b" " * 80), read()),
    ("attributes", attribute, read()),
    ("nan_normals", floats(0, *[float("nan")] * 3), read()),
    ("trailing_bytes", lambda data: data + b"\0" * 7, either()),
    ("trailing_text", lambda data: data + b"made with care", either()),
    ("head_solid_trailing_bytes", lambda data: binary_stl(head=b"solid mine") + b"\0" * 7, either()),
    ("count_too_large", count(17), refused()),
    ("count_too_small", count(15), refused()),
    ("count_zero", count(0), refused()),
    ("count_huge", count(0xFFFFFFFF), refused()),
    ("count_of_other_machine", lambda data: data[:80] + data[83:79:-1] + data[84:], refused()),
    ("cut_by_one_byte", lambda data: data[:-1], refused()),
    ("cut_in_head", lambda data: data[:70], refused()),
    ("only_head", lambda data: data[:HEAD], refused()),
    ("triangle_missing", lambda data: count(15)(data[:-TRIANGLE]), refused(word="closed")),
    ("triangle_twice", lambda data: count(17)(data + data[-TRIANGLE:]), either()),
    ("triangle_without_area", lambda data: count(17)(data + b"\0" * TRIANGLE), read()),
    ("nan_in_corner", floats(3, float("nan")), refused()),
    ("infinite_corner", floats(4, float("inf")), refused()),
    ("corner_too_far", floats(4, 3e38), refused()),
    ("dent", lambda data: binary_stl(DENTED), refused(word="hull")),
    ("two_houses", lambda data: binary_stl(*TWICE), refused()),
    ("nanometres", lambda data: binary_stl(placed(1e-9)), read(volume=50e-27)),
    ("corners_apart", lambda data: binary_stl(*apart(1e-6)), refused(word="merge")),
]
VOLUME = polyhedron.volume(DODECAHEDRON, DODECAHEDRON_FACES)
BINARY_STL_WITH_KEYS = [
    ("corners_welded", lambda data: binary_stl(*apart(1e-6)), read(), WELD),
    ("dodecahedron", lambda data: binary_stl(TURNED, DODECAHEDRON_FACES), read((12, 30, 20), VOLUME), WELD),
]
