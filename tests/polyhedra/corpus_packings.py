"""Malformed and unusual files of packings, extended XYZ and GSD, each with its expected outcome.

Every file means 64 octahedra of unit volume on a cubic lattice. Octahedra of any orientation do not touch there. The
outcomes are those of corpus.py; an accepted file needs no further number."""

import itertools

import gsd.hoomd
import numpy

from corpus import chain, either, every, insert, put, read, refused, same
from polyhedron import wythoff

N, SIDE = 64, 7.4
EDGE = (3 / 2**0.5) ** (1 / 3)
OCTAHEDRON = wythoff(3, 4, {0}) * EDGE
POSITIONS = numpy.array(list(itertools.product((numpy.arange(4) + 0.5) * SIDE / 4 - SIDE / 2, repeat=3)))
QUATERNIONS = numpy.random.default_rng(14).normal(size=(N, 4))
QUATERNIONS /= numpy.linalg.norm(QUATERNIONS, axis=1)[:, None]
FREE = {"protocol": {"cell": "free"}}

# ---- Extended XYZ: number in line 1, keys in line 2, particles in lines 3 to 66 --------------------------------------
LATTICE = f'Lattice="{SIDE} 0 0 0 {SIDE} 0 0 0 {SIDE}"'
PROPERTIES = "Properties=species:S:1:pos:R:3:orientation:R:4"
PARTICLES, LINE = slice(2, N + 2), 7


def xyz():
    rows = [" ".join(["octahedron", *(f"{x:.9f}" for x in (*p, *q[[1, 2, 3, 0]]))])
            for p, q in zip(POSITIONS, QUATERNIONS)]
    return "\n".join([str(N), f"{LATTICE} {PROPERTIES}", *rows, ""])


def head(lattice=LATTICE, properties=PROPERTIES, more=""):
    return put(2, f"{lattice} {properties} {more}".strip())


def lattice(*numbers):
    return f'Lattice="{" ".join(map(str, numbers))}"'


def column(k, text):
    """Another text in a column of the particle in line 7."""
    def change(text_of_file):
        lines = text_of_file.split("\n")
        words = lines[LINE - 1].split()
        words[k:k + 1] = [text]
        lines[LINE - 1] = " ".join(words)
        return "\n".join(lines)
    return change


