/** What somebody points at: cursor, mark, the stroke that is being drawn, a finger, a preview. */

import { Events } from "../basics/events.js";
import { within } from "../basics/geometry.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Document, Part } from "../types.js" */

/**
 * @typedef {object} Cursor
 * @property {number} column
 * @property {number | null} row - null while it rests on the line.
 */

/**
 * @typedef {object} Stroke - What is being drawn.
 * @property {"forbid" | "straight" | "drawn" | "hidden"} kind
 * @property {Point[]} points
 * @property {boolean} allow - Whether it takes back what other strokes of its kind did.
 * @property {number} radius - Of the brush.
 */

/**
 * @typedef {object} Selected
 * @property {Cursor | null} cursor
 * @property {{column: number, row: number} | null} mark
 * @property {Stroke | null} stroke
 * @property {number | null} dragged - Column of the anchor that is dragged.
 * @property {Point | null} finger - Where a finger touches, on the screen.
 * @property {Part | null} preview
 */

/** @type {Readonly<Selected>} */
const NOTHING = Object.freeze({ cursor: null, mark: null, stroke: null, dragged: null, finger: null, preview: null });

/**
 * One place for what is selected; nothing of it is known to the server. Event: `change`.
 *
 * @extends {Events<{change: undefined}>}
 */
export class Selection extends Events {
  #now = NOTHING;

  /** What is selected. */
  get now() {
    return this.#now;
  }

  /**
   * The pixel of the cursor: on the line while it rests there, and in the middle while there is none.
   *
   * @param {Document} shown
   * @returns {Point}
   */
  place({ width, height, rows }) {
    const { cursor } = this.#now;
    const column = cursor?.column ?? Math.floor(width / 2);
    return [column, cursor?.row ?? rows?.[column] ?? Math.floor(height / 2)];
  }

  /**
   * Columns from the mark to the cursor, or that of the cursor alone.
   *
   * @param {Document} shown
   */
  columns(shown) {
    const [column] = this.place(shown);
    const mark = this.#now.mark?.column ?? column;
    return { first: Math.min(mark, column), last: Math.max(mark, column) };
  }

  /**
   * Put the cursor on a pixel of the photo, or let it rest on the line.
   *
   * @param {Document} shown
   * @param {number} column
   * @param {number | null} [row]
   */
  moveTo({ width, height }, column, row = null) {
    this.#set({ cursor: { column: within(column, 0, width - 1), row: row === null ? null : within(row, 0, height - 1) } });
  }

  /** Let the cursor rest on the line, where there is one; the mark goes. */
  rest() {
    this.#set({ mark: null, cursor: this.#resting() });
  }

  /**
   * Put the mark where the cursor is.
   *
   * @param {Document} shown
   */
  mark(shown) {
    const [column, row] = this.place(shown);
    this.#set({ mark: { column, row }, cursor: this.#now.cursor ?? { column, row: null } });
  }

  /**
   * Begin a stroke.
   *
   * @param {Stroke["kind"]} kind
   * @param {Point} pixel
   * @param {{allow?: boolean, radius?: number}} [how]
   */
  begin(kind, pixel, { allow = false, radius = 0 } = {}) {
    this.#set({ stroke: { kind, points: [pixel], allow, radius } });
  }

  /**
   * Go on with the stroke to another pixel.
   *
   * @param {Point} pixel
   */
  extend(pixel) {
    const { stroke } = this.#now;
    if (!stroke || String(stroke.points.at(-1)) === String(pixel)) return;
    stroke.points.push(pixel); // strokes are long, so they grow in place
    this.#set({});
  }

  /**
   * Let the stroke end at another pixel than before.
   *
   * @param {Point} pixel
   */
  stretch(pixel) {
    const { stroke } = this.#now;
    if (stroke) this.#set({ stroke: { ...stroke, points: [stroke.points[0], pixel] } });
  }

  /**
   * Point at a pixel, which may be where an anchor is dragged to.
   *
   * @param {Point} pixel
   * @param {number | null} [dragged]
   */
  aim([column, row], dragged = null) {
    this.#set({ cursor: { column, row }, dragged });
  }

  /**
   * Say where a finger touches the screen.
   *
   * @param {Point} at
   */
  touch(at) {
    this.#set({ finger: at });
  }

  /**
   * Show another line.
   *
   * @param {Part | null} part
   */
  preview(part) {
    if (part !== this.#now.preview) this.#set({ preview: part });
  }

  /** Forget what is being drawn or dragged. */
  letGo() {
    this.#set({ stroke: null, finger: null, dragged: null, cursor: this.#resting() });
  }

  /** Select nothing. */
  clear() {
    this.#set(NOTHING);
  }

  #resting() {
    const { cursor } = this.#now;
    return cursor && { ...cursor, row: null };
  }

  /** @param {Partial<Selected>} changes */
  #set(changes) {
    this.#now = Object.freeze({ ...this.#now, ...changes });
    this.tell("change");
  }
}
