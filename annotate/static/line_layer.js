/** Draws what belongs to the line: the line itself as one path, previews, anchors, the brush. */

import { paintWaiting, sketched } from "./waiting.js";

const LINE = "#ff2d95";
const PREVIEW = "#ffd400";
const HALO = "rgb(20 20 20 / 70%)";
const ANCHOR = 6; // radius, in screen pixels
const STAIRS = 6; // screen pixels a column, from which on the line is drawn as stairs

/** The upper canvas of the stage. */
export class LineLayer {
  preview = null; // {first, rows}
  cursor = null; // {column, row}: row is null while it rests on the line
  stroke = null; // what is being drawn: {kind, points, radius, allow}
  mark = null; // column and row of the mark
  finger = null; // where a finger touches, on the screen
  dragged = null; // column of the anchor that is dragged
  #waiting = sketched([]);
  #canvas;
  #below;
  #view;
  #document = null;
  #line = null;
  #hidden = null;
  #stairs = false;
  #brushed = null;
  #drawing = false;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLCanvasElement} below - the canvas of the photo, for the magnifier
   * @param {import("./view.js").View} view
   */
  constructor(canvas, below, view) {
    this.#canvas = canvas;
    this.#below = below;
    this.#view = view;
    view.addEventListener("change", () => this.draw());
  }

  /** Show another state of the line. */
  show(document) {
    this.#document = document;
    this.#line = null;
    this.#brushed = brushed(document);
    this.draw();
  }

  /** Show what waits for the server on this photo, too. */
  showWaiting(items) {
    this.#waiting = sketched(items);
    this.draw();
  }

  /** Column of the anchor under a point of the screen; undefined where there is none. */
  anchorAt(x, y, reach) {
    const near = ([column, row]) => {
      const [ax, ay] = this.#view.toScreen(column + 0.5, row);
      return Math.hypot(ax - x, ay - y);
    };
    const found = this.#document?.anchors.toSorted((a, b) => near(a) - near(b))[0];
    return found && near(found) <= reach ? found[0] : undefined;
  }

