/** The line's actions by key. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { answer } from "./model.mjs";
import { Asked, Labelled, photo, soon } from "./stubs.mjs";
import { me } from "../../annotate/static/server/api.js";
import { lineActions } from "../../annotate/static/gestures/line_actions.js";
import { Selection } from "../../annotate/static/labelled/selection.js";
import { View } from "../../annotate/static/labelled/view.js";

let labelling;
let selection;
let previewer;
let act;

beforeEach(() => {
  Object.assign(me, { token: "token", pass: "the pass" });
  labelling = new Labelled();
  selection = new Selection();
  previewer = new Asked();
  const view = new View();
  view.resize(400, 240);
  view.show(400, 240);
  act = lineActions({ labelling, view, selection, previewer, focus: () => {} });
});

test("without a photo, or while another is on its way, nothing is done", () => {
  labelling.loading = "hill-2.png";
  for (const run of Object.values(act)) run(1, 2);
  labelling.loading = "";
  labelling.document = null;
  for (const run of Object.values(act)) run(1, 2);
  assert.deepEqual([labelling.applied, labelling.said, selection.now.cursor], [[], [], null]);
});

test("the first arrow shows the cursor, the next ones move it, and Enter sets an anchor there", () => {
  act.moveColumn(10);
  assert.deepEqual(selection.place(labelling.document), [200, 100]);
  act.moveColumn(10);
  act.moveRow(-7);
  assert.deepEqual(labelling.said.at(-1), "Column 210, row 93.");
  assert.deepEqual(previewer.asked, [[210, 93]]);
  act.anchorHere(false);
  assert.deepEqual(labelling.applied, [{ kind: "anchor", column: 210, row: 93 }]);
  assert.deepEqual(selection.now.cursor, { column: 210, row: null });
});

test("what an anchor will look like is shown at once where that is known", () => {
  previewer.part = { first: 0, rows: [1] };
  act.setAnchor(5, 6);
  act.setAnchor(7, 8, true); // with a stroke before it, the line will be another one
  assert.deepEqual(labelling.applied.map((one) => Array.isArray(one)), [true, false, false]);
});

test("an anchor that leaves the old line around brushes along that", () => {
  act.setAnchor(200, 150, true);
  const [stroke, anchor] = labelling.applied;
  assert.deepEqual([stroke.kind, stroke.allow, stroke.points[0], stroke.points.at(-1)], ["forbid", false, [150, 100], [249, 100]]);
  assert.deepEqual(anchor, { kind: "anchor", column: 200, row: 150 });
  act.setAnchor(200, 102, true); // it runs there already
  assert.deepEqual(labelling.applied.length, 3);
});

test("a straight line needs a mark, which is used up by it", () => {
  act.straight();
  assert.deepEqual(labelling.said, ["Put a mark at one end first: M."]);
  act.mark();
  act.moveColumn(40);
  act.straight();
  assert.deepEqual(labelling.applied, [{ kind: "straight", column: 200, row: 100, to_column: 240, to_row: 100 }]);
  assert.equal(selection.now.mark, null);
});

test("columns from the mark to the cursor are hidden, shown and dropped", () => {
  const until = () => {
    act.mark();
    act.moveColumn(-30);
  };
  for (const run of [() => act.hide(true), () => act.hide(false), () => act.release()]) {
    selection.clear();
    until();
    run();
  }
  assert.deepEqual(labelling.applied, [
    { kind: "hidden", first: 170, last: 200, hidden: true }, { kind: "hidden", first: 170, last: 200, hidden: false },
    { kind: "release", first: 170, last: 200 }]);
});

test("the anchor nearest the cursor is removed", () => {
  act.removeNearest();
  assert.deepEqual(labelling.said, ["There is no anchor."]);
  labelling.document = photo({ anchors: [[10, 90], [220, 95], [390, 90]] });
  act.removeNearest();
  assert.deepEqual(labelling.applied, [{ kind: "remove", column: 220 }]);
});

test("the brush keeps the line away from the cursor", () => {
  act.forbid(false);
  act.forbid(true);
  assert.deepEqual(labelling.applied.map(({ points, radius, allow }) => [points, radius, allow]),
    [[[[200, 100]], 12, false], [[[200, 100]], 12, true]]);
});

test("uncertain columns are visited, and said to be so", () => {
  act.uncertain(1);
  assert.deepEqual(labelling.said, ["No column is uncertain."]);
  labelling.margins = { revision: 3, margins: Array(400).fill(0.25), uncertain: [300, 20] };
  act.uncertain(1);
  act.uncertain(1);
  assert.deepEqual(labelling.said.slice(1), ["Column 300, margin 0.25.", "Column 20, margin 0.25."]);
});

test("other lines are taken by number, on the photo they were asked for alone", async () => {
  let arrive;
  globalThis.fetch = () => new Promise((done) => { arrive = () => done(answer(200, { alternatives: [{ points: [[0, 80], [399, 70]], radius: 4 }] })); });
  const settle = async () => {
    arrive();
    for (let turn = 0; turn < 5; turn++) await soon();
  };
  act.alternative(1);
  await settle();
  assert.deepEqual(labelling.applied, [{ kind: "guide", points: [[0, 80], [399, 70]], radius: 4 }]);
  act.alternative(2);
  await settle();
  assert.equal(labelling.said.at(-1), "There are 1 other line.");
  act.alternative(1);
  labelling.document = photo({ id: 2 });
  await settle();
  assert.equal(labelling.applied.length, 1);
});

test("Escape drops everything that is selected", () => {
  act.mark();
  act.escape();
  assert.deepEqual([selection.now.mark, selection.now.cursor], [null, null]);
});
