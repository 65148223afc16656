/** What is under a finger, three times as large and beside it. */

import { ratio } from "../basics/drawing.js";

/** @import { Point } from "../basics/geometry.js" */

const RADIUS = 64; // screen pixels
const TIMES = 3;

/**
 * Draw the magnifier.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Point} finger - On the screen.
 * @param {HTMLCanvasElement[]} seen - What is under it, from the lowest canvas up.
 * @param {string} rim
 */
export function magnify(pen, [x, y], seen, rim) {
  const beside = x < 2 * RADIUS + 20 ? x + RADIUS + 30 : x - RADIUS - 30;
  const above = Math.max(y - RADIUS - 20, RADIUS + 4);
  const reach = RADIUS / TIMES;
  pen.save();
  pen.beginPath();
  pen.arc(beside, above, RADIUS, 0, 2 * Math.PI);
  pen.clip();
  for (const canvas of seen) {
    pen.drawImage(
      canvas, (x - reach) * ratio(), (y - reach) * ratio(), 2 * reach * ratio(), 2 * reach * ratio(),
      beside - RADIUS, above - RADIUS, 2 * RADIUS, 2 * RADIUS);
  }
  pen.restore();
  pen.strokeStyle = rim;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.arc(beside, above, RADIUS, 0, 2 * Math.PI);
  pen.moveTo(beside - 8, above);
  pen.lineTo(beside + 8, above);
  pen.stroke();
}
