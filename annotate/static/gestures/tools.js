/** The tools: what a press on the photo begins, how it follows the pointer, and what comes of it. */

import { BrushTool, DrawTool, SpanTool, touch } from "./strokes.js";

/** @import { Bench, Contact, Tool } from "./strokes.js" */

/** The tools, in the order of their buttons. */
export const TOOLS = /** @type {const} */ ([
  { id: "anchor", name: "Anchor", key: "A", title: "Click: the line passes through here; with Shift, it leaves the old line around. Drag an anchor to move it, right-click to remove it." },
  { id: "forbid", name: "Brush", key: "B", title: "Paint where the line must not go; with Alt, erase." },
  { id: "straight", name: "Straight", key: "S", title: "Drag from one end of a straight piece to the other." },
  { id: "drawn", name: "Draw", key: "D", title: "Drag along the line." },
  { id: "hidden", name: "Hide", key: "H", title: "Drag across columns in which the line cannot be seen; with Alt, show them again." },
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

/** Sets an anchor where a finger lets go, or the mouse clicks; the mouse moves the photo. @implements {Tool} */
export class AnchorTool {
  #bench;
  #pan;

  /** @param {Bench} bench */
  constructor(bench) {
    this.#bench = bench;
    this.#pan = new PanTool(bench);
  }

  /** @param {Contact} contact */
  start(contact) {
    if (contact.finger) aim(this.#bench, contact);
  }

  /** @param {Contact} contact */
  move(contact) {
    if (contact.finger) aim(this.#bench, contact);
    else if (contact.moved) this.#pan.move(contact);
  }

  /** @param {Contact} contact */
  end({ pixel, finger, moved, shift }) {
    if (finger || !moved) this.#bench.anchor(...pixel, shift);
  }
}

/** Moves an anchor; a click puts the cursor there. @implements {Tool} */
export class DragTool {
  #bench;
  #column;

  /**
   * @param {Bench} bench
   * @param {number} column - Of the anchor.
   */
  constructor(bench, column) {
    this.#bench = bench;
    this.#column = column;
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
  end({ pixel: [column, row], moved }) {
    if (moved) this.#bench.apply({ kind: "move", from_column: this.#column, column, row });
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
    forbid: new BrushTool(bench),
    straight: new SpanTool(bench, "straight"),
    drawn: new DrawTool(bench),
    hidden: new SpanTool(bench, "hidden"),
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
  bench.previewer.ask(...contact.pixel, dragged);
}
