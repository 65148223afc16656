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
let view;

beforeEach(() => {
  Object.assign(me, { token: "token", pass: "the pass" });
  labelling = new Labelled();
  selection = new Selection();
  previewer = new Asked();
  view = new View();
  view.resize(400, 240);
  view.show(400, 240);
  act = lineActions({ labelling, view, selection, previewer, brush: { radius: 12 }, focus: () => {} });
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
  act.anchorHere();
  assert.deepEqual(labelling.applied, [{ kind: "anchor", column: 210, row: 93, within: 0 }]);
  assert.deepEqual(selection.now.cursor, { column: 210, row: null });
});

test("what an anchor will look like is shown at once where that is known", () => {
  previewer.part = { first: 0, rows: [1] };
  act.setAnchor(5, 6, 2);
  previewer.part = null;
  act.setAnchor(7, 8);
  assert.deepEqual(labelling.applied, [[{ kind: "anchor", column: 5, row: 6, within: 2 }, { first: 0, rows: [1] }], { kind: "anchor", column: 7, row: 8, within: 0 }]);
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

test("uncertain spans are visited and counted, and looked at closely", () => {
  act.uncertain(1);
  assert.match(labelling.said.at(-1), /being measured/);
  labelling.margins = { revision: 3, margins: Array(400).fill(3), uncertain: [] };
  act.uncertain(1);
  assert.equal(labelling.said.at(-1), "No span is uncertain.");
  for (const [column, margin] of [[20, 0.3], [300, 0.1], [304, 0.25]]) labelling.margins.margins[column] = margin;
  act.uncertain(1);
  assert.equal(labelling.said.at(-1), "Uncertain span 2 of 2: columns 300 to 304. Another line there costs only 0.10 more.");
  act.uncertain(1);
  assert.equal(labelling.said.at(-1), "Uncertain span 1 of 2: column 20. Another line there costs only 0.30 more.");
  assert.deepEqual(selection.now.cursor, { column: 20, row: null });
  assert.ok(view.scale > 1);
});

test("in the consensus, spans in which passes differ are visited instead", () => {
  labelling.document = photo({ apart: [[20, 39], [300, 309]] });
  act.uncertain(1);
  assert.equal(labelling.said.at(-1), "Passes differ in span 1 of 2: columns 20 to 39. 1 shows their lines.");
  act.uncertain(1);
  assert.equal(labelling.said.at(-1), "Passes differ in span 2 of 2: columns 300 to 309. 1 shows their lines.");
  assert.deepEqual(selection.now.cursor, { column: 304, row: null });
  assert.ok(view.scale > 1);
});

test("the line of another pass is asked for at the cursor, and taken just where passes differ", async () => {
  const take = { kind: "taken", first: 20, rows: [80, 81], origins: [["solved", 2]], hidden: [], of: ["bob"] };
  const bob = { points: [], radius: 4, rows: Array(400).fill(80), detour: 0, apart: 1, name: "bob", take };
  let asked = "";
  globalThis.fetch = (path) => {
    asked = String(path);
    return Promise.resolve(answer(200, { alternatives: [bob] }));
  };
  selection.moveTo(labelling.document, 25);
  await act.others();
  assert.match(asked, /api\/photos\/1\/alternatives\?column=25$/);
  assert.equal(labelling.said.at(-1), "Passes differ in columns 20 to 21. A number takes the line of one there, Escape leaves.");
  act.alternative(1);
  assert.deepEqual(labelling.applied, [[take, { first: 20, rows: [80, 81] }]]);
  assert.equal(labelling.said.at(-1), "The line of bob is taken in columns 20 to 21.");
});

test("what hides columns is asked once, and is said of these columns; what shows them is not", () => {
  labelling.legend = { hidden_by: ["cloud"] };
  let asked;
  let choose;
  labelling.say = (text, bad, undo, choices) => {
    asked = [text, choices.map(({ words }) => words)];
    choose ??= choices[0]?.run;
  };
  act.did({ kind: "hidden", first: 3, last: 9, hidden: true });
  assert.deepEqual(asked, ["Columns 3 to 9 are not visible.", ["cloud"]]);
  choose();
  assert.deepEqual(labelling.applied.at(-1), { kind: "hidden", first: 3, last: 9, hidden: true, why: "cloud" });
  assert.deepEqual(asked, ["Columns 3 to 9 are not visible: cloud.", []]);
  const { length } = labelling.applied;
  labelling.document = photo({ id: 2 });
  choose(); // the columns were those of another photo
  assert.equal(labelling.applied.length, length);
  act.did({ kind: "hidden", first: 3, last: 9, hidden: false });
  assert.deepEqual(asked, ["Columns 3 to 9 are visible.", []]);
});

test("other lines are shown first and then taken by number, on the photo they were asked for alone", async () => {
  let arrive;
  const one = { points: [[0, 80], [399, 70]], radius: 4, rows: Array(400).fill(80), detour: 1, apart: 1 };
  globalThis.fetch = () => new Promise((done) => { arrive = () => done(answer(200, { alternatives: [one] })); });
  const settle = async () => {
    arrive();
    for (let turn = 0; turn < 5; turn++) await soon();
  };
  act.alternative(1);
  await settle();
  assert.deepEqual([labelling.applied, selection.now.others], [[], [one]]);
  act.alternative(2);
  assert.equal(labelling.said.at(-1), "There is 1 other line.");
  act.alternative(1);
  assert.deepEqual(labelling.applied, [[{ kind: "guide", points: one.points, radius: 4 }, { first: 0, rows: one.rows }]]);
  assert.deepEqual(selection.now.others, []);
  act.others();
  labelling.document = photo({ id: 2 });
  await settle();
  assert.deepEqual(selection.now.others, []); // they are another photo's
  act.others();
  await settle();
  labelling.show(photo({ id: 2, revision: 4 }));
  assert.deepEqual(selection.now.others, []); // the line is another one
});

test("Escape drops everything that is selected", () => {
  act.mark();
  act.escape();
  assert.deepEqual([selection.now.mark, selection.now.cursor], [null, null]);
});

test("a guide is made by key from nothing", () => {
  act.corner();
  act.moveColumn(100);
  act.corner();
  act.anchorHere();
  assert.deepEqual(labelling.applied.map(({ points }) => points), [[[200, 100], [300, 100]]]);
});
