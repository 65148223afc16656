/** Mouse, pen and fingers on the photo: which tool follows them, and zoom and pan. */

import { nearest } from "../basics/geometry.js";
import { snapping } from "./strokes.js";
import { DragTool, PanTool, makeTools } from "./tools.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Previewer } from "../labelled/previewer.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { Bench, Contact, Tool } from "./strokes.js" */
/** @import { ToolId } from "./tools.js" */
/** @import { View } from "../labelled/view.js" */

const STILL = 4; // screen pixels within which a press is a click
const FAR = { finger: 48, mouse: 12 }; // screen pixels from which on a press draws a stroke
const EDGE = { finger: 24, mouse: 8 }; // screen pixels beside the photo that still mean its edge
const REACH = { finger: 24, mouse: 10 }; // screen pixels within which an anchor is dragged
const MARK = 5; // of the anchor's mark: a click beside it sets another one

/**
 * @typedef {object} Parts
 * @property {HTMLCanvasElement} canvas
 * @property {View} view
 * @property {Selection} selection
 * @property {Labelling} labelling
 * @property {Previewer} previewer
 * @property {Bench["brush"]} brush
 * @property {Pick<Bench, "anchor" | "goTo" | "guide" | "corner" | "explain"> & {did: Bench["apply"]} & {showGuide: (pixel?: Point) => void}} line
 */

/** Gives what pointers do to the chosen tool. */
export class Pointer {
  #parts;
  #bench;
  #tools;
  /** @type {ToolId} */
  #chosen = "anchor";
  /** @type {Map<number, Point>} */
  #down = new Map(); // where each pointer is
  /** @type {{tool: Tool, from: Point, last: Point, moved: boolean, far: boolean} | null} */
  #press = null;
  /** @type {{x: number, y: number, apart: number} | null} */
  #pinch = null;

