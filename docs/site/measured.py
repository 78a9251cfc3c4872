"""usage: measured.py [--bench RATIOS.json] [--chart DATA.json] [--check]

Inserts into README.md and docs/accuracy.md the numbers of one run of `make bench` and one of `isojam chart`, which are in
docs/data/measured.json. --bench and --chart replace these by the results of new runs, build/ratios.json and data.json.
With --check, nothing is written, and a page that differs is an error."""

import argparse
import collections
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples/page"))
from marks import BLOCK  # noqa: E402
from text import significant, table  # noqa: E402

STORED = ROOT / "docs/data/measured.json"
SOLIDS = ("tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron")
JAMMED = [solid for solid in SOLIDS if solid != "cube"]
UNITS = ((60e9, "min"), (1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1, "ns"))


def duration(ns):
    size, unit = next((size, unit) for size, unit in UNITS if ns >= (2 * size if unit == "min" else size))
    return f"{significant(ns / size, 3)} {unit}"


def ratios(found, above, below, cases):
    return [found[above.format(case)] / found[below.format(case)] for case in cases]


def row(label, values):
    return [label, *(significant(value, 3) for value in values)]


def kernel(found):
    loop = "overlap/contact_loop/{}"
    times = {"time for a random pair": loop, "pair that almost touches, with the separating axis of the last evaluation":
             "near_miss/cached_axis/{}"}
    rows = [[label, *(duration(found[name.format(solid)]) for solid in SOLIDS)] for label, name in times.items()]
    return table(["overlap kernel", *SOLIDS], [
        rows[0], row("speed-up over the cell cutting of voro++", ratios(found, "overlap/voro++/{}", loop, SOLIDS)),
        row("touching pair in a packing, relative to a random pair", ratios(found, "overlap/in_packings/{}", loop, SOLIDS)),
        row("time with second derivatives, relative to the time without them",
            ratios(found, "overlap/with_hessian/{}", loop, SOLIDS)), rows[1]])


def yade(found):
    def of(show):
        return [show(lambda key: found[f"packing/{key.format(solid)}"]) for solid in JAMMED]

    return table(["100 particles", *JAMMED], [
        ["YADE, time per contact and step", *of(lambda one: duration(1e9 * one("yade/{}#seconds_per_contact")))],
        ["isojam, time per contact and evaluation",
         *of(lambda one: duration(1e9 * one("isojam/{}#seconds_per_contact")))],
        row("time of a step of YADE divided by that of an evaluation",
            ratios(found, "packing/yade/{}", "packing/isojam/{}", JAMMED)),
        ["contacts that YADE misses", *of(lambda one: f"{one('yade/{}#missed'):.0f} of {one('yade/{}#contacts'):.0f}")],
        ["share of all contact forces that is missed", *of(lambda one: f"{100 * one('yade/{}#missed_force'):.2g} %")],
        ["angle between force and −∇E, median (largest)",
         *of(lambda one: f"{one('yade/{}#median_angle'):.1g}° ({one('yade/{}#largest_angle'):.0f}°)")]])


def replicates(found):
    cases = [(solid, 100) for solid in JAMMED] + [("octahedron", 400), ("dodecahedron", 400)]
    return table(["solid", "N", "CPU time"], [[solid, str(n), duration(found[f"replicate/jam/{solid}_N={n}"])]
                                              for solid, n in cases])


def factorisation(found):
    sizes = (100, 400, 800, 1000)
    return table(["Hessian", *(f"N = {n}" for n in sizes)], [
        row("speed-up of the factorisation over the supernodal CHOLMOD with OpenBLAS",
            ratios(found, "factorise/cholmod/N={}", "factorise/block_cholesky/N={}", sizes))])


def atlas(found):
    return table(["method", "cases", "correct", "refused", "failed"],
                 [[method, *map(str, (sum(counts), *counts))] for method, counts in found["atlas"]])


def outermost(found, end, above, below, cases):
    return significant({"least": min, "greatest": max}[end](ratios(found, above, below, cases)), 2)


VALUES = {
    "voro++": lambda found, end: outermost(found, end, "overlap/voro++/{}", "overlap/contact_loop/{}", SOLIDS),
    "yade": lambda found, end: outermost(found, end, "packing/yade/{}", "packing/isojam/{}", JAMMED),
    "missed": lambda found, end: significant(100 * {"least": min, "greatest": max}[end](
        ratios(found, "packing/yade/{}#missed", "packing/yade/{}#contacts", JAMMED)), 1),
    "left": lambda found, solid: f"{found[f'packing/yade/{solid}#left']:.0f}",
    "time": lambda found, name, per=1: duration(found[name] / float(per)),
    "ratio": lambda found, name, other: significant(found[name] / found[other], 3),
    "bytes": lambda found, name, per: f"{significant(found[name] / float(per) / 1e3, 2)} kB",
    "cases": lambda found: str(sum(sum(counts) for _, counts in found["atlas"])),
}
BLOCKS = {"kernel": kernel, "yade": yade, "replicates": replicates, "factorisation": factorisation, "atlas": atlas}


def renewed(page, found):
    """The page with its blocks, and with its values between `<!-- measured NAME -->` and `<!-- / -->`, made again."""
    def value(match):
        name, *arguments = match[2].split()
        return match[1] + VALUES[name](found, *arguments) + match[3]

    page = BLOCK.sub(lambda match: match[1] + BLOCKS[match[2]](found) + match[3] if match[2] in BLOCKS else match[0], page)
    return re.sub(r"(<!-- measured (.+?) -->).*?(<!-- / -->)", value, page, flags=re.DOTALL)


def counted(chart):
    """[method, [cases that are correct, refused, failed]] for each method of the atlas, isojam's first and in bold."""
    counts = collections.defaultdict(collections.Counter)
    for cell in chart["atlas"]["rows"]:
        counts[not cell["standard"], cell["method"]][cell["verdict"]] += 1
    return [[method if other else f"**{method}**", [count[verdict] for verdict in ("holds", "refuses", "fails")]]
            for (other, method), count in sorted(counts.items())]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bench", type=pathlib.Path)
    parser.add_argument("--chart", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    found = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    if arguments.bench:
        run = json.loads(arguments.bench.read_text(encoding="utf-8"))
        machine = {key: run["machine"].get(key) for key in ("date", "num_cpus", "mhz_per_cpu", "load_avg", "compiler")}
        found = {"machine": machine, "atlas": found.get("atlas"), **run["medians"]}
    if arguments.chart:
        found["atlas"] = counted(json.loads(arguments.chart.read_text(encoding="utf-8")))
    if not arguments.check:
        STORED.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for page in (ROOT / "README.md", ROOT / "docs/accuracy.md"):
        text = page.read_text(encoding="utf-8")
        if arguments.check and renewed(text, found) != text:
            sys.exit(f"{page.name} differs from {STORED.name}; docs/site/measured.py without --check updates it")
        if not arguments.check:
            page.write_text(renewed(text, found), encoding="utf-8")


if __name__ == "__main__":
    main()
