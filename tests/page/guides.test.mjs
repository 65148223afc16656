/** Guides: strokes and corners, and what is sent of them. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Asked, Labelled, photo } from "./stubs.mjs";
import { guideActions, handRadius, roughly } from "../../annotate/static/gestures/guides.js";
import { Selection } from "../../annotate/static/labelled/selection.js";
import { View } from "../../annotate/static/labelled/view.js";

let labelling;
let selection;
let previewer;
let act;

beforeEach(() => {
  labelling = new Labelled();
  selection = new Selection();
  previewer = new Asked();
  const view = new View();
  view.resize(400, 240);
  view.show(400, 240);
  act = guideActions({ labelling, selection, view, previewer });
});

test("a hand is as uncertain as it looks at the zoom, and a finger more", () => {
  assert.deepEqual([1, 0.25, 8, 1e-6].map((scale) => handRadius(scale)), [6, 24, 2, 1000]);
  assert.ok(handRadius(1, true) > handRadius(1));
});

test("a stroke is sent with times that begin with 0, or with none", () => {
  const points = [[1, 2], [3, 4]];
  assert.deepEqual(roughly({ points, radius: 5, times: [900.4, 950.9] }), { points, radius: 5, times: [0, 51] });
  assert.deepEqual(roughly({ points, radius: 5, times: [] }).times, []);
  const long = Array.from({ length: 6000 }, (_, column) => [column, 5]);
  const sent = roughly({ points: long, radius: 5, times: long.map(([column]) => column) });
  assert.ok(sent.points.length <= 2001 && sent.points.length === sent.times.length);
});

test("corners are shown as a line, and the last one again ends the guide", () => {
  act.corner([50, 100]);
  assert.deepEqual(previewer.followed, []);
  act.corner([150, 90]);
  act.showGuide([200, 95]);
  assert.deepEqual(previewer.followed.map(({ points }) => points.length), [2, 3]);
  act.corner([153, 92]); // within a few screen pixels
  assert.deepEqual(labelling.applied, [{ kind: "guide", points: [[50, 100], [150, 90]], radius: 12, times: [] }]);
  assert.deepEqual(selection.now.corners, []);
});

test("the cursor makes corners, too; one alone is no guide, and the last one is taken off", () => {
  act.corner();
  act.finishGuide();
  assert.match(labelling.said.at(-1), /two corners/);
  selection.moveTo(labelling.document, 300, 80);
  act.corner();
  act.dropCorner();
  assert.deepEqual(selection.now.corners, [[200, 100]]);
  assert.deepEqual(labelling.applied, []);
});

test("a photo that is labelled blind has nothing to snap to, which is said", () => {
  labelling.document = photo({ blind: true, rows: null });
  act.guide({ points: [[1, 2], [50, 2]], radius: 9, times: [] });
  assert.match(labelling.said.at(-1), /blind/);
  assert.deepEqual(labelling.applied, []);
});

test("a corner by key shows the cursor, so that an arrow moves on from there; a click does not", () => {
  act.corner([50, 100]);
  assert.equal(selection.now.cursor, null);
  selection.corner([]);
  act.corner();
  assert.deepEqual(selection.now.cursor, { column: 200, row: null });
});
