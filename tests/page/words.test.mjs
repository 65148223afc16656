// How sure a proposal is, in words.

import assert from "node:assert/strict";
import test from "node:test";

import { sure } from "../../annotate/static/basics/words.js";

test("only proposals that nobody has looked at are told to be sure", () => {
  assert.deepEqual(sure("to do", 0.276), ["28 % sure"]);
  assert.deepEqual(sure("to do", 0.998), ["99 % sure"]); // nobody is quite
  assert.deepEqual(sure("to do", null), []);
  assert.deepEqual(sure("accepted", 0.9), []);
});
