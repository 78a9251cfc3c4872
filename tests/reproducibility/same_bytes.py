"""Checks that variants of the program write the same bytes: same_bytes.py MANIFEST NAME=PROGRAM [NAME=PROGRAM ...]

Every variant runs the manifest in its own directory. PROGRAM may contain arguments. VARIABLE:VALUE and a comma in front
of PROGRAM set an environment variable, as in old=GLIBC_TUNABLES:glibc.cpu.hwcaps=-FMA,build/isojam . The digest of each
result and the bytes of packings and paths are compared with those of the first variant. If files differ, their names
are printed and the exit code is 1.
"""

import json
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path


def parsed(argument):
    """Splits NAME=[VARIABLE:VALUE,...]PROGRAM. The program is the text after the last comma."""
    name, _, rest = argument.partition("=")
    *settings, program = rest.rsplit(",", 1)
    environment = dict(os.environ)
    for setting in settings:
        variable, _, value = setting.partition(":")
        environment[variable] = value
    return name, environment, shlex.split(program)


def results_of(directory):
    """The content of all files that must be identical, by name."""
    results = {}
    for path in sorted((directory / "records").iterdir()):
        results[f"records/{path.name}"] = json.loads(path.read_text(encoding="utf-8"))["result_digest"]
    for folder in ("packings", "paths"):
        for path in sorted((directory / folder).iterdir()):
            results[f"{folder}/{path.name}"] = path.read_bytes()
    return results


def run(manifest, environment, program, directory):
    began = time.monotonic()
    ended = subprocess.run([*program, "run", manifest, "-o", str(directory), "--quiet"], env=environment,
                           stdout=subprocess.DEVNULL, check=False)
    if ended.returncode != 0:
        sys.exit(f"{shlex.join(program)} ended with {ended.returncode}")
    return time.monotonic() - began


def main():
    manifest, *variants = sys.argv[1:]
    expected, different = None, 0
    with tempfile.TemporaryDirectory() as scratch:
        for k, (name, environment, program) in enumerate(map(parsed, variants)):
            seconds = run(manifest, environment, program, Path(scratch) / str(k))
            found = results_of(Path(scratch) / str(k))
            expected = expected or found
            wrong = sorted(key for key in expected.keys() | found.keys() if expected.get(key) != found.get(key))
            print(f"{name}: {len(found) - len(wrong)} of {len(found)} files the same, {seconds:.0f} s")
            for key in wrong:
                print(f"  {key} differs")
            different += len(wrong)
    sys.exit(1 if different or not expected else 0)


if __name__ == "__main__":
    main()
