/** Columns that do not count. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { notVisible, unseen } from "../../annotate/static/basics/hidden.js";
import { photo } from "./stubs.mjs";

test("hidden columns do not count, and none does without a visible skyline", () => {
  const hidden = [[3, 9, "fog"]];
  assert.deepEqual(unseen(photo({ hidden })), hidden);
  assert.deepEqual(unseen(photo({ hidden, nothing_visible: true })), [[0, 399, "no skyline"]]);
});

test("a band says what hides its columns where that is known", () => {
  assert.deepEqual([notVisible("fog"), notVisible(""), notVisible(null)], ["not visible: fog", "not visible", "not visible"]);
});
