/** The document that is shown follows what the server acknowledges, and what was shown ahead of it. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { answer } from "./model.mjs";
import { photo, soon } from "./stubs.mjs";
import { me } from "../../annotate/static/api.js";
import { Labelling } from "../../annotate/static/labelling.js";

const LEGEND = { statuses: ["to do"], tags: [], stages: [], formats: [], colours: {}, tile: 512, band: 40 };
const listed = (id, how = {}) => ({ id, name: `hill-${id}.png`, status: "to do", tags: [], missing: false, too_large: false, ...how });

let documents; // what the server knows, by id
let list;
let asked; // paths, the latest last
let refusals; // of the next operations
let held; // operations that wait for `release`

beforeEach(() => {
  Object.assign(me, { token: "token", pass: "the pass" });
  documents = new Map([1, 2, 3].map((id) => [id, photo({ id, name: `hill-${id}.png`, rows: [5, 5, 5], width: 3 })]));
  list = [listed(1), listed(2), listed(3)];
  [asked, refusals, held] = [[], [], null];
  globalThis.createImageBitmap = async () => ({ width: 3, height: 2 });
  globalThis.fetch = async (path, { body }) => {
    asked.push(path);
    if (path.endsWith("/image")) return new Response("pixels", { headers: { "X-Skyline-Pass": "the pass" } });
    if (body && held) await new Promise((done) => held.push(done));
    return answer(...respond(path, body && JSON.parse(body)));
  };
});

function respond(path, body) {
  if (path === "api/legend") return [200, LEGEND];
  if (path === "api/photos") return [200, { folder: "alps", annotator: "ann", number: 2, photos: list.map((one) => ({ ...one })), progress: {} }];
  const id = Number(/photos\/(\d+)/.exec(path)[1]);
  if (path.endsWith("/margins")) return [200, { revision: 0, margins: [1, 2, 3], uncertain: [0] }];
  if (!documents.has(id)) return [410, { detail: `hill-${id}.png has vanished.` }];
  if (!body) return [200, structuredClone(documents.get(id))];
  const refusal = body.operation.kind === "open" ? null : refusals.shift();
  return refusal ?? [200, change(documents.get(id), body.operation)];
}

/** Do an operation on what the server knows. */
function change(known, operation) {
  if (operation.kind !== "open") known.revision++;
  if (operation.kind === "status") known.status = operation.status;
  if (operation.kind === "anchor") known.rows[operation.column] = operation.row;
  return { ...structuredClone(known), kept: known.revision };
}

async function opened(id = 1) {
  const labelling = new Labelling();
  await labelling.load();
  await labelling.open(id);
  await labelling.queue.settled();
  return labelling;
}

/** Let what is asked meanwhile be answered. */
async function quiet() {
  for (let turn = 0; turn < 30; turn++) await soon();
}

test("the legend is read once, the list whenever it may have changed", async () => {
  const labelling = new Labelling();
  const told = [];
  labelling.on("legend", ({ tile }) => told.push(tile));
  await labelling.load();
  await labelling.load();
  assert.deepEqual([told, labelling.folder, labelling.annotator], [[512], "alps", "ann, pass 2"]);
  assert.deepEqual(asked, ["api/legend", "api/photos", "api/photos"]);
});

test("a photo is shown with its margins, and the next one to do is read ahead", async () => {
  const labelling = await opened();
  await quiet();
  assert.equal(labelling.document.id, 1);
  assert.deepEqual(labelling.margins.uncertain, [0]);
  assert.ok(asked.includes("api/photos/2/image"));
  asked = [];
  assert.equal(await labelling.open(2), true);
  assert.ok(!asked.includes("api/photos/2/image")); // it is there
});

test("of two photos that are opened at once the later one is shown", async () => {
  const labelling = await opened();
  const [first, second] = [labelling.open(2), labelling.open(3)];
  assert.deepEqual([await first, await second, labelling.document.id], [false, true, 3]);
});

test("a photo that has vanished is said, and the one that was shown stays", async () => {
  const labelling = await opened();
  const said = [];
  labelling.on("said", ({ text }) => said.push(text));
  documents.delete(3);
  assert.equal(await labelling.open(3), false);
  assert.deepEqual([said, labelling.document.id, labelling.loading], [["hill-3.png has vanished."], 1, ""]);
});

test("a part is shown before the server has it, and stays when it has", async () => {
  const labelling = await opened();
  held = [];
  labelling.apply({ kind: "anchor", column: 1, row: 9 }, { first: 1, rows: [9] });
  assert.deepEqual(labelling.document.rows, [5, 9, 5]);
  await quiet();
  held.forEach((done) => done());
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
  refusals = [[422, { detail: "no line is possible." }]];
  labelling.apply({ kind: "anchor", column: 1, row: 9 }, { first: 1, rows: [9] });
  await labelling.queue.settled();
  assert.deepEqual(labelling.document.rows, [5, 5, 5]);
  assert.deepEqual(said, ["hill-1.png: the anchor at column 1, row 9 is not kept: no line is possible."]);
});

test("a change in another tab is shown, said, and built upon", async () => {
  const labelling = await opened();
  const said = [];
  labelling.on("said", ({ text }) => said.push(text));
  change(documents.get(1), { kind: "anchor", column: 0, row: 1 });
  refusals = [[409, { detail: "the photo was changed.", revision: 4 }]];
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
  list = [listed(1), listed(2, { status: "accepted" }), listed(3, { missing: true })];
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
