"""What the server is asked and what it answers: refused in one sentence, or understood."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from annotate.server.messages import Part


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"[" * 100_000,
        b"null",
        b"\xff\xfe",
        b'{"id": "a", "revision": 0}',
        b'{"revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "", "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "a b", "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": 7, "revision": 0, "operation": {"kind": "open"}}',
        b'{"id": "%s", "revision": 0, "operation": {"kind": "open"}}' % (b"a" * 65),
        b'{"id": "a", "revision": 0, "operation": {}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "drop table"}}',
        b'{"id": "a", "revision": "0", "operation": {"kind": "open"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 1e400, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": NaN, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 1.5, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "open", "x": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "anchor", "column": 700, "row": 1}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "remove", "column": 7}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "status", "status": "done"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "tag", "tag": "\\u0000"}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "drawn", "first": 0, "rows": []}}',
        b'{"id": "a", "revision": 0, "operation": {"kind": "forbid", "points": [[1]]}}',
    ],
)
def test_malformed_operations_are_one_sentence(client, body):
    headers = {"Content-Type": "application/json"}
    said = client.post("/api/photos/1/operations", content=body, headers=headers)
    assert 400 <= said.status_code < 500
    assert said.json()["detail"].endswith(".")
    assert client.get("/api/photos/1").json()["revision"] == 0


@given(arrays(np.int32, st.integers(1, 30), elements=st.integers(0, 50)), st.data())
def test_the_part_of_a_line_that_changed_can_be_joined(before, data):
    rows = before.copy()
    for column in data.draw(st.lists(st.integers(0, len(rows) - 1), max_size=4)):
        rows[column] += 1
    part = Part.of(rows, before)
    changed = np.flatnonzero(rows != before)
    if len(changed) == 0:
        assert part.rows == []
        return
    last = part.first + len(part.rows) - 1
    assert part.first == max(changed[0] - 1, 0)  # a column more on either side
    assert last == min(changed[-1] + 1, len(rows) - 1)
    assert part.rows == rows[part.first : last + 1].tolist()
    assert Part.of(rows, None).rows == rows.tolist()