XYZ = [
    ("plain", same, read()),
    ("returns_and_newlines", lambda text: text.replace("\n", "\r\n"), read()),
    ("byte_order_mark", lambda text: b"\xef\xbb\xbf" + text.encode(), read()),
    ("tabs", every(" ", "\t", PARTICLES), read()),
    ("tab_between_keys", put(2, f"{LATTICE}\t{PROPERTIES}"), read()),
    ("small_letters_in_keys", every("Lattice|Properties", lambda m: m[0].lower()), read()),
    ("capital_letters_in_keys", every("Lattice|Properties", lambda m: m[0].upper()), either(2)),
    ("properties_first", put(2, f"{PROPERTIES} {LATTICE}"), read()),
    ("periodic_key", head(more='pbc="T T T"'), read()),
    ("open_boundaries", head(more='pbc="F F F"'), either(2)),
    ("comment_with_keys", head(f'comment="the Lattice=1 and Properties=pos:R:3" {LATTICE}'), read()),
    ("comment_with_quotes", head(more=r'comment="a \"quoted\" word"'), read()),
    ("single_quotes", head(LATTICE.replace('"', "'")), either(2)),
    ("braces", head(LATTICE.replace('="', "={")[:-1] + "}"), either(2)),
    ("plus_signs", every(r" (\d)", r" +\1", PARTICLES), read()),
    ("exponents", every(r"(\.\d+)", r"\1e+00", PARTICLES), read()),
    ("further_property", chain(head(properties=PROPERTIES + ":mass:R:1"), every("$", " 1.0", PARTICLES)), read()),
    ("equal_sizes", chain(head(properties=PROPERTIES + ":size:R:1"), every("$", " 1.0", PARTICLES)), read()),
    ("other_unit", chain(head(properties=PROPERTIES + ":size:R:1"), every("$", " 1.01", PARTICLES)), read()),
    ("two_sizes", chain(head(properties=PROPERTIES + ":size:R:1"), every("$", " 1.0", PARTICLES),
                        column(8, "0.5")), refused(word="size")),
    ("negative_size", chain(head(properties=PROPERTIES + ":size:R:1"), every("$", " -1.0", PARTICLES)),
     refused(3, "size")),
    ("blank_lines_after_end", lambda text: text + "\n\n", read()),
    ("two_frames", lambda text: text + text, read()),
    ("second_frame_cut", lambda text: text + "\n".join(text.split("\n")[:9]), refused()),
    ("particles_of_one_solid_less", put(1, "63"), refused()),
    ("one_line_missing", put(1, "65"), refused()),
    ("word_as_number", put(1, "many"), refused(1)),
    ("fraction_as_number", put(1, "64.5"), refused(1)),
    ("no_particles", put(1, "0"), refused(1)),
    ("huge_number", put(1, "1000000000000"), refused(1)),
    ("no_lattice", put(2, PROPERTIES), refused(2, "Lattice")),
    ("lattice_of_eight", head(lattice(*[SIDE, 0, 0, 0, SIDE, 0, 0, 0])), refused(2, "Lattice")),
    ("lattice_of_words", head(lattice(*"abcdefghi")), refused(2, "number")),
    ("lattice_nan", head(lattice(SIDE, 0, 0, 0, "nan", 0, 0, 0, SIDE)), refused(2, "number")),
    ("lattice_flat", head(lattice(SIDE, 0, 0, 0, 0, 0, 0, 0, SIDE)), refused()),
    ("lattice_huge", head(lattice(1e30, 0, 0, 0, 1e30, 0, 0, 0, 1e30)), refused()),
    ("lattice_too_small", head(lattice(2, 0, 0, 0, 2, 0, 0, 0, 2)), refused()),
    ("lattice_skew", head(lattice(SIDE, 0, 0, 1, SIDE, 0, 0, 0, SIDE)), refused(word="free")),
    ("lattice_skew_and_free", head(lattice(SIDE, 0, 0, .1, SIDE, 0, 0, 0, SIDE)), read(), FREE),
    ("no_properties", put(2, LATTICE), refused(2, "Properties")),
    ("no_orientation", head(properties="Properties=species:S:1:pos:R:3"), refused(2, "orientation")),
    ("no_species", head(properties="Properties=pos:R:3:orientation:R:4"), refused(2, "species")),
    ("no_positions", head(properties="Properties=species:S:1:orientation:R:4"), refused(2, "pos")),
    ("orientation_of_three", head(properties="Properties=species:S:1:pos:R:3:orientation:R:3"), refused(2)),
    ("properties_incomplete", head(properties="Properties=species:S:1:pos:R"), refused(2)),
    ("unknown_species", every("^octahedron", "sphere", PARTICLES), refused(word="sphere")),
    ("one_other_species", column(0, "cube"), refused(word="cube")),
    ("line_too_short", column(7, ""), refused(LINE)),
    ("line_too_long", column(8, "0.5 0.5"), refused(LINE)),
    ("blank_line_between", insert(LINE, ""), refused(word="number of particles")),
    ("word_in_position", column(1, "left"), refused(LINE, "number")),
    ("nan_position", column(2, "nan"), refused(LINE, "number")),
    ("infinite_position", column(3, "inf"), refused(LINE, "number")),
    ("position_far_away", column(3, "1e30"), refused()),
    ("decimal_commas", every(r"(\d)\.(\d)", r"\1,\2", PARTICLES), refused(3, "number")),
    ("nan_orientation", column(5, "nan"), refused(LINE, "number")),
    ("no_rotation", every(r"^(\S+ \S+ \S+ \S+).*", r"\1 0 0 0 0", slice(LINE - 1, LINE)), refused(LINE)),
    ("quaternions_not_normalised", every(r"^(\S+ \S+ \S+ \S+).*", r"\1 0 0 0 2", PARTICLES), refused(3, "length")),
    ("two_at_one_place", every(r"^(\S+) \S+ \S+ \S+", rf"\1 {' '.join(map(str, POSITIONS[0]))}",
                               slice(LINE - 1, LINE)), refused(word="overlap")),
    ("empty", lambda text: "", refused()),
    ("only_first_line", lambda text: "64\n", refused()),
    ("zero_bytes", lambda text: b"\0" * 500, refused()),
]


