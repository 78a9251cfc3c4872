"""Tests the checksums of files."""

import re

import support
from support import CUBES, isojam, numpy

from isojam import seals


def byte_by_byte(data):
    value = seals.BASIS
    for byte in data:
        value = ((value ^ byte) * seals.PRIME) & seals.MASK
    return value


class Seals(support.Case):
    def test_the_hash(self):
        for text, value in ((b"", 0xCBF29CE484222325), (b"a", 0xAF63DC4C8601EC8C), (b"foobar", 0x85944171F73967E8)):
            self.assertEqual(seals.fnv1a(text), value, text)
        data = numpy.random.default_rng(1).integers(0, 256, 2 * seals.BLOCK + 20, dtype=numpy.uint8).tobytes()
        for n in [*range(40), *(k * seals.BLOCK + d for k in (1, 2) for d in (-9, -8, -1, 0, 1, 7, 8, 9))]:
            self.assertEqual(seals.fnv1a(data[:n]), byte_by_byte(data[:n]), f"{n} bytes")
        for byte in (0, 0x7F, 0x80, 0xFF):
            self.assertEqual(seals.fnv1a(bytes([byte]) * 1000), byte_by_byte(bytes([byte]) * 1000), f"bytes {byte}")

    def test_every_file_is_whole(self):
        files = [file for directory in support.ALL for file in directory.rglob("*.json")]
        self.assertGreater(len(files), 20)
        for file in files:
            seals.read_sealed(file)

    def test_a_flipped_byte(self):
        name = support.done(CUBES)[0]
        reads = {f"records/{name}.json": lambda study: study.replicates,
                 f"packings/{name}.json": lambda study: study.packing(name),
                 f"paths/{name}.json": lambda study: study.path(name), "manifest.json": lambda study: study}
        random = numpy.random.default_rng(3)
        for file, read in reads.items():
            where = self.copy(CUBES)
            whole = (where / file).read_bytes()
            digits = whole.index(b'"checksum": "') + 13
            for at in [digits, digits + 15, 0, len(whole) - 1, *random.integers(0, len(whole), 12)]:
                (where / file).write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:])
                error = self.refused(lambda: read(isojam.load(where)), file)
                self.assertEqual((error.file, error.place), (str(where / file), "/checksum"))
            # With another digit in a number it is JSON all the same.
            digit = max(match.end() for match in re.finditer(rb"\.\d", whole)) - 1
            other = b"1" if whole[digit:digit + 1] != b"1" else b"2"
            (where / file).write_bytes(whole[:digit] + other + whole[digit + 1:])
            self.refused(lambda: read(isojam.load(where)), file)
            read(isojam.load(where, check=False))

    def test_files_of_others(self):
        first, second = support.done(CUBES)[:2]
        where = self.copy(CUBES)
        for folder, read in (("packings", "packing"), ("paths", "path")):
            (where / folder / f"{first}.json").write_bytes((where / folder / f"{second}.json").read_bytes())
            error = self.refused(lambda: getattr(isojam.load(where), read)(first), folder, second)
            self.assertEqual(error.place, "/replicate")
        (where / "records" / f"{first}.json").write_bytes((where / "records" / f"{second}.json").read_bytes())
        self.assertEqual(self.refused(lambda: isojam.load(where).states, first).place, "/spec")

    def test_files_that_are_none(self):
        name = support.done(CUBES)[0]
        where = self.copy(CUBES)
        packing, record = where / f"packings/{name}.json", where / f"records/{name}.json"
        whole = packing.read_bytes()
        for content in (b"", whole[:len(whole) // 2], b"\xff" * 300):
            packing.write_bytes(content)
            self.refused(lambda: isojam.load(where).packing(name), str(packing), "written by isojam")
        packing.write_bytes(record.read_bytes())
        self.assertEqual(self.refused(lambda: isojam.load(where).packing(name), "isojam.packing").place, "/schema")
        packing.unlink()
        self.refused(lambda: isojam.load(where).packing(name), str(packing), "cannot be read")
        record.write_bytes(whole)
        self.assertEqual(self.refused(lambda: isojam.load(where).record(name), "isojam.replicate").place, "/schema")


if __name__ == "__main__":
    support.main()
