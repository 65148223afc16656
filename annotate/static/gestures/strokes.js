/** Tools that draw a stroke: the brush, the line by hand, and from one end to another. */

import { drawn, thinned, within } from "../basics/geometry.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { Operation, Rough } from "../types.js" */

/**
 * @typedef {object} Contact - A pointer at one moment.
 * @property {Point} at - On the screen.
 * @property {Point} pixel - Of the photo.
 * @property {[number, number]} by - How far it has moved on the screen since the last moment.
 * @property {boolean} moved - Whether it has left the place where it was pressed.
 * @property {boolean} far - Whether it has gone so far that it draws, and does not aim.
 * @property {number} time - In milliseconds.
 * @property {boolean} finger
 * @property {boolean} shift
 * @property {boolean} alt
 */

/**
 * @typedef {object} Tool
 * @property {(contact: Contact) => void} start
 * @property {(contact: Contact) => void} move
 * @property {(contact: Contact) => void} end
 */

/**
 * @typedef {object} Bench - What the tools work with.
 * @property {Selection} selection
 * @property {{scale: number, pan: (x: number, y: number) => void}} view
 * @property {{ask: (column: number, row: number, within?: number, lifted?: number | null) => void, follow: (rough: Rough) => void, clear: () => void}} previewer
 * @property {{readonly radius: number}} brush - In screen pixels.
 * @property {(operation: Operation) => unknown} apply
 * @property {(rough: Rough) => void} guide - Let the line lie along a stroke.
 * @property {(pixel: Point) => void} corner - Go on with a guide that is made corner by corner.
 * @property {(pixel: Point) => void} explain - Tell what the detector thought of a pixel.
 * @property {(column: number, row: number, within: number) => void} anchor - Set an anchor, on the best edge so many rows away at most.
 * @property {(column: number) => void} goTo - Put the cursor into a column.
 */

const SNAP = { mouse: 4, finger: 8 }; // screen pixels within which a click means an edge
const WIDEST = 1000; // radius in pixels of the photo, as the server takes it

/**
 * How many rows a click may be off the edge that it means; none with Shift, which means just this pixel.
 *
 * @param {number} scale
 * @param {{finger: boolean, shift: boolean}} contact
 */
export function snapping(scale, { finger, shift }) {
  return shift ? 0 : within(Math.round((finger ? SNAP.finger : SNAP.mouse) / scale), 1, WIDEST);
}

/**
 * Radius of the brush in pixels of the photo, which looks the same at every zoom.
 *
 * @param {number} radius - On the screen.
 * @param {number} scale
 * @param {number} [least]
 */
export function brushRadius(radius, scale, least = 1) {
  return within(Math.round(radius / scale), least, WIDEST);
}

/** Keeps the line out of what is painted; with Alt, allows it there again. @implements {Tool} */
export class BrushTool {
  #bench;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#bench.selection.begin("forbid", contact.pixel, { allow: contact.alt, radius: brushRadius(this.#bench.brush.radius, this.#bench.view.scale) });
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    this.#bench.selection.extend(contact.pixel);
    touch(this.#bench, contact);
  }

  end() {
    const { stroke } = this.#bench.selection.now;
    if (!stroke) return;
    const { points, radius, allow } = stroke;
    this.#bench.apply({ kind: "forbid", points: thinned(points), radius, allow });
  }
}

/** Says that all above a stroke is sky; with Alt, that all below it is terrain. @implements {Tool} */
export class SideTool {
  #bench;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#bench.selection.begin("side", contact.pixel, { allow: contact.alt });
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    this.#bench.selection.extend(contact.pixel);
    touch(this.#bench, contact);
  }

  end() {
    const { points = [], allow = false } = this.#bench.selection.now.stroke ?? {};
    if (points.length > 1) this.#bench.apply({ kind: "side", points: thinned(points), ground: allow ? "terrain" : "sky" });
  }
}

/** Draws the line by hand. @implements {Tool} */
export class DrawTool {
  #bench;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#bench.selection.begin("drawn", contact.pixel);
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    this.#bench.selection.extend(contact.pixel);
    touch(this.#bench, contact);
  }

  end() {
    const points = this.#bench.selection.now.stroke?.points ?? [];
    if (points.length > 1) this.#bench.apply({ kind: "drawn", ...drawn(points) });
  }
}

/** Drags from one pixel to another: a straight piece of the line, or columns in which it is hidden. @implements {Tool} */
export class SpanTool {
  #bench;
  #kind;

  /**
   * @param {Bench} bench
   * @param {"straight" | "hidden"} kind
   */
  constructor(bench, kind) {
    this.#bench = bench;
    this.#kind = kind;
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#bench.selection.begin(this.#kind, contact.pixel, { allow: contact.alt });
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    this.#bench.selection.stretch(contact.pixel);
    touch(this.#bench, contact);
  }

  end() {
    const { points = [], allow = false } = this.#bench.selection.now.stroke ?? {};
    if (points.length < 2) return;
    const [[column, row], [to, low]] = points;
    if (this.#kind === "hidden") {
      this.#bench.apply({ kind: "hidden", first: Math.min(column, to), last: Math.max(column, to), hidden: !allow });
    } else if (column !== to) {
      this.#bench.apply({ kind: "straight", column, row, to_column: to, to_row: low });
    }
  }
}

/**
 * Magnify what a finger covers.
 *
 * @param {Bench} bench
 * @param {Contact} contact
 */
export function touch({ selection }, { finger, at }) {
  if (finger) selection.touch(at);
}
