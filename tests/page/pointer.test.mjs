/** Mouse, pen and fingers: which tool gets what, zoom and pan. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Asked, Labelled, photo } from "./stubs.mjs";
import { Pointer } from "../../annotate/static/gestures/pointer.js";
import { Selection } from "../../annotate/static/labelled/selection.js";
import { View } from "../../annotate/static/labelled/view.js";

/** A canvas at the corner of the window. */
class Canvas extends EventTarget {
  focus() {}

  setPointerCapture() {}

  getBoundingClientRect() {
    return { left: 0, top: 0 };
  }
}

let canvas;
let view;
let labelling;
let previewer;
let pointer;
let done;

beforeEach(() => {
  canvas = new Canvas();
  view = new View();
  view.resize(400, 240);
  view.show(400, 240); // a screen pixel a pixel
  labelling = new Labelled(photo({ anchors: [[50, 100]] }));
  previewer = new Asked();
  done = [];
  pointer = new Pointer({
    canvas, view, labelling, previewer, selection: new Selection(),
    brush: { radius: 12 },
    line: {
      did: (operation) => labelling.apply(operation), anchor: (...how) => done.push(["anchor", ...how]), goTo: (column) => done.push(["goTo", column]),
      guide: (rough) => done.push(["guide", rough]), corner: (pixel) => done.push(["corner", pixel]), explain: (pixel) => done.push(["explain", pixel]),
      showGuide: (pixel) => done.push(["show", pixel]),
    },
  });
});

function tell(name, x, y, how = {}) {
  const event = new Event(name, { cancelable: true });
  const said = { pointerId: 1, pointerType: "mouse", button: 0, clientX: x, clientY: y, offsetX: x, offsetY: y, shiftKey: false, altKey: false };
  canvas.dispatchEvent(Object.assign(event, said, how));
  return event;
}

const finger = (id) => ({ pointerType: "touch", pointerId: id });

/** Press at the first place, move through the others, and let go at the last. */
function drag(places, how = {}) {
  tell("pointerdown", ...places[0], how);
  for (const place of places.slice(1)) tell("pointermove", ...place, how);
  tell("pointerup", ...places.at(-1), how);
}

test("a click, also of a hand that trembles, is one", () => {
  drag([[100, 60], [102, 62]]);
  assert.deepEqual(done, [["anchor", 102, 62, 4]]);
});

test("with the mouse over the photo, the line through its pixel is shown; over an anchor it is not", () => {
  tell("pointermove", 100, 60);
  assert.deepEqual(previewer.asked, [[100, 60, 4]]);
  tell("pointermove", 51, 101);
  assert.equal(previewer.cleared, 1);
  labelling.waiting = 1; // the line is another one soon
  tell("pointermove", 120, 60);
  assert.equal(previewer.asked.length, 1);
  tell("pointerleave", 0, 0);
  assert.equal(previewer.cleared, 2);
});

test("a press that goes on is a stroke along a ridge, from where it began; with Alt it moves the photo", () => {
  drag([[100, 60], [106, 60], [140, 70], [180, 75]]);
  const [[name, { points, radius }]] = done;
  assert.deepEqual([name, points, radius], ["guide", [[100, 60], [140, 70], [180, 75]], 6]);
  assert.equal(previewer.followed.length, 2);
  view.zoom(4);
  const { left } = view;
  drag([[200, 100], [210, 100], [215, 100]], { altKey: true });
  assert.equal(view.left, left + 15);
  assert.equal(done.length, 1);
});

test("a finger aims within a fingertip, and draws beyond it", () => {
  drag([[100, 60], [130, 80]], finger(1));
  assert.deepEqual(done.shift(), ["anchor", 130, 80, 8]);
  drag([[100, 60], [130, 80], [170, 80]], finger(1));
  assert.deepEqual(done.map(([name]) => name), ["guide"]);
});

test("corners of a guide are clicked, and shown on the way to the next", () => {
  pointer.use("guide");
  drag([[100, 60]]);
  assert.deepEqual(done, [["corner", [100, 60]]]);
  drag([[100, 60], [150, 60]]); // a drag is a whole one
  assert.equal(done.at(-1)[0], "guide");
});

test("a stroke that is broken off is not shown any more", () => {
  tell("pointerdown", 100, 60);
  tell("pointermove", 150, 60);
  const { cleared } = previewer;
  tell("pointercancel", 150, 60);
  assert.ok(previewer.cleared > cleared);
  assert.deepEqual(done, []);
});

test("an anchor is hit within ten pixels by the mouse and 24 by a finger", () => {
  drag([[59, 100], [80, 110]]);
  drag([[73, 100], [80, 110]], finger(1));
  drag([[73, 100]]);
  assert.deepEqual(labelling.applied, [4, 8].map((within) => ({ kind: "move", from_column: 50, column: 80, row: 110, within })));
  assert.deepEqual(done, [["anchor", 73, 100, 4]]);
});