# ---- GSD -------------------------------------------------------------------------------------------------------------
def frame(types=("octahedron",), shapes=None, box=(SIDE, SIDE, SIDE, 0, 0, 0), positions=POSITIONS,
          orientations=QUATERNIONS, typeid=None, dimensions=3):
    result = gsd.hoomd.Frame() if hasattr(gsd.hoomd, "Frame") else gsd.hoomd.Snapshot()
    result.configuration.box, result.configuration.dimensions = list(box), dimensions
    particles = result.particles
    particles.N, particles.types, particles.position = len(positions), list(types), positions
    particles.type_shapes = shapes
    particles.orientation = orientations
    particles.typeid = numpy.zeros(len(positions), dtype=numpy.uint32) if typeid is None else typeid
    return result


def polyhedron_shape(vertices=OCTAHEDRON, **more):
    return [{"type": "ConvexPolyhedron", "rounding_radius": 0, "vertices": numpy.asarray(vertices).tolist(), **more}]


def with_nan(k):
    box = [SIDE, SIDE, SIDE, 0, 0, 0]
    box[k] = float("nan")
    return box


def changed(array, value):
    array = numpy.array(array)
    array[5] = value
    return array


NAN, INF = float("nan"), float("inf")
CUBE = wythoff(4, 3, {0})
TYPES = {"start": {"types": {"A": "octahedron"}}}
#: Name, arguments of frame(), outcome.
GSD = [
    ("plain", {}, read()),
    ("shape", {"types": ["A"], "shapes": polyhedron_shape()}, read()),
    ("shape_in_other_unit", {"types": ["A"], "shapes": polyhedron_shape(7 * OCTAHEDRON + 3), "positions": 7 * POSITIONS,
                             "box": [7 * SIDE] * 3 + [0] * 3}, read()),
    ("shape_in_other_order", {"types": ["A"], "shapes": polyhedron_shape(OCTAHEDRON[::-1])}, read()),
    ("shape_with_other_name", {"types": ["cube"], "shapes": polyhedron_shape()}, read()),
    ("shape_of_other_solid", {"shapes": polyhedron_shape(CUBE)}, refused()),
    ("shape_with_inner_point", {"types": ["A"], "shapes": polyhedron_shape([*OCTAHEDRON, (0, 0, 0)])}, either()),
    ("shape_nearly_the_solid", {"types": ["A"], "shapes": polyhedron_shape(OCTAHEDRON * (1, 1, 1.1))}, refused()),
    ("sphere_named_octahedron", {"shapes": [{"type": "Sphere", "diameter": 1}]}, refused(word="Sphere")),
    ("ellipsoid_named_octahedron", {"shapes": [{"type": "Ellipsoid", "a": 1, "b": 1, "c": 1}]}, refused()),
    ("polygon_named_octahedron", {"shapes": [{"type": "Polygon", "vertices": [[0, 0], [1, 0], [0, 1]]}]}, refused()),
    ("mesh_named_octahedron", {"shapes": [{"type": "Mesh", "vertices": OCTAHEDRON.tolist(), "indices": [[0, 1, 2]]}]},
     either()),
    ("union_named_octahedron", {"shapes": [{"type": "SphereUnion", "diameters": [1], "centers": [[0, 0, 0]]}]},
     refused()),
    ("empty_shape", {"shapes": [{}]}, read()),
    ("empty_shape_of_type_a", {"types": ["A"], "shapes": [{}]}, refused(word="types")),
    ("rounded", {"shapes": polyhedron_shape(rounding_radius=0.1)}, refused(word="round")),
    ("shape_without_vertices", {"types": ["A"], "shapes": polyhedron_shape([])}, refused()),
    ("shape_of_two_coordinates", {"types": ["A"], "shapes": polyhedron_shape(OCTAHEDRON[:, :2])}, refused()),
    ("type_a", {"types": ["A"]}, refused(word="types")),
    ("type_a_named", {"types": ["A"]}, read(), TYPES),
    ("type_b_not_named", {"types": ["B"]}, refused(word="types"), TYPES),
    ("unused_type", {"types": ["octahedron", "B"]}, read()),
    ("two_dimensions", {"dimensions": 2, "box": [SIDE, SIDE, 1, 0, 0, 0]}, refused()),
    ("two_dimensions_thick", {"dimensions": 2}, refused()),
    ("nan_lx", {"box": with_nan(0)}, refused()),
    ("nan_ly", {"box": with_nan(1)}, refused()),
    ("nan_lz", {"box": with_nan(2)}, refused()),
    ("nan_xy", {"box": with_nan(3)}, refused()),
    ("nan_xz", {"box": with_nan(4)}, refused()),
    ("nan_yz", {"box": with_nan(5)}, refused()),
    ("infinite_box", {"box": [INF, INF, INF, 0, 0, 0]}, refused()),
    ("negative_box", {"box": [-SIDE, SIDE, SIDE, 0, 0, 0]}, refused()),
    ("no_box", {"box": [0] * 6}, refused()),
    ("huge_box", {"box": [1e30, 1e30, 1e30, 0, 0, 0]}, refused()),
    ("box_too_small", {"box": [2, 2, 2, 0, 0, 0]}, refused()),
    ("no_cube", {"box": [SIDE, SIDE, SIDE + 1, 0, 0, 0]}, refused(word="free")),
    ("no_cube_and_free", {"box": [SIDE, SIDE, SIDE + 0.1, 0, 0, 0]}, read(), FREE),
    ("tilted", {"box": [SIDE, SIDE, SIDE, 0.1, 0, 0]}, refused(word="free")),
    ("outside_of_box", {"positions": POSITIONS + 3 * SIDE}, read()),
    ("nan_position", {"positions": changed(POSITIONS, NAN)}, refused()),
    ("infinite_position", {"positions": changed(POSITIONS, INF)}, refused()),
    ("two_at_one_place", {"positions": changed(POSITIONS, POSITIONS[0])}, refused(word="overlap")),
    ("nan_orientation", {"orientations": changed(QUATERNIONS, NAN)}, refused()),
    ("no_rotation", {"orientations": changed(QUATERNIONS, 0)}, refused()),
    ("no_orientations", {"orientations": None}, read()),
    ("orientations_not_normalised", {"orientations": 3 * QUATERNIONS}, refused(word="length")),
    ("undefined_type", {"typeid": changed(numpy.zeros(N, dtype=numpy.uint32), 3)}, refused()),
    ("half_as_many", {"positions": POSITIONS[:32], "orientations": QUATERNIONS[:32]}, refused()),
    ("many_types", {"types": [f"t{k}" for k in range(300000)], "typeid": numpy.arange(N, dtype=numpy.uint32)},
     refused()),
]


