"""JSON files of isojam, and the checksums that they contain.

The second key, "checksum", is the 64-bit FNV-1a hash of the file with zeros in place of its sixteen digits. The hash is
computed byte by byte: for each byte b, h = (h xor b)·p modulo 2^64. The two steps below give the same result with array
operations of numpy:

- The xor changes only the low byte l of h: h xor b = h + d with d = (l xor b) − l. If all d are known, h is a
  polynomial in p: h_n = p^n h_0 + Σ_i d_i p^(n−i) modulo 2^64. This sum is a scalar product.
- Each low byte follows from the previous one: l' = p·(l xor b) modulo 256. Since p is odd, bit k of l' is bit k of l,
  flipped by bit k of b and by the carry from the lower bits. If the lower bits of all low bytes are known, bit k of all
  low bytes is therefore a running xor. The bits are computed one after another, from the lowest."""

import json
import os
from typing import Any

import numpy
from numpy.typing import NDArray

from .errors import InputError
from .files import open_file, parse_json, reading

PRIME = 0x100000001B3
BASIS = 0xCBF29CE484222325
MASK = (1 << 64) - 1
BLOCK = 1 << 16
_WORD = numpy.dtype("<u8")
_BEFORE, _BLANK = b'"checksum": "', b"0" * 16
#: The checksum begins before this position: it is the second member, and names of schemas are short.
_FARTHEST = 200
_WHOLE = "a complete file written by isojam"


def _powers() -> NDArray[numpy.uint64]:
    """p^BLOCK, …, p^2, p."""
    return numpy.multiply.accumulate(numpy.full(BLOCK, PRIME, dtype=numpy.uint64))[::-1].copy()


_POWERS = _powers()


def _running_xor(flips: NDArray[numpy.uint8]) -> None:
    """Replaces each byte by the xor of all bytes up to it. The number of bytes must be a multiple of eight."""
    words = flips.view(_WORD)
    for shift in (8, 16, 32):
        words ^= words << _WORD.type(shift)
    ends = numpy.bitwise_xor.accumulate(words >> _WORD.type(56))
    words[1:] ^= ends[:-1] * _WORD.type(0x0101010101010101)


def _mixed_low_bytes(data: NDArray[numpy.uint8], low: int) -> NDArray[numpy.uint8]:
    """l xor b for every byte b, where l is the low byte of the hash before b. `low` is l for the first byte."""
    mixed = numpy.zeros_like(data)
    flips = numpy.empty_like(data)
    for k in range(8):
        bit = numpy.uint8(1 << k)
        carried = mixed * numpy.uint8(PRIME & 0xFF)
        flips[0] = low
        numpy.bitwise_xor(data[:-1], carried[:-1], out=flips[1:])
        flips &= bit
        _running_xor(flips)
        flips ^= data
        flips &= bit
        mixed |= flips
    return mixed


def fnv1a(data: bytes) -> int:
    """The 64-bit FNV-1a hash of `data`."""
    everything = numpy.frombuffer(data, dtype=numpy.uint8)
    value = BASIS
    for start in range(0, len(everything), BLOCK):
        block = everything[start:start + BLOCK]
        n = len(block)
        padded = numpy.concatenate([block, numpy.zeros(-n % 8, dtype=numpy.uint8)])
        mixed = _mixed_low_bytes(padded, value & 0xFF)
        change = (mixed.astype(numpy.int64) - (mixed ^ padded))[:n]
        total = numpy.dot(change.view(numpy.uint64), _POWERS[BLOCK - n:])
        value = (value * pow(PRIME, n, 1 << 64) + int(total)) & MASK
    return value


def check_seal(data: bytes, file: str | os.PathLike[str]) -> None:
    """Raises InputError unless the file has a checksum that matches its bytes."""
    at = data.find(_BEFORE, 0, _FARTHEST)
    if at < 0 or len(data) < at + len(_BEFORE) + len(_BLANK):
        raise InputError(file, "/checksum", "the file has no checksum", _WHOLE)
    at += len(_BEFORE)
    stated = data[at:at + len(_BLANK)]
    if b"%016x" % fnv1a(data[:at] + _BLANK + data[at + len(_BLANK):]) != stated:
        raise InputError(file, "/checksum", "the file is damaged: its content does not match its checksum",
                         "an unchanged file written by isojam")


def read_sealed(file: str | os.PathLike[str], schema: str = "", check: bool = True) -> dict[str, Any]:
    """Returns the document in a file that isojam wrote, as a dict.

    Raises InputError if the file cannot be read, is not valid JSON, or has another schema than `schema`. If
    `check` is true, also raises it if the checksum does not match."""
    with reading(file, _WHOLE):
        with open_file(file) as opened:
            data = opened.read()
        if check:
            check_seal(data, file)
        document = parse_json(data)
        if schema and document.get("schema") != schema:
            raise InputError(file, "/schema", f"unknown value {json.dumps(document.get('schema'))}", f'"{schema}"')
    return document


def check_owner(document: dict[str, Any], file: str | os.PathLike[str], name: str, record: dict[str, Any]) -> None:
    """Raises InputError unless the first keys of a packing file or a path file identify this record."""
    provenance = record["provenance"]
    now = {"manifest_digest": provenance["manifest_digest"], "result_digest": record["result_digest"]}
    # Files of packings and paths do not change when measures are added to the record.
    owners = [{"replicate": name, **digests} for digests in [now] + [each["before"] for each in provenance.get("added", [])]]
    if any(all(document.get(key) == expected for key, expected in owner.items()) for owner in owners):
        return
    for key, expected in owners[0].items():
        if document.get(key) != expected:
            raise InputError(file, "/" + key, f"{json.dumps(document.get(key))} does not match the record",
                             f'"{expected}"')
