/** Marks over the photo in screen pixels: numbers, hidden spans, the ring of the brush, corners of a guide. */

import { OTHERS, disc, softHalo } from "../basics/drawing.js";
import { notVisible, unseen } from "../basics/hidden.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Colours, Document } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

/** Radius of a number, in screen pixels. */
export const BADGE = 11;

const ALIKE = 0.1; // what a row from the line as it is counts against one from all lines: decides where others go along

/**
 * The colour of one of the lines along other ridges.
 *
 * @param {number} at - From 0.
 */
export const colourOf = (at) => OTHERS[at % OTHERS.length];

/**
 * The number of a line, on it and in its colour.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Point} at - On the screen.
 * @param {number} number - From 1.
 * @param {Colours} colours
 */
export function badge(pen, at, number, colours) {
  disc(pen, at, BADGE, { fill: colourOf(number - 1), rim: colours.halo, width: 2 });
  Object.assign(pen, { fillStyle: colours.halo, font: "bold 14px system-ui, sans-serif", textAlign: "center", textBaseline: "middle" });
  pen.fillText(String(number), at[0], at[1] + 1);
  Object.assign(pen, { textAlign: "start", textBaseline: "alphabetic" });
}

/**
 * Where the badge of each of some lines stands: where the line is farthest from all others, so that it is seen
 * which one is meant, and not on another badge. What is never far from another one is far from the current one.
 *
 * @param {number[][]} lines - Rows of each.
 * @param {number[]} current - Rows of the line as it is.
 * @param {Point} columns - First and last in sight.
 * @param {number} room - Columns that a badge takes.
 * @returns {Point[]} Pixels.
 */
export function badges(lines, current, [first, last], room) {
  /** @type {Point[]} */
  const found = [];
  for (const rows of lines) {
    const others = [current, ...lines.filter((other) => other !== rows)];
    let [best, most] = [first, -2];
    for (let column = first; column <= last; column += Math.max(Math.floor(room / 4), 1)) {
      const taken = found.some(([one, row]) => Math.hypot(one - column, row - rows[column]) < 2 * room);
      const each = others.map((other) => Math.abs(other[column] - rows[column])); // the current one is the first
      const away = taken ? -1 : Math.min(...each) + ALIKE * each[0];
      if (away > most) [best, most] = [column, away];
    }
    found.push([best, rows[best]]);
  }
  return found;
}

/**
 * Runs of columns in which a line is another one than the current, with a column more on either side.
 *
 * @param {number[]} rows
 * @param {number[]} current
 * @returns {{first: number, rows: number[]}[]}
 */
export function apart(rows, current) {
  /** @type {[number, number][]} */
  const found = [];
  rows.forEach((row, column) => {
    if (row === current[column]) return;
    const before = found.at(-1);
    if (before && column <= before[1] + 2) before[1] = column;
    else found.push([column, column]);
  });
  return found.map(([first, last]) => {
    const from = Math.max(first - 1, 0);
    return { first: from, rows: rows.slice(from, last + 2) };
  });
}

/**
 * Columns in which the line cannot be seen: a veil over the photo, with what hides it at its top.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Document} document
 * @param {View} view
 * @param {Colours} colours
 */
export function veil(pen, document, view, colours) {
  for (const [first, last, why] of unseen(document)) {
    const [left, top] = view.toScreen(first, 0);
    const [right, bottom] = view.toScreen(last + 1, document.height);
    pen.fillStyle = "rgb(0 0 0 / 28%)";
    pen.fillRect(left, top, right - left, bottom - top);
    Object.assign(pen, { strokeStyle: softHalo(colours), lineWidth: 1 });
    pen.strokeRect(left, top, right - left, bottom - top);
    if (right - left < 24) continue;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, right - left, bottom - top);
    pen.clip();
    pen.font = "12px system-ui, sans-serif";
    const from = Math.max(left, 0) + 5;
    const fits = (/** @type {string} */ one) => pen.measureText(one).width < right - from - 6;
    const words = [notVisible(why), why, "not visible"].find((one) => one && fits(one)) ?? "…"; // the most that there is room for
    const across = pen.measureText(words).width;
    pen.fillStyle = "rgb(0 0 0 / 65%)";
    pen.fillRect(from - 3, Math.max(top, 0) + 3, across + 6, 17);
    pen.fillStyle = colours.anchor;
    pen.fillText(words, from, Math.max(top, 0) + 16);
    pen.restore();
  }
}

/**
 * A circle with a halo.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Point} at - On the screen.
 * @param {number} radius
 * @param {Colours} colours
 */
export function ring(pen, at, radius, colours) {
  for (const [style, width] of /** @type {[string, number][]} */ ([[softHalo(colours), 3], [colours.anchor, 1]])) {
    Object.assign(pen, { strokeStyle: style, lineWidth: width });
    pen.beginPath();
    pen.arc(...at, radius, 0, 2 * Math.PI);
    pen.stroke();
  }
}

/**
 * A square around a pixel, at least some screen pixels wide.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {Point} pixel
 * @param {View} view
 * @param {Colours} colours
 */
export function framed(pen, [column, row], view, colours) {
  const [left, top] = view.toScreen(column, row);
  const spare = Math.max(10 - view.scale, 0) / 2;
  for (const [style, width] of /** @type {[string, number][]} */ ([[softHalo(colours), 4], [colours.preview, 2]])) {
    Object.assign(pen, { strokeStyle: style, lineWidth: width });
    pen.strokeRect(left - spare, top - spare, view.scale + 2 * spare, view.scale + 2 * spare);
  }
}