test("a click on an anchor's mark goes there, and one beside it sets another anchor", () => {
  drag([[53, 102]]);
  drag([[57, 100]]);
  drag([[62, 100]], finger(1));
  assert.deepEqual(done, [["goTo", 50], ["anchor", 57, 100, 4], ["goTo", 50]]);
});

test("a right click removes an anchor, and moves the photo elsewhere", () => {
  drag([[52, 100]], { button: 2 });
  assert.deepEqual(labelling.applied, [{ kind: "remove", column: 50 }]);
  view.zoom(4);
  const { left } = view;
  drag([[200, 100], [210, 100], [215, 100]], { button: 2 });
  assert.equal(view.left, left + 15);
  assert.deepEqual([labelling.applied.length, done], [1, []]);
});

test("the chosen tool follows, whatever it is over", () => {
  pointer.use("hidden");
  drag([[50, 100], [80, 100]]);
  assert.deepEqual(labelling.applied, [{ kind: "hidden", first: 50, last: 80, hidden: true }]);
});

test("two fingers zoom and move, and do nothing else", () => {
  pointer.use("forbid");
  tell("pointerdown", 180, 120, finger(1));
  tell("pointerdown", 220, 120, finger(2));
  tell("pointermove", 160, 120, finger(1));
  tell("pointermove", 240, 120, finger(2));
  assert.equal(view.scale, 2);
  tell("pointerup", 160, 120, finger(1));
  tell("pointermove", 20, 20, finger(2)); // the one that is left does nothing
  tell("pointerup", 20, 20, finger(2));
  assert.equal(view.scale, 2);
  assert.deepEqual(labelling.applied, []);
  drag([[100, 60]], finger(1)); // and the next one is a press again
  assert.equal(labelling.applied.length, 1);
});

test("of three fingers, those that are left go on from where they are", () => {
  tell("pointerdown", 100, 120, finger(1));
  tell("pointerdown", 140, 120, finger(2));
  tell("pointerdown", 300, 120, finger(3));
  tell("pointerup", 100, 120, finger(1));
  const { scale, left } = view;
  tell("pointermove", 140, 120, finger(2)); // nothing has moved
  assert.deepEqual([view.scale, view.left], [scale, left]);
});

test("a press that is broken off comes to nothing", () => {
  pointer.use("drawn");
  tell("pointerdown", 100, 60);
  tell("pointermove", 150, 60);
  tell("pointercancel", 150, 60);
  tell("pointerup", 160, 60);
  assert.deepEqual([labelling.applied, done], [[], []]);
});

test("the wheel zooms around the pointer, and the page stays where it is", () => {
  const event = tell("wheel", 100, 60, { deltaY: -100, deltaMode: 0 });
  assert.ok(event.defaultPrevented && view.scale > 1);
  assert.deepEqual(view.toPixel(100, 60), [100, 60]);
});

test("without a photo nothing happens", () => {
  labelling.document = null;
  drag([[100, 60], [120, 60]]);
  assert.deepEqual([labelling.applied, done, previewer.asked], [[], [], []]);
});

test("a press comes to nothing on the next photo", () => {
  tell("pointerdown", 100, 60);
  labelling.show(photo({ id: 2 }), true);
  tell("pointermove", 103, 60);
  tell("pointerup", 103, 60);
  assert.deepEqual([done, previewer.asked], [[], []]);
  drag([[100, 60]]); // and the next one is a press again
  assert.deepEqual(done, [["anchor", 100, 60, 4]]);
});

test("a press that is dropped comes to nothing, before it draws and while it moves an anchor", () => {
  for (const places of [[[100, 60], [105, 60]], [[50, 100], [80, 110]]]) {
    tell("pointerdown", ...places[0]);
    tell("pointermove", ...places[1]);
    pointer.drop();
    tell("pointermove", 150, 110);
    tell("pointerup", 150, 110);
  }
  assert.deepEqual([done, labelling.applied], [[], []]);
});

test("beside the photo a press does nothing and shows nothing; a few pixels beside its edge mean the edge", () => {
  view.resize(600, 240); // 100 screen pixels on either side
  for (const tool of ["anchor", "guide", "forbid", "straight", "explain"]) {
    pointer.use(tool);
    drag([[40, 60], [60, 70], [300, 80]]);
  }
  pointer.use("anchor");
  tell("pointermove", 560, 60);
  assert.deepEqual([done, labelling.applied, previewer.asked], [[], [], []]);
  drag([[96, 60]]);
  assert.deepEqual(done, [["anchor", 0, 60, 4]]);
});