  /** Draw with the next frame. */
  draw() {
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => {
      this.#drawing = false;
      this.#paint();
    });
  }

  #paint() {
    const pen = this.#canvas.getContext("2d");
    const ratio = devicePixelRatio || 1;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (!this.#document) return;
    const { scale, left, top } = this.#view;
    const photo = () => pen.setTransform(ratio * scale, 0, 0, ratio * scale, ratio * left, ratio * top);
    const screen = () => pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.lineJoin = pen.lineCap = "round";
    const stairs = scale >= STAIRS;
    if (!this.#line || stairs !== this.#stairs) this.#build(stairs);
    photo();
    if (this.#brushed) pen.drawImage(this.#brushed, 0, 0, this.#document.width, this.#document.height);
    if (this.#document.rows) {
      this.#trace(pen, this.#hidden, LINE, 2, scale, [6, 5]);
      this.#trace(pen, this.#line, LINE, 2, scale);
    }
    if (this.preview?.rows.length) this.#trace(pen, this.#path(this.preview.first, this.preview.rows, stairs), PREVIEW, 2, scale);
    if (this.stroke) this.#paintStroke(pen, scale);
    screen();
    this.#paintSpans(pen);
    this.#paintCursor(pen);
    for (const [column, row] of this.#document.anchors) {
      if (column !== this.dragged) this.#disc(pen, column, row, ANCHOR, "#fff");
    }
    paintWaiting(pen, this.#waiting, this.#view, (column) => this.#document.anchors.find(([one]) => one === column)?.[1]);
    if (this.finger) this.#magnify(pen, ratio);
  }

  #build(stairs) {
    const { rows, hidden } = this.#document;
    this.#stairs = stairs;
    this.#line = new Path2D();
    this.#hidden = new Path2D();
    if (!rows) return;
    let from = 0;
    for (const [first, last] of hidden) {
      if (first > from) this.#line.addPath(this.#path(from, rows.slice(from, first), stairs));
      this.#hidden.addPath(this.#path(first, rows.slice(first, last + 1), stairs));
      from = last + 1;
    }
    if (from < rows.length) this.#line.addPath(this.#path(from, rows.slice(from), stairs));
  }

  #path(first, rows, stairs) {
    const path = new Path2D();
    rows.forEach((row, at) => {
      const x = first + at;
      if (stairs) {
        path[at ? "lineTo" : "moveTo"](x, row);
        path.lineTo(x + 1, row);
      } else {
        path[at ? "lineTo" : "moveTo"](x + 0.5, row);
      }
    });
    return path;
  }

  #trace(pen, path, colour, width, scale, dashes = []) {
    pen.setLineDash(dashes.map((one) => one / scale));
    pen.strokeStyle = HALO;
    pen.lineWidth = (width + 2.5) / scale;
    pen.stroke(path);
    pen.strokeStyle = colour;
    pen.lineWidth = width / scale;
    pen.stroke(path);
    pen.setLineDash([]);
  }

  #paintStroke(pen, scale) {
    const { kind, points, radius, allow } = this.stroke;
    const path = new Path2D();
    points.forEach(([column, row], at) => path[at ? "lineTo" : "moveTo"](column + 0.5, row + (kind === "forbid" ? 0.5 : 0)));
    if (kind === "forbid") {
      if (points.length === 1) path.lineTo(points[0][0] + 0.51, points[0][1] + 0.5);
      pen.strokeStyle = allow ? "rgb(255 255 255 / 35%)" : "rgb(0 0 0 / 55%)";
      pen.lineWidth = 2 * radius + 1;
      pen.stroke(path);
    } else {
      this.#trace(pen, path, PREVIEW, 2, scale);
    }
  }

  #paintSpans(pen) {
    for (const { first, last, kind } of this.#document.spans) {
      for (const column of [first, last]) {
        const [x, y] = this.#view.toScreen(column + 0.5, this.#document.rows[column]);
        pen.fillStyle = "#fff";
        pen.strokeStyle = "#141414";
        pen.lineWidth = 1.5;
        pen.beginPath();
        if (kind === "straight") pen.rect(x - 4, y - 4, 8, 8);
        else pen.ellipse(x, y, 3, 5, 0, 0, 2 * Math.PI);
        pen.fill();
        pen.stroke();
      }
    }
  }

  #paintCursor(pen) {
    for (const [place, dashes] of [[this.mark, [3, 4]], [this.cursor, []]]) {
      if (!place) continue;
      const [x] = this.#view.toScreen(place.column + 0.5, 0);
      const bottom = this.#canvas.clientHeight;
      for (const [colour, width] of [["rgb(20 20 20 / 60%)", 3], ["#fff", 1]]) {
        pen.setLineDash(dashes);
        pen.strokeStyle = colour;
        pen.lineWidth = width;
        pen.beginPath();
        pen.moveTo(x, 0);
        pen.lineTo(x, bottom);
        pen.stroke();
      }
      pen.setLineDash([]);
      const row = place.row ?? this.#document.rows?.[place.column];
      if (row !== undefined) this.#disc(pen, place.column, row, 4, place.row === null ? "#fff" : PREVIEW);
    }
  }

  #disc(pen, column, row, radius, colour) {
    const [x, y] = this.#view.toScreen(column + 0.5, row);
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fillStyle = colour;
    pen.fill();
    pen.lineWidth = 2;
    pen.strokeStyle = "#141414";
    pen.stroke();
  }

  /** What is under a finger, three times as large and beside it. */
  #magnify(pen, ratio) {
    const [x, y] = this.finger;
    const radius = 64;
    const at = [x < 2 * radius + 20 ? x + radius + 30 : x - radius - 30, Math.max(y - radius - 20, radius + 4)];
    pen.save();
    pen.beginPath();
    pen.arc(...at, radius, 0, 2 * Math.PI);
    pen.clip();
    const part = [(x - radius / 3) * ratio, (y - radius / 3) * ratio, radius * 2 / 3 * ratio, radius * 2 / 3 * ratio];
    const place = [at[0] - radius, at[1] - radius, 2 * radius, 2 * radius];
    pen.drawImage(this.#below, ...part, ...place);
    pen.drawImage(this.#canvas, ...part, ...place);
    pen.restore();
    pen.strokeStyle = "#fff";
    pen.lineWidth = 2;
    pen.beginPath();
    pen.arc(...at, radius, 0, 2 * Math.PI);
    pen.moveTo(at[0] - 8, at[1]);
    pen.lineTo(at[0] + 8, at[1]);
    pen.stroke();
  }
}

/** What the brush forbids, hatched; null where it has not been used. */
function brushed(document) {
  if (!document.forbidden.length) return null;
  const scale = Math.min(1, 1600 / document.width);
  const canvas = new OffscreenCanvas(Math.ceil(document.width * scale), Math.ceil(document.height * scale));
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.lineCap = pen.lineJoin = "round";
  for (const { points, radius, allow } of document.forbidden) {
    pen.globalCompositeOperation = allow ? "destination-out" : "source-over";
    pen.lineWidth = 2 * radius + 1;
    pen.beginPath();
    points.forEach(([column, row], at) => pen[at ? "lineTo" : "moveTo"](column + 0.5, row + 0.5));
    if (points.length === 1) pen.lineTo(points[0][0] + 0.51, points[0][1] + 0.5);
    pen.stroke();
  }
  pen.globalCompositeOperation = "source-in";
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.fillStyle = hatching(pen);
  pen.fillRect(0, 0, canvas.width, canvas.height);
  return canvas;
}

function hatching(pen) {
  const cell = new OffscreenCanvas(8, 8);
  const line = cell.getContext("2d");
  line.fillStyle = "rgb(0 0 0 / 40%)";
  line.fillRect(0, 0, 8, 8);
  line.strokeStyle = "rgb(255 255 255 / 75%)";
  line.lineWidth = 1.5;
  line.beginPath();
  for (const shift of [-8, 0, 8]) {
    line.moveTo(shift, 8);
    line.lineTo(shift + 8, 0);
  }
  line.stroke();
  return pen.createPattern(cell, "repeat");
}
