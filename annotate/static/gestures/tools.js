/** The tools: what a press on the photo begins, how it follows the pointer, and what comes of it. */

import { GuideStroke } from "./guides.js";
import { BrushTool, DrawTool, SideTool, SpanTool, snapping, touch } from "./strokes.js";

/** @import { Bench, Contact, Tool } from "./strokes.js" */

/** The tools, in the order of their buttons. */
export const TOOLS = /** @type {const} */ ([
  { id: "anchor", name: "Line", key: "A", title: "Click: the line passes through the edge here; with Shift, just here. Drag along a ridge: the line snaps to it. Drag an anchor to move it, right-click to remove it." },
  { id: "guide", name: "Guide", key: "I", title: "Click corners along a ridge, the last one twice: the line snaps to it. Or drag along the ridge." },
  { id: "forbid", name: "Brush", key: "B", title: "Paint where the line must not go; with Alt, erase." },
  { id: "side", name: "Sky", key: "5", title: "Drag below the sky: all above is sky; with Alt, all below is terrain." },
  { id: "straight", name: "Straight", key: "S", title: "Drag from one end of a straight piece to the other." },
  { id: "drawn", name: "Draw", key: "D", title: "Drag along the line: it lies just where you draw." },
  { id: "hidden", name: "Hide", key: "H", title: "Drag across columns in which the line cannot be seen; with Alt, show them again." },
  { id: "explain", name: "Explain", key: "E", title: "Click a pixel: what the detector thought of it." },
]);

/** @typedef {typeof TOOLS[number]["id"]} ToolId */

/** Moves the photo. @implements {Tool} */
export class PanTool {
  #bench;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  start() {}

  /** @param {Contact} contact */
  move({ by }) {
    this.#bench.previewer.clear();
    this.#bench.view.pan(...by);
  }

  end() {}
}

/**
 * Sets an anchor at a click, or where a finger lets go that has aimed. What goes further is a stroke along a
 * ridge, and with Alt it moves the photo. @implements {Tool}
 */
export class AnchorTool {
  #bench;
  #pan;
  /** @type {Contact | null} */
  #first = null;
  /** @type {GuideStroke | null} */
  #guide = null;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
    this.#pan = new PanTool(bench);
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#first = contact;
    this.#guide = null;
    if (contact.finger) aim(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    if (this.#first?.alt) this.#pan.move(contact);
    else if (contact.far || this.#guide) this.#draw(contact);
    else if (contact.finger) aim(this.#bench, contact);
  }

  /** @param {Contact} contact */
  end(contact) {
    if (this.#guide) this.#guide.end();
    else if (!this.#first?.alt || !contact.moved) this.#bench.anchor(...contact.pixel, snapping(this.#bench.view.scale, contact));
  }

  /** @param {Contact} contact */
  #draw(contact) {
    this.#guide ??= new GuideStroke(this.#bench, this.#first ?? contact);
    this.#guide.move(contact);
  }
}

/** Makes a guide corner by corner, a click each; a drag is a whole one. @implements {Tool} */
export class GuideTool {
  #bench;
  /** @type {Contact | null} */
  #first = null;
  /** @type {GuideStroke | null} */
  #guide = null;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  /** @param {Contact} contact */
  start(contact) {
    this.#first = contact;
    this.#guide = null;
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    touch(this.#bench, contact);
    const whole = contact.far && !this.#bench.selection.now.corners.length;
    if (whole) this.#guide ??= new GuideStroke(this.#bench, this.#first ?? contact);
    this.#guide?.move(contact);
  }

  /** @param {Contact} contact */
  end({ pixel }) {
    if (this.#guide) this.#guide.end();
    else this.#bench.corner(pixel);
  }
}

/** Tells what the detector thought of a pixel. @implements {Tool} */
export class ExplainTool {
  #bench;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
  }

  /** @param {Contact} contact */
  start(contact) {
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    touch(this.#bench, contact);
  }

  /** @param {Contact} contact */
  end({ pixel }) {
    this.#bench.explain(pixel);
  }
}

/** Moves an anchor; a click puts the cursor there. @implements {Tool} */
export class DragTool {
  #bench;
  #column;
  #beside;

  /**
   * @param {Bench} bench
   * @param {number} column - Of the anchor.
   * @param {boolean} beside - Whether the press is beside its mark: without a drag it is a click there.
   */
  constructor(bench, column, beside) {
    this.#bench = bench;
    this.#column = column;
    this.#beside = beside;
  }

  /** @param {Contact} contact */
  start(contact) {
    if (contact.finger) aim(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    if (contact.moved) aim(this.#bench, contact, this.#column);
  }

  /** @param {Contact} contact */
  end(contact) {
    const [column, row] = contact.pixel;
    const within = snapping(this.#bench.view.scale, contact);
    if (contact.moved) this.#bench.apply({ kind: "move", from_column: this.#column, column, row, within });
    else if (this.#beside) this.#bench.anchor(column, row, within);
    else this.#bench.goTo(this.#column);
  }
}

/**
 * Every tool that has a button.
 *
 * @param {Bench} bench
 * @returns {Record<ToolId, Tool>}
 */
export function makeTools(bench) {
  return {
    anchor: new AnchorTool(bench),
    guide: new GuideTool(bench),
    forbid: new BrushTool(bench),
    side: new SideTool(bench),
    straight: new SpanTool(bench, "straight"),
    drawn: new DrawTool(bench),
    hidden: new SpanTool(bench, "hidden"),
    explain: new ExplainTool(bench),
  };
}

/**
 * Show what would come of letting go here.
 *
 * @param {Bench} bench
 * @param {Contact} contact
 * @param {number | null} [dragged]
 */
function aim(bench, contact, dragged = null) {
  bench.selection.aim(contact.pixel, dragged);
  touch(bench, contact);
  bench.previewer.ask(...contact.pixel, snapping(bench.view.scale, contact), dragged);
}
