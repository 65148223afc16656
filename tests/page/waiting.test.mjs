/** What waits is drawn as it was done, and the page says whether the line follows. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { changesLine } from "../../annotate/static/basics/operations.js";
import { sketched } from "../../annotate/static/drawn/waiting.js";
import { trouble } from "../../annotate/static/basics/words.js";

const did = (kind, how = {}) => ({ what: "operations", operation: { kind, ...how } });
const anchor = (column, row = 5) => did("anchor", { column, row });
const NOTHING = { discs: new Map(), crosses: new Set(), paths: [], bands: [], strokes: [] };

test("nothing is drawn for what does not change the line", () => {
  const items = [did("tag", { tag: "fog", on: true }), did("status", { status: "accepted" })];
  assert.deepEqual(sketched(items), NOTHING);
  assert.equal(changesLine(items), false);
  assert.equal(changesLine([...items, { what: "undo", operation: null }]), true);
});

test("anchors that are set, moved and removed are drawn where they will be", () => {
  const items = [anchor(3), anchor(9), did("move", { from_column: 3, column: 4, row: 7 }), did("remove", { column: 9 }), anchor(3, 8)];
  assert.deepEqual(sketched(items), { ...NOTHING, discs: new Map([[4, [4, 7]], [3, [3, 8]]]), crosses: new Set([9]) });
});

test("everything that changes the line is drawn", () => {
  const found = sketched([
    did("straight", { column: 1, row: 2, to_column: 5, to_row: 6 }), did("drawn", { first: 7, rows: [3, 4] }),
    did("hidden", { first: 1, last: 2, hidden: true }), did("hidden", { first: 1, last: 1, hidden: false }),
    did("release", { first: 4, last: 5 }), did("forbid", { points: [[1, 1]], radius: 3, allow: false }),
  ]);
  assert.deepEqual(found.paths, [[[1, 2], [5, 6]], [[7, 3], [8, 4]]]);
  assert.deepEqual(found.bands.map(({ words }) => words), ["not visible", "visible", "dropped"]);
  assert.equal(found.strokes.length, 1);
});

test("what a waiting undo takes back is not drawn, and what redo does again is", () => {
  const [undo, redo] = ["undo", "redo"].map((what) => ({ what, operation: null }));
  assert.deepEqual(sketched([anchor(3), anchor(9), undo]).discs, new Map([[3, [3, 5]]]));
  assert.deepEqual(sketched([anchor(3), undo, redo]).discs, new Map([[3, [3, 5]]]));
  assert.deepEqual(sketched([anchor(3), did("status", { status: "accepted" }), undo]).discs, new Map([[3, [3, 5]]]));
  assert.deepEqual(sketched([undo, redo]), NOTHING);
});

test("the page says that the line follows", () => {
  const said = "The server does not answer. 1 edit waits and is sent as soon as it can be";
  assert.equal(trouble("The server does not answer.", 1, true), `${said}; the line follows then.`);
  assert.equal(trouble("The server does not answer.", 1), `${said}.`);
});
