"""Blocks about floppy motions: how the energy rises along motions that change no contact's volume to first order."""

from data import SOLIDS
from held import BINS, bins_falling, by_grid
from text import counted, table

RUNGS = {"rung_0": "Δφ/256 – Δφ/64", "rung_1": "Δφ/64 – Δφ/16", "rung_2": "Δφ/16 – Δφ/4"}
SIZES = (50, 64, 100)
FEW = (0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)


def quartic(data):
    columns = {"floppy_each": "floppy, each", "quartic_each": "quartic, each", "missing": "missing by class, each",
               "quartic_share": "quartic share"}
    return by_grid(data, columns, SIZES, FEW)


def rungs(data):
    return by_grid(data, RUNGS, (100,), FEW)


def coefficients(data):
    rows = []
    for solid in SOLIDS:
        found = data.slopes(solid, 100, "c_floppy", BINS)
        rows.append([f"{solid} 100", *(counted(data.at(solid, 100, "c_floppy", d)) for d in (0.02, 0.005, 0.001)),
                     *(counted(e) for e in reversed(found))])
    return table(["median coefficient, Y V_p^(−1/3)", "Δφ = .02", ".005", ".001",
                  *(f"exponent, {b}" for b in bins_falling())], rows)


BLOCKS = {f.__name__: f for f in (quartic, rungs, coefficients)}
