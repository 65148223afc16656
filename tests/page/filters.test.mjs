/** Which photos are shown. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { filters, matches } from "../../annotate/static/basics/filters.js";

const PHOTOS = [
  { id: 1, status: "to do", confidence: 0.4, tags: [], finished_by: ["bob", "bob, pass 2"] },
  { id: 2, status: "to do", confidence: 0.8, tags: ["fog", "a: b"], finished_by: [] },
  { id: 3, status: "accepted", confidence: 0.1, tags: ["fog"], finished_by: ["bob"] },
  { id: 4, status: "rejected", confidence: null, tags: [], finished_by: [] },
];

const found = (wanted) => PHOTOS.filter((photo) => matches(photo, wanted)).map(({ id }) => id);

test("photos are wanted by status, confidence, tag, and what others have finished", () => {
  assert.deepEqual(found(""), [1, 2, 3, 4]);
  assert.deepEqual(found("is:to do"), [1, 2]);
  assert.deepEqual(found("sure:0.5"), [1]); // of proposals alone
  assert.deepEqual(found("sure:0.9"), [1, 2]);
  assert.deepEqual(found("tag:fog"), [2, 3]);
  assert.deepEqual(found("tag:a: b"), [2]);
  assert.deepEqual(found("by:bob"), [1, 3]);
  assert.deepEqual(found("by:bob, pass 2"), [1]);
  assert.deepEqual(found("not:bob"), [2, 4]);
});

test("only what some photo has is offered, in groups", () => {
  const offered = filters(["to do", "accepted"], PHOTOS);
  assert.deepEqual(offered.map(([name]) => name), ["Status", "Proposal", "Tag", "Others"]);
  assert.deepEqual(offered[2][1], [["tag:a: b", "tag: a: b"], ["tag:fog", "tag: fog"]]);
  assert.deepEqual(offered[3][1].map(([value]) => value), ["by:bob", "not:bob", "by:bob, pass 2", "not:bob, pass 2"]);
  assert.deepEqual(filters(["to do"], [PHOTOS[3]]), [["Status", [["is:to do", "to do"]]]]);
  for (const [, options] of offered) for (const [value] of options) assert.ok(Array.isArray(found(value)));
});
