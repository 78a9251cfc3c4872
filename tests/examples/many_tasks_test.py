"""Tests examples/08-many-short-tasks. usage: many_tasks_test.py ISOJAM EXAMPLE RESULTS

A program replaces HyperQueue. It starts the tasks of an array as its options require, each in its own environment.
RESULTS are the results of a single run of the manifest of the example.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "slurm"))
import same_results  # noqa: E402

EXECUTABLE, EXAMPLE, RESULTS = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
del sys.argv[1:4]
TASKS = 6

STAND_IN = f"#!{sys.executable} -B" + '''
import concurrent.futures, os, pathlib, signal, subprocess, sys, time

words = sys.argv[1:]
if words[:2] == ["job", "wait"]:
    sys.exit(1 if words[2:] != ["4711"] else 0)
assert words[:2] == ["--output-mode=quiet", "submit"], words
end = words.index("--")
options = dict(word.split("=", 1) for word in words[2:end])
command, (first, last) = words[end + 1:], map(int, options.pop("--array").split("-"))
assert set(options) == {"--name", "--cpus", "--stdout", "--stderr"} and options["--stdout"] == "none", options
checkpoints = pathlib.Path(command[3], "checkpoints")


def start(task):
    log = options["--stderr"].replace("%{JOB_ID}", "4711").replace("%{TASK_ID}", str(task))
    with open(log, "w") as errors:
        return subprocess.Popen(command, env={"HQ_TASK_ID": str(task), "HQ_JOB_ID": "4711", "PATH": os.environ["PATH"]},
                                stdout=subprocess.DEVNULL, stderr=errors, cwd="/")


killed = int(os.environ.get("KILLED", 0))
if killed:
    process = start(killed)
    while not list(checkpoints.glob("*.json")):
        assert process.poll() is None, "it ended before it could be killed"
        time.sleep(.002)
    process.send_signal(signal.SIGKILL)
    process.wait()
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    others = [task for task in range(last, first - 1, -1) if task != killed]
    codes = list(pool.map(lambda task: start(task).wait(), others))
print(4711)
print(*codes, file=sys.stderr)
'''


def stamps(directory):
    return {file.name: file.stat().st_mtime_ns for file in (directory / "records").iterdir()}


class ManyTasks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="isojam-tasks-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        stand_in = self.root / "hq"
        stand_in.write_text(STAND_IN)
        stand_in.chmod(0o755)
        self.results = self.root / "results"

    def submit(self, **environment):
        # Variables of a surrounding batch system must not choose the part.
        known = dict(os.environ, PATH=f"{self.root}:{os.environ['PATH']}", ISOJAM=str(EXECUTABLE), TASKS=str(TASKS),
                     SLURM_ARRAY_TASK_ID="3", SLURM_ARRAY_TASK_COUNT="7", **environment)
        done = subprocess.run([EXAMPLE / "submit.sh", EXAMPLE / "manifest.json", self.results], env=known, check=False,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done)
        self.assertTrue(done.stdout.startswith("job 4711\n"), done)
        return done

    def test_a_killed_task_run_again_gives_what_one_run_gives(self):
        done = self.submit(KILLED="5")
        before = stamps(self.results)
        self.assertEqual(len(before), TASKS - 1, done)
        self.assertEqual(len(list((self.results / "checkpoints").glob("*.json"))), 1)
        self.assertNotEqual((self.results / "tables.json").read_bytes(), (RESULTS / "tables.json").read_bytes())
        self.submit()
        after = stamps(self.results)
        self.assertEqual(len(after), TASKS)
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertEqual(len(list((self.results / "logs").iterdir())), TASKS)
        self.assertEqual(same_results.main(RESULTS, self.results), 0)
        for name in after:
            ours, theirs = (json.loads((directory / "records" / name).read_text()) for directory in (self.results, RESULTS))
            self.assertEqual(ours["result_digest"], theirs["result_digest"], name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