def write_gsd(path, arguments):
    with gsd.hoomd.open(str(path), "wb" if hasattr(gsd.hoomd, "Snapshot") else "w") as file:
        file.append(frame(**arguments))


#: Changes of the bytes of a correct GSD file.
BYTES = [
    ("cut_in_the_middle", lambda data: data[:len(data) // 2], refused()),
    ("cut_in_the_head", lambda data: data[:100], refused()),
    ("other_magic_number", lambda data: b"\0" + data[1:], refused()),
    ("other_schema", lambda data: data.replace(b"hoomd\0", b"gromx\0"), refused(word="schema")),
    ("bytes_after_end", lambda data: data + b"\0" * 64, read()),
    ("index_beyond_end", lambda data: data[:8] + b"\xff" * 7 + b"\x7f" + data[16:], refused()),
]


def write_all(folder):
    """Writes all files; returns name, file, outcome and further keys of the manifest."""
    result = []
    for name, change, outcome, *keys in XYZ:
        content = change(xyz())
        path = folder / f"xyz_{name}.xyz"
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        result.append((path.stem, path, outcome, *(keys or [{}])))
    for name, arguments, outcome, *keys in GSD:
        path = folder / f"gsd_{name}.gsd"
        write_gsd(path, arguments)
        result.append((path.stem, path, outcome, *(keys or [{}])))
    plain = (folder / "gsd_plain.gsd").read_bytes()
    for name, change, outcome in BYTES:
        path = folder / f"bytes_{name}.gsd"
        path.write_bytes(change(plain))
        result.append((path.stem, path, outcome, {}))
    return result
