/** What keys and buttons do where more than one part has a say. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { makeActs } from "../../annotate/static/acts.js";
import { Selection } from "../../annotate/static/labelled/selection.js";

let selection;
let sheet;
let done;
let act;

beforeEach(() => {
  selection = new Selection();
  sheet = { shown: false };
  done = [];
  const told = (name) => () => done.push(name);
  act = makeActs({
    selection, sheet, pointer: { drop: told("press") }, explained: { hide: told("panel") }, actions: { undo: told("undo") },
    line: { escape: told("line"), dropCorner: told("corner") },
  });
});

test("Escape drops the press, what is selected and what is explained", () => {
  act.escape();
  assert.deepEqual(done, ["press", "line", "panel"]);
});

test("Undo takes the last corner of a guide back first, where the guide is seen", () => {
  selection.corner([[1, 2]]);
  act.undo();
  sheet.shown = true;
  act.undo();
  selection.corner([]);
  sheet.shown = false;
  act.undo();
  assert.deepEqual(done, ["corner", "undo", "undo"]);
});
