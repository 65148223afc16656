/** Numbers of other lines, and where they are other ones. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { radiiOf } from "../../annotate/static/drawn/corridor.js";
import { apart, badges } from "../../annotate/static/drawn/marks.js";

test("a line is drawn where it is another one, with a column more on either side", () => {
  const current = Array(10).fill(5);
  const rows = [5, 5, 7, 8, 5, 8, 5, 5, 5, 9];
  assert.deepEqual(apart(rows, current), [{ first: 1, rows: [5, 7, 8, 5, 8, 5] }, { first: 8, rows: [5, 9] }]);
  assert.deepEqual(apart(current, current), []);
});

test("the number of a line stands where no other line is, and on no other number", () => {
  const current = Array(100).fill(50);
  const one = current.map((row, column) => (column < 40 ? 20 : row));
  const both = current.map((row, column) => (column < 40 ? 20 : 80));
  const [[first], [second, row]] = badges([one, both], current, [0, 99], 4);
  assert.ok(first < 100 && second >= 40 && row === 80);
  const late = current.map((level, column) => (column >= 60 ? 20 : level + column % 2));
  for (const [column] of badges([late, [...late]], current, [0, 99], 4)) assert.ok(column >= 60); // nor a pixel from it
  const [[left], [right]] = badges([one, [...one]], current, [0, 99], 4);
  assert.notEqual(left, right);
  assert.ok(left < 40 && right < 40); // not where both lie on the current one
});

test("the corridor is as wide as the server makes it", () => {
  const stroke = { points: [[0, 0], [10, 0], [410, 0]], radius: 10 };
  assert.deepEqual(radiiOf({ ...stroke, times: [0, 1000, 2000] }), [10.25, 20, 20]); // as in `guide.radii_of`
  assert.deepEqual(radiiOf({ ...stroke, times: [] }), [10, 10, 10]);
});
