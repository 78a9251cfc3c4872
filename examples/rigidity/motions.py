"""Blocks about floppy motions: how the energy rises along motions that change no contact's volume to first order."""

import math

from data import SOLIDS
from estimates import estimate_of
from held import by_grid
from scaling import at
from text import number, significant, table

RUNGS = {"rung_0": "Δφ/256 – Δφ/64", "rung_1": "Δφ/64 – Δφ/16", "rung_2": "Δφ/16 – Δφ/4", "rung_3": "Δφ/4 – Δφ"}
SIZES = (50, 64, 100)
FEW = (0.04, 0.02, 0.01, 0.005, 0.0025, 0.001, 0.0005)


def quartic(data):
    columns = {"floppy_each": "floppy, each", "quartic_each": "quartic, each", "missing": "missing by class, each"}
    return by_grid(data, columns, SIZES, FEW)


def exponent_shares(data):
    """How exponents are spread, from a = Δφ/16 to Δφ/4."""
    columns = {"quadratic_share": "below 2.5", "quartic_share": "3 to 5", "steeper_share": "5 and more"}
    return by_grid(data, columns, (100,), FEW)


def rungs(data):
    return by_grid(data, RUNGS, (100,), FEW)


def geometric(data, solid, distance):
    """Mean and 95 % factor over replicates of the median coefficient, in its logarithm."""
    logs = [(x, [math.log(v) if v and v > 0 else None for v in y]) for x, y in data.paths(solid, 100, "c_floppy")]
    estimate = estimate_of([at(x, y, distance) for x, y in logs])
    if not estimate or estimate["n"] < 3:
        return None
    return {"mean": math.exp(estimate["mean"]), "factor": math.exp(estimate["half_width"]), "n": estimate["n"]}


def with_factor(found):
    return f"{significant(found['mean'], 2)} ×÷ {number(found['factor'], 1)} ({found['n']})" if found else "–"


def coefficients(data):
    rows = [[f"{solid} 100", *(with_factor(geometric(data, solid, d)) for d in FEW)] for solid in SOLIDS]
    return table(["rise over a⁴, Y V_p^(−1/3)", *(f"Δφ = {significant(d, 2).rstrip('0')}" for d in FEW)], rows)


BLOCKS = {f.__name__: f for f in (quartic, exponent_shares, rungs, coefficients)}
