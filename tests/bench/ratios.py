"""Judges the results of isojam_bench, and compares two builds.

    ratios.py RESULTS.json RATIOS.json                          # prints and writes the medians and the verdicts
    ratios.py --against BEFORE NOW [--filter REGEX] [--rounds N]

RESULTS.json is the file of --benchmark_out. A quantity is the median time of a benchmark in ns, with the name
`family/method/case`, or one of its counters, `family/method/case#counter`. BEFORE and NOW are two programs
isojam_bench. Each round runs both, in an order that alternates, so that other load affects both equally. The ratio of
the times is BEFORE divided by NOW.
"""

import argparse
import json
import re
import statistics
import subprocess
import sys
import tempfile

OWN_KEYS = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
            "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit", "label"}
NANOSECONDS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}
SOLIDS = ("tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron")


def claims():
    """Yields (kind, ours, peer, bound, ours_per, peer_per). `faster` claims peer / ours >= bound, `costs` claims
    ours / peer <= bound, and `absolute` claims ours <= bound. A bound of None claims nothing. The quantities are first
    divided by the last two numbers, such as numbers of particles."""
    def claim(kind, ours, peer, bound, ours_per=1, peer_per=1):
        return kind, ours, peer, bound, ours_per, peer_per

    for solid, faster in zip(SOLIDS, (9, 10, 13, 14, 13)):
        loop = f"overlap/contact_loop/{solid}"
        yield claim("faster", loop, f"overlap/voro++/{solid}", faster)
        yield claim("faster", loop, f"overlap/cgal/{solid}", 500)
        yield claim("costs", f"overlap/with_hessian/{solid}", loop, 1.6)
        for n, bound in ((64, None), (1000, None), (10000, 1.15)):
            yield claim("costs", f"overlap/in_packings_N={n}/{solid}", loop, bound)
        for clip in ("simple_clip", "quadruple_clip"):
            yield claim("faster", loop, f"overlap/{clip}/{solid}", None)
        yield claim("absolute", f"near_miss/cached_axis/{solid}", None, 12)
    for n in (100, 400):
        yield claim("faster", f"factorise/block_cholesky/N={n}", f"factorise/simplicial_ldlt/N={n}", 5)
    for n, faster in ((100, 3), (400, 1.5), (800, 1), (1000, None)):
        yield claim("faster", f"factorise/block_cholesky/N={n}", f"factorise/cholmod/N={n}", faster)
    yield claim("costs", "evaluate/double_double/N=100", "evaluate/1_thread/N=100", 1.3)
    for case, faster in (("evaluate/{}/N=400", 1.7), ("factorise/{}/N=400", None), ("factorise/{}/N=1000", 1.6),
                         ("factorise/{}/N=4000", None), ("sweep/{}/N=40", 1.9)):
        yield claim("faster", case.format("2_threads"), case.format("1_thread"), faster)
    # Costs grow linearly with N. The factor 1.2 allows for caches that are too small.
    yield claim("absolute", "evaluate/1_thread/N=10000#bytes", None, 5000, 10000)
    for n in (1000, 10000):
        for counter in ("", "#bytes"):
            yield claim("costs", f"evaluate/1_thread/N={n}{counter}", f"evaluate/1_thread/N=100{counter}", 1.2, n, 100)
    for method, faster in (("conjugate_gradient", 100), ("fire", None), ("lbfgs", None)):
        yield claim("faster", "minimise/newton/octahedron_.03", f"minimise/{method}/octahedron_.03", faster)
    for case in ("octahedron_.03", "octahedron_.008", "tetrahedron_.033", "tetrahedron_.01"):
        yield claim("absolute", f"minimise/newton/{case}#residual", None, 1e-6)
        yield claim("absolute", f"minimise/newton_to_1e-9/{case}#residual", None, 1e-9)
        for method in ("conjugate_gradient", "fire", "lbfgs") if case != "octahedron_.03" else ():
            yield claim("faster", f"minimise/newton/{case}#residual", f"minimise/{method}/{case}#residual", 10)
    for case, seconds in (("tetrahedron_N=100", 15), ("octahedron_N=100", 6), ("dodecahedron_N=100", 5),
                          ("icosahedron_N=100", 5), ("octahedron_N=400", 60), ("dodecahedron_N=400", 60)):
        yield claim("absolute", f"replicate/jam/{case}", None, seconds * 1e9)
    for n, seconds in ((100, 0.05), (400, 0.5)):
        yield claim("absolute", f"modes/both_ends/N={n}", None, seconds * 1e9)


