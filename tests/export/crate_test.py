"""Facts proved here, of crates that isojam writes, by a reader that knows JSON and RO-Crate 1.1 and nothing of isojam:
- the description is flat: entities with an id and a type, each id once, every reference to one that is there;
- it names manifest, records, packings, paths, table and report, all of them and nothing else, with the sizes and SHA-256
  that they have; not checkpoints, temporaries or what others put there;
- root, profile, software, run, paper, license and agent have what the Process Run Crate asks for; without options there
  is no license of the data and no agent;
- the same directory gives the same bytes, elsewhere and at another time too;
- records of two builds are results of two runs; a replicate that failed has a record and no more;
- a damaged record, packing, path, table or manifest is refused with its place, and so are a directory without records, a
  day that there is not, and what is no license or name; nothing is written then.
usage: crate_test.py ISOJAM RESULTS
"""

import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

EXECUTABLE, RESULTS = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
del sys.argv[1:3]
NAME = "ro-crate-metadata.json"
DATE = ("--date", "2026-01-31")


def sealed_again(text):
    """With the checksum that it should have: FNV-1a of the text with zeros in place of the digits."""
    digits = re.compile(r'(?<="checksum": ")[0-9a-f]{16}')
    text = digits.sub("0" * 16, text, count=1)
    checksum = 0xCBF29CE484222325
    for byte in text.encode():
        checksum = ((checksum ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return digits.sub(f"{checksum:016x}", text, count=1)


def references(value):
    """Every {"@id": …} within an entity."""
    if isinstance(value, list):
        for each in value:
            yield from references(each)
    elif isinstance(value, dict):
        if set(value) == {"@id"}:
            yield value["@id"]
        else:
            for each in value.values():
                yield from references(each)


class Crate(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="isojam-crate-")
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        self.results = self.root / "results"
        shutil.copytree(RESULTS, self.results)
        (self.results / NAME).unlink(missing_ok=True)
        (self.results / "report.html").write_text("<!doctype html><title>made up</title>")

    def crate(self, *arguments, code=0, results=None):
        done = subprocess.run([EXECUTABLE, "crate", results or self.results, *arguments], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, code, done)
        return done

    def described(self, *arguments):
        done = self.crate(*DATE, *arguments)
        self.assertEqual(done.stdout, f"{self.results / NAME}\n")
        document = json.loads((self.results / NAME).read_text())
        self.assertEqual(set(document), {"@context", "@graph"})
        self.assertIn("https://w3id.org/ro/crate/1.1/context", document["@context"])
        graph = document["@graph"]
        entities = {entity["@id"]: entity for entity in graph}
        self.assertEqual(len(entities), len(graph), "an id twice")
        for entity in graph:
            self.assertIsInstance(entity["@type"], str)
            for reference in references([value for key, value in entity.items() if key != "@id"]):
                known = reference in entities or reference == "https://w3id.org/ro/crate/1.1"
                self.assertTrue(known, f"{entity['@id']} refers to {reference}, which is not there")
        return entities

    def of_type(self, entities, name):
        return [entity for entity in entities.values() if entity["@type"] == name]

    def files_there(self):
        return {str(file.relative_to(self.results)) for file in self.results.rglob("*") if file.is_file()}

    def test_every_file_is_there_with_its_hash(self):
        before = self.files_there()
        (self.results / "checkpoints").mkdir(exist_ok=True)
        for other in ("checkpoints/octahedron-N64-r0000.json", "records/.octahedron-N64-r0000.json.x.tmp", "notes.txt"):
            (self.results / other).write_text("{}")
        files = self.of_type(self.described(), "File")
        self.assertEqual({urllib.parse.unquote(file["@id"]) for file in files}, before)
        self.assertTrue({"manifest.json", "tables.json", "report.html"} <= before)
        self.assertTrue(any(name.startswith("paths/") for name in before))
        for file in files:
            content = (self.results / urllib.parse.unquote(file["@id"])).read_bytes()
            self.assertEqual(file["sha256"], hashlib.sha256(content).hexdigest(), file["@id"])
            self.assertEqual(int(file["contentSize"]), len(content), file["@id"])
            self.assertEqual(file["encodingFormat"],
                             "text/html" if file["@id"].endswith("html") else "application/json")

    def test_it_is_a_process_run_crate(self):
        entities = self.described("--license", "CC-BY-4.0", "--agent", "Ada Lovelace <https://orcid.org/0000-0000>")
        self.assertEqual(entities[NAME]["about"], {"@id": "./"})
        self.assertEqual(entities[NAME]["conformsTo"], {"@id": "https://w3id.org/ro/crate/1.1"})
        root = entities["./"]
        self.assertEqual(root["@type"], "Dataset")
        self.assertEqual(root["datePublished"], DATE[1])
        self.assertEqual(entities[root["conformsTo"]["@id"]]["version"], "0.5")
        self.assertTrue(root["name"] and root["description"])
        (action,) = self.of_type(entities, "CreateAction")
        self.assertEqual(root["mentions"], [{"@id": action["@id"]}])
        self.assertEqual(action["object"], {"@id": "manifest.json"})
        results = {part["@id"] for part in root["hasPart"]} - {"manifest.json"}
        self.assertEqual({result["@id"] for result in action["result"]}, results)
        self.assertEqual(entities[action["agent"]["@id"]],
                         {"@id": "https://orcid.org/0000-0000", "@type": "Person", "name": "Ada Lovelace"})
        program = entities[action["instrument"]["@id"]]
        record = json.loads(next((self.results / "records").iterdir()).read_text())
        self.assertEqual(program["@type"], "SoftwareApplication")
        self.assertEqual((program["name"], program["softwareVersion"]), ("isojam", record["provenance"]["version"]))
        self.assertEqual(entities[program["identifier"]["@id"]]["value"], record["provenance"]["git"])
        self.assertEqual(root["license"], {"@id": "https://spdx.org/licenses/CC-BY-4.0"})
        paper = entities[root["citation"]["@id"]]
        self.assertEqual(paper["@type"], "ScholarlyArticle")
        self.assertTrue(paper["@id"].startswith("https://doi.org/10."))
        # Records know no times of day, and none is made up.
        self.assertFalse({"startTime", "endTime"} & set(action))

    def test_nobody_is_made_up(self):
        entities = self.described()
        self.assertNotIn("license", entities["./"])
        self.assertNotIn("agent", self.of_type(entities, "CreateAction")[0])

    def test_the_same_directory_gives_the_same_bytes(self):
        self.described()
        first = (self.results / NAME).read_bytes()
        copy = self.root / "copy"
        shutil.copytree(self.results, copy)
        for file in copy.rglob("*"):
            os.utime(file, (1e9, 1e9))
        self.crate(*DATE, results=copy)
        self.assertEqual((copy / NAME).read_bytes(), first)

    def test_builds_are_told_apart(self):
        other = sorted((self.results / "records").iterdir())[0]
        text = other.read_text()
        version = json.loads(text)["provenance"]["version"]
        other.write_text(sealed_again(text.replace(f'"version": "{version}"', '"version": "0.0.1"', 1)))
        entities = self.described()
        actions = {entities[action["instrument"]["@id"]]["softwareVersion"]: action
                   for action in self.of_type(entities, "CreateAction")}
        self.assertEqual(set(actions), {version, "0.0.1"})
        made = {name: {result["@id"] for result in action["result"]} for name, action in actions.items()}
        self.assertEqual(made["0.0.1"], {f"{folder}/{other.name}" for folder in ("records", "packings", "paths")})
        self.assertFalse(made[version] & (made["0.0.1"] | {"tables.json", "report.html"}))

    def test_a_failed_replicate_has_its_record_alone(self):
        manifest = self.root / "failing.json"
        manifest.write_text(json.dumps({
            "name": "failing", "seed": 1, "replicates": 1, "protocol": {"max_steps": 1},
            "sweep": {"solid": ["dodecahedron"], "particles": [24]}}))
        failing = self.root / "failing"
        subprocess.run([EXECUTABLE, "run", manifest, "-o", failing, "--quiet"], capture_output=True, check=False)
        self.crate(*DATE, results=failing)
        graph = json.loads((failing / NAME).read_text())["@graph"]
        self.assertEqual([entity["@id"] for entity in graph if entity["@type"] == "File"],
                         ["manifest.json", "records/dodecahedron-N24-r0000.json", "tables.json"])
        (action,) = (entity for entity in graph if entity["@type"] == "CreateAction")
        self.assertIn("of which 1 failed", action["description"])

    def test_what_is_damaged_is_refused(self):
        for folder in ("records", "packings", "paths", "."):
            for file in sorted((self.results / folder).glob("*.json"))[:2]:
                content = file.read_bytes()
                middle = len(content) // 2
                file.write_bytes(content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1:])
                done = self.crate(*DATE, code=65)
                self.assertIn(str(file), done.stderr)
                file.write_bytes(content)
                self.assertFalse((self.results / NAME).exists(), file)
        packings = sorted((self.results / "packings").iterdir())
        packings[0].write_bytes(packings[1].read_bytes())
        self.assertIn(str(packings[0]), self.crate(*DATE, code=65).stderr)
        packings[0].unlink()
        self.assertIn(str(packings[0]), self.crate(*DATE, code=2).stderr)
        self.assertFalse((self.results / NAME).exists())

    def test_what_cannot_be_a_crate_is_refused(self):
        empty = self.root / "empty"
        empty.mkdir()
        self.assertIn("holds no records", self.crate(*DATE, code=2, results=empty).stderr)
        self.assertIn("no such directory", self.crate(*DATE, code=2, results=self.root / "none").stderr)
        self.assertEqual(list(empty.iterdir()), [])
        for wrong in ([], ["--date", "2026-02-30"], ["--date", "today"], [*DATE, "--license", "my own"],
                      [*DATE, "--agent", "<https://x>"], [*DATE, "--agent", "Ada <nowhere>"]):
            self.crate(*wrong, code=2)
        self.assertFalse((self.results / NAME).exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