  /** @param {Parts} parts */
  constructor(parts) {
    const { canvas, view, selection, previewer, brush, line } = parts;
    const { anchor, goTo, guide, corner, explain, did } = line;
    this.#parts = parts;
    this.#bench = { selection, view, previewer, brush, anchor, goTo, guide, corner, explain, apply: did };
    this.#tools = makeTools(this.#bench);
    parts.labelling.on("document", ({ fresh }) => fresh && this.drop()); // it was meant for another photo
    canvas.addEventListener("pointerdown", (event) => this.#start(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#end(event));
    canvas.addEventListener("pointercancel", (event) => this.#cancel(event));
    canvas.addEventListener("pointerleave", (event) => this.#leave(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) view.pan(-event.deltaX, 0);
      else view.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.002)), event.offsetX, event.offsetY);
    }, { passive: false });
  }

  /**
   * Follow the pointer with another tool.
   *
   * @param {ToolId} tool
   */
  use(tool) {
    this.#chosen = tool;
    this.#parts.previewer.clear();
    this.#parts.selection.corner([]);
  }

  /** Let a press that is not over come to nothing. */
  drop() {
    if (this.#press) this.#drop();
  }

  /** @param {PointerEvent} event */
  #start(event) {
    const { canvas, labelling } = this.#parts;
    if (!labelling.document) return;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const at = this.#at(event);
    this.#down.set(event.pointerId, at);
    if (this.#down.size > 1) {
      this.#drop();
      this.#pinch = this.#fingers();
      return;
    }
    const anchor = this.#anchorAt(event);
    if (event.button === 2 && anchor !== undefined) {
      this.#bench.apply({ kind: "remove", column: anchor });
      return;
    }
    this.#parts.selection.offer([]);
    const tool = this.#toolFor(event, anchor);
    if (!tool) return;
    this.#press = { tool, from: at, last: at, moved: false, far: false };
    tool.start(this.#contact(event));
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (!this.#parts.labelling.document) return;
    if (this.#down.has(event.pointerId)) this.#down.set(event.pointerId, this.#at(event));
    if (this.#pinch) this.#pinched(this.#pinch);
    else if (this.#press) this.#press.tool.move(this.#contact(event));
    else if (!this.#down.size) this.#hover(event); // else the press was dropped
  }

  /** @param {PointerEvent} event */
  #end(event) {
    this.#lift(event);
    if (this.#press) {
      this.#press.tool.end(this.#contact(event));
      this.#drop();
    }
  }

  /** @param {PointerEvent} event */
  #cancel(event) {
    this.#lift(event);
    this.#drop();
    this.#parts.previewer.clear();
  }

  /** @param {PointerEvent} event */
  #leave(event) {
    this.#parts.selection.point(null);
    if (!this.#press && event.pointerType !== "touch") this.#parts.previewer.clear();
  }

  /**
   * A pointer is up; with two fingers left, these go on.
   *
   * @param {PointerEvent} event
   */
  #lift(event) {
    this.#down.delete(event.pointerId);
    if (this.#down.size === 0) this.#pinch = null;
    else if (this.#pinch && this.#down.size > 1) this.#pinch = this.#fingers();
  }

  /**
   * Show what a click would do.
   *
   * @param {PointerEvent} event
   */
  #hover(event) {
    const { view, labelling, previewer, selection, line } = this.#parts;
    if (event.pointerType === "touch") return;
    selection.point(this.#at(event));
    if (labelling.waiting || selection.now.others.length) return;
    const pixel = view.toPixel(...this.#at(event));
    if (this.#beside(event)) previewer.clear();
    else if (selection.now.corners.length) line.showGuide(pixel);
    else if (this.#chosen !== "anchor") return;
    else if (this.#anchorAt(event, MARK) === undefined) previewer.ask(...pixel, snapping(view.scale, { finger: false, shift: event.shiftKey }));
    else previewer.clear();
  }

  /**
   * What follows a press; null where it is beside the photo.
   *
   * @param {PointerEvent} event
   * @param {number | undefined} anchor - Column of the anchor that is hit.
   * @returns {Tool | null}
   */
  #toolFor(event, anchor) {
    if (event.button !== 0) return new PanTool(this.#bench);
    if (this.#chosen === "anchor" && anchor !== undefined) {
      return new DragTool(this.#bench, anchor, event.pointerType !== "touch" && this.#anchorAt(event, MARK) === undefined);
    }
    if (this.#beside(event)) return event.altKey ? new PanTool(this.#bench) : null;
    return this.#tools[this.#chosen];
  }

  /**
   * What a press has come to with this event.
   *
   * @param {PointerEvent} event
   * @returns {Contact}
   */
  #contact(event) {
    const at = this.#at(event);
    const press = this.#press ?? { from: at, last: at, moved: false, far: false };
    const away = Math.hypot(at[0] - press.from[0], at[1] - press.from[1]);
    const finger = event.pointerType === "touch";
    press.moved ||= away > STILL;
    press.far ||= away > (finger ? FAR.finger : FAR.mouse);
    const by = /** @type {Point} */ ([at[0] - press.last[0], at[1] - press.last[1]]);
    press.last = at;
    return {
      at, by, pixel: this.#parts.view.toPixel(...at), moved: press.moved, far: press.far,
      time: event.timeStamp, finger, shift: event.shiftKey, alt: event.altKey,
    };
  }

  /** Forget what is being done. */
  #drop() {
    this.#press = null;
    this.#parts.selection.letGo();
    if (this.#down.size) this.#parts.previewer.clear();
  }

  /**
   * @param {PointerEvent} event
   * @returns {Point}
   */
  #at(event) {
    const bounds = this.#parts.canvas.getBoundingClientRect();
    return [event.clientX - bounds.left, event.clientY - bounds.top];
  }

  /**
   * Whether a pointer is so far beside the photo that no pixel of it is meant.
   *
   * @param {PointerEvent} event
   */
  #beside(event) {
    return this.#parts.view.beside(...this.#at(event)) > (event.pointerType === "touch" ? EDGE.finger : EDGE.mouse);
  }

  /**
   * Column of the anchor under a pointer; undefined where there is none.
   *
   * @param {PointerEvent} event
   * @param {number} [reach] - Screen pixels within which it is hit.
   */
  #anchorAt(event, reach = event.pointerType === "touch" ? REACH.finger : REACH.mouse) {
    const { view, labelling } = this.#parts;
    const [x, y] = this.#at(event);
    return nearest(labelling.document?.anchors ?? [], ([column, row]) => {
      const [ax, ay] = view.toScreen(column + 0.5, row);
      return Math.hypot(ax - x, ay - y);
    }, reach)?.[0];
  }

  /** Middle and distance of the first two fingers. */
  #fingers() {
    const [[ax, ay], [bx, by]] = [...this.#down.values()];
    return { x: (ax + bx) / 2, y: (ay + by) / 2, apart: Math.max(Math.hypot(ax - bx, ay - by), 1) };
  }

  /** @param {{x: number, y: number, apart: number}} before */
  #pinched(before) {
    if (this.#down.size < 2) return;
    const now = this.#fingers();
    this.#parts.view.zoom(now.apart / before.apart, before.x, before.y);
    this.#parts.view.pan(now.x - before.x, now.y - before.y);
    this.#pinch = now;
  }
}
