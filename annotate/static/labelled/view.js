/** Which part of the photo is seen: zoom and pan. Screen pixels are CSS pixels. */

import { Events } from "../basics/events.js";
import { within } from "../basics/geometry.js";

/** @import { Point } from "../basics/geometry.js" */

const LARGEST = 32; // screen pixels a pixel
const CLOSE = 2; // screen pixels a pixel in which a place is looked at
const AROUND = 4; // times as wide as what is looked at

/**
 * Maps pixels of the photo to the screen and back. Event: `change`.
 *
 * @extends {Events<{change: undefined}>}
 */
export class View extends Events {
  scale = 1;
  left = 0;
  top = 0;
  #size = { width: 1, height: 1 };
  #photo = { width: 1, height: 1 };
  #fitted = true;

  /**
   * The photo changes: show all of it.
   *
   * @param {number} width
   * @param {number} height
   */
  show(width, height) {
    this.#photo = { width, height };
    this.fit();
  }

  /**
   * The window changes.
   *
   * @param {number} width
   * @param {number} height
   */
  resize(width, height) {
    this.#size = { width, height };
    if (this.#fitted) this.fit();
    else this.#settle();
  }

  /** Show the whole photo. */
  fit() {
    const { width, height } = this.#size;
    this.scale = this.#smallest();
    this.left = (width - this.#photo.width * this.scale) / 2;
    this.top = (height - this.#photo.height * this.scale) / 2;
    this.#fitted = true;
    this.tell("change");
  }

  /**
   * Zoom by a factor around a point of the screen.
   *
   * @param {number} factor
   * @param {number} [x]
   * @param {number} [y]
   */
  zoom(factor, x = this.#size.width / 2, y = this.#size.height / 2) {
    const scale = within(this.scale * factor, this.#smallest(), LARGEST);
    const by = scale / this.scale;
    this.left = x - (x - this.left) * by;
    this.top = y - (y - this.top) * by;
    this.scale = scale;
    this.#fitted = scale === this.#smallest();
    this.#settle();
  }

  /**
   * Move by screen pixels.
   *
   * @param {number} x
   * @param {number} y
   */
  pan(x, y) {
    this.left += x;
    this.top += y;
    this.#settle();
  }

  /**
   * Bring a pixel into sight, in the middle unless it is seen already.
   *
   * @param {number} column
   * @param {number} row
   */
  reveal(column, row) {
    const [x, y] = this.toScreen(column, row);
    const { width, height } = this.#size;
    if (x < 40 || x > width - 40) this.left += width / 2 - x;
    if (y < 40 || y > height - 40) this.top += height / 2 - y;
    this.#settle();
  }

  /**
   * Show some columns with what is around them, exact where they are few.
   *
   * @param {number} first
   * @param {number} last
   * @param {number} row - In the middle.
   */
  look(first, last, row) {
    const { width, height } = this.#size;
    const wanted = width / (AROUND * (last - first + 1));
    this.scale = within(wanted, this.#smallest(), Math.max(CLOSE, this.#smallest()));
    this.left = width / 2 - (first + last + 1) / 2 * this.scale;
    this.top = height / 2 - row * this.scale;
    this.#fitted = this.scale === this.#smallest();
    this.#settle();
  }

  /**
   * Screen position of a point of the photo.
   *
   * @param {number} x
   * @param {number} y
   * @returns {Point}
   */
  toScreen(x, y) {
    return [x * this.scale + this.left, y * this.scale + this.top];
  }

  /**
   * Column and row of the pixel under a point of the screen, within the photo.
   *
   * @param {number} x
   * @param {number} y
   * @returns {Point}
   */
  toPixel(x, y) {
    return [
      within(Math.floor((x - this.left) / this.scale), 0, this.#photo.width - 1),
      within(Math.floor((y - this.top) / this.scale + 0.5), 0, this.#photo.height - 1), // the line lies on top of a pixel
    ];
  }

  /**
   * How many screen pixels a point lies beside the photo; 0 on it.
   *
   * @param {number} x
   * @param {number} y
   */
  beside(x, y) {
    const [right, bottom] = this.toScreen(this.#photo.width, this.#photo.height);
    return Math.hypot(x - within(x, this.left, right), y - within(y, this.top, bottom));
  }

  /**
   * First and last column in sight.
   *
   * @returns {Point}
   */
  columns() {
    return [this.toPixel(0, 0)[0], this.toPixel(this.#size.width, 0)[0]];
  }

  #smallest() {
    const { width, height } = this.#size;
    return Math.min(width / this.#photo.width, height / this.#photo.height, LARGEST);
  }

  #settle() {
    this.left = settled(this.left, this.#photo.width * this.scale, this.#size.width);
    this.top = settled(this.top, this.#photo.height * this.scale, this.#size.height);
    this.tell("change");
  }
}

/**
 * Where the photo begins: in the middle where it is smaller than the window, else never too far out of it.
 *
 * @param {number} start
 * @param {number} length - Of the photo, on the screen.
 * @param {number} size - Of the window.
 */
function settled(start, length, size) {
  return length <= size ? (size - length) / 2 : within(start, size - length - size / 2, size / 2);
}
