"""Every key of the model file as tables, from the JSON Schema that `scabo schema` prints, with an example of each key from
the model files of the repository.

    schema_reference.py SCABO ROOT > keys.md
"""
from __future__ import annotations

import json
import pathlib
import re
import subprocess
import sys
from collections.abc import Iterator

import yaml

# A unit at the end of a first sentence: `Thickness out of the plane, m.`
UNIT = re.compile(r", (m|m2|N|N/m|N/m2|N/m3|N/m4|N m|Pa|Pa/m|kg/m3|1/K|K|K/m|degrees|rad|m/s2|J|s)(?=[.;,:]|$| in| \()")
PROSE = {  # sections of docs/model about what a name of the schema does not say
    "place": "places", "edge_place": "places", "names": "shape-polygon", "piece": "shape-outline", "copies": "repeat", "support": "supports",
    "springs": "springs", "load": "loads", "contact": "contacts", "contact_property": "contact_properties", "friction": "contacts", "tie": "ties",
    "step": "steps", "curve": "curves", "material": "materials", "body": "bodies", "mesh": "mesh", "shape": "bodies", "quantity": "tolerance",
    "history_quantity": "history", "history_section": "history", "output_point": "output", "output_line": "output", "output_grid": "output",
}
SIMPLE = {"name", "number", "positive", "not_negative", "coefficient", "vector", "quantity", "output_range"}


class Loader(yaml.SafeLoader):
    """YAML 1.2's truth values: `on` is a key."""