def medians(results):
    """Median of each quantity, and the benchmarks that failed."""
    samples, failed = {}, {}
    for run in results["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        name = re.sub(r"/(iterations|repeats|real_time)\b.*", "", run["run_name"])
        if run.get("error_occurred"):
            failed[name] = run["error_message"]
            continue
        # Benchmarks on one thread report their own CPU time, so that other processes have little effect.
        time = run["real_time" if run["run_name"].endswith("/real_time") else "cpu_time"]
        samples.setdefault(name, []).append(time * NANOSECONDS[run["time_unit"]])
        for counter in run.keys() - OWN_KEYS:
            samples.setdefault(f"{name}#{counter}", []).append(run[counter])
    return {name: statistics.median(values) for name, values in sorted(samples.items())}, failed


def judge(claim, found):
    """The claim as a row with its ratio and verdict; None if a quantity was not measured."""
    kind, ours, peer, bound, ours_per, peer_per = claim
    if ours not in found or (peer and peer not in found):
        return None
    ratio = found[ours] / ours_per
    row = {"ours": ours, "ours_value": ratio}
    if peer:
        other = found[peer] / peer_per
        ratio = other / ratio if kind == "faster" else ratio / other
        row |= {"peer": peer, "peer_value": other, "ratio": ratio}
    if bound is not None:
        row |= {"at_least" if kind == "faster" else "at_most": bound,
                "met": ratio >= bound if kind == "faster" else ratio <= bound}
    return row


def report(results_path, ratios_path):
    with open(results_path, encoding="utf-8") as file:
        results = json.load(file)
    found, failed = medians(results)
    rows = [row for row in (judge(claim, found) for claim in claims()) if row]
    for name, value in found.items():
        print(f"{name:56}{value:12.4g}{'' if '#' in name else ' ns'}")
    print(f"\n{'ours':44}{'peer':44}{'ratio':>10}  required")
    for row in rows:
        required = "".join(f"{sign} {row[key]:g} {'met' if row['met'] else 'MISSED'}"
                           for key, sign in (("at_least", ">="), ("at_most", "<=")) if key in row)
        print(f"{row['ours']:44}{row.get('peer', ''):44}{row.get('ratio', row['ours_value']):10.4g}  {required}")
    with open(ratios_path, "w", encoding="utf-8") as file:
        json.dump({"machine": results["context"], "medians": found, "ratios": rows}, file, indent=2)
    for name, why in failed.items():
        print(f"{name}: {why}", file=sys.stderr)
    return 1 if failed else 0


def times(binary, pattern):
    """Times of one run in ns, by the name of the benchmark."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        subprocess.run([binary, "--benchmark_filter=" + pattern, "--benchmark_repetitions=3",
                        "--benchmark_out=" + file.name], check=True, stdout=subprocess.DEVNULL)
        return {name: value for name, value in medians(json.load(file))[0].items() if "#" not in name}


def against(binaries, pattern, rounds, measure=times):
    """Prints the median times of two programs, and the median and range of their ratios over the rounds."""
    found = []
    for k in range(rounds):
        one = {binary: measure(binary, pattern) for binary in (binaries if k % 2 == 0 else binaries[::-1])}
        found.append([one[binary] for binary in binaries])
    names = [name for name in found[0][1] if name in found[0][0]]
    if not names:
        sys.exit("no benchmark that both have matches " + pattern)
    print(f"{'benchmark':50}{'before':>12}{'now':>12}  before/now, range of {rounds} rounds")
    for name in names:
        before, now = ([one[side][name] for one in found] for side in (0, 1))
        ratios = [p / q for p, q in zip(before, now)]
        print(f"{name:50}{statistics.median(before):10.4g} ns{statistics.median(now):10.4g} ns"
              f"  {statistics.median(ratios):.2f}  {min(ratios):.2f} … {max(ratios):.2f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs=2)
    parser.add_argument("--against", action="store_true")
    parser.add_argument("--filter", default=".")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    if not arguments.against:
        sys.exit(report(*arguments.files))
    against(arguments.files, arguments.filter, arguments.rounds)


if __name__ == "__main__":
    main()
