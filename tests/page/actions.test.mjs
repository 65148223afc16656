/** Which photo a status, a tag and Undo are for, and what becomes of it. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Server } from "./server.mjs";
import { quiet } from "./stubs.mjs";
import { Actions } from "../../annotate/static/around/actions.js";
import { Events } from "../../annotate/static/basics/events.js";
import { Labelling } from "../../annotate/static/labelled/labelling.js";

/** A sheet without cards to look at. */
class Sheet extends Events {
  shown = false;
  card = null;
  steps = 0;
  focused = [];

  step() {
    this.steps++;
  }

  focus(id) {
    this.focused.push(id);
  }
}

let server;
let sheet;
let labelling;
let actions;
let said; // {text, undo}, the latest last
let draft; // words about what is being made

beforeEach(async () => {
  server = new Server();
  sheet = new Sheet();
  labelling = new Labelling();
  draft = "";
  actions = new Actions(labelling, sheet, { says: () => draft, drop: () => { draft = ""; } });
  said = [];
  labelling.on("said", (what) => said.push(what));
  await labelling.load();
  await labelling.open(1);
  await quiet();
});

const status = (id) => server.documents.get(id).status;
const anchor = (column = 1) => labelling.apply({ kind: "anchor", column, row: 9 });

test("a status is kept, said, and the next photo is shown", async () => {
  await actions.finish("accepted");
  assert.deepEqual([status(1), labelling.document.id, said.at(-1).text], ["accepted", 2, "hill-1.png is accepted."]);
  await actions.setStatus("rejected");
  assert.deepEqual([status(2), labelling.document.id], ["rejected", 2]);
});

test("from the next photo, Undo takes the status of the last one back, and goes there", async () => {
  await actions.finish("accepted");
  assert.equal(actions.undoes, "hill-1.png accepted");
  actions.undo();
  await quiet();
  assert.deepEqual([status(1), labelling.document.id, said.at(-1).text], ["to do", 1, "hill-1.png is to do again."]);
  assert.equal(actions.undoes, "");
});