Loader.yaml_implicit_resolvers = {
    letter: [(tag, pattern) for tag, pattern in pairs if tag != "tag:yaml.org,2002:bool"]
    for letter, pairs in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(?:true|false)$"), ["t", "f"])


class Reference:
    def __init__(self, schema: dict, root: pathlib.Path) -> None:
        self.schema, self.definitions, self.root = schema, schema["$defs"], root
        self.used: dict[str, list[str]] = {}      # definition: the paths of keys that hold it
        self.examples: dict[tuple[int, str], tuple[object, pathlib.Path]] = {}  # by identity of the object's schema
        self.sections: list[tuple[str, dict]] = []  # title and object schema, in the sequence of the file
        self.seen: set[str] = set()
        self.collect("", schema)
        for file in self.files():
            self.find(schema, load(file), file)

    def files(self) -> Iterator[pathlib.Path]:
        yield from sorted(self.root.glob("examples/*/*.yaml"))
        yield from sorted(self.root.glob("tests/input/good/*.yaml"))

    # ---- what the schema holds ------------------------------------------------------------------------------

    def target(self, schema: dict) -> tuple[str, dict]:
        """Name of the definition that a schema refers to (empty: none), and the schema itself."""
        if "$ref" in schema:
            name = schema["$ref"].rsplit("/", 1)[-1]
            return name, self.definitions[name]
        return "", schema

    def collect(self, title: str, schema: dict) -> None:
        if "properties" in schema:
            forms = 1 + sum(name.split(" (form")[0] == title for name, _ in self.sections)
            self.sections.append((title if forms == 1 else f"{title} (form {forms})", schema))
        for key, inner in schema.get("properties", {}).items():
            self.visit(f"{title}.{key}" if title else key, inner)
        for choice in choices_of(schema):
            self.visit(title, choice)

    def visit(self, path: str, schema: dict) -> None:
        name, inner = self.target(schema)
        if name:
            if name in SIMPLE:
                return
            if path not in self.used.setdefault(name, []):
                self.used[name].append(path)
            if name in self.seen:
                return
            self.seen.add(name)
            self.collect(name, inner)
            self.within(name, inner)
            return
        if "properties" in inner:
            self.collect(path, inner)
        else:
            for choice in choices_of(inner):
                self.visit(path, choice)
        self.within(path, inner)

    def within(self, path: str, schema: dict) -> None:
        if isinstance(schema.get("additionalProperties"), dict):
            self.visit(f"{path}.NAME", schema["additionalProperties"])
        if isinstance(schema.get("items"), dict):
            self.visit(f"{path}[]", schema["items"])

    # ---- examples -------------------------------------------------------------------------------------------

    def find(self, schema: dict, value: object, file: pathlib.Path) -> None:
        """Remembers the first value of every key that `value` has."""
        _, inner = self.target(schema)
        if isinstance(value, dict):
            for key, of_key in inner.get("properties", {}).items():
                if key in value:
                    self.examples.setdefault((id(inner), key), (value[key], file))
                    self.find(of_key, value[key], file)
            if isinstance(inner.get("additionalProperties"), dict):
                for held in value.values():
                    self.find(inner["additionalProperties"], held, file)
        if isinstance(value, list) and isinstance(inner.get("items"), dict):
            for held in value:
                self.find(inner["items"], held, file)
        for choice in choices_of(inner):
            if may_be(self.target(choice)[1], value):
                self.find(choice, value, file)

    # ---- text -----------------------------------------------------------------------------------------------

    def type_of(self, schema: dict) -> str:
        name, inner = self.target(schema)
        if name == "name":
            return "name"
        if name == "vector":
            return "[number, number]"
        if name and name not in SIMPLE and name in self.seen and "properties" in inner:
            return f"[{name}](#{anchor(name)})"
        if name and name in self.seen and name not in SIMPLE:
            return f"{self.plain_type(inner)}"
        return self.plain_type({**inner, **{key: value for key, value in schema.items() if key != "$ref"}})

    def plain_type(self, schema: dict) -> str:
        if "const" in schema:
            return f"`{text_of(schema['const'])}`"
        if "enum" in schema:
            return " or ".join(f"`{text_of(value)}`" for value in schema["enum"])
        if choices_of(schema) and "properties" not in schema:
            kinds = [self.type_of(choice) for choice in choices_of(schema)]
            return " or ".join(dict.fromkeys(kinds))
        types = schema.get("type", "object" if "properties" in schema else "any")
        types = [kind for kind in ([types] if isinstance(types, str) else types) if kind != "null"]
        if "number" in types or "integer" in types:
            return ("integer" if "integer" in types else "number") + range_of(schema)
        if "array" in types:
            items = self.type_of(schema.get("items", {}))
            if schema.get("minItems") and schema.get("minItems") == schema.get("maxItems") and schema["minItems"] <= 3:
                return "[" + ", ".join([items] * schema["minItems"]) + "]"
            least = f", {schema['minItems']} or more" if schema.get("minItems", 0) > 1 else ""
            return f"list of {items}{least}"
        if "object" in types:
            more = schema.get("additionalProperties")
            return f"by name: {self.type_of(more)}" if isinstance(more, dict) else "keys"
        return {"string": "text", "boolean": "`true` or `false`", "null": "`null`", "any": "any"}.get(types[0] if types else "null", "any")

    def section(self, title: str, schema: dict) -> str:
        required = required_of(schema)
        held = self.used.get(title, [])
        title, form = title.split(" (form")[0], title
        lines = [f"## {heading(form)}", ""]
        if schema.get("description") and title:
            lines += [schema["description"], ""]
        if held:
            lines += ["Stands at: " + ", ".join(f"`{path}`" for path in sorted(set(held))) + ".", ""]
        prose = self.prose(title)
        if prose:
            lines += [f"Explained in {prose}.", ""]
        lines += ["| key | type | unit | default | meaning | example |", "|---|---|---|---|---|---|"]
        for key, of_key in schema["properties"].items():
            text, unit = with_unit(self.description_of(of_key))
            default = "required" if key in required else f"`{text_of(of_key['default'])}`" if "default" in of_key else ""
            kind = self.type_of(of_key)
            below = f"{title}.{key}" if title else key
            if below in dict(self.sections):
                kind = f"[keys](#{anchor(below)})"
            elif f"{below}.NAME" in dict(self.sections):
                kind = f"by name: [keys](#{anchor(f'{below}.NAME')})"
            elif f"{below}[]" in dict(self.sections):
                kind = f"list of [keys](#{anchor(f'{below}[]')})"
            lines.append(f"| `{key}` | {escaped(kind)} | {unit} | {default} | {escaped(text)} | {self.example(schema, key)} |")
        return "\n".join(lines) + "\n"

    def description_of(self, schema: dict) -> str:
        return schema.get("description") or self.target(schema)[1].get("description", "")

    def example(self, schema: dict, key: str) -> str:
        if (id(schema), key) not in self.examples:
            return ""
        value, file = self.examples[id(schema), key]
        text = f"{key}: {text_of(value)}"
        short = f"`{escaped(text)}`" if len(text) <= 48 else ""
        name = file.parent.name[:2] if file.parent.parent.name == "examples" else file.stem
        where = f"[{name}](../{file.relative_to(self.root).as_posix()})"
        return f"{short} {where}".strip()

    def prose(self, title: str) -> str:
        words = re.split(r"[.\[]", title)
        for word in (title, words[0], *words[::-1]):
            slug = PROSE.get(word, word)
            if slug in self.headings():
                return f"[model file: {slug.replace('-', ' ')}](../docs/{self.headings()[slug]}#{slug})"
        return ""

    def headings(self) -> dict[str, str]:
        """The page of each heading of the model file's pages, relative to docs/."""
        if not hasattr(self, "_headings"):
            from markdown import anchors_of
            docs = self.root / "docs"
            pages = [docs / "model_file.md", *sorted((docs / "model").glob("*.md"))]
            self._headings = {anchor: page.relative_to(docs).as_posix() for page in pages for anchor in anchors_of(page.read_text(encoding="utf-8"))}
        return self._headings

    def page(self) -> str:
        keys = sum(len(schema["properties"]) for _, schema in self.sections)
        intro = f"""# Model file: all keys

{self.schema['description']} This page is made from the JSON Schema that `scabo schema` prints: {keys} keys in
{len(self.sections)} groups. [The model file](../docs/model_file.md) explains them with their rules and more examples.

A number may also be a formula, `${{2 * b}}`, of the [parameters](../docs/model/writing.md#parameters). `NAME` stands for a name
of your own, `[]` for an entry of a list. The name beside an example is that of the model file from which it is taken: a
number is that of an [example](../examples/README.md), the others are in `tests/input/good`.

"""
        return intro + "\n".join(self.section(title, schema) for title, schema in self.sections)


def load(file: pathlib.Path) -> object:
    return yaml.load(file.read_text(encoding="utf-8"), Loader)


def choices_of(schema: dict) -> list[dict]:
    """What a value may be; not what `oneOf` only says of required keys."""
    return [choice for choice in schema.get("oneOf", []) + schema.get("anyOf", []) if set(choice) - {"required", "not", "properties"} or "type" in choice]


def may_be(choice: dict, value: object) -> bool:
    """Whether a choice of `oneOf` is meant; of objects the keys decide."""
    if "properties" in choice:
        return isinstance(value, dict) and set(value) <= set(choice["properties"]) and set(choice.get("required", [])) <= set(value)
    return isinstance(value, list) if choice.get("type") == "array" else True


def required_of(schema: dict) -> set[str]:
    return set(schema.get("required", []))


def range_of(schema: dict) -> str:
    low, high = schema.get("minimum"), schema.get("maximum")
    above, below = schema.get("exclusiveMinimum"), schema.get("exclusiveMaximum")
    low, high = (None if value is not None and abs(value) >= 1e99 else value for value in (low, high))
    above, below = (None if value is not None and abs(value) >= 1e99 else value for value in (above, below))
    if low is not None and high is not None:
        return f", {text_of(low)} to {text_of(high)}"
    parts = [f"{text_of(low)} or more" if low is not None else "", f"more than {text_of(above)}" if above is not None else "",
             f"at most {text_of(high)}" if high is not None else "", f"less than {text_of(below)}" if below is not None else ""]
    parts = [part for part in parts if part]
    return ", " + ", ".join(parts) if parts else ""


def with_unit(description: str) -> tuple[str, str]:
    found = UNIT.search(description)
    if not found:
        return description, ""
    return description[:found.start()] + description[found.end():], found[1]


def text_of(value: object) -> str:
    """As it would stand in a model file."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {text_of(held)}" for key, held in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(text_of, value)) + "]"
    if isinstance(value, bool) or value is None:
        return json.dumps(value)
    if isinstance(value, float):
        return f"{value:.12g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")
    return str(value)


def heading(title: str) -> str:
    return re.sub(r"^([^ ]+)", r"`\1`", title) or "The whole file"


def anchor(title: str) -> str:
    from markdown import slug_of
    return slug_of(heading(title))


def escaped(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def main() -> None:
    scabo, root = sys.argv[1:]
    schema = json.loads(subprocess.run([scabo, "schema"], capture_output=True, text=True, check=True).stdout)
    sys.stdout.write(Reference(schema, pathlib.Path(root)).page())


if __name__ == "__main__":
    main()
