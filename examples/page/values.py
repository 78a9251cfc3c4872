"""Numbers in sentences that both pages use: functions of the data and of words of a mark, which return text."""

import verdict
from data import PLURALS, SOLIDS
from marks import PageError
from text import number


def constraints(data, how, solid, particles):
    """C without its errors, with two decimals."""
    found = data.constraints(solid, int(particles), how)
    return number(found["mean"], 2) if found else "–"


def listed(solids):
    names = [PLURALS[solid] for solid in solids]
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def against_isostatic(data, how, particles):
    """Sentences that compare C with 12 − 4/N: above or below by more than the sum of its errors, or in agreement."""
    places = {"above": [], "below": [], "near": []}
    for solid in SOLIDS:
        found = data.constraints(solid, int(particles), how)
        if found:
            off = found["mean"] - (12 - 4 / int(particles))
            error = (found["half_width"] or 0) + found.get("systematic", 0)
            places["near" if abs(off) <= error else "above" if off > 0 else "below"].append(solid)
    text = {"above": "C of {} is above 12 − 4/N.", "below": "C of {} is below 12 − 4/N.",
            "near": "C of {} agrees with 12 − 4/N within its errors."}
    return " ".join(text[place].format(listed(solids)) for place, solids in places.items() if solids) or "–"


def farthest(data, sizes):
    """Largest Δφ of the states nearest jamming, without tetrahedra with N ≥ 400."""
    return max(x[-1] for solid in SOLIDS for n in sizes if (solid, n >= 400) != (SOLIDS[0], True)
               for x in data.distances(solid, n))


def minima(data, which, *sizes):
    """Numbers of states nearest jamming: minima with three zero modes by all particles, by the backbone, or all."""
    found = [data.minima(solid, int(n)) for solid in SOLIDS for n in sizes]
    return str(sum(one[("whole", "backbone", "all").index(which)] for one in found))


VALUES = {"verdict": verdict.verdict, "place": verdict.place, "single_stress": lambda data, i: str(verdict.single_stress(data)[int(i)]),
          "C": constraints, "minima": minima}


def value_of(functions):
    """A function of (data, words of a mark) for these functions."""
    def make(data, words):
        name, *arguments = words.split()
        if name not in functions:
            raise PageError(f"there is no value named {name}; the values are {', '.join(sorted(functions))}")
        try:
            return functions[name](data, *arguments)
        except (TypeError, ValueError, ArithmeticError) as error:
            raise PageError(f"the data lack the value {words}: {error}") from error
    return make
