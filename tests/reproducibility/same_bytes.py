"""Checks that variants of the program write the same bytes: same_bytes.py MANIFEST... NAME=COMMAND...

COMMAND is the program, perhaps with arguments and other programs in front of it, such as "env VARIABLE=VALUE isojam". For
each variant, a digest of all results, packings and paths and the CPU time are printed. If files differ from those of the
first variant, their names are printed and the exit code is 1.
"""

import hashlib
import json
import resource
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path


def results_of(program, manifest, directory):
    """Runs a manifest. Returns the content of all files that must be identical, by name."""
    ended = subprocess.run([*program, "run", manifest, "-o", str(directory), "--quiet"], stdout=subprocess.DEVNULL,
                           check=False)
    if ended.returncode != 0:
        sys.exit(f"{shlex.join(program)} ended with {ended.returncode}")
    results = {}
    for path in sorted((directory / "records").iterdir()):
        results[f"records/{path.name}"] = json.loads(path.read_text(encoding="utf-8"))["result_digest"]
    for folder in ("packings", "paths"):
        for path in sorted((directory / folder).glob("*")):
            results[f"{folder}/{path.name}"] = path.read_bytes()
    return {f"{Path(manifest).name}: {name}": content for name, content in results.items()}


def main():
    manifests = [argument for argument in sys.argv[1:] if "=" not in argument]
    expected, different = None, 0
    for variant in sys.argv[1 + len(manifests):]:
        name, _, command = variant.partition("=")
        before, found = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, {}
        for manifest in manifests:
            with tempfile.TemporaryDirectory() as scratch:
                found |= results_of(shlex.split(command), manifest, Path(scratch) / "results")
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        digest = hashlib.sha256(repr(sorted(found.items())).encode()).hexdigest()[:16]
        print(f"{digest}  {len(found)} files, {seconds:6.1f} s  {name}", flush=True)
        expected = expected or found
        wrong = sorted(key for key in expected.keys() | found.keys() if expected.get(key) != found.get(key))
        print(*(f"  {key} differs\n" for key in wrong), sep="", end="")
        different += len(wrong)
    sys.exit(1 if different or not expected else 0)


if __name__ == "__main__":
    main()
