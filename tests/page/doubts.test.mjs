/** Where the line is uncertain. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { doubts, nextDoubt } from "../../annotate/static/basics/doubts.js";

/** Margins of a photo that is sure but for some columns. */
function margins(width, unsure) {
  const found = Array(width).fill(3);
  for (const [column, margin] of Object.entries(unsure)) found[column] = margin;
  return found;
}

test("columns near each other are one span, named by its least certain column", () => {
  const found = doubts(margins(400, { 100: 0.3, 104: 0.1, 110: 0.4, 200: 0.2, 300: 0.5 }));
  assert.deepEqual(found, [{ first: 100, last: 110, column: 104, margin: 0.1 }, { first: 200, last: 200, column: 200, margin: 0.2 }]);
});

test("what is fixed, hidden, or a sliver at the rim is no doubt", () => {
  const unsure = margins(400, { 0: 0, 60: 0.1, 65: 0.2, 150: null, 399: 0 });
  assert.deepEqual(doubts(unsure, [[50, 70]]), []);
  assert.deepEqual(doubts(unsure).map(({ first, last }) => [first, last]), [[60, 65]]);
  const wide = margins(400, Object.fromEntries([0, 1, 2].map((column) => [column, 0.1])));
  assert.equal(doubts(wide).length, 1); // not only the rim
});

test("spans are visited from left to right and round, the least certain one first", () => {
  const spans = [[10, 0.3], [50, 0.1], [90, 0.2]].map(([column, margin]) => ({ first: column, last: column, column, margin }));
  assert.equal(nextDoubt(spans, undefined, 1), 1);
  assert.deepEqual([10, 50, 90].map((from) => nextDoubt(spans, from, 1)), [1, 2, 0]);
  assert.deepEqual([10, 50, 90].map((from) => nextDoubt(spans, from, -1)), [2, 0, 1]);
  assert.equal(nextDoubt([], 3, 1), -1);
});
