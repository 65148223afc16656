/** The queue against a network that does what it likes: everything is kept once, in order, or named. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { FAULTS, Store, answer, asked, never } from "./model.mjs";
import { me } from "../../annotate/static/server/api.js";
import { Queue, newId } from "../../annotate/static/server/queue.js";
import { trouble } from "../../annotate/static/basics/words.js";

const soon = { pause: () => new Promise((done) => setImmediate(done)), patience: [20] };

/** A queue before a network: each call of `fetch` is answered by the next fault, and when none is left, truly. */
function before(store, faults = [], options = soon) {
  globalThis.fetch = async (path, { body, signal }) => {
    const fault = faults.shift();
    return fault ? fault({ path, body, signal, reach: () => asked(store, path, body) }) : answer(...asked(store, path, body));
  };
  const queue = new Queue(options);
  queue.said = [];
  queue.on("change", () => queue.reason && queue.said.at(-1) !== queue.reason && queue.said.push(queue.reason));
  return queue;
}

const anchor = (column, photo = 1, revision = 0) => ({
  photo, name: `photo ${photo}`, what: "operations", operation: { kind: "anchor", column, row: 5 }, revision, says: `the anchor at column ${column}`,
});
const undo = (photo = 1, revision = 0) => ({ photo, name: `photo ${photo}`, what: "undo", revision, says: "undoing" });
const kinds = (store, photo = 1) => store.of(photo).rows.map((row) => row.what);

beforeEach(() => Object.assign(me, { token: "token", pass: "the pass" }));

for (const [fault, how] of Object.entries(FAULTS)) {
  for (const times of [1, 3]) {
    test(`an edit that ${fault} ${times} times is kept once, and so are those after it`, async () => {
      const store = new Store();
      const queue = before(store, Array(times).fill(how));
      const first = queue.add(anchor(1));
      queue.add(anchor(2));
      queue.add(anchor(3));
      assert.equal(queue.waiting, 3);
      await queue.settled();
      assert.equal((await first).id, 1);
      assert.deepEqual(kinds(store), ["anchor", "anchor", "anchor"]);
      assert.deepEqual(queue.lost, []);
      assert.equal(queue.said.length > 0, true);
      assert.equal(queue.reason, "");
    });
  }
}

test("what waits, and why, is said in one sentence", async () => {
  const queue = before(new Store(), [() => { throw new TypeError("network"); }]);
  queue.add(anchor(1));
  queue.add(anchor(2));
  await new Promise((done) => queue.on("change", () => queue.reason && done()));
  assert.equal(trouble(queue.reason, queue.waiting), "The server does not answer. 2 edits wait and are sent as soon as they can be.");
  await queue.settled();
  assert.equal(trouble(queue.reason, queue.waiting), "");
});

test("an attempt follows at once when the network is back", async () => {
  const store = new Store();
  const queue = before(store, [() => { throw new TypeError("network"); }], { pause: never, patience: [1000] });
  queue.add(anchor(1));
  await new Promise((done) => queue.on("change", () => queue.reason && done()));
  await new Promise((done) => setImmediate(done));
  queue.wake();
  await queue.settled();
  assert.deepEqual(kinds(store), ["anchor"]);
});

test("edits after another tab's change are sent on top of it, and said", async () => {
  const store = new Store();
  store.change(1, "operations", { id: "other", revision: 0, operation: { kind: "anchor", column: 9, row: 9 } });
  const queue = before(store);
  const stale = [];
  queue.on("stale", ({ photo }) => stale.push(photo));
  queue.add(anchor(1));
  queue.add(anchor(2));
  await queue.settled();
  assert.deepEqual(kinds(store), ["anchor", "anchor", "anchor"]);
  assert.deepEqual(stale, [1]);
  assert.deepEqual(queue.lost, []);
});

test("undo never takes back what another tab did, and an unseen line is never accepted", async () => {
  const store = new Store();
  store.change(1, "operations", { id: "other", revision: 0, operation: { kind: "anchor", column: 9, row: 9 } });
  const queue = before(store);
  queue.add(undo());
  queue.add(anchor(2));
  queue.add(undo());
  queue.add({ ...undo(), what: "redo" });
  queue.add({ ...anchor(0), operation: { kind: "status", status: "accepted" }, says: "“accepted”" });
  queue.add(undo());
  await queue.settled();
  assert.deepEqual(kinds(store), ["anchor", "anchor", "undo", "redo"]);
  assert.deepEqual(queue.lost.map(({ says }) => says), ["undoing", "“accepted”", "undoing"]);
  assert.match(queue.lost[0].reason, /changed meanwhile/);
});

test("an edit that is refused is named with its own undo, and the rest goes on", async () => {
  const store = new Store();
  const queue = before(store);
  queue.add(anchor(1));
  const refused = queue.add({ ...anchor(0), operation: { kind: "remove", column: -1 }, says: "removing" });
  queue.add(undo());
  queue.add(anchor(2));
  await queue.settled();
  assert.equal(await refused, null);
  assert.deepEqual(kinds(store), ["anchor", "anchor"]);
  assert.deepEqual(queue.lost.map(({ says }) => says), ["removing", "undoing"]);
});

test("nothing to undo is no loss", async () => {
  const queue = before(new Store());
  queue.add(undo());
  await queue.settled();
  assert.deepEqual(queue.lost, []);
});

test("a photo that is gone loses its own edits by name, and no other's", async () => {
  const store = new Store();
  store.gone.add(1);
  const queue = before(store);
  queue.add(anchor(1, 1));
  queue.add(anchor(2, 2));
  queue.add(anchor(3, 1));
  await queue.settled();
  assert.deepEqual(kinds(store, 2), ["anchor"]);
  assert.deepEqual(queue.lost.map(({ name, says }) => [name, says]), [
    ["photo 1", "the anchor at column 1"], ["photo 1", "the anchor at column 3"]]);
  queue.forget();
  assert.deepEqual(queue.lost, []);
});

test("a page that is not on this machine makes ids, too", () => {
  const given = crypto.randomUUID;
  Object.defineProperty(crypto, "randomUUID", { value: undefined, configurable: true });
  const ids = new Set(Array.from({ length: 100 }, newId));
  Object.defineProperty(crypto, "randomUUID", { value: given, configurable: true });
  assert.equal(ids.size, 100);
  for (const id of ids) assert.match(id, /^[A-Za-z0-9-]{1,64}$/);
});
