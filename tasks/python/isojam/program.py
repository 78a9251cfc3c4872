"""Where the program is, and what it is asked for."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import warnings

from . import facts
from .errors import ProgramError
from .solid import read_obj
from .table import read_table


def find(program=None):
    """The path of the program: `program` if given, else the environment variable ISOJAM, else the one that was built or
    installed with this module, else the one on the PATH. Raises ProgramError if there is none."""
    for asked, by in ((program, "the argument"), (os.environ.get("ISOJAM"), "the environment variable ISOJAM")):
        if asked:
            found = shutil.which(os.fspath(asked))
            if found is None:
                raise ProgramError([], f"{by} says that the program is {asked}, which cannot be run")
            return found
    found = shutil.which(os.fspath(facts.program)) or shutil.which("isojam")
    if found is None:
        raise ProgramError([], "the program isojam is not found: give its path as `program` of isojam.load or in the "
                               "environment variable ISOJAM")
    return found


def run(program, *words, stdout=subprocess.PIPE):
    """Runs it to its end; what it warned of as text. Raises ProgramError with what it said if it ended with an error."""
    command = [find(program), *map(os.fspath, words)]
    ended = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE, text=True,
                           errors="replace", check=False)
    if ended.returncode != 0:
        raise ProgramError(command, ended.stderr.strip() or f"ended with {ended.returncode}")
    return ended.stderr.strip()


def solids(program, directory, replicate):
    """The solids of a replicate by their names."""
    with tempfile.TemporaryDirectory() as folder:
        run(program, "export", directory, replicate, "--format", "xyz", "-o", pathlib.Path(folder, "packing.xyz"))
        found = [read_obj(file) for file in sorted(pathlib.Path(folder).glob("*.obj"))]
    return {solid.name: solid for solid in found}


def contacts(program, directory, replicate, path):
    """Contacts of a replicate, or of "all", as Rows: nearest jamming, or of every state."""
    words = ["export", directory, replicate, "--format", "contacts"] + (["--path"] if path else [])
    with tempfile.TemporaryFile("w+", newline="", encoding="utf-8") as output:
        for said in filter(None, run(program, *words, stdout=output).splitlines()):
            warnings.warn(said, stacklevel=3)
        output.seek(0)
        return read_table(output, f"isojam {' '.join(map(str, words))}")
