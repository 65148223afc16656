/** Zoom and pan. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { chance } from "./model.mjs";
import { View } from "../../annotate/static/labelled/view.js";

/** A view of 800 by 400 screen pixels on a photo. */
function opened(width = 1600, height = 400) {
  const view = new View();
  view.resize(800, 400);
  view.show(width, height);
  return view;
}

const near = (found, wanted) => found.forEach((one, at) => assert.ok(Math.abs(one - wanted[at]) < 1e-6, `${found} is not ${wanted}`));

test("a photo is shown whole, in the middle", () => {
  const view = opened();
  assert.equal(view.scale, 0.5);
  assert.deepEqual([view.left, view.top], [0, 100]);
  assert.deepEqual(view.columns(), [0, 1599]);
});

test("what is under the pointer stays there when zooming", () => {
  const view = opened();
  const before = [(300 - view.left) / view.scale, (180 - view.top) / view.scale];
  view.zoom(8, 300, 180);
  near([(300 - view.left) / view.scale, (180 - view.top) / view.scale], before);
});

test("zooming ends where the whole photo is seen, and at 32 screen pixels a pixel", () => {
  const view = opened();
  view.zoom(1e9);
  assert.equal(view.scale, 32);
  view.zoom(1e-9);
  assert.equal(view.scale, 0.5);
  assert.deepEqual([view.left, view.top], [0, 100]);
});

test("a photo that was shown whole is so in a window of another size, and one that was not stays", () => {
  const view = opened();
  view.resize(400, 400);
  assert.equal(view.scale, 0.25);
  view.zoom(4);
  view.resize(800, 400);
  assert.equal(view.scale, 1);
  view.zoom(0.01); // all of it is seen again
  view.resize(400, 400);
  assert.equal(view.scale, 0.25);
});

test("wherever the view is, part of the photo is seen, and pixels come back from the screen", () => {
  const random = chance(3);
  const view = opened();
  for (let step = 0; step < 300; step++) {
    if (random.next() < 0.5) view.zoom(0.3 + 3 * random.next(), random.below(800), random.below(400));
    else view.pan(random.below(4000) - 2000, random.below(4000) - 2000);
    const [left, top] = view.toScreen(0, 0);
    const [right, bottom] = view.toScreen(1600, 400);
    assert.ok(left <= 400 && right >= 400 && top <= 200 && bottom >= 200, "the middle of the window shows the photo");
    const pixel = [random.below(1600), random.below(400)];
    assert.deepEqual(view.toPixel(...view.toScreen(pixel[0] + 0.5, pixel[1])), pixel);
  }
});

test("a pixel is never outside the photo", () => {
  const view = opened();
  assert.deepEqual(view.toPixel(-50, -50), [0, 0]);
  assert.deepEqual(view.toPixel(5000, 5000), [1599, 399]);
});

test("a pixel that is out of sight is brought into the middle, and one in sight stays where it is", () => {
  const view = opened();
  view.zoom(8);
  view.reveal(10, 200);
  const seen = view.toScreen(10, 200);
  view.reveal(12, 200);
  assert.deepEqual(view.toScreen(10, 200), seen);
  view.reveal(1500, 200);
  near(view.toScreen(1500, 200).slice(0, 1), [400]);
});

test("every change is told", () => {
  const view = opened();
  let told = 0;
  view.on("change", () => told++);
  view.zoom(2);
  view.pan(1, 1);
  view.reveal(0, 0);
  view.fit();
  view.resize(700, 300);
  assert.equal(told, 5);
});

test("how far a point is beside the photo", () => {
  const view = new View();
  view.resize(600, 240);
  view.show(400, 240);
  assert.deepEqual([[100, 0], [300, 240], [97, 100], [503, 244]].map((at) => view.beside(...at)), [0, 0, 3, 5]);
});
