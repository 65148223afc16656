/** What somebody points at: cursor, mark, the stroke that is being drawn, a finger, a preview. */

import { Events } from "../basics/events.js";
import { within } from "../basics/geometry.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Document, Part, ShownAlternative } from "../types.js" */

/**
 * @typedef {object} Cursor
 * @property {number} column
 * @property {number | null} row - null while it rests on the line.
 */

/**
 * @typedef {object} Stroke - What is being drawn.
 * @property {"forbid" | "guide" | "side" | "straight" | "drawn" | "hidden"} kind
 * @property {Point[]} points
 * @property {boolean} allow - Whether it takes back what other strokes of its kind did.
 * @property {number} radius - Of the brush, or what the hand is uncertain by.
 * @property {number[]} times - When each point of a guide was reached, in milliseconds.
 */

/**
 * @typedef {object} Selected
 * @property {Cursor | null} cursor
 * @property {{column: number, row: number} | null} mark
 * @property {Stroke | null} stroke
 * @property {number | null} dragged - Column of the anchor that is dragged.
 * @property {Point | null} finger - Where a finger touches, on the screen.
 * @property {Point | null} pointer - Where the mouse is, on the screen.
 * @property {Part | null} preview
 * @property {Point[]} corners - Of a guide that is made point by point.
 * @property {ShownAlternative[]} others - Lines along other ridges, to choose from.
 * @property {number | null} other - Which of them is looked at.
 * @property {Point | null} explained - The pixel that is explained.
 */

/** @type {Readonly<Selected>} */
const NOTHING = Object.freeze({
  cursor: null, mark: null, stroke: null, dragged: null, finger: null, pointer: null, preview: null, corners: [], others: [], other: null,
  explained: null,
});

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
   * @param {{allow?: boolean, radius?: number, time?: number}} [how]
   */
  begin(kind, pixel, { allow = false, radius = 0, time } = {}) {
    this.#set({ stroke: { kind, points: [pixel], allow, radius, times: time === undefined ? [] : [time] } });
  }

  /**
   * Go on with the stroke to another pixel.
   *
   * @param {Point} pixel
   * @param {number} [time]
   */
  extend(pixel, time) {
    const { stroke } = this.#now;
    if (!stroke || String(stroke.points.at(-1)) === String(pixel)) return;
    stroke.points.push(pixel); // strokes are long, so they grow in place
    if (time !== undefined) stroke.times.push(time);
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

  /**
   * Say where the mouse is on the screen.
   *
   * @param {Point | null} at
   */
  point(at) {
    this.#set({ pointer: at });
  }

  /**
   * Make a guide of these corners.
   *
   * @param {Point[]} corners
   */
  corner(corners) {
    this.#set({ corners });
  }

  /**
   * Offer lines along other ridges; none ends that.
   *
   * @param {ShownAlternative[]} others
   */
  offer(others) {
    this.#set({ others, other: null });
  }

  /**
   * Look at one of the lines that are offered, or at all of them again.
   *
   * @param {number | null} other
   */
  lookAt(other) {
    this.#set({ other });
  }

  /**
   * Mark the pixel that is explained.
   *
   * @param {Point | null} pixel
   */
  explain(pixel) {
    this.#set({ explained: pixel });
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
