/** Which key does what, and where. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { entryFor, keyTable } from "../../annotate/static/keys.js";

/** What was done, by name, with what. */
function recorded() {
  const did = [];
  return { did, act: new Proxy({}, { get: (_, name) => (...how) => did.push([name, ...how]) }) };
}

const press = (key, how = {}) => ({ key, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...how });

/** What a key does. */
function done(event, sheet = false) {
  const { did, act } = recorded();
  entryFor(keyTable(act), event, sheet)?.run(event);
  return did[0];
}

test("no key has two meanings, and each says what it does", () => {
  const table = keyTable(recorded().act);
  const keys = table.flatMap((entry) => entry.keys);
  assert.equal(new Set(keys).size, keys.length);
  for (const { shown, says } of table) assert.ok(shown && says);
});

test("every entry does something with each of its keys", () => {
  for (const entry of keyTable(recorded().act)) {
    for (const key of entry.keys) {
      const [, control, alt, plain] = /^(Ctrl\+)?(Alt\+)?(.+)$/.exec(key);
      const event = press(plain, { ctrlKey: Boolean(control), altKey: Boolean(alt) });
      assert.ok(done(event), `${key} does nothing`);
    }
  }
});

test("keys do what the help says", () => {
  assert.deepEqual(done(press(" ")), ["finish", "accepted"]);
  assert.deepEqual(done(press("N", { shiftKey: true })), ["uncertain", -1]);
  assert.deepEqual(done(press("5")), ["tool", "5"]);
  assert.deepEqual(done(press("3")), ["alternative", 3]);
  assert.deepEqual(done(press("F", { shiftKey: true })), ["forbid", true]);
  assert.deepEqual(done(press("PageUp")), ["step", -1]);
});

test("arrows are slow alone, faster with Shift, fastest with Ctrl, and move the photo with Alt", () => {
  assert.deepEqual(done(press("ArrowLeft")), ["moveColumn", -1]);
  assert.deepEqual(done(press("ArrowRight", { shiftKey: true })), ["moveColumn", 10]);
  assert.deepEqual(done(press("ArrowDown", { ctrlKey: true })), ["moveRow", 100]);
  assert.deepEqual(done(press("ArrowUp", { altKey: true })), ["pan", "ArrowUp"]);
});

test("what belongs to the browser is left to it", () => {
  for (const key of ["a", "t", "n", "1", "Enter", "j"]) assert.equal(done(press(key, { ctrlKey: true })), undefined, key);
  assert.equal(done(press("f", { altKey: true })), undefined);
  assert.deepEqual(done(press("z", { metaKey: true })), ["undo"]);
  assert.deepEqual(done(press("Z", { ctrlKey: true, shiftKey: true })), ["redo"]);
});

test("in the sheet only those keys work that act on its card", () => {
  assert.deepEqual(done(press("r"), true), ["finish", "needs review"]);
  assert.deepEqual(done(press("u"), true), ["undo"]);
  for (const key of ["Enter", "1", "n", "Delete", "k", "]", "ArrowLeft"]) assert.equal(done(press(key), true), undefined, key);
});
