"""Compares the speed of two versions: python3 against.py BEFORE NOW [--filter REGEX] [--rounds N]

BEFORE and NOW are two programs isojam_bench. Each round runs both. The order alternates from round to round, so that
other load on the machine affects both equally.

For every benchmark in both programs, the output has the median time of each program. It also has the ratio of times,
BEFORE divided by NOW: the median and the range over the rounds. NOW is faster if the ratio is above 1.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile


def medians(binary, pattern):
    """Times of one run in ns, by the name of the benchmark. Other counters are left out."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        words = [binary, "--benchmark_filter=" + pattern, "--benchmark_repetitions=3", "--ratios", file.name]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
        return {name: value for name, value in json.load(file)["medians"].items() if "#" not in name}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("before")
    parser.add_argument("now")
    parser.add_argument("--filter", default=".")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    rounds = []
    for k in range(arguments.rounds):
        binaries = [arguments.before, arguments.now]
        found = {binary: medians(binary, arguments.filter) for binary in (binaries if k % 2 == 0 else binaries[::-1])}
        rounds.append([found[binary] for binary in binaries])
    names = [name for name in rounds[0][1] if name in rounds[0][0]]
    if not names:
        sys.exit("no benchmark that both have matches " + arguments.filter)
    print(f"{'benchmark':50}{'before':>12}{'now':>12}  before/now, range of {arguments.rounds} rounds")
    for name in names:
        before, now = ([one[side][name] for one in rounds] for side in (0, 1))
        ratios = [p / q for p, q in zip(before, now)]
        print(f"{name:50}{statistics.median(before):10.4g} ns{statistics.median(now):10.4g} ns"
              f"  {statistics.median(ratios):.2f}  {min(ratios):.2f} … {max(ratios):.2f}")


if __name__ == "__main__":
    main()
