/** The tools: from a press to an operation. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Asked } from "./stubs.mjs";
import { Selection } from "../../annotate/static/labelled/selection.js";
import { brushRadius, snapping } from "../../annotate/static/gestures/strokes.js";
import { DragTool, PanTool, TOOLS, makeTools } from "../../annotate/static/gestures/tools.js";

let bench;
let done; // what came of it

beforeEach(() => {
  done = [];
  bench = {
    selection: new Selection(),
    view: { scale: 2, pan: (...by) => done.push(["pan", ...by]) },
    previewer: new Asked(),
    apply: (operation) => done.push(operation),
    brush: { radius: 12 },
    guide: (rough) => done.push(["guide", rough.points]),
    corner: (pixel) => done.push(["corner", pixel]),
    explain: (pixel) => done.push(["explain", pixel]),
    anchor: (...how) => done.push(["anchor", ...how]),
    goTo: (column) => done.push(["goTo", column]),
  };
});

const at = (column, row, how = {}) =>
  ({ at: [2 * column, 2 * row], pixel: [column, row], by: [6, 2], moved: true, far: false, time: 0, finger: false, shift: false, alt: false, ...how });

/** Press at the first contact, move through the others, and let go at the last. */
function use(tool, ...contacts) {
  tool.start(contacts[0]);
  for (const contact of contacts.slice(1)) tool.move(contact);
  tool.end(contacts.at(-1));
}

test("every button has a tool, and every tool another key", () => {
  assert.deepEqual(Object.keys(makeTools(bench)), TOOLS.map(({ id }) => id));
  assert.equal(new Set(TOOLS.map(({ key }) => key)).size, TOOLS.length);
});

test("a click sets an anchor on the edge beside it, with Shift just there", () => {
  const { anchor } = makeTools(bench);
  use(anchor, at(5, 6, { moved: false }));
  use(anchor, at(7, 8, { moved: false, shift: true }));
  assert.deepEqual(done, [["anchor", 5, 6, 2], ["anchor", 7, 8, 0]]);
});

test("a drag along a ridge is a guide, which is shown on the way", () => {
  use(makeTools(bench).anchor, at(5, 6, { moved: false }), at(6, 6, { moved: false }), at(9, 6, { far: true }), at(12, 7, { far: true }));
  assert.deepEqual(done, [["guide", [[5, 6], [9, 6], [12, 7]]]]);
  assert.deepEqual(bench.previewer.followed.map(({ points, radius }) => [points.length, radius]), [[2, 3], [3, 3]]);
});

test("with Alt the mouse moves the photo with the anchor tool, and sets nothing then", () => {
  use(makeTools(bench).anchor, at(5, 6, { moved: false, alt: true }), at(9, 6, { far: true, alt: true }));
  assert.deepEqual(done, [["pan", 6, 2]]);
});

test("corners of a guide are clicked, and a pixel is explained", () => {
  const { guide, explain } = makeTools(bench);
  use(guide, at(5, 6, { moved: false }));
  use(explain, at(7, 8, { moved: false }));
  assert.deepEqual(done, [["corner", [5, 6]], ["explain", [7, 8]]]);
});

test("a finger aims before it sets an anchor, and is magnified", () => {
  const { anchor } = makeTools(bench);
  anchor.start(at(5, 6, { finger: true, moved: false }));
  assert.deepEqual(bench.selection.now.finger, [10, 12]);
  anchor.move(at(9, 3, { finger: true }));
  assert.deepEqual(bench.selection.now.cursor, { column: 9, row: 3 });
  assert.deepEqual(bench.previewer.asked, [[5, 6, 4, null], [9, 3, 4, null]]);
  anchor.end(at(9, 3, { finger: true }));
  assert.deepEqual(done, [["anchor", 9, 3, 4]]);
});

test("an anchor that is dragged is moved, and shown where it goes", () => {
  const drag = new DragTool(bench, 5);
  drag.start(at(5, 6, { moved: false }));
  drag.move(at(8, 9));
  assert.equal(bench.selection.now.dragged, 5);
  assert.deepEqual(bench.previewer.asked, [[8, 9, 2, 5]]);
  drag.end(at(8, 9));
  assert.deepEqual(done, [{ kind: "move", from_column: 5, column: 8, row: 9, within: 2 }]);
});

