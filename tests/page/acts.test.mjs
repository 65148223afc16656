/** What keys and buttons do where more than one part has a say. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { makeActs } from "../../annotate/static/acts.js";

let done;
let act;

beforeEach(() => {
  done = [];
  const told = (name) => () => done.push(name);
  act = makeActs({
    pointer: { drop: told("press") }, explained: { hide: told("panel") }, line: { escape: told("line") },
  });
});

test("Escape drops the press, what is selected and what is explained", () => {
  act.escape();
  assert.deepEqual(done, ["press", "line", "panel"]);
});
