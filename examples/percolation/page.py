"""Makes README.md and tables.md: python3 page.py [--data FILE...] [-o OUT] [--check]"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "page"))

import pages  # noqa: E402
from analysis import SOLIDS, Data, collapse, difference_at, mean, threshold_of, all_of_size  # noqa: E402
from marks import PageError  # noqa: E402
from tables import TABLES, main_table, remaining  # noqa: E402, F401
from text import interval, number, significant  # noqa: E402

TITLE = "Cohesion and the percolation of face-face contacts"
FILES = (HERE / "data/records.json",)
ENTRIES = """An entry a ± b (n) is the mean a over n packings and half the width b of its 95 % confidence interval
(Student t). A dash means that the value is unknown."""
BLOCKS = {"main": main_table}


def kept(data, column, solid, w, particles="100"):
    return interval(mean(data.kept(solid, int(particles), float(w)), column))


def threshold_text(data, particles, null="", method="fit"):
    found = threshold_of(all_of_size(data, int(particles)), method, null == "random")
    return f"{number(found['mean'], 2)} ({number(found['low'], 2)} … {number(found['high'], 2)})" if found else "–"


def memory(data, which, particles, distance):
    chi_squared, freedom, probability = remaining(data, int(particles), float(distance))
    return {"chi": number(chi_squared, 1), "freedom": str(freedom), "p": significant(probability, 2)}[which]


def largest_memory(data, particles, distance):
    found = [d["mean"] for solid in SOLIDS for w in data.strengths("decompression", int(particles))
             if (d := difference_at(data, solid, int(particles), w, float(distance)))]
    return number(max(found), 2) if found else "–"


def misfit(data, which, particles="100"):
    return number(collapse(data, int(particles))[which], 2)


FUNCTIONS = {"kept": kept, "threshold": threshold_text, "memory": memory, "largest_memory": largest_memory,
             "misfit": misfit}


def value_of(data, words):
    name, *arguments = words.split()
    if name not in FUNCTIONS:
        raise PageError(f"there is no value named {words}")
    return FUNCTIONS[name](data, *arguments)


CLAIMS = {}

if __name__ == "__main__":
    pages.main(sys.modules[__name__], HERE)
