"""What an annotator can do to a photo: checked for form, and done to the edits."""

import json

import pytest
from pydantic import ValidationError

from annotate.engine.edits import Edits
from annotate.engine.steering import Left
from annotate.store.operations import LOGGED, MoveAnchor, SetAnchor, Side, spoken

EDITS = Edits(30, 40).anchor(5, 6)
DONE = {
    "anchor": ({"column": 3, "row": 4}, EDITS.anchor(3, 4)),
    "move": ({"from_column": 5, "column": 3, "row": 4}, EDITS.move(5, 3, 4)),
    "remove": ({"column": 5}, EDITS.remove(5)),
    "forbid": ({"points": [[1, 2], [3, 4]], "radius": 2}, EDITS.forbid([(1, 2), (3, 4)], 2)),
    "guide": (
        {"points": [[1, 2], [30, 4]], "radius": 3, "times": [0, 900]},
        EDITS.guide([(1, 2), (30, 4)], 3, [0, 900]),
    ),
    "side": (
        {"points": [[1, 2], [30, 4]], "ground": "sky"},
        EDITS.side([(1, 2), (30, 4)], "sky"),
    ),
    "straight": (
        {"column": 1, "row": 2, "to_column": 9, "to_row": 8},
        EDITS.straight(1, 2, 9, 8),
    ),
    "drawn": ({"first": 7, "rows": [1, 2]}, EDITS.draw(7, [1, 2])),
    "hidden": ({"first": 7, "last": 9, "why": "fog"}, EDITS.hide(7, 9, why="fog")),
    "carried": (
        {"points": [[1, 2], [9, 4]], "radius": 3, "name": "hill-0.png"},
        EDITS.guide([(1, 2), (9, 4)], 3),
    ),
    "release": ({"first": 0, "last": 9}, EDITS.release(0, 9)),
}


@pytest.mark.parametrize("kind", DONE)
def test_each_does_what_it_says(kind):
    body, wanted = DONE[kind]
    operation = LOGGED.validate_json(json.dumps({"kind": kind, **body}))
    assert operation.on(EDITS) == wanted
    told = operation.model_dump(mode="json", by_alias=True)
    assert LOGGED.validate_json(json.dumps(told)) == operation
    assert spoken(operation)


@pytest.mark.parametrize(
    "body",
    [
        {"kind": "anchor", "column": 3},
        {"kind": "anchor", "column": "3", "row": 4},
        {"kind": "anchor", "column": 3.0, "row": 4},
        {"kind": "anchor", "column": 100_001, "row": 4},
        {"kind": "anchor", "column": 3, "row": 4, "more": 1},
        {"kind": "forbid", "points": [], "radius": 2},
        {"kind": "hidden", "first": 7, "last": 9, "why": ""},
        {"kind": "hidden", "first": 7, "last": 9, "why": "a\nb"},
        {"kind": "hidden", "first": 7, "last": 9, "why": "x" * 81},
        {"kind": "forbid", "points": [[1, 2]], "radius": -1},
        {"kind": "forbid", "points": [[1, 2, 3]], "radius": 1},
        {"kind": "guide", "points": [], "radius": 2},
        {"kind": "guide", "points": [[1, 2]], "radius": 0},
        {"kind": "guide", "points": [[1, 2]], "times": [-1]},
        {"kind": "side", "points": [[1, 2]], "ground": "water"},
        {"kind": "anchor", "column": 3, "row": 4, "within": -1},
        {"kind": "drawn", "first": 0, "rows": []},
        {"kind": "tag", "tag": ""},
        {"kind": "tag", "tag": "a\nb"},
        {"kind": "tag", "tag": "x" * 81},
        {"kind": "status", "status": "perfect"},
        {"kind": "undo", "status": "yes"},
        {"kind": "rotate"},
        {},
    ],
)
def test_what_has_another_form_is_refused(body):
    with pytest.raises(ValidationError):
        LOGGED.validate_json(json.dumps(body))


def test_a_click_does_what_it_came_to():
    left = {"points": [[1, 9], [8, 9]], "radius": 2}
    body = {"kind": "anchor", "column": 3, "row": 4, "within": 2}
    found = LOGGED.validate_json(json.dumps({**body, "found": {"row": 5, "left": left}}))
    assert found.on(EDITS) == EDITS.anchor(3, 5, Left(((1, 9), (8, 9)), 2, 3))
    assert LOGGED.validate_json(json.dumps(body)).on(EDITS) == EDITS.anchor(3, 4)


def test_sides_are_told_apart():
    sides = [Side(points=[(1, 2)], ground=ground) for ground in ("sky", "terrain")]
    assert [spoken(one) for one in sides] == ["all above is sky", "all below is terrain"]


def test_operations_are_values():
    assert SetAnchor(column=1, row=2) == SetAnchor(column=1, row=2)
    assert SetAnchor(column=1, row=2) != MoveAnchor(from_column=1, column=1, row=2)
    with pytest.raises(ValidationError, match="frozen"):
        SetAnchor(column=1, row=2).row = 3
