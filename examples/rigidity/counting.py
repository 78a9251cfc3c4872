"""Blocks about counting by stiffness: bands, constraint numbers by threshold, and scaling of angles."""

import functools
import statistics

from data import SOLIDS
from estimates import estimate_of
from gather import QUANTILES, THRESHOLDS
from held import BINS, bins_falling, by_grid, exponents
from limits import limit_of_choices
from text import counted, interval, number, significant, signed, table

WINDOWS = ((0, 0.01), (0, 0.02), (0, 0.005))
AT = (0.02, 0.005)  # Δφ, besides the smallest, at which records have the stiffness of every contact


def banded(data, solid, particles, place):
    """By replicate ([Z_l, Z_ef, Z_ff, C] by bands for boundaries × ½, 1 and 2, and the same by the record's fits), at
    Δφ = place or at the smallest. Z_l, Z_ef, Z_ff are classified by normals. C is Z plus 2/N for each tilt of the upper
    band."""
    made = []
    for replicate in data.counted(solid, particles):
        some = replicate.get("bands") or []
        entries = [b for b in some if place and abs(b[0] / place - 1) < 0.2] if place else some[-1:]
        if not entries:
            continue
        if len(entries[0]) < 8:
            continue
        _, Z, Z_ef, Z_ff, C, edges, faces, tilts = entries[0]
        by_factor = [[Z - 2 * e / particles, 2 * (e - f) / particles, 2 * f / particles, Z + 2 * t / particles]
                     for e, f, t in zip(edges, faces, tilts)]
        fits = [None if None in (Z_ef, Z_ff) else Z - Z_ef - Z_ff, Z_ef, Z_ff, C]
        made.append((by_factor, fits))
    return made


def band(data, solid, particles, place, number_of):
    """Estimate of Z_l, Z_ef, Z_ff or C (0 … 3) by bands, with half the range over boundaries as systematic error."""
    found = banded(data, solid, particles, place)
    if not found:
        return None
    others = [statistics.fmean(f[0][i][number_of] for f in found) for i in (0, 2)]
    return {**estimate_of([f[0][1][number_of] for f in found]), "systematic": abs(others[1] - others[0]) / 2}


def bands(data):
    rows = []
    for solid in SOLIDS:
        for particles in (100, 400):
            for place in (*AT, None):
                found = banded(data, solid, particles, place)
                if not found:
                    continue
                cells = []
                for i in range(4):
                    cells += [interval(band(data, solid, particles, place, i)),
                              interval(estimate_of([f[1][i] for f in found]))]
                where = significant(place, 1) if place else "smallest"
                rows.append([f"{solid} {particles}", where, str(len(found)), *cells])
    return table(["solid, N", "Δφ", "n", "Z_l by bands", "Z_l by fits", "Z_ef by bands", "Z_ef by fits",
                  "Z_ff by bands", "Z_ff by fits", "C by bands of tilts", "C by fits"], rows)


def stiff_numbers(data):
    return by_grid(data, {**{f"C_s_{t}": f"C_s, s > {t}" for t in THRESHOLDS}, "C": "C by cut-offs"}, (100,))


@functools.cache
def stiff_limit(data, solid, particles, column="C_s_10"):
    """Limit of a + b Δφ^x with half the range over windows and forms, and half the range over thresholds 10 … 100."""
    paths = [list(zip(x, y)) for x, y in data.paths(solid, particles, column)]
    if not paths:
        return None, None
    _, chosen = limit_of_choices(paths, WINDOWS, central=(0, 1.0) if column.startswith("C_s") else (0, None))
    if not chosen:
        return None, None
    others = [limit_of_choices([list(zip(x, y)) for x, y in data.paths(solid, particles, f"C_s_{t}")], WINDOWS,
                               central=(0, 1.0))[1] for t in (10, 30, 100)]
    means = [e["mean"] for e in others if e]
    return chosen, (max(means) - min(means)) / 2 if len(means) > 1 else None


def stiff_limits(data):
    rows = []
    for solid in SOLIDS:
        for particles in data.sizes(solid):
            chosen, thresholds = stiff_limit(data, solid, particles)
            if not chosen or thresholds is None:
                continue
            by_fits = stiff_limit(data, solid, particles, "C")[0]
            target = 12 - 4 / particles
            rows.append([f"{solid} {particles}", counted(chosen), f"± {number(thresholds, 2)}",
                         counted(by_fits) if by_fits else "–", number(target, 2),
                         signed(chosen["mean"] - target, 2),
                         "yes" if abs(chosen["mean"] - target) <= chosen["half_width"] + chosen["systematic"] +
                         thresholds else "**no**"])
    return table(["solid, N", "C_s as Δφ → 0, s > 10, ± fit ± form", "error from thresholds 10 … 100",
                  "C by cut-offs as Δφ → 0", "12 − 4/N", "C_s − (12 − 4/N)", "within the sum of errors"], rows)


def redundancy(data):
    return by_grid(data, {"self_stress_s": "states of self-stress", "missing_s": "missing constraints per particle"},
                   (100,))


def collapse(data):
    """Exponents in Δφ of quantiles of θ_ef."""
    rows = []
    for solid in SOLIDS:
        for share in QUANTILES:
            found = data.slopes(solid, 100, f"theta_{share}", BINS)
            if any(found):
                rows.append([f"{solid} 100", significant(share, 2).rstrip("0"), *exponents(found)])
    return table(["solid, N", "share", *bins_falling()], rows)


BLOCKS = {f.__name__: f for f in (bands, stiff_numbers, stiff_limits, redundancy, collapse)}
