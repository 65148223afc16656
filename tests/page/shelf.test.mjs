/** What waits outlives its page, and no living tab loses it to another one. */

import assert from "node:assert/strict";
import { test } from "node:test";

import "./model.mjs";
import { signIn, me } from "../../annotate/static/server/api.js";
import { Shelf } from "../../annotate/static/server/shelf.js";

/** A storage as browsers have it; `room` limits its characters. */
function storage(room = Infinity) {
  return Object.create({
    getItem(key) { return this[key] ?? null; },
    setItem(key, text) {
      if (text.length > room) throw new Error("full");
      this[key] = text;
    },
    removeItem(key) { delete this[key]; },
  });
}

const item = { id: "a", photo: 1, name: "hill", what: "undo", operation: null, revision: 3, says: "undoing", chain: "c" };
const shelf = (kept, how = {}) => new Shelf({ pass: "ann", folder: "alps", storage: kept, ...how });

test("without locks, what a page leaves is taken over once, and at once", async () => {
  const kept = storage();
  const first = shelf(kept);
  first.put([item], [{ says: "lost" }]);
  const second = shelf(kept);
  assert.deepEqual(await second.orphans(), { items: [], lost: [] }); // the first one lives
  first.leave();
  assert.deepEqual(await second.orphans(), { items: [item], lost: [{ says: "lost" }] });
  assert.deepEqual(await shelf(kept).orphans(), { items: [], lost: [] });
  second.leave();
  assert.deepEqual((await shelf(kept).orphans()).items, [item]); // it was on the second one's shelf
});

test("without locks, a page that has crashed is found dead after a while", async (context) => {
  const kept = storage();
  context.mock.timers.enable({ apis: ["Date"], now: 0 });
  const first = shelf(kept);
  first.put([item], []);
  context.mock.timers.setTime(100_000);
  first.live();
  context.mock.timers.setTime(200_000);
  assert.deepEqual((await shelf(kept).orphans()).items, []);
  context.mock.timers.setTime(300_000);
  assert.deepEqual((await shelf(kept).orphans()).items, [item]);
});

test("another pass takes nothing, and can say that something waits", async () => {
  const kept = storage();
  const first = shelf(kept);
  first.put([item, item], []);
  first.leave();
  const other = shelf(kept, { pass: "bob" });
  assert.deepEqual(await other.orphans(), { items: [], lost: [] });
  assert.deepEqual(other.elsewhere(), [{ folder: "alps", count: 2 }]);
  assert.deepEqual(shelf(kept).elsewhere(), []);
});

test("a browser that keeps nothing, or no more, is no error", async () => {
  assert.equal(shelf(storage(10)).put([item], []), false);
  assert.equal(shelf({}).put([item], []), false);
  assert.deepEqual(await shelf({}).orphans(), { items: [], lost: [] });
  const strange = storage();
  strange.setItem("skyline-queue/ann/x", "{no JSON");
  strange.setItem("skyline-queue/ann/y", "null");
  strange.setItem("skyline-queue/ann/z", '{"items": 3}');
  assert.deepEqual(await shelf(strange).orphans(), { items: [], lost: [] });
});

test("nothing is left on the shelf when nothing waits", () => {
  const kept = storage();
  const one = shelf(kept);
  one.put([item], []);
  one.put([], []);
  assert.deepEqual(Object.keys(kept), []);
});

test("the token leaves the address and comes back after a reload", () => {
  const kept = storage();
  const replaced = [];
  const history = { replaceState: (...how) => replaced.push(how.at(-1)) };
  signIn({ location: { search: "?token=secret", pathname: "/" }, history, storage: kept });
  assert.deepEqual([me.token, replaced], ["secret", ["/"]]);
  me.token = "";
  signIn({ location: { search: "", pathname: "/" }, history, storage: kept });
  assert.deepEqual([me.token, replaced], ["secret", ["/"]]);
  signIn({ location: { search: "?token=other", pathname: "/" }, history, storage: {} });
  assert.deepEqual([me.token, replaced], ["other", ["/"]]); // it stays in the address where nothing is kept
});
