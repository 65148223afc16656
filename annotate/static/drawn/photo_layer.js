/** Draws the photo: its view, exact tiles when zoomed in, adjustments, and a stage laid over it. */

import { penOf, ratio, withNextFrame } from "../basics/drawing.js";
import { Tiles } from "../server/tiles.js";
import { NEUTRAL, adjusted, reduced } from "./adjusting.js";

/** @import { How } from "./adjusting.js" */
/** @import { Picture } from "../server/tiles.js" */
/** @import { Document } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

/**
 * @typedef {object} Shown
 * @property {number} width
 * @property {number} height
 * @property {ImageBitmap} bitmap - The view of the whole photo, which may be smaller.
 * @property {Picture} soft
 * @property {Picture} adjusted
 * @property {Tiles} tiles
 * @property {number} side - Of a tile, in pixels.
 */

/** The lower canvas of the stage. It draws itself whenever what it shows changes. */
export class PhotoLayer {
  #canvas;
  #view;
  /** @type {Shown | null} */
  #shown = null;
  /** @type {ImageBitmap | null} */
  #overlay = null;
  #opacity = 1;
  /** @type {How} */
  #how = NEUTRAL;
  #draw = withNextFrame(() => this.#paint());

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {View} view
   */
  constructor(canvas, view) {
    this.#canvas = canvas;
    this.#view = view;
    view.on("change", this.#draw);
  }

  /**
   * Show another photo.
   *
   * @param {Document} document
   * @param {ImageBitmap} bitmap
   * @param {number} side - Of the server's tiles.
   */
  show({ id, width, height }, bitmap, side) {
    const soft = reduced(bitmap);
    const whole = adjusted(bitmap, soft, WHOLE, this.#how);
    this.#shown = { width, height, bitmap, soft, adjusted: whole, side, tiles: new Tiles(id, this.#draw) };
    this.#overlay = null;
    this.#draw();
  }

  /**
   * Change contrast, gamma or local contrast.
   *
   * @param {How} how
   */
  adjust(how) {
    this.#how = how;
    if (!this.#shown) return;
    this.#shown.tiles.readjust();
    this.#shown.adjusted = adjusted(this.#shown.bitmap, this.#shown.soft, WHOLE, how);
    this.#draw();
  }

  /**
   * Lay a picture over the photo, or nothing.
   *
   * @param {ImageBitmap | null} bitmap
   * @param {number} opacity
   */
  lay(bitmap, opacity) {
    this.#overlay = bitmap;
    this.#opacity = opacity;
    this.#draw();
  }

  #paint() {
    const pen = penOf(this.#canvas, { alpha: false });
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = getComputedStyle(/** @type {Element} */ (this.#canvas.parentElement)).backgroundColor;
    pen.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (!this.#shown) return;
    const { width, height, bitmap } = this.#shown;
    const scale = ratio() * this.#view.scale;
    pen.setTransform(scale, 0, 0, scale, ratio() * this.#view.left, ratio() * this.#view.top);
    pen.imageSmoothingEnabled = scale < 2;
    pen.imageSmoothingQuality = "high";
    pen.drawImage(this.#shown.adjusted, 0, 0, width, height);
    if (bitmap.width < width && scale > 1.1 * bitmap.width / width) this.#paintTiles(pen, this.#shown);
    if (this.#overlay) {
      pen.globalAlpha = this.#opacity;
      pen.drawImage(this.#overlay, 0, 0, width, height);
      pen.globalAlpha = 1;
    }
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintTiles(pen, { width, height, soft, tiles, side }) {
    const [first, last] = this.#view.columns();
    const [, top] = this.#view.toPixel(0, 0);
    const [, bottom] = this.#view.toPixel(0, this.#canvas.clientHeight);
    for (let down = Math.floor(top / side); down <= bottom / side; down++) {
      for (let across = Math.floor(first / side); across <= last / side; across++) {
        const tile = tiles.at(across, down);
        if (!tile.bitmap) continue;
        const [x, y] = [across * side, down * side];
        const part = { x: x / width, y: y / height, width: tile.bitmap.width / width, height: tile.bitmap.height / height };
        tile.adjusted ??= adjusted(tile.bitmap, soft, part, this.#how);
        pen.drawImage(tile.adjusted, x, y);
      }
    }
  }
}

const WHOLE = { x: 0, y: 0, width: 1, height: 1 };
