/** The document that is shown follows what the server acknowledges, and what was shown ahead of it. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Server, listed } from "./server.mjs";
import { quiet } from "./stubs.mjs";
import { Labelling } from "../../annotate/static/labelled/labelling.js";

let server;

beforeEach(() => { server = new Server(); });

async function opened(id = 1) {
  const labelling = new Labelling();
  await labelling.load();
  await labelling.open(id);
  await labelling.queue.settled();
  return labelling;
}

test("the legend is read once, the list whenever it may have changed", async () => {
  const labelling = new Labelling();
  const told = [];
  labelling.on("legend", ({ tile }) => told.push(tile));
  await labelling.load();
  await labelling.load();
  assert.deepEqual([told, labelling.folder, labelling.annotator], [[512], "alps", "ann, pass 2"]);
  assert.deepEqual(server.asked, ["api/legend", "api/photos", "api/photos"]);
});

test("a photo is shown with its margins, and the next one to do is read ahead", async () => {
  const labelling = await opened();
  await quiet();
  assert.equal(labelling.document.id, 1);
  assert.deepEqual(labelling.margins.uncertain, [0]);
  assert.ok(server.asked.includes("api/photos/2/image"));
  server.asked = [];
  assert.equal(await labelling.open(2), true);
  assert.ok(!server.asked.includes("api/photos/2/image")); // it is there
});

test("of two photos that are opened at once the later one is shown", async () => {
  const labelling = await opened();
  const [first, second] = [labelling.open(2), labelling.open(3)];
  assert.deepEqual([await first, await second, labelling.document.id], [false, true, 3]);
});

test("previous and next are those of the photo that is on its way", async () => {
  const labelling = await opened();
  const opening = labelling.open(3);
  assert.equal(labelling.place, 2);
  await opening;
  server.documents.delete(1);
  await labelling.open(1);
  assert.equal(labelling.place, 2); // it is not on its way any more
});

test("a photo that has vanished is said, and the one that was shown stays", async () => {
  const labelling = await opened();
  const said = [];
  labelling.on("said", ({ text }) => said.push(text));
  server.documents.delete(3);
  assert.equal(await labelling.open(3), false);
  assert.deepEqual([said, labelling.document.id, labelling.loading], [["hill-3.png has vanished."], 1, ""]);
});

test("a part is shown before the server has it, and stays when it has", async () => {
  const labelling = await opened();
  server.held = [];
  labelling.apply({ kind: "anchor", column: 1, row: 9 }, { first: 1, rows: [9] });
  assert.deepEqual(labelling.document.rows, [5, 9, 5]);
  await quiet();
  server.release();
  await labelling.queue.settled();
  assert.deepEqual([labelling.document.rows, labelling.document.revision], [[5, 9, 5], 4]);
});

test("with two parts on their way, the first acknowledgement does not take the second one away", async () => {
  const labelling = await opened();
  const shown = [];
  labelling.on("document", () => shown.push(String(labelling.document.rows)));
  labelling.apply({ kind: "anchor", column: 0, row: 8 }, { first: 0, rows: [8] });
  labelling.apply({ kind: "anchor", column: 2, row: 7 }, { first: 2, rows: [7] });
  await labelling.queue.settled();
  assert.deepEqual(shown, ["8,5,5", "8,5,7", "8,5,7", "8,5,7"]);
});

test("a part whose operation is refused is taken away again, and why is said", async () => {
  const labelling = await opened();
  const said = [];
  labelling.on("said", ({ text, bad }) => bad && said.push(text));
  server.refusals = [[422, { detail: "no line is possible." }]];
  labelling.apply({ kind: "anchor", column: 1, row: 9 }, { first: 1, rows: [9] });
  await labelling.queue.settled();
  assert.deepEqual(labelling.document.rows, [5, 5, 5]);
  assert.deepEqual(said, ["hill-1.png: the anchor at column 1, row 9 is not kept: no line is possible."]);
});

test("with two parts on their way, a refusal of the first one gives back the line that the server has", async () => {
  const labelling = await opened();
  const shown = [];
  labelling.on("document", () => shown.push(String(labelling.document.rows)));
  server.refusals = [[422, { detail: "no line is possible." }]];
  labelling.apply({ kind: "anchor", column: 0, row: 8 }, { first: 0, rows: [8] });
  labelling.apply({ kind: "anchor", column: 2, row: 7 }, { first: 2, rows: [7] });
  await labelling.queue.settled();
  assert.deepEqual(shown.slice(0, 3), ["8,5,5", "8,5,7", "5,5,5"]);
  assert.equal(shown.at(-1), "5,5,7");
});

test("a change in another tab is shown, said, and built upon", async () => {
  const labelling = await opened();
  const said = [];
  labelling.on("said", ({ text }) => said.push(text));
  server.change(1, { kind: "anchor", column: 0, row: 1 });
  server.refusals = [[409, { detail: "the photo was changed.", revision: 4 }]];
  labelling.apply({ kind: "anchor", column: 1, row: 9 });
  await labelling.queue.settled();
  await quiet();
  assert.deepEqual(labelling.document.rows, [1, 9, 5]);
  assert.deepEqual(said, ["hill-1.png was changed in another tab, and is shown as it is now; what you did since is sent on top of it."]);
});

test("a status that changes is told with the one before, also of a photo that has been left", async () => {
  const labelling = await opened();
  const told = [];
  labelling.on("status", ({ before, now }) => told.push([now.id, before, now.status]));
  labelling.apply({ kind: "status", status: "accepted" });
  await labelling.open(2);
  await labelling.queue.settled();
  labelling.send({ id: 1, name: "hill-1.png" }, { what: "operations", operation: { kind: "status", status: "rejected" }, says: "rejected" });
  await labelling.queue.settled();
  assert.deepEqual(told, [[1, "to do", "accepted"], [1, "accepted", "rejected"]]);
  assert.equal(labelling.photos[0].status, "rejected");
});

test("the next photo to do comes after this one, or from the start; those that cannot be read are passed over", async () => {
  server.list = [listed(1), listed(2, { status: "accepted" }), listed(3, { missing: true })];
  const labelling = await opened(1);
  assert.equal(labelling.following(), undefined);
  await labelling.open(2);
  assert.equal(labelling.following().id, 1);
});

test("nothing is done to a photo that is being left", async () => {
  const labelling = await opened();
  const opening = labelling.open(2);
  assert.equal(labelling.apply({ kind: "remove", column: 1 }), null);
  await opening;
  assert.equal(labelling.waiting, 0);
});

test("a reason that is chosen later is a tag of the photo as it is by then", async () => {
  const labelling = await opened();
  const [reason] = labelling.reasons(labelling.document, ["hidden by cloud"]);
  await labelling.apply({ kind: "anchor", column: 0, row: 7 });
  const said = [];
  labelling.on("said", ({ text, bad }) => said.push([text, bad]));
  reason.run();
  await labelling.queue.settled();
  assert.deepEqual(server.documents.get(1).tags, ["hidden by cloud"]);
  assert.deepEqual(said, [["hill-1.png has the tag “hidden by cloud”.", false]]);
});
