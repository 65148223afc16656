/** Operations in words, and what they do to Undo and to the line. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { changesLine, described, isChange } from "../../annotate/static/basics/operations.js";
import { isAccept, senseless } from "../../annotate/static/server/senseless.js";
import { counted, spoken } from "../../annotate/static/basics/words.js";

const EVERY = {
  anchor: [{ column: 3, row: 4 }, "the anchor at column 3, row 4"],
  move: [{ from_column: 3, column: 5, row: 4 }, "moving the anchor from column 3 to 5"],
  remove: [{ column: 3 }, "removing the anchor at column 3"],
  forbid: [{ points: [[7, 1]], radius: 2, allow: false }, "the stroke of the brush at column 7"],
  straight: [{ column: 1, row: 2, to_column: 5, to_row: 6 }, "the straight line from column 1 to 5"],
  drawn: [{ first: 4, rows: [1, 2, 3] }, "the drawn line from column 4 to 6"],
  hidden: [{ first: 1, last: 2, hidden: true }, "hiding columns 1 to 2"],
  release: [{ first: 1, last: 2 }, "dropping what was asked for in columns 1 to 2"],
  tag: [{ tag: "fog", on: true }, "the tag “fog”"],
  status: [{ status: "accepted" }, "“accepted”"],
  open: [{}, "open"],
};
const item = (operation, what = "operations") => ({ what, operation });

test("every operation has its words", () => {
  for (const [kind, [how, words]] of Object.entries(EVERY)) assert.equal(described({ kind, ...how }), words);
  assert.equal(described({ kind: "forbid", points: [[7, 1]], radius: 2, allow: true }), "the stroke of the eraser at column 7");
  assert.equal(described({ kind: "hidden", first: 1, last: 2, hidden: false }), "showing columns 1 to 2");
  assert.equal(described({ kind: "hidden", first: 1, last: 2, hidden: true, why: "fog" }), "hiding columns 1 to 2: fog");
  assert.equal(described({ kind: "tag", tag: "fog", on: false }), "taking off the tag “fog”");
});

test("tags and looking at a photo cannot be undone, and a status leaves the line alone", () => {
  const kinds = Object.keys(EVERY);
  assert.deepEqual(kinds.filter((kind) => !isChange(item({ kind }))), ["tag", "open"]);
  assert.deepEqual(kinds.filter((kind) => !changesLine([item({ kind })])), ["tag", "status", "open"]);
  assert.ok(isChange(item(null, "undo")) && changesLine([item(null, "redo")]));
});

test("an undo of something that is not sent is not sent either, and one of what was there before is", () => {
  const [lost, undo, redo, more] = [item({ kind: "anchor" }), item(null, "undo"), item(null, "redo"), item({ kind: "remove" })];
  const out = (one) => one === lost;
  assert.deepEqual(senseless([lost, undo], out, false), [lost, undo]);
  assert.deepEqual(senseless([lost, undo, redo], out, false), [lost, undo, redo]);
  assert.deepEqual(senseless([lost, more, undo], out, false), [lost]);
  assert.deepEqual(senseless([lost, more, undo, undo], out, false), [lost, item(null, "undo")]);
  const first = item(null, "undo");
  assert.deepEqual(senseless([first], () => false, false), []);
  assert.deepEqual(senseless([first], () => false, true), [first]); // it would take back what another tab did
});

test("Redo does nothing once something else was done", () => {
  const [undo, anchor, redo] = [item(null, "undo"), item({ kind: "anchor" }), item(null, "redo")];
  assert.deepEqual(senseless([undo, redo], () => false, false), []);
  assert.deepEqual(senseless([undo, anchor, redo], () => false, false), [redo]);
});

test("what cannot be undone is left out of the reckoning", () => {
  const tag = item({ kind: "tag" });
  const [anchor, undo] = [item({ kind: "anchor" }), item(null, "undo")];
  assert.deepEqual(senseless([anchor, tag, undo], (one) => one === tag, true), [tag]);
  assert.ok(isAccept(item({ kind: "status", status: "accepted" })) && !isAccept(item({ kind: "status", status: "rejected" })));
});

test("numbers and times are said as people say them", () => {
  assert.deepEqual([counted(0, "edit"), counted(1, "edit"), counted(2, "edit")], ["0 edits", "1 edit", "2 edits"]);
  assert.deepEqual([spoken(89), spoken(90), spoken(5399), spoken(5400)], ["89 s", "2 min", "90 min", "1.5 h"]);
});
