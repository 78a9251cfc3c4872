"""Blocks of the page's two main results: a column for each solid."""

import rank
from data import SOLIDS
from text import counted, interval, table

PLURAL = {"tetrahedron": "tetrahedra", "octahedron": "octahedra", "icosahedron": "icosahedra",
          "dodecahedron": "dodecahedra"}
NEAR = 0.001  # Δφ of the first result, N = 100: the smallest that tetrahedra reach
LAST = {("tetrahedron", 400): 0.005, ("tetrahedron", 100): 0.001}  # Δφ of the second; others:
OTHERS = 0.0005
SAME = 0.005  # a Δφ that all sizes have


def by_solid(title, rows):
    """{name of a row: function of a solid}."""
    return table([title, *(PLURAL[solid] for solid in SOLIDS)],
                 [[name, *(cell(solid) for solid in SOLIDS)] for name, cell in rows.items()])


def evidence_of_tilts(data):
    def at(column):
        return lambda solid: counted(data.at(solid, 100, column, NEAR))

    return by_solid("N = 100, Δφ = 0.001", {
        "stiff tilts per face-face contact": at("tilts_each_ff"),
        "stiff tilts per edge-face contact": at("tilts_each_ef"),
        "stiff tilts per lower-order contact": at("tilts_each_l"),
        "modes per particle, normals < ½": at("second_each"),
        "modes per particle, normals and tilts with s > 10 < ½": at("prestress_each"),
        "the same with s > 3": at("prestress_3_each"), "the same with s > 30": at("prestress_30_each"),
        "floppy motions per particle, normals only": at("missing_normals")})


def evidence_of_rank(data):
    def last(column, particles=400):
        return lambda solid: counted(data.at(solid, particles, column, LAST.get((solid, particles), OTHERS)))

    return by_solid("missing constraints m per particle, Δφ = 0.0005", {
        "N = 400, Δφ = 0.02": lambda solid: counted(data.at(solid, 400, "missing", 0.02)),
        "N = 400 (tetrahedra: Δφ = 0.005)": last("missing"), "N = 100 (tetrahedra: Δφ = 0.001)": last("missing", 100),
        "N = 100, cut-offs × ½": last("missing_half", 100), "N = 100, cut-offs × 2": last("missing_double", 100),
        "Δφ → 0, N → ∞, ± fit and form ± cut-offs": lambda solid: interval(rank.infinite(data, solid)),
        "states of self-stress per particle, N = 400": last("self_stress_each"), "C by classes, N = 400": last("C")})


def evidence_of_self_stress(data):
    def size(n):
        return lambda solid: counted(data.at(solid, 64 if n == 50 and solid == "tetrahedron" else n,
                                             "self_stress_each", SAME))

    def nearest(column):
        return lambda solid: counted(data.nearest(solid, 100, column))

    return by_solid("states of self-stress per particle", {
        "Δφ = 0.005, N = 50 (tetrahedra 64)": size(50), "N = 100": size(100), "N = 200": size(200),
        "N = 400": size(400),
        "smallest Δφ, N = 100": nearest("self_stress_each"),
        "smallest Δφ, N = 100, cut-offs × ½": nearest("self_stress_half_each"),
        "smallest Δφ, N = 100, cut-offs × 2": nearest("self_stress_double_each")})


BLOCKS = {f.__name__: f for f in (evidence_of_tilts, evidence_of_rank, evidence_of_self_stress)}
