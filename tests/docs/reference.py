"""Makes the tables of docs/fields.md from the schemas: reference.py SOURCE FACTS [--write]

SOURCE is the source tree. FACTS is the file facts.json, which the build writes next to the Python module. The tables of
NAME are between `<!-- block NAME -->` and `<!-- end -->`. With --write, the pages are updated. Without it, the pages
whose tables differ are printed, and the exit code is 1 if there are any.
"""

import json
import pathlib
import re
import sys

from schema import Schema, cell, fields_of, kinds


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(line) + " |" for line in lines]


def heading(kind, path):
    return f"### {kind}: {path}"


def anchor(kind, path):
    return re.sub(r"[^\w -]", "", f"{kind}: {path}").lower().replace(" ", "-")


# ---- Results -------------------------------------------------------------------------------------------------------
def result_rows(schema, kind, fields, units, path):
    rows = []
    for name, field in fields.items():
        inner = schema.resolved(field)
        target = schema.definition_of(field)
        where = f"{path}.{name}" if path else name
        if target:
            what = f"[{target}](#{anchor(kind, target)})"
            what = ("list of " if "array" in inner.get("type", []) else "") + what
            what += " or null" if {"type": "null"} in field.get("anyOf", []) else ""
        elif fields_of(inner) or fields_of(inner.get("items", {})):
            what = ("list of objects" if "items" in inner else "object") + f", [below](#{anchor(kind, where)})"
            what += " or null" if "null" in inner.get("type", []) else ""
        else:
            what = cell(kinds(schema, field)) or "any"
        unit = units.get((kind, where))
        unit = None if unit in ("per particle", "particles", "L") else unit  # the description contains these
        meaning = inner.get("description", "") + (f" Unit: {unit}." if unit else "")
        rows.append([f"`{name}`", what, cell(meaning)])
    return rows


def objects_block(schema, kind, roots, units):
    lines = []
    for root_path, node in roots:
        for path, fields, _ in schema.objects(node, root_path):
            if path:
                lines += [heading(kind, path), ""]
            if path and path == root_path and "description" in node:
                lines += [node["description"], ""]
            lines += [*table(("field", "value", "meaning"), result_rows(schema, kind, fields, units, path)), ""]
    return lines


def record_units(schema, quantities):
    """Units of quantities, by their places in records."""
    units = {}
    for one in quantities:
        if one["unit"] == "1":
            continue
        keys = one["pointer"].split("/")[1:]
        root = "" if one["of"] == "replicate" else "state"
        if keys[0].startswith("kind_"):
            root, keys = "kind", keys[1:]
        units["Record", ".".join(filter(None, (root, *keys)))] = one["unit"]
    return units


def quantity_block(record, tables, quantities):
    known = {one["name"]: one for one in quantities}
    rows = []
    for name, field in tables.tree["properties"]["rows"]["items"]["properties"].items():
        if field.get("$ref") != "#/definitions/estimate":
            continue
        one = known[name]
        of_state = one["of"] == "state"
        root = record.tree["definitions"]["state"] if of_state else None
        # Fields that several objects share, such as an exponent, are described per quantity in the schema of tables.
        meaning = field.get("description") or record.property_at(one["pointer"], root).get("description", "")
        rows.append([f"`{name}`", one["group"], one["unit"], "state" if of_state else "replicate",
                     f"`{one['pointer']}`", cell(meaning)])
    return table(("quantity", "table", "unit", "one value per", "place in records", "meaning"), rows) + [""]


def tables_block(schema):
    row = schema.tree["properties"]["rows"]["items"]
    plain = {name: field for name, field in row["properties"].items() if field.get("$ref") != "#/definitions/estimate"}
    series = row["properties"]["series"]["items"]["properties"]
    lines = table(("field", "value", "meaning"), result_rows(schema, "Table", schema.tree["properties"], {}, "")) + [""]
    parts = [("rows[]", plain)]
    for name in ("goal", "differences", "critical_angles"):
        fields = row["properties"][name]["properties"]
        parts.append((f"rows[].{name}", {key: field for key, field in fields.items()
                                         if field.get("$ref") != "#/definitions/estimate"}))
    parts.append(("rows[].series[]", {key: field for key, field in series.items()
                                      if field.get("$ref") != "#/definitions/estimate"}))
    own = ("pooled_trough", "trough", "estimate")  # definitions with tables of their own
    parts += [(name, schema.tree["definitions"][name]["properties"]) for name in own]
    for path, fields in parts:
        plain_rows = []
        for key, field in fields.items():
            inner = schema.resolved(field)
            deeper = f"{path}.{key}"
            links = {f"rows[].{name}" for name in ("goal", "differences", "critical_angles")}
            what = f"object, [below](#{anchor('Table', deeper)})" if deeper in links else \
                "object of estimates" if key == "all" else \
                f"[{target}](#{anchor('Table', target)})" if (target := schema.definition_of(field)) in own else \
                f"list of objects, [below](#{anchor('Table', deeper + '[]')})" if key == "series" else \
                cell(kinds(schema, field))
            plain_rows.append([f"`{key}`", what, cell(inner.get("description", ""))])
        lines += [heading("Table", path), "", *table(("field", "value", "meaning"), plain_rows), ""]
    return lines


def blocks(source, facts):
    quantities = json.loads(pathlib.Path(facts).read_text(encoding="utf-8"))["quantities"]
    names = ("replicate", "packing", "tables")
    record, packing, tables = (Schema(source, name) for name in names)
    definitions = [(name, node) for name, node in record.tree["definitions"].items() if fields_of(node)]
    files = packing.tree["definitions"]
    made = {
        "quantities": quantity_block(record, tables, quantities),
        "tables": tables_block(tables),
        "records": objects_block(record, "Record", [("", record.tree), *definitions], record_units(record, quantities)),
        "packings": objects_block(packing, "Packing", [(name, files[name]) for name in ("packing_file", "path_file")],
                                  {}),
    }
    return {name: "\n".join(lines).strip() for name, lines in made.items()}


PAGES = ("docs/fields.md",)


def rewritten(text, made, used):
    def block(match):
        name = match[1]
        used.add(name)
        return f"<!-- block {name} -->\n\n{made[name]}\n\n<!-- end -->"

    return re.sub(r"<!-- block (\w+) -->.*?<!-- end -->", block, text, flags=re.S)


def stale(source, facts, write=False):
    """Pages whose blocks differ from the schemas or the program, and blocks that no page has."""
    made, used, pages = blocks(source, facts), set(), []
    for name in PAGES:
        path = pathlib.Path(source) / name
        text = path.read_text(encoding="utf-8")
        new = rewritten(text, made, used)
        if new != text:
            pages.append(name)
            if write:
                path.write_text(new, encoding="utf-8")
    return pages, sorted(set(made) - used)


if __name__ == "__main__":
    changed, missing = stale(sys.argv[1], sys.argv[2], "--write" in sys.argv[3:])
    for page in changed:
        print(f"{page}: {'written' if '--write' in sys.argv[3:] else 'differs from the schemas'}")
    for name in missing:
        print(f"no page has the block {name}")
    sys.exit(1 if missing or (changed and "--write" not in sys.argv[3:]) else 0)
