/** Contrast, gamma and local contrast of a picture. */

import { hiddenPenOf } from "../basics/drawing.js";

/** @import { Picture } from "../server/tiles.js" */
/** @typedef {{contrast: number, gamma: number, local: number}} How */
/** @typedef {{x: number, y: number, width: number, height: number}} Part - Of the photo, from 0 to 1. */

/** What changes nothing. */
export const NEUTRAL = { contrast: 1, gamma: 1, local: 0 };

const AROUND = 48; // pixels across the small copy that tells what surrounds each pixel

/**
 * What each level of a channel becomes by contrast and gamma.
 *
 * @param {Pick<How, "contrast" | "gamma">} how
 */
export function curve({ contrast, gamma }) {
  return Uint8ClampedArray.from({ length: 256 }, (_, level) =>
    255 * Math.pow(Math.min(Math.max((level / 255 - 0.5) * contrast + 0.5, 0), 1), 1 / gamma));
}

/**
 * A part of a photo with the adjustments applied.
 *
 * @param {Picture} bitmap
 * @param {Picture} soft - A small copy of the whole photo.
 * @param {Part} part
 * @param {How} how
 * @returns {Picture}
 */
export function adjusted(bitmap, soft, part, how) {
  if (how.contrast === 1 && how.gamma === 1 && how.local === 0) return bitmap;
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const pen = hiddenPenOf(canvas, { willReadFrequently: true });
  const pixels = () => pen.getImageData(0, 0, canvas.width, canvas.height);
  let around = null;
  if (how.local > 0) {
    const [left, top, across, down] = [part.x * soft.width, part.y * soft.height, part.width * soft.width, part.height * soft.height];
    pen.imageSmoothingQuality = "high";
    pen.drawImage(soft, left, top, across, down, 0, 0, canvas.width, canvas.height);
    around = pixels().data;
  }
  pen.drawImage(bitmap, 0, 0);
  const image = pixels();
  change(image.data, around, how);
  pen.putImageData(image, 0, 0);
  return canvas;
}

/**
 * Change pixels in place: red, green and blue, not what is opaque.
 *
 * @param {Uint8ClampedArray<ArrayBuffer>} data
 * @param {Uint8ClampedArray<ArrayBuffer> | null} around - What surrounds them, where it matters.
 * @param {How} how
 */
export function change(data, around, how) {
  const levels = curve(how);
  for (let at = 0; at < data.length; at++) {
    if (at % 4 === 3) continue;
    const level = around ? data[at] + how.local * (data[at] - around[at]) : data[at];
    data[at] = levels[level < 0 ? 0 : level > 255 ? 255 : level | 0];
  }
}

/**
 * A small copy of a picture: what surrounds each of its pixels.
 *
 * @param {Picture} bitmap
 */
export function reduced(bitmap) {
  const canvas = new OffscreenCanvas(AROUND, Math.max(Math.round(AROUND * bitmap.height / bitmap.width), 2));
  const pen = hiddenPenOf(canvas);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  return canvas;
}
