"""Reads the JSON schemas of the project, to make tables of objects, their fields, and the allowed values and
meanings."""

import json
import pathlib


class Schema:
    """One of the files in schemas/. Only the parts of draft-07 that these files use are supported."""

    def __init__(self, root, name):
        self.name = name
        self.tree = json.loads((pathlib.Path(root) / f"schemas/{name}.schema.json").read_text(encoding="utf-8"))

    def resolved(self, node):
        """A node with its reference replaced. A description in the node itself has precedence."""
        inner = node
        for part in node.get("allOf", []) + ([self.at(node["$ref"])] if "$ref" in node else []):
            inner = {**self.resolved(part), **inner}
        return inner

    def at(self, reference):
        node = self.tree
        for key in reference.removeprefix("#/").split("/"):
            node = node[key]
        return node

    def definition_of(self, node):
        """Name of the definition to which a node refers, if this definition has fields; otherwise None."""
        for part in [node, *node.get("allOf", []), node.get("items", {}), *node.get("anyOf", [])]:
            name = part.get("$ref", "").rsplit("/", 1)[-1]
            if name and fields_of(self.tree["definitions"][name]):
                return name
        return None

    def property_at(self, pointer, node=None):
        """Schema of the value at a JSON pointer. The pointer starts at `node`, or at the root of a document."""
        node = self.tree if node is None else node
        for key in pointer.split("/")[1:]:
            node = self.resolved(node)
            if key in node.get("properties", {}):
                node = node["properties"][key]
            elif key.startswith("kind_"):
                node = self.tree["definitions"]["kind"]
            else:
                raise KeyError(f"{self.name}: {pointer}")
        return self.resolved(node)

    def names(self, node=None):
        """Names of all fields, in the node and everything below it."""
        node = self.tree if node is None else node
        if isinstance(node, list):
            return set().union(*map(self.names, node)) if node else set()
        if not isinstance(node, dict):
            return set()
        found = set(node["properties"]) if isinstance(node.get("properties"), dict) else set()
        return found.union(*(self.names(value) for value in node.values()))

    def objects(self, node, path=""):
        """Triples of a path, the fields of the object at this path, and the names of the required ones.

        The node itself comes first, then the objects inside it, in their order. Objects that a definition describes are
        left out."""
        fields = fields_of(node)
        if fields:
            yield path, fields, set(node.get("required", []))
        for name, field in fields.items():
            if self.definition_of(field) is None:
                yield from self.objects(self.resolved(field), f"{path}.{name}" if path else name)
        inner = node.get("items")
        if inner is not None and self.definition_of(node) is None:
            yield from self.objects(inner, f"{path}[]")
        for part in node.get("oneOf", []) + node.get("anyOf", []):
            if "$ref" not in part and path:
                yield from self.objects(part, path)


def fields_of(node):
    return node.get("properties", {}) if node.get("type") != "null" else {}


def cell(text):
    return text.replace("|", "\\|")


def code(value):
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def bounds(node):
    said = []
    for key, sign in (("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<")):
        if key in node:
            said.append(f"{sign} {number(node[key])}")
    return ", ".join(said)


def number(x):
    """A number as text. The largest integer up to which doubles represent every integer is written 2^53."""
    return "2^53" if x == 2**53 else f"{x:g}" if isinstance(x, float) else str(x)


def alternatives(parts):
    """Parts with "or" before the last one."""
    return " or ".join(filter(None, (", ".join(parts[:-1]), parts[-1])))


PLURALS = {"number": "numbers", "integer": "integers", "object": "objects", "text": "texts", "list": "lists"}


def elements(schema, node):
    """Allowed kinds of the elements of a list, as text."""
    inner = schema.resolved(node.get("items", {}))
    text = kinds(schema, inner) or "values"
    if "enum" in inner:
        return f"any of {text}"
    if " or " in text:
        return f"values ({text})"
    word = text.split(" ")[0]
    return PLURALS.get(word, word) + text[len(word):]


def kinds(schema, node):
    """Allowed types of a value, as text."""
    node = schema.resolved(node)
    if "const" in node:
        return code(node["const"])
    if "enum" in node:
        return alternatives([code(value) for value in node["enum"]])
    names = node.get("type", [])
    names = [names] if isinstance(names, str) else list(names)
    if not names:
        parts = [kinds(schema, part) for part in node.get("oneOf", []) + node.get("anyOf", [])]
        return either(dict.fromkeys(part for part in parts if part))
    words = []
    for name in names:
        if name == "array":
            least, most = node.get("minItems"), node.get("maxItems")
            many = f"{least} " if least and least == most else f"up to {most} " if most else ""
            words.append(f"list of {many}{elements(schema, node)}")
        elif name in ("number", "integer"):
            words.append(" ".join(filter(None, (name, bounds(node)))))
        else:
            words.append({"string": "text", "boolean": "`true` or `false`"}.get(name, name))
    return either(words)


def either(words):
    """Alternatives. A comma ends a list, which may contain "or" itself."""
    words = list(words)
    return (", or " if any(word.startswith("list of ") or " or " in word for word in words) else " or ").join(words)
