/** What waits for the server, as it can be drawn before the line is known that follows from it. */

import { ANCHOR, BRUSHES, follow, softHalo } from "../basics/drawing.js";
import { brushed } from "../basics/geometry.js";
import { notVisible } from "../basics/hidden.js";
import { isChange } from "../basics/operations.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Of } from "../basics/operations.js" */
/** @import { Item } from "../server/queue.js" */
/** @import { Colours, Operation } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

/** @typedef {Pick<Of<"forbid">, "points" | "radius" | "allow">} Stroke */
/** @typedef {{first: number, last: number, words: string}} Band */

/**
 * What to draw for operations that wait.
 *
 * @typedef {object} Sketch
 * @property {Map<number, Point>} discs - Anchors to come, by their columns.
 * @property {Set<number>} crosses - Columns whose anchor goes.
 * @property {Point[][]} paths
 * @property {Band[]} bands - Columns with words about them.
 * @property {Stroke[]} strokes - Of the brush.
 */

/** @type {{[Kind in Operation["kind"]]?: (how: Of<Kind>, found: Sketch) => void}} */
const SKETCHES = {
  anchor: ({ column, row }, found) => set(found, [column, row]),
  remove: ({ column }, found) => remove(found, column),
  move(how, found) {
    remove(found, how.from_column);
    set(found, [how.column, how.row]);
  },
  straight: (how, found) => found.paths.push([[how.column, how.row], [how.to_column, how.to_row]]),
  guide: ({ points }, found) => found.paths.push(points),
  side: ({ points }, found) => found.paths.push(points),
  drawn: ({ first, rows }, found) => found.paths.push(rows.map((row, at) => [first + at, row])),
  hidden: ({ first, last, hidden, why }, found) => found.bands.push({ first, last, words: hidden ? notVisible(why) : "visible" }),
  release: ({ first, last }, found) => found.bands.push({ first, last, words: "dropped" }),
  forbid: ({ points, radius, allow }, found) => found.strokes.push({ points, radius, allow }),
};

/**
 * What to draw for what waits. What a waiting undo takes back is left out.
 *
 * @param {Pick<Item, "what" | "operation">[]} items - For one photo, oldest first.
 * @returns {Sketch}
 */
export function sketched(items) {
  /** @type {Sketch} */
  const found = { discs: new Map(), crosses: new Set(), paths: [], bands: [], strokes: [] };
  for (const operation of standing(items)) {
    /** @type {((how: Operation, found: Sketch) => void) | undefined} */ (SKETCHES[operation.kind])?.(operation, found);
  }
  return found;
}

/**
 * What is left of what waits when each undo and redo has done its work.
 *
 * @param {Pick<Item, "what" | "operation">[]} items
 */
function standing(items) {
  /** @type {Operation[]} */
  const done = [];
  /** @type {Operation[]} */
  const undone = [];
  for (const item of items) {
    if (item.operation) {
      if (isChange(item)) done.push(item.operation);
      continue;
    }
    const [from, to] = item.what === "undo" ? [done, undone] : [undone, done];
    const last = from.pop();
    if (last) to.push(last);
  }
  return done;
}

/**
 * @param {Sketch} found
 * @param {Point} anchor
 */
function set(found, anchor) {
  found.crosses.delete(anchor[0]);
  found.discs.set(anchor[0], anchor);
}

/**
 * @param {Sketch} found
 * @param {number} column
 */
function remove(found, column) {
  found.discs.delete(column);
  found.crosses.add(column);
}

/**
 * Draw it, hollow and dashed, on a canvas in screen pixels.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Sketch} sketch
 * @param {View} view
 * @param {Colours} colours
 * @param {Point[]} anchors - That the photo has.
 */
export function paintWaiting(pen, sketch, view, colours, anchors) {
  /** @param {Point} pixel */
  const at = ([column, row]) => view.toScreen(column + 0.5, row);
  const outline = () => {
    for (const [style, width] of /** @type {[string, number][]} */ ([[softHalo(colours), 4.5], [colours.preview, 2]])) {
      Object.assign(pen, { strokeStyle: style, lineWidth: width });
      pen.stroke();
    }
  };
  for (const { points, radius, allow } of sketch.strokes) {
    pen.beginPath();
    follow(pen, brushed(points).map((point) => view.toScreen(...point)));
    pen.strokeStyle = allow ? BRUSHES.allow : BRUSHES.forbid;
    pen.lineWidth = (2 * radius + 1) * view.scale;
    pen.stroke();
  }
  pen.setLineDash([3, 4]);
  for (const path of sketch.paths) {
    pen.beginPath();
    follow(pen, path.map(at));
    outline();
  }
  for (const band of sketch.bands) paintBand(pen, band, view, colours, outline);
  pen.setLineDash([]);
  for (const anchor of sketch.discs.values()) {
    pen.beginPath();
    pen.arc(...at(anchor), ANCHOR, 0, 2 * Math.PI);
    outline();
  }
  for (const anchor of anchors.filter(([column]) => sketch.crosses.has(column))) {
    const [x, y] = at(anchor);
    pen.beginPath();
    for (const side of [-ANCHOR, ANCHOR]) {
      pen.moveTo(x - ANCHOR, y - side);
      pen.lineTo(x + ANCHOR, y + side);
    }
    outline();
  }
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {Band} band
 * @param {View} view
 * @param {Colours} colours
 * @param {() => void} outline
 */
function paintBand(pen, { first, last, words }, view, colours, outline) {
  const [left, right] = [view.toScreen(first, 0)[0], view.toScreen(last + 1, 0)[0]];
  pen.beginPath();
  pen.rect(left, 4, right - left, 18);
  outline();
  pen.fillStyle = colours.preview;
  pen.font = "12px sans-serif";
  pen.fillText(words, left + 6, 17, Math.max(right - left - 12, 1));
}
