"""Tests the pages about fields. usage: fields_test.py SOURCE FACTS"""

import json
import pathlib
import re
import sys
import unittest

import reference

SOURCE, FACTS = map(pathlib.Path, sys.argv[1:3])


def text_of(name):
    return (SOURCE / name).read_text(encoding="utf-8")


def schema_of(name):
    return json.loads(text_of(f"schemas/{name}.schema.json"))


def fields(node):
    """Pairs of a name and a schema, for every field below a node."""
    if isinstance(node, list):
        for value in node:
            yield from fields(value)
    elif isinstance(node, dict):
        if isinstance(node.get("properties"), dict):
            yield from node["properties"].items()
        for value in node.values():
            yield from fields(value)


def rows_of(page):
    """Cells of every table row whose first cell is a name, by that name."""
    rows = {}
    for line in page.split("\n"):
        match = re.match(r"\| `([^`]+)` \|(.*)\|$", line)
        if match:
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", match[2])]
            rows.setdefault(match[1], []).append(cells)
    return rows


def missing_fields(page, schemas):
    rows = rows_of(page)
    names = {name for schema in schemas for name, _ in fields(schema)}
    return sorted(name for name in names if name not in rows or not all(cells[-1] for cells in rows[name]))


class Fields(unittest.TestCase):
    def test_tables_are_those_of_today(self):
        stale, missing = reference.stale(SOURCE, FACTS)
        self.assertEqual((stale, missing), ([], []), "tests/docs/reference.py SOURCE FACTS --write makes them again")

    def test_fields_have_rows(self):
        page, schemas = text_of("docs/fields.md"), [schema_of(name) for name in ("replicate", "packing", "tables")]
        self.assertGreater(len({name for schema in schemas for name, _ in fields(schema)}), 200)
        self.assertEqual(missing_fields(page, schemas), [])
        self.assertIn("(w, x, y, z)", page)
        rows = rows_of(page)
        for one in json.loads(FACTS.read_text(encoding="utf-8"))["quantities"]:
            self.assertTrue(any(one["unit"] in cells for cells in rows.get(one["name"], [])),
                            f"docs/fields.md has no row of {one['name']} with its unit")

    def test_quantities_have_different_meanings(self):
        page = text_of("docs/fields.md").split("## Quantities")[1].split("\n## ")[0]
        names = {}
        for name, rows in rows_of(page).items():
            names.setdefault(rows[0][-1], []).append(name)
        self.assertGreater(len(names), 50)
        self.assertEqual([same for same in names.values() if len(same) > 1], [])

    def test_measures_have_rows(self):
        rows = rows_of(text_of("docs/manifest.md").split("## Measures")[1].split("\n## ")[0])
        self.assertEqual(set(rows), set(schema_of("manifest")["properties"]["measure"]["items"]["enum"]))

    def test_flags_have_rows(self):
        page = text_of("docs/results.md").split("## Flags")[1].split("\n## ")[0]
        self.assertEqual(set(rows_of(page)), set(schema_of("manifest")["properties"]["exclude"]["items"]["enum"]))

    def test_what_is_missing_is_found(self):
        page, schema = text_of("docs/fields.md"), [schema_of("replicate")]
        renamed = page.replace("| `particles_moved` |", "| moved |")
        self.assertEqual(missing_fields(renamed, schema), ["particles_moved"])
        row = next(line for line in page.split("\n") if line.startswith("| `residual_floor` |"))
        bare = page.replace(row, "| `residual_floor` | number | |")
        self.assertEqual(missing_fields(bare, schema), ["residual_floor"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
