/** Strokes, anchors and columns as numbers. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { chance } from "./model.mjs";
import { brushed, drawn, nearest, thinned, uncertainty } from "../../annotate/static/basics/geometry.js";

const line = (length) => Array.from({ length }, (_, at) => [at, at]);

test("a long stroke keeps its ends and at most some 2,000 points, a short one all", () => {
  assert.deepEqual(thinned(line(2000)), line(2000));
  for (const length of [2001, 5000, 123_457]) {
    const kept = thinned(line(length));
    assert.ok(kept.length <= 2001, `${length} points leave ${kept.length}`);
    assert.deepEqual([kept[0], kept.at(-1)], [[0, 0], [length - 1, length - 1]]);
  }
});

test("the brush goes through the middle of pixels, and a dot has a length", () => {
  assert.deepEqual(brushed([[1, 2], [3, 4]]), [[1.5, 2.5], [3.5, 4.5]]);
  const [from, to] = brushed([[1, 2]]);
  assert.deepEqual(from, [1.5, 2.5]);
  assert.notDeepEqual(to, from);
});

test("a drawn stroke has a row in each of its columns, between those of its points", () => {
  assert.deepEqual(drawn([[4, 10], [8, 14]]), { first: 4, rows: [10, 11, 12, 13, 14] });
  assert.deepEqual(drawn([[8, 14], [4, 10]]), { first: 4, rows: [10, 11, 12, 13, 14] });
  assert.deepEqual(drawn([[3, 7]]), { first: 3, rows: [7] });
});

test("where a stroke goes back, what was drawn last counts", () => {
  assert.deepEqual(drawn([[0, 0], [4, 0], [2, 9]]), { first: 0, rows: [0, 0, 9, 5, 0] }); // back from column 4
});

test("any stroke comes to as many rows as it is wide, without a gap", () => {
  const random = chance(1);
  for (let round = 0; round < 200; round++) {
    const points = Array.from({ length: 1 + random.below(12) }, () => [random.below(60), random.below(40)]);
    const { first, rows } = drawn(points);
    const columns = points.map(([column]) => column);
    assert.equal(first, Math.min(...columns));
    assert.equal(rows.length, Math.max(...columns) - first + 1);
    assert.ok(rows.every((row) => Number.isInteger(row) && row >= 0 && row < 40));
    assert.equal(rows[points.at(-1)[0] - first], points.at(-1)[1]); // the last point is where it was let go
  }
});

test("the nearest anchor within reach is found", () => {
  const away = ([column]) => Math.abs(column - 10);
  assert.deepEqual(nearest([[2, 0], [13, 0], [30, 0]], away), [13, 0]);
  assert.deepEqual(nearest([[2, 0], [13, 0]], away, 3), [13, 0]);
  assert.equal(nearest([[2, 0], [13, 0]], away, 2), undefined);
  assert.equal(nearest([], away), undefined);
});

test("a bar is as uncertain as its least certain column, whether it has many or shares one", () => {
  assert.deepEqual(uncertainty([0, null, 4, 2], 2), [1, 0.25]);
  assert.deepEqual(uncertainty([0, 4], 4), [1, 1, 0, 0]);
  assert.deepEqual(uncertainty([null, 9], 2), [0, 0]);
  assert.deepEqual(uncertainty([0, 4, 4, 0], 6, -1, 6), [0, 1, 0, 0, 1, 0]); // beside the photo there is nothing
  assert.deepEqual(uncertainty([0, 4, 4, 0], 2, 2, 2), [0, 1]);
});
