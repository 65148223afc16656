/** What everything that is drawn has in common: pens, pixels of the screen, colours, frames. */

/** @import { Colours } from "../types.js" */

/** Physical pixels a CSS pixel. */
export const ratio = () => devicePixelRatio || 1;

/** Radius of an anchor, in CSS pixels. */
export const ANCHOR = 6;

/** Colours in which the brush forbids, and its eraser allows, while they paint. */
export const BRUSHES = { forbid: "rgb(0 0 0 / 55%)", allow: "rgb(255 255 255 / 35%)" };

/** Colours of the lines along other ridges, which are told apart by most eyes, and none is that of the line. */
export const OTHERS = ["#f0e442", "#5cc8ff", "#ff9f1c", "#52d683"];

/**
 * What draws on a canvas.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2DSettings} [how]
 */
export function penOf(canvas, how) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", how));
}

/**
 * What draws on a canvas that is not on the page.
 *
 * @param {OffscreenCanvas} canvas
 * @param {CanvasRenderingContext2DSettings} [how]
 */
export function hiddenPenOf(canvas, how) {
  return /** @type {OffscreenCanvasRenderingContext2D} */ (canvas.getContext("2d", how));
}

/**
 * Give a canvas as many pixels as it has on the screen.
 *
 * @param {HTMLCanvasElement} canvas
 */
export function fit(canvas) {
  const [width, height] = [Math.round(canvas.clientWidth * ratio()), Math.round(canvas.clientHeight * ratio())];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
}

/**
 * A function that paints with the next frame, once, however often it is called until then.
 *
 * @param {() => void} paint
 */
export function withNextFrame(paint) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      paint();
    });
  };
}

/**
 * The halo, through which the photo is still seen.
 *
 * @param {Colours} colours
 */
export function softHalo({ halo }) {
  return `${halo}b3`; // 70 %
}

/**
 * Go from point to point.
 *
 * @param {Pick<CanvasPath, "moveTo" | "lineTo">} path
 * @param {[number, number][]} points
 */
export function follow(path, points) {
  points.forEach(([x, y], at) => (at ? path.lineTo(x, y) : path.moveTo(x, y)));
}

/**
 * A disc with a rim, in CSS pixels.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number]} at
 * @param {number} radius
 * @param {{fill: string, rim: string, width: number}} how
 */
export function disc(pen, [x, y], radius, { fill, rim, width }) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  Object.assign(pen, { fillStyle: fill, strokeStyle: rim, lineWidth: width });
  pen.fill();
  pen.stroke();
}