test("where the next photo begins with a line that is carried over, it is said, and Undo is of that line", async () => {
  const undo_what = "the line carried over from hill-1.png";
  Object.assign(server.documents.get(2), { carried: "hill-1.png", can_undo: true, undo_what });
  await actions.finish("accepted");
  assert.match(said.at(-1).text, /carried over from hill-1\.png; Undo gives the detector's own\.$/);
  assert.equal(actions.undoes, undo_what);
  said.at(-1).undo();
  await quiet();
  assert.deepEqual([status(1), labelling.document.id], ["to do", 1]);
});

test("the button beside the words does the same", async () => {
  await actions.finish("needs review");
  said.at(-1).undo();
  await quiet();
  assert.equal(status(1), "to do");
});

test("once something is done on the next photo, Undo is of that", async () => {
  await actions.finish("accepted");
  anchor();
  await quiet();
  actions.undo();
  await quiet();
  assert.deepEqual([status(1), server.documents.get(2).rows], ["accepted", [5, 5, 5]]);
});

test("what was done since to the photo that was left is not taken back", async () => {
  await actions.finish("accepted");
  labelling.send({ id: 1, name: "hill-1.png" }, { what: "operations", operation: { kind: "anchor", column: 0, row: 1 }, says: "an anchor" });
  await quiet();
  assert.equal(actions.undoes, "");
});

test("a status is not taken back where another tab has changed the photo since", async () => {
  await actions.finish("accepted");
  server.change(1, { kind: "anchor", column: 0, row: 1 });
  actions.undo();
  await quiet();
  assert.deepEqual([status(1), server.documents.get(1).rows], ["in progress", [1, 5, 5]]);
  assert.equal(labelling.queue.lost.length, 1);
});

test("a tag behind a status leaves its Undo in place", async () => {
  server.held = [];
  const done = actions.finish("accepted");
  labelling.send({ id: 1, name: "hill-1.png" }, { what: "operations", operation: { kind: "tag", tag: "fog", on: true }, says: "a tag" });
  server.release();
  await done;
  await quiet();
  said.findLast(({ undo }) => undo).undo();
  await quiet();
  assert.deepEqual([status(1), labelling.queue.lost], ["to do", []]);
});

test("a second press while the first one is on its way does nothing", async () => {
  server.held = [];
  const both = [actions.finish("accepted"), actions.finish("accepted")];
  assert.equal(labelling.waiting, 1);
  server.release();
  await Promise.all(both);
  assert.deepEqual([status(1), status(2)], ["accepted", "to do"]);
});

test("a status that the photo has already is said, and there is nothing to take back", async () => {
  await actions.setStatus("rejected");
  await actions.finish("rejected");
  assert.deepEqual([said.at(-1).text, said.at(-1).undo, labelling.document.id], ["hill-1.png is rejected already.", null, 2]);
});

test("a photo without a line is not accepted, but can be rejected", async () => {
  labelling.document.rows = null;
  await actions.finish("accepted");
  assert.deepEqual([status(1), said.at(-1).text], ["to do", "hill-1.png has no line yet, so there is nothing to accept."]);
  await actions.finish("rejected");
  assert.equal(status(1), "rejected");
});

test("an edit of an accepted photo says that it is not accepted any more, and how to take it back", async () => {
  await actions.setStatus("accepted");
  anchor();
  await quiet();
  assert.equal(said.at(-1).text, "hill-1.png is no longer accepted: it was changed. Undo takes that back.");
  said.at(-1).undo();
  await quiet();
  assert.deepEqual([status(1), said.at(-1).text], ["accepted", "hill-1.png is accepted again."]);
});

test("at the end nothing is to do any more", async () => {
  for (let photo = 0; photo < 3; photo++) await actions.finish("accepted");
  assert.equal(said.at(-1).text, "hill-3.png is accepted. No photo is to do any more.");
});

test("in the sheet everything is for its card, and Undo goes back card by card", async () => {
  sheet.shown = true;
  for (const id of [2, 3]) {
    sheet.card = labelling.photos.find((one) => one.id === id);
    await actions.finish("accepted");
  }
  assert.deepEqual([status(1), status(2), status(3), sheet.steps, labelling.document.id], ["to do", "accepted", "accepted", 2, 1]);
  actions.undo();
  await quiet();
  actions.undo();
  await quiet();
  assert.deepEqual([status(2), status(3), sheet.focused], ["to do", "to do", [3, 2]]);
  actions.undo();
  assert.match(said.at(-1).text, /^Nothing was done on this page/);
});

test("without anything done there is nothing to undo or redo, and while a photo is on its way there is no target", async () => {
  actions.undo();
  actions.redo();
  assert.deepEqual(said.slice(-2).map(({ text }) => text), ["There is nothing to undo.", "There is nothing to redo."]);
  const opening = labelling.open(2);
  assert.equal(actions.target(), null);
  await actions.finish("accepted");
  await opening;
  assert.deepEqual([status(1), status(2)], ["to do", "to do"]);
});

test("what the detector doubts of the next photo's proposal is said with it", async () => {
  server.documents.get(2).doubt = "No skyline is visible: there seems to be no sky (evidence 0.10).";
  await actions.finish("accepted");
  assert.match(said.at(-1).text, /^hill-1.png is accepted. The detector says of this one: No skyline is visible/);
});

for (const shown of [false, true]) {
  test(`one Undo takes back what several photos were given at once, ${shown ? "in the sheet" : "beside the photo"}`, async () => {
    sheet.shown = shown;
    await actions.finishAll(labelling.photos, "rejected");
    assert.deepEqual([said.at(-1).text, actions.undoes], ["3 photos are rejected.", "3 photos rejected"]);
    actions.undo();
    await quiet();
    assert.deepEqual([1, 2, 3].map(status), ["to do", "to do", "to do"]);
    assert.deepEqual([said.at(-1).text, actions.undoes, labelling.document.id], ["3 photos as before.", "", 1]);
  });
}

test("of several photos, Undo leaves the one that was changed since as it is", async () => {
  sheet.shown = true;
  await actions.finishAll(labelling.photos, "accepted");
  labelling.send({ id: 2, name: "hill-2.png" }, { what: "operations", operation: { kind: "anchor", column: 0, row: 1 }, says: "an anchor" });
  await quiet();
  actions.undo();
  await quiet();
  assert.deepEqual([1, 2, 3].map(status), ["to do", "in progress", "to do"]);
});

test("what was said of the next photo is said with it", async () => {
  server.documents.get(2).comment = { text: "the hut is cut off", by: "eve" };
  await actions.finish("accepted");
  assert.equal(said.at(-1).text, "hill-1.png is accepted. Of this one says eve: the hut is cut off");
});

test("Undo drops what is being made first, where it is seen", () => {
  anchor();
  draft = "the last corner of the guide";
  assert.equal(actions.undoes, draft);
  sheet.shown = true;
  assert.equal(actions.undoes, "");
  sheet.shown = false;
  actions.undo();
  assert.deepEqual([draft, actions.undoes], ["", "the anchor at column 1, row 9"]);
});

test("accepting a photo without a visible skyline says that its line does not count", async () => {
  server.documents.get(1).nothing_visible = true;
  labelling.document.nothing_visible = true;
  await actions.finish("accepted");
  assert.equal(said.at(-1).text, "hill-1.png is accepted, with no visible skyline: its line does not count.");
});

test("what was said of what is undone, or done again, does not stay", () => {
  anchor();
  labelling.say("The anchor is at column 1.");
  actions.undo();
  assert.equal(said.at(-1).text, "");
  labelling.say("The anchor is gone.");
  actions.redo();
  assert.equal(said.at(-1).text, "");
});
