/** What is selected, in one place, and told whenever it changes. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { Selection } from "../../annotate/static/labelled/selection.js";

const SHOWN = { width: 100, height: 50, rows: Array.from({ length: 100 }, (_, at) => 10 + Math.floor(at / 10)) };

/** A selection, and how often it has told of a change. */
function watched() {
  const selection = new Selection();
  const told = { times: 0 };
  selection.on("change", () => told.times++);
  return { selection, told };
}

test("the cursor is in the middle, on the line, until it is put elsewhere", () => {
  const { selection } = watched();
  assert.deepEqual(selection.place(SHOWN), [50, 15]);
  selection.moveTo(SHOWN, 83);
  assert.deepEqual(selection.place(SHOWN), [83, 18]);
  selection.moveTo(SHOWN, 83, 4);
  assert.deepEqual(selection.place(SHOWN), [83, 4]);
  selection.rest();
  assert.deepEqual(selection.place(SHOWN), [83, 18]);
  assert.deepEqual(selection.place({ ...SHOWN, rows: null }), [83, 25]);
});

test("the cursor stays within the photo", () => {
  const { selection } = watched();
  selection.moveTo(SHOWN, -3, 99);
  assert.deepEqual(selection.now.cursor, { column: 0, row: 49 });
});

test("columns go from the mark to the cursor, in either direction, or are the cursor's alone", () => {
  const { selection } = watched();
  selection.moveTo(SHOWN, 30);
  assert.deepEqual(selection.columns(SHOWN), { first: 30, last: 30 });
  selection.mark(SHOWN);
  selection.moveTo(SHOWN, 12);
  assert.deepEqual(selection.columns(SHOWN), { first: 12, last: 30 });
  selection.rest();
  assert.equal(selection.now.mark, null);
});

test("a mark without a cursor is where the cursor is shown then", () => {
  const { selection } = watched();
  selection.mark(SHOWN);
  assert.deepEqual(selection.now.mark, { column: 50, row: 15 });
  assert.deepEqual(selection.now.cursor, { column: 50, row: null });
});

test("a stroke grows by pixels that are new, or is stretched from its first one", () => {
  const { selection } = watched();
  selection.begin("forbid", [1, 1], { radius: 3 });
  for (const pixel of [[1, 1], [2, 1], [2, 1], [3, 2]]) selection.extend(pixel);
  assert.deepEqual(selection.now.stroke, { kind: "forbid", points: [[1, 1], [2, 1], [3, 2]], radius: 3, allow: false, times: [] });
  selection.begin("straight", [1, 1]);
  selection.stretch([5, 5]);
  selection.stretch([9, 2]);
  assert.deepEqual(selection.now.stroke.points, [[1, 1], [9, 2]]);
});

test("letting go forgets what was drawn or dragged, and the cursor comes to rest on the line", () => {
  const { selection } = watched();
  selection.aim([7, 7], 4);
  selection.touch([200, 100]);
  selection.begin("drawn", [7, 7]);
  selection.letGo();
  const { cursor, stroke, dragged, finger } = selection.now;
  assert.deepEqual({ cursor, stroke, dragged, finger }, { cursor: { column: 7, row: null }, stroke: null, dragged: null, finger: null });
  selection.extend([9, 9]); // nothing is being drawn any more
  assert.equal(selection.now.stroke, null);
});

test("every change is told once, and what changes nothing is not", () => {
  const { selection, told } = watched();
  const part = { first: 3, rows: [1, 2] };
  const changes = [
    () => selection.moveTo(SHOWN, 3), () => selection.mark(SHOWN), () => selection.begin("drawn", [1, 1]),
    () => selection.extend([2, 2]), () => selection.preview(part), () => selection.aim([3, 3]), () => selection.touch([1, 1]),
    () => selection.letGo(), () => selection.clear(),
  ];
  changes.forEach((change, at) => {
    change();
    assert.equal(told.times, at + 1, String(change));
  });
  selection.preview(null);
  selection.extend([4, 4]);
  assert.equal(told.times, changes.length);
});

test("what is selected is changed by the selection alone", () => {
  const { selection } = watched();
  assert.throws(() => { selection.now.cursor = { column: 1, row: 1 }; }, TypeError);
  assert.throws(() => { selection.now = {}; }, TypeError);
});
