"""Results directories for the browser tests: results of a real run, modified copies of it, and artificial packings."""

import fractions
import json
import math
import pathlib
import random
import re
import shutil
import subprocess

MEASURES = ["contacts", "order", "clusters", "modes", "moduli", "strict", "shear", "rigidity", "exponents", "backbone", "difference_modes",
            "gaps"]
HOSTILE = "<script>alert(1)</script>"


def manifest(**changes):
    """A manifest of packings that take about one second each: 24 or 28 dodecahedra, minimised to large residuals."""
    tiny = {
        "name": "tiny", "seed": 11, "sweep": {"solid": ["dodecahedron"], "particles": [24, 28]}, "replicates": 2,
        "protocol": {"initial_density": 0.3, "compression_step": 0.07, "target_energy": 3e-7, "longest_step": 0.03,
                     "step_fraction": 0.4, "final_distance": 0.03, "fit_window": 0.1},
        "minimiser": {"residual": 1e-3, "max_evaluations": 2000},
        "measure": MEASURES, "shear": {"step": 0.002, "until": 0.006},
    }
    return {**tiny, **changes}


def checksum(data):
    """64-bit FNV-1a hash of `data`."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


NUMBER = "@number "


def read(path):
    """Reads a document, and keeps each number as text. A checksum depends on these texts, and Python would write some
    of the numbers with other digits."""
    return json.loads(path.read_text(encoding="utf-8"), parse_float=lambda digits: NUMBER + digits)


def text_of(document, **form):
    return re.sub(f'"{NUMBER}([^"]*)"', r"\1", json.dumps(document, ensure_ascii=False, **form))


def write_sealed(path, document, indent=2):
    """Writes a document with its checksum as isojam does: it is the second key, and is computed with zeros in its
    place."""
    first, *others = [(key, value) for key, value in document.items() if key != "checksum"]
    text = text_of(dict([first, ("checksum", "0" * 16), *others]), indent=indent) + "\n"
    path.write_text(text.replace("0" * 16, checksum(text.encode()), 1), encoding="utf-8")


def result_digest(record):
    """The result digest as isojam computes it: the hash of a record without timing, provenance, checksum and digest."""
    result = {key: value for key, value in record.items()
              if key not in ("checksum", "timing", "provenance", "result_digest")}
    return checksum(text_of(result, separators=(",", ":")).encode())


def change_record(path, change):
    """Changes a record, and updates its digest and checksum, the beginning of its packing file, and the names of both
    files."""
    document = read(path)
    assert result_digest(document) == document["result_digest"], path
    change(document)
    document["result_digest"] = result_digest(document)
    spec = document["spec"]
    name = f"{spec['solid']}-N{spec['particles']}-r{spec['replicate']:04}"
    path.unlink()
    write_sealed(path.with_stem(name), document)
    packing = path.parents[1] / "packings" / path.name
    if packing.exists():
        held = read(packing)
        packing.unlink()
        held.update(replicate=name, result_digest=document["result_digest"])
        write_sealed(packing.with_stem(name), held)


def fail(record):
    record["status"] = "failed"
    record["failure"] = {"where": "jam", "why": f"made to fail with {record['spec']['particles']} particles"}
    for key in ("flags", "phi_j", "nearest"):
        record[key], record[f"{key}_reason"] = None, "the replicate failed"


MOVED = {"Z": 0.2, "Z_ff": 0.1, "Z_ef": 0.1, "Z_l": 0.2, "C": 0.3, "energy_per_particle": 0, "omega_l": 0, "omega_h": 0,
         "K": 0, "G": 0, "cpu_seconds": 0, "stress": 0}


def slim(value):
    """A copy of a record with shorter lists of numbers, so that hundreds of records can be written quickly. The lists of
    a histogram of angles depend on each other, and stay as they are."""
    if isinstance(value, dict):
        return {key: part if key == "angle_bins" else slim(part) for key, part in value.items()}
    if not isinstance(value, list):
        return value
    step = math.ceil(len(value) / 30) if value and isinstance(value[0], (str, int)) else 1
    return [slim(part) for part in value[::step]]


def written_alike(number):
    """A number near `number` with fewer digits. It is far enough from the limits between doubles for every program to
    print the same shortest digits."""
    for digits in range(8, 0, -1):
        text = f"{number:.{digits}g}"
        if abs(fractions.Fraction(text) - fractions.Fraction(float(text))) < 0.4 * fractions.Fraction(math.ulp(number)):
            return float(text)
    return 0.0


def moved(value, numbers, denser):
    """A modified copy of a record, for another replicate. All densities are shifted by the same value; other numbers
    are changed independently."""
    shift = denser + numbers.gauss(0, 0.004)

    def change(part, key=None):
        if isinstance(part, dict):
            return {name: change(inner, name) for name, inner in part.items()}
        if isinstance(part, list):
            return [change(inner, key) for inner in part]
        if not isinstance(part, str) or not part.startswith(NUMBER):
            return part
        number = float(part[len(NUMBER):])
        if key in ("density", "phi_j"):
            number += shift
        elif key in MOVED:
            number = number + numbers.gauss(0, MOVED[key]) if MOVED[key] else number * math.exp(numbers.gauss(0, 0.15))
        else:
            return part
        return written_alike(number)

    return change(value)


class Pages:
    """Makes results directories below `root`, and reports of them with the isojam executable."""

    def __init__(self, executable, root):
        self.executable, self.root = executable, pathlib.Path(root)

    def run(self, name, **changes):
        """Runs a study and returns its results directory. Replicates may fail."""
        source = self.root / f"{name}.json"
        source.write_text(json.dumps(manifest(**changes)))
        ran = subprocess.run([self.executable, "--quiet", "run", source, "-o", self.root / name], check=False,
                             stdout=subprocess.DEVNULL)
        assert ran.returncode in (0, 1), ran.returncode
        return self.root / name

    def copied(self, name, source):
        shutil.copytree(source, self.root / name)
        return self.root / name

    def report(self, directory):
        """Makes the report of a results directory, and returns its path."""
        made = subprocess.run([self.executable, "report", directory], check=True, capture_output=True, text=True)
        assert made.stdout == f"{directory}/report.html\n", made.stdout
        return directory / "report.html"

    def table(self, directory, form):
        made = subprocess.run([self.executable, "aggregate", directory, "--format", form], check=True,
                              capture_output=True, text=True)
        return made.stdout

    def with_failures(self, name, source, which):
        directory = self.copied(name, source)
        for path in sorted((directory / "records").iterdir()):
            if which(path.stem):
                change_record(path, fail)
                (directory / "packings" / path.name).unlink()
        return directory

    def flagged(self, name, source, flags):
        """A copy of results in which replicates have the flags in `flags`, by name. Other replicates have no flags."""
        directory = self.copied(name, source)
        for path in sorted((directory / "records").iterdir()):
            change_record(path, lambda record, stem=path.stem: record.update(flags=flags.get(stem, [])))
        return directory

    def single(self, name, source):
        directory = self.copied(name, source)
        for folder in ("records", "packings"):
            for path in sorted((directory / folder).iterdir())[:-1]:
                path.unlink()
        return directory

    def forged(self, name, source):
        """A copy of results in which texts of records are markup."""
        directory = self.copied(name, source)

        def forge(record):
            record["provenance"]["compiler"] = HOSTILE + "<img src=x onerror=alert(2)>"

        for path in sorted((directory / "records").iterdir()):
            change_record(path, forge)
        return directory

    def many(self, name, source, replicates, solids):
        """Results with `replicates` replicates of every sweep point of `source`.

        They are shortened and modified copies of the real ones. Every tenth is crystalline with a much higher density.
        All replicates of a sweep point in `solids` have that solid. At other sweep points, the first copies have the
        packings of the real replicates."""
        directory = self.root / name
        shutil.copytree(source, directory, ignore=lambda folder, names: [entry for entry in names if "-r" in entry])
        without_manifest(directory)
        numbers, points = random.Random(5), {}
        for path in sorted((source / "records").iterdir()):
            points.setdefault(path.stem.rpartition("-r")[0], []).append(path)
        for stem, paths in points.items():
            originals = [slim(read(path)) for path in paths]
            for k in range(replicates):
                record = moved(originals[k % len(paths)], numbers, 0.08 if k % 10 == 9 else 0)
                record["spec"].update(replicate=k, solid=solids.get(stem, record["spec"]["solid"]))
                record["flags"] = ["crystalline"] if k % 10 == 9 else ["not_stable"] if k % 10 == 4 else []
                record["result_digest"] = result_digest(record)
                copy_name = f"{record['spec']['solid']}-N{record['spec']['particles']}-r{k:04}"
                write_sealed(directory / "records" / f"{copy_name}.json", record, indent=None)
                if stem not in solids and k < len(paths):
                    held = read(source / "packings" / paths[k].name)
                    held.update(replicate=copy_name, result_digest=record["result_digest"])
                    write_sealed(directory / "packings" / f"{copy_name}.json", held)
        return directory


def without_manifest(directory):
    """The directory after its manifests were removed, because they do not request the records that are made by hand."""
    (directory / "manifest.json").unlink()
    shutil.rmtree(directory / "manifests")
    return directory
