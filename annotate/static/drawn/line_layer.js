/** Draws what belongs to the line: the line itself as one path, previews, anchors, the brush. */

import { ANCHOR, BRUSHES, disc, follow, penOf, ratio, softHalo, withNextFrame } from "../basics/drawing.js";
import { brushed } from "../basics/geometry.js";
import { unseen } from "../basics/hidden.js";
import { corridor } from "./corridor.js";
import { hatched } from "./hatching.js";
import { magnify } from "./magnifier.js";
import { BADGE, apart, badge, badges, colourOf, framed, ring, veil } from "./marks.js";
import { paintWaiting, sketched } from "./waiting.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Item } from "../server/queue.js" */
/** @import { Selection, Stroke } from "../labelled/selection.js" */
/** @import { Colours, Document } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

const STAIRS = 6; // screen pixels a column, from which on the line is drawn as stairs

/** @typedef {{document: Document, colours: Colours}} Shown */
/** @typedef {{stairs: boolean, visible: Path2D, hidden: Path2D}} Paths - The line's, in pixels of the photo. */

/** The upper canvas of the stage. It draws itself whenever what it shows changes. */
export class LineLayer {
  #canvas;
  #below;
  #view;
  #selection;
  /** @type {Shown | null} */
  #shown = null;
  #waiting = sketched([]);
  /** @type {Paths | null} */
  #paths = null;
  /** @type {OffscreenCanvas | null} */
  #forbidden = null;
  #brush = 0; // radius of its ring, in screen pixels
  #magnified = false;
  #draw = withNextFrame(() => this.#paint());

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLCanvasElement} below - The canvas of the photo, for the magnifier.
   * @param {View} view
   * @param {Selection} selection
   */
  constructor(canvas, below, view, selection) {
    this.#canvas = canvas;
    this.#below = below;
    this.#view = view;
    this.#selection = selection;
    view.on("change", this.#draw);
    selection.on("change", this.#draw);
  }

  /**
   * Show another state of the line.
   *
   * @param {Document} document
   * @param {Colours} colours
   */
  show(document, colours) {
    this.#shown = { document, colours };
    this.#paths = null;
    this.#forbidden = hatched(document);
    this.#draw();
  }

  /**
   * Draw a ring as wide as the brush at the mouse; none for 0.
   *
   * @param {number} radius - In screen pixels.
   */
  ring(radius) {
    this.#brush = radius;
    this.#draw();
  }

  /**
   * Magnify what is under the mouse, or do not.
   *
   * @param {boolean} on
   */
  magnify(on) {
    if (on === this.#magnified) return;
    this.#magnified = on;
    this.#draw();
  }

  /**
   * Show what waits for the server on this photo, too.
   *
   * @param {Item[]} items
   */
  showWaiting(items) {
    this.#waiting = sketched(items);
    this.#draw();
  }

  #paint() {
    const pen = penOf(this.#canvas);
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (!this.#shown) return;
    const { document, colours } = this.#shown;
    const { finger, pointer } = this.#selection.now;
    const { scale, left, top } = this.#view;
    const [across, down] = [ratio() * scale, ratio()];
    pen.lineJoin = pen.lineCap = "round";
    pen.setTransform(down, 0, 0, down, 0, 0);
    veil(pen, document, this.#view, colours);
    pen.setTransform(across, 0, 0, across, down * left, down * top);
    this.#paintLines(pen, this.#shown);
    pen.setTransform(down, 0, 0, down, 0, 0);
    this.#paintSpans(pen, this.#shown);
    this.#paintCursor(pen, this.#shown);
    this.#paintAnchors(pen, this.#shown);
    paintWaiting(pen, this.#waiting, this.#view, colours, document.anchors);
    this.#paintChoices(pen, colours, document.rows ?? []);
    const closely = finger ?? (this.#magnified ? pointer : null);
    if (closely) magnify(pen, closely, [this.#below, this.#canvas], colours.anchor);
  }

  /**
   * In pixels of the photo: what is forbidden, the line, a preview of another one, and a stroke.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintLines(pen, { document, colours }) {
    const { preview, stroke } = this.#selection.now;
    const stairs = this.#view.scale >= STAIRS;
    if (this.#forbidden) pen.drawImage(this.#forbidden, 0, 0, document.width, document.height);
    if (this.#paths?.stairs !== stairs) this.#paths = linePaths(document, stairs);
    this.#trace(pen, this.#paths.hidden, colours.line, [6, 5]);
    this.#trace(pen, this.#paths.visible, colours.line);
    this.#paintOthers(pen, document.rows ?? [], stairs);
    if (preview?.rows.length) this.#trace(pen, linePath(preview.first, preview.rows, stairs), colours.preview);
    if (stroke) this.#paintStroke(pen, stroke, colours);
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Path2D} path
   * @param {string} colour
   * @param {number[]} [dashes] - In screen pixels.
   */
  #trace(pen, path, colour, dashes = []) {
    const { scale } = this.#view;
    pen.setLineDash(dashes.map((one) => one / scale));
    for (const [style, width] of /** @type {[string, number][]} */ ([[this.#halo, 4.5], [colour, 2]])) {
      Object.assign(pen, { strokeStyle: style, lineWidth: width / scale });
      pen.stroke(path);
    }
    pen.setLineDash([]);
  }

  get #halo() {
    return this.#shown ? softHalo(this.#shown.colours) : "";
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Stroke} stroke
   * @param {Colours} colours
   */
  #paintStroke(pen, stroke, colours) {
    const { kind, points, radius, allow } = stroke;
    if (kind === "guide") {
      pen.fillStyle = `${colours.preview}38`; // light: the ridge is seen through it
      return pen.fill(corridor(stroke));
    }
    const path = new Path2D();
    follow(path, kind === "forbid" ? brushed(points) : points.map(([column, row]) => [column + 0.5, row]));
    if (kind !== "forbid") return this.#trace(pen, path, colours.preview);
    pen.strokeStyle = allow ? BRUSHES.allow : BRUSHES.forbid;
    pen.lineWidth = 2 * radius + 1;
    pen.stroke(path);
  }

  /**
   * Lines along other ridges; the one that is looked at alone.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {number[]} current
   * @param {boolean} stairs
   */
  #paintOthers(pen, current, stairs) {
    const { others, other } = this.#selection.now;
    others.forEach(({ rows }, at) => {
      if (other !== null && other !== at) return;
      for (const part of apart(rows, current)) this.#trace(pen, linePath(part.first, part.rows, stairs), colourOf(at));
    });
  }

  /**
   * What is chosen from or made: numbers of other lines, corners of a guide, the pixel that is explained, the brush.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Colours} colours
   * @param {number[]} current
   */
  #paintChoices(pen, colours, current) {
    const { others, other, corners, explained, pointer } = this.#selection.now;
    const places = badges(others.map(({ rows }) => rows), current, this.#view.columns(), BADGE / this.#view.scale);
    places.forEach(([column, row], at) => {
      if (other === null || other === at) badge(pen, this.#view.toScreen(column + 0.5, row), at + 1, colours);
    });
    for (const corner of corners) this.#disc(pen, corner, 5, colours.preview, colours);
    if (explained) framed(pen, explained, this.#view, colours);
    if (pointer && this.#brush) ring(pen, pointer, this.#brush, colours);
  }

  /**
   * Both ends of each span: squares of straight ones, ellipses of drawn ones.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintSpans(pen, { document, colours }) {
    for (const { first, last, kind } of document.spans) {
      for (const column of [first, last]) {
        const [x, y] = this.#view.toScreen(column + 0.5, document.rows?.[column] ?? 0);
        Object.assign(pen, { fillStyle: colours.anchor, strokeStyle: colours.halo, lineWidth: 1.5 });
        pen.beginPath();
        if (kind === "straight") pen.rect(x - 4, y - 4, 8, 8);
        else pen.ellipse(x, y, 3, 5, 0, 0, 2 * Math.PI);
        pen.fill();
        pen.stroke();
      }
    }
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintCursor(pen, shown) {
    const { mark, cursor } = this.#selection.now;
    if (mark) this.#paintColumn(pen, mark, [3, 4], shown);
    if (cursor) this.#paintColumn(pen, cursor, [], shown);
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {{column: number, row: number | null}} place
   * @param {number[]} dashes
   * @param {Shown} shown
   */
  #paintColumn(pen, { column, row }, dashes, { document, colours }) {
    const [x] = this.#view.toScreen(column + 0.5, 0);
    const rails = /** @type {[string, number][]} */ ([[softHalo(colours), 3], [colours.anchor, 1]]);
    pen.setLineDash(dashes);
    for (const [style, width] of rails) {
      Object.assign(pen, { strokeStyle: style, lineWidth: width });
      pen.beginPath();
      follow(pen, [[x, 0], [x, this.#canvas.clientHeight]]);
      pen.stroke();
    }
    pen.setLineDash([]);
    const at = row ?? document.rows?.[column];
    if (at !== undefined) this.#disc(pen, [column, at], 4, row === null ? colours.anchor : colours.preview, colours);
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintAnchors(pen, { document, colours }) {
    const { dragged } = this.#selection.now;
    for (const anchor of document.anchors) {
      if (anchor[0] !== dragged) this.#disc(pen, anchor, ANCHOR, colours.anchor, colours);
    }
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Point} pixel
   * @param {number} radius
   * @param {string} fill
   * @param {Colours} colours
   */
  #disc(pen, [column, row], radius, fill, { halo }) {
    disc(pen, this.#view.toScreen(column + 0.5, row), radius, { fill, rim: halo, width: 2 });
  }
}

/**
 * The visible and the hidden parts of the line.
 *
 * @param {Document} document
 * @param {boolean} stairs
 * @returns {Paths}
 */
function linePaths(document, stairs) {
  const { rows } = document;
  const paths = { stairs, visible: new Path2D(), hidden: new Path2D() };
  if (!rows) return paths;
  let from = 0;
  for (const [first, last] of unseen(document)) {
    if (first > from) paths.visible.addPath(linePath(from, rows.slice(from, first), stairs));
    paths.hidden.addPath(linePath(first, rows.slice(first, last + 1), stairs));
    from = last + 1;
  }
  if (from < rows.length) paths.visible.addPath(linePath(from, rows.slice(from), stairs));
  return paths;
}

/**
 * @param {number} first
 * @param {number[]} rows
 * @param {boolean} stairs
 */
function linePath(first, rows, stairs) {
  const path = new Path2D();
  follow(path, rows.flatMap((row, at) => {
    const x = first + at;
    return /** @type {Point[]} */ (stairs ? [[x, row], [x + 1, row]] : [[x + 0.5, row]]);
  }));
  return path;
}
