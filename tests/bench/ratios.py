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
    """Yields (kind, ours, peer, bound, ours_per, peer_per). `faster` claims peer / ours >= bound, and `costs` claims
    ours / peer <= bound. The quantities are first divided by the last two numbers, such as numbers of particles. A peer
    of None is 1. A bound is what the best peer, the kernel or the machine sets, or a limit that a regression exceeds."""
    def claim(kind, ours, peer, bound, ours_per=1, peer_per=1):
        return kind, ours, peer, bound, ours_per, peer_per

    for solid, faster in zip(SOLIDS, (6, 7, 10, 11, 15)):
        loop = f"overlap/contact_loop/{solid}"
        yield claim("faster", loop, f"overlap/voro++/{solid}", faster)
        yield claim("costs", f"overlap/with_hessian/{solid}", loop, 2.2)
        yield claim("costs", f"overlap/in_packings/{solid}", loop, 1.7)
        yield claim("costs", f"near_miss/cached_axis/{solid}", loop, 0.1)
    for n in (100, 400, 800, 1000):
        yield claim("faster", f"factorise/block_cholesky/N={n}", f"factorise/cholmod/N={n}", 1)
    yield claim("costs", "modes/both_ends/N=400", "factorise/block_cholesky/N=400", 25)
    # Two cores at most double the speed.
    for case, faster in (("evaluate/{}/N=400", 1.5), ("factorise/{}/N=1000", 1.7), ("sweep/{}/N=40", 1.8)):
        yield claim("faster", case.format("2_threads"), case.format("1_thread"), faster)
    yield claim("costs", "evaluate/double_double/N=100", "evaluate/1_thread/N=100", 1.5)
    # Costs grow linearly with N; the factor allows for caches that are too small.
    for counter in ("", "#bytes"):
        yield claim("costs", f"evaluate/1_thread/N=10000{counter}", f"evaluate/1_thread/N=100{counter}", 1.4, 10000, 100)
    yield claim("costs", "evaluate/1_thread/N=10000#bytes", None, 2500, 10000)
    # The overlaps alone take the time of the kernel, here in ns.
    kernel = "overlap/in_packings/{}"
    yield claim("costs", "evaluate/1_thread/N=1000#seconds_per_contact", kernel.format("octahedron"), 2.5, 1e-9)
    for case, limit in (("octahedron_N=100", 7), ("octahedron_N=400", 9), ("dodecahedron_N=100", 6),
                        ("icosahedron_N=100", 6), ("tetrahedron_N=100", 7)):
        yield claim("costs", f"replicate/jam/{case}#seconds_per_overlap", kernel.format(case.split("_")[0]), limit, 1e-9)
    for solid in (solid for solid in SOLIDS if solid != "cube"):
        yield claim("faster", f"packing/isojam/{solid}", f"packing/yade/{solid}", 300)


def medians(results):
    """Median of each quantity, and the benchmarks that failed."""
    samples, failed = {}, {}
    for run in results["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        name = re.sub(r"/(iterations|repeats|real_time|manual_time)\b.*", "", run["run_name"])
        if run.get("error_occurred"):
            failed[name] = run["error_message"]
            continue
        # Benchmarks on one thread report their own CPU time, so that other processes have little effect.
        time = run["real_time" if run["run_name"].endswith(("/real_time", "/manual_time")) else "cpu_time"]
        samples.setdefault(name, []).append(time * NANOSECONDS[run["time_unit"]])
        for counter in run.keys() - OWN_KEYS:
            samples.setdefault(f"{name}#{counter}", []).append(run[counter])
    return {name: statistics.median(values) for name, values in sorted(samples.items())}, failed


def judge(claim, found):
    """The claim as a row with its ratio and verdict; None if a quantity was not measured."""
    kind, ours, peer, bound, ours_per, peer_per = claim
    if ours not in found or (peer and peer not in found):
        return None
    ours_value, peer_value = found[ours] / ours_per, found[peer] / peer_per if peer else 1
    ratio = peer_value / ours_value if kind == "faster" else ours_value / peer_value
    return {"ours": ours, "peer": peer or "", "ratio": ratio, "at_least" if kind == "faster" else "at_most": bound,
            "met": ratio >= bound if kind == "faster" else ratio <= bound}


def report(results_path, ratios_path):
    with open(results_path, encoding="utf-8") as file:
        results = json.load(file)
    found, failed = medians(results)
    judged = [(claim[1], judge(claim, found)) for claim in claims()]
    rows = [row for _, row in judged if row]
    failed = {name: "it or its peer was not measured" for name, row in judged if not row} | failed
    for name, value in found.items():
        print(f"{name:56}{value:12.4g}{'' if '#' in name else ' ns'}")
    print(f"\n{'ours':52}{'peer':44}{'ratio':>10}  required")
    for row in rows:
        sign, bound = ("<=", row["at_most"]) if "at_most" in row else (">=", row["at_least"])
        print(f"{row['ours']:52}{row['peer']:44}{row['ratio']:10.4g}  {sign} {bound:g} {'met' if row['met'] else 'MISSED'}")
    with open(ratios_path, "w", encoding="utf-8") as file:
        json.dump({"machine": results["context"], "medians": found, "ratios": rows}, file, indent=2)
    for name, why in failed.items():
        print(f"{name}: {why}", file=sys.stderr)
    return 1 if failed or not all(row["met"] for row in rows) else 0


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
