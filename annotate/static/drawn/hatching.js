/** What the brush forbids, hatched so that the photo is seen through it. */

import { follow, hiddenPenOf } from "../basics/drawing.js";
import { brushed } from "../basics/geometry.js";

/** @import { Document } from "../types.js" */

const LONGEST = 1600; // pixels of the picture
const CELL = 8; // pixels between two lines

/**
 * A picture of what is forbidden, to be laid over the photo; null where the brush has not been used.
 *
 * @param {Document} document
 */
export function hatched({ width, height, forbidden, sides }) {
  if (!forbidden.length && !sides.length) return null;
  const scale = Math.min(1, LONGEST / width);
  const canvas = new OffscreenCanvas(Math.ceil(width * scale), Math.ceil(height * scale));
  const pen = hiddenPenOf(canvas);
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.lineCap = pen.lineJoin = "round";
  for (const { points, radius, allow } of forbidden) {
    pen.globalCompositeOperation = allow ? "destination-out" : "source-over";
    pen.lineWidth = 2 * radius + 1;
    pen.beginPath();
    follow(pen, brushed(points));
    pen.stroke();
  }
  pen.globalCompositeOperation = "source-over";
  for (const { first, rows, ground } of sides) {
    const far = ground === "sky" ? 0 : height;
    const near = ground === "sky" ? 0 : 1; // the line may lie in the row of the stroke itself
    pen.beginPath();
    follow(pen, [[first, far], ...rows.map((row, at) => /** @type {[number, number]} */ ([first + at + 0.5, row + near])), [first + rows.length, far]]);
    pen.fill();
  }
  pen.globalCompositeOperation = "source-in";
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.fillStyle = pattern(pen);
  pen.fillRect(0, 0, canvas.width, canvas.height);
  return canvas;
}

/** @param {OffscreenCanvasRenderingContext2D} pen */
function pattern(pen) {
  const cell = new OffscreenCanvas(CELL, CELL);
  const line = hiddenPenOf(cell);
  line.fillStyle = "rgb(0 0 0 / 40%)";
  line.fillRect(0, 0, CELL, CELL);
  line.strokeStyle = "rgb(255 255 255 / 75%)";
  line.lineWidth = 1.5;
  line.beginPath();
  for (const shift of [-CELL, 0, CELL]) {
    line.moveTo(shift, CELL);
    line.lineTo(shift + CELL, 0);
  }
  line.stroke();
  return /** @type {CanvasPattern} */ (pen.createPattern(cell, "repeat"));
}