test("an anchor that is clicked takes the cursor", () => {
  use(new DragTool(bench, 5), at(5, 6, { moved: false }), at(5, 6, { moved: false }));
  assert.deepEqual(done, [["goTo", 5]]);
});

test("the brush paints a stroke as wide as it looks, and erases with Alt at its start", () => {
  const { forbid } = makeTools(bench);
  use(forbid, at(1, 1), at(2, 2), at(2, 2), at(3, 1));
  assert.deepEqual(done, [{ kind: "forbid", points: [[1, 1], [2, 2], [3, 1]], radius: 6, allow: false }]);
  use(forbid, at(1, 1, { alt: true }), at(2, 2));
  assert.equal(done[1].allow, true);
  use(forbid, at(4, 4));
  assert.deepEqual(done[2].points, [[4, 4]]);
});

test("a long stroke is sent with fewer points", () => {
  use(makeTools(bench).forbid, ...Array.from({ length: 6000 }, (_, column) => at(column, 5)));
  assert.ok(done[0].points.length <= 2001);
});

test("the brush has a width at every zoom that the server takes", () => {
  assert.deepEqual([32, 2, 0.5, 1e-6].map((scale) => brushRadius(12, scale)), [1, 6, 24, 1000]);
  assert.equal(brushRadius(12, 32, 2), 2);
});

test("a line that is drawn is sent a row a column; a click draws none", () => {
  const { drawn } = makeTools(bench);
  use(drawn, at(4, 10), at(6, 12));
  assert.deepEqual(done, [{ kind: "drawn", first: 4, rows: [10, 11, 12] }]);
  use(drawn, at(4, 10));
  assert.equal(done.length, 1);
});

test("all above a stroke is sky, with Alt all below it is terrain; a click says nothing", () => {
  const { side } = makeTools(bench);
  use(side, at(4, 10), at(9, 12));
  use(side, at(4, 10, { alt: true }), at(9, 12));
  use(side, at(4, 10));
  assert.deepEqual(done, ["sky", "terrain"].map((ground) => ({ kind: "side", points: [[4, 10], [9, 12]], ground })));
});

test("a click means an edge within a few screen pixels, and of a finger within more", () => {
  const hand = { finger: false, shift: false };
  assert.deepEqual([0.25, 1, 32].map((scale) => snapping(scale, hand)), [16, 4, 1]);
  assert.ok(snapping(1, { ...hand, finger: true }) > 4);
  assert.equal(snapping(1, { ...hand, shift: true }), 0);
});

test("a straight piece goes from press to release, and needs two columns", () => {
  const { straight } = makeTools(bench);
  use(straight, at(4, 10), at(9, 9), at(8, 12));
  assert.deepEqual(done, [{ kind: "straight", column: 4, row: 10, to_column: 8, to_row: 12 }]);
  use(straight, at(4, 10), at(4, 30));
  use(straight, at(4, 10));
  assert.equal(done.length, 1);
});

test("columns are hidden in either direction, and shown again with Alt; one column is enough", () => {
  const { hidden } = makeTools(bench);
  use(hidden, at(9, 1), at(4, 1));
  use(hidden, at(4, 1, { alt: true }), at(9, 1));
  use(hidden, at(4, 1), at(4, 2));
  assert.deepEqual(done.map(({ first, last, hidden: off }) => [first, last, off]), [[4, 9, true], [4, 9, false], [4, 4, true]]);
});

test("a stroke that is dropped on the way comes to nothing", () => {
  for (const tool of ["anchor", "forbid", "guide", "side", "straight", "drawn", "hidden"].map((id) => makeTools(bench)[id])) {
    tool.start(at(1, 1));
    tool.move(at(4, 4, { far: true }));
    bench.selection.clear(); // Escape
    tool.move(at(5, 5));
    tool.end(at(5, 5));
  }
  assert.deepEqual(done, []);
});

test("a finger is magnified wherever a tool follows it", () => {
  for (const tool of Object.values(makeTools(bench))) {
    tool.start(at(1, 1, { finger: true }));
    tool.move(at(40, 50, { finger: true }));
    assert.deepEqual(bench.selection.now.finger, [80, 100]);
  }
});

test("other buttons move the photo", () => {
  use(new PanTool(bench), at(1, 1), at(2, 2));
  assert.deepEqual(done, [["pan", 6, 2]]);
});
