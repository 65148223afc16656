/** Previews: one question at a time, the latest one next, and never one of another line. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { answer } from "./model.mjs";
import { Labelled, photo, soon } from "./stubs.mjs";
import { me } from "../../annotate/static/server/api.js";
import { Previewer } from "../../annotate/static/labelled/previewer.js";

let labelling;
let previewer;
let shown; // parts, the latest last
let asked; // what the server was asked, each with a function that answers it

beforeEach(() => {
  Object.assign(me, { token: "token", pass: "the pass" });
  labelling = new Labelled();
  shown = [];
  asked = [];
  previewer = new Previewer(labelling, (part) => shown.push(part));
  globalThis.fetch = (path, { body }) => new Promise((done) => {
    asked.push({ path, body: JSON.parse(body), say: (status, said) => done(answer(status, said)) });
  });
});

/** Answer a question with a part. */
async function reply(at, part) {
  asked[at].say(200, part);
  for (let turn = 0; turn < 5; turn++) await soon();
}

const PART = { first: 3, rows: [1, 2, 3] };

test("a preview is shown, and known until the line changes", async () => {
  previewer.ask(5, 6);
  await reply(0, PART);
  assert.deepEqual(asked[0].body, { column: 5, row: 6, within: 0, lifted: null });
  assert.deepEqual(shown, [PART]);
  assert.deepEqual(previewer.known("preview", { column: 5, row: 6, within: 0, lifted: null }), PART);
  assert.equal(previewer.known("preview", { column: 5, row: 7, within: 0, lifted: null }), null);
  labelling.show(photo({ revision: 4 }));
  assert.equal(previewer.known("preview", { column: 5, row: 6, within: 0, lifted: null }), null);
  assert.deepEqual(shown, [PART, null]); // it was of the old line
});

test("while one question is on its way, only the latest one is asked next", async () => {
  for (const column of [1, 2, 3, 4]) previewer.ask(column, 9);
  await reply(0, PART);
  assert.deepEqual(shown, [PART]); // the newest that is known, though something else is wanted by now
  assert.equal(previewer.known("preview", { column: 4, row: 9, within: 0, lifted: null }), null);
  await reply(1, { first: 7, rows: [8] });
  assert.deepEqual(asked.map(({ body }) => body.column), [1, 4]);
  assert.deepEqual(shown, [PART, { first: 7, rows: [8] }]);
});

test("an answer that comes after it is not wanted any more shows nothing", async () => {
  previewer.ask(5, 6);
  previewer.clear();
  await reply(0, PART);
  assert.deepEqual(shown, [null]);
  assert.equal(previewer.known("preview", { column: 5, row: 6, within: 0, lifted: null }), null);
});

test("a hand that never rests sees a line for each answer, the newest last", async () => {
  const rough = (to) => ({ points: [[0, 9], [to, 9]], radius: 6, times: [] });
  for (let at = 0; at < 5; at++) {
    previewer.follow(rough(2 * at + 1));
    previewer.follow(rough(2 * at + 2)); // the hand is elsewhere before the answer comes
    await reply(at, { first: at, rows: [1] });
  }
  assert.deepEqual(shown.map(({ first }) => first), [0, 1, 2, 3, 4]);
});

test("what was asked before previews were dropped is not shown for what is wanted since", async () => {
  previewer.ask(5, 6);
  previewer.clear();
  previewer.ask(7, 8);
  await reply(0, PART);
  assert.deepEqual(shown, [null]);
  await reply(1, PART);
  assert.deepEqual(shown, [null, PART]);
});

test("an answer about another line, or another photo, shows nothing", async () => {
  previewer.ask(5, 6);
  labelling.show(photo({ revision: 4 }));
  await reply(0, PART);
  previewer.ask(5, 6);
  labelling.show(photo({ id: 2 }), true);
  await reply(1, PART);
  assert.equal(shown.filter(Boolean).length, 0);
  assert.equal(asked.length, 2);
});

test("what was wanted of one photo is not asked of the next one", async () => {
  previewer.ask(1, 9);
  previewer.ask(2, 9);
  labelling.show(photo({ id: 2 }), true);
  await reply(0, PART);
  assert.equal(asked.length, 1);
});

test("the part of an anchor that is dragged is no part of a new one", async () => {
  previewer.ask(5, 6, 2);
  await reply(0, PART);
  assert.deepEqual(shown, [PART]);
  assert.equal(previewer.known("preview", { column: 5, row: 6, within: 0, lifted: null }), null);
});

test("a pixel through which no line can pass shows nothing, without a word; a fault is said", async () => {
  previewer.ask(5, 6);
  asked[0].say(422, { detail: "no line is possible." });
  await reply(0, PART);
  assert.deepEqual([shown, labelling.said], [[null], []]);
  previewer.ask(5, 7);
  asked[1].say(500, { detail: "a fault." });
  await reply(1, PART);
  assert.deepEqual(labelling.said, ["a fault."]);
  previewer.ask(5, 8); // and it goes on
  await reply(2, PART);
  assert.deepEqual(shown.at(-1), PART);
});
