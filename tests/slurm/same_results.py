#!/usr/bin/python3
"""Checks that two results directories have the same results. usage: same_results.py DIR OTHER

The table and the packings must have the same bytes. Records may differ only in their time and in the checksum.
Differences are printed. The exit code is 1 if there are differences or no records.
"""
import json
import pathlib
import sys

OF_THE_RUN = ("timing", "checksum")


def files(directory, folder):
    return {path.name: path for path in sorted((directory / folder).iterdir())}


def result_of(path):
    record = json.loads(path.read_text())
    for key in OF_THE_RUN:
        del record[key]
    return record


def differences(one, other, folder, read):
    ours, theirs = files(one, folder), files(other, folder)
    yield from (f"{folder}/{name}: in one of them only" for name in ours.keys() ^ theirs.keys())
    yield from (f"{folder}/{name}" for name in ours.keys() & theirs.keys() if read(ours[name]) != read(theirs[name]))


def main(one, other):
    found = sorted(differences(one, other, "records", result_of))
    found += sorted(differences(one, other, "packings", pathlib.Path.read_bytes))
    if (one / "tables.json").read_bytes() != (other / "tables.json").read_bytes():
        found.append("tables.json")
    for difference in found:
        print(f"differs: {difference}")
    records = len(files(one, "records"))
    print(f"{records} records, {len(files(one, 'packings'))} packings, {len(found)} differences")
    return 1 if found or records == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*map(pathlib.Path, sys.argv[1:])))
