/** Contrast, gamma and local contrast. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { NEUTRAL, change, curve } from "../../annotate/static/drawn/adjusting.js";

const levels = Array.from({ length: 256 }, (_, level) => level);

test("the neutral curve changes no level", () => {
  assert.deepEqual([...curve(NEUTRAL)], levels);
});

test("contrast turns around the middle, and gamma keeps black and white", () => {
  const hard = curve({ contrast: 3, gamma: 1 });
  assert.deepEqual([hard[0], hard[60], hard[200], hard[255]], [0, 0, 255, 255]);
  assert.ok(Math.abs(hard[127] - 127) <= 2);
  const bright = curve({ contrast: 1, gamma: 2 });
  assert.deepEqual([bright[0], bright[255]], [0, 255]);
  assert.ok(bright[64] > 120);
});

test("curves never fall", () => {
  for (const contrast of [0.5, 1, 3]) {
    for (const gamma of [0.3, 1, 3]) {
      const one = curve({ contrast, gamma });
      assert.ok(levels.slice(1).every((level) => one[level] >= one[level - 1]));
    }
  }
});

test("local contrast moves a pixel away from what surrounds it, and leaves alone how opaque it is", () => {
  const data = Uint8ClampedArray.of(100, 100, 200, 77);
  change(data, Uint8ClampedArray.of(90, 110, 20, 0), { contrast: 1, gamma: 1, local: 2 });
  assert.deepEqual([...data], [120, 80, 255, 77]);
});
