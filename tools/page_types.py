"""Write what the server is asked and answers as TypeScript: python -m tools.page_types.

The page's JavaScript is checked against these types, and a test holds them to the models.
"""

import json
from pathlib import Path

from pydantic import TypeAdapter

from annotate.server import messages
from annotate.server.alternatives import Alternatives
from annotate.server.explained import Explained
from annotate.store.operations import Rough
from annotate.work.learning import Learning

PLACE = Path(__file__).parents[1] / "annotate" / "static" / "types.d.ts"
"""Where the types are."""

ASKED = (messages.Apply, messages.Step, messages.Pixel, Rough)
ANSWERED = (
    messages.Legend,
    messages.PhotoList,
    messages.Document,
    messages.Part,
    messages.Margins,
    Alternatives,
    Explained,
    messages.OwnGuideline,
    Learning,
)

_HEAD = """\
/**
 * What the server is asked and what it answers.
 *
 * Written by `python -m tools.page_types` from the server's models; do not edit it by hand.
 */
"""
_PLAIN = {one: one for one in ("number", "string", "boolean", "null")} | {"integer": "number"}


def types():
    """All types, as the text of a declaration file."""
    modes = {"validation": ASKED, "serialization": ANSWERED}
    _, schema = TypeAdapter.json_schemas(
        [
            (model.__name__, mode, TypeAdapter(model))
            for mode, models in modes.items()
            for model in models
        ]
    )
    found = schema["$defs"]
    named = {
        "Operation": ("Anything that the page does to a photo", found["Apply"], "operation"),
        "Status": ("How far a photo is", found["Document"], "status"),
    }
    text = "\n".join(_interface(name, found[name]) for name in sorted(found))
    for name, (says, model, field) in named.items():
        meant = _type(model["properties"][field])
        text = text.replace(f"({meant})[]", f"{name}[]").replace(f": {meant};", f": {name};")
        lines = "".join(f"\n  | {one}" for one in meant.split(" | "))
        text += f"\n/** {says}. */\nexport type {name} ={lines};\n"
    return f"{_HEAD}\n{text}"


def _interface(name, schema):
    """One type; a field with a default may be left out, but for a constant one."""
    says = schema.get("description", "").split("\n\n")[0].replace("\n", " ")
    if "prefixItems" in schema:
        return f"export type {name} = {_plain(schema)};\n"
    fields = [
        f"  {field}{_mark(field, how, schema)}: {_type(how)};"
        for field, how in schema["properties"].items()
    ]
    return "\n".join([f"/** {says} */", f"export interface {name} {{", *fields, "}", ""])


def _mark(field, how, schema):
    return "" if field in schema.get("required", ()) or "const" in how else "?"


def _type(how):
    """A JSON schema as a type."""
    for several in ("oneOf", "anyOf"):
        if several in how:
            return " | ".join(_type(one) for one in how[several])
    if "$ref" in how:
        return how["$ref"].rpartition("/")[2]
    values = [how["const"]] if "const" in how else how.get("enum")
    return " | ".join(map(json.dumps, values)) if values else _plain(how)


def _plain(how):
    """A JSON schema that names a type."""
    if "prefixItems" in how:
        return f"[{', '.join(_type(one) for one in how['prefixItems'])}]"
    if how["type"] == "array":
        inner = _type(how["items"])
        return f"({inner})[]" if "|" in inner else f"{inner}[]"
    if how["type"] == "object":
        return f"{{ [name: string]: {_type(how['additionalProperties'])} }}"
    return _PLAIN[how["type"]]


if __name__ == "__main__":
    PLACE.write_text(types(), encoding="utf-8")
    print(PLACE)
