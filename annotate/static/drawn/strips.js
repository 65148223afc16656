/** Under the photo, column under column: the straightened strip, and the uncertainty of each column. */

import { canvas } from "../basics/dom.js";
import { disc, fit, penOf, ratio, withNextFrame } from "../basics/drawing.js";
import { uncertainty, within } from "../basics/geometry.js";
import { unseen } from "../basics/hidden.js";
import { picture } from "../server/api.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Selected, Selection } from "../labelled/selection.js" */
/** @import { View } from "../labelled/view.js" */
/** @import { Document, Legend, Margins } from "../types.js" */

const SETTLING = 120; // milliseconds after an edit or a zoom until the strip is asked for
const WIDEST = 4096; // columns of a strip, as the server makes it
const COARSE = 1.2; // times as wide as its picture is a strip drawn before a finer one is asked for

/** @typedef {{document: Document, margins: Margins | null, legend: Legend}} Shown */

/** Both strips. They follow the zoom of the photo. */
export class Strips {
  #strip = canvas("strip");
  #margin = canvas("margin");
  #labelling;
  #view;
  #selection;
  /** @type {ImageBitmap | null} */
  #image = null;
  /** @type {[Selected["cursor"], Selected["mark"]]} */
  #places = [null, null];
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #turn = 0;
  #draw = withNextFrame(() => this.#paint());

  /**
   * @param {Labelling} labelling
   * @param {View} view
   * @param {Selection} selection
   * @param {(column: number) => void} goTo - Called with the column that is clicked.
   */
  constructor(labelling, view, selection, goTo) {
    this.#labelling = labelling;
    this.#view = view;
    this.#selection = selection;
    for (const strip of [this.#strip, this.#margin]) {
      strip.addEventListener("click", (event) => labelling.document && goTo(view.toPixel(event.offsetX, 0)[0]));
    }
    labelling.on("document", ({ fresh }) => {
      if (fresh) this.#image = null; // it is of the photo before
      this.#ask(fresh ? 0 : SETTLING);
      this.#draw();
    });
    labelling.on("margins", this.#draw);
    selection.on("change", () => {
      const { cursor, mark } = selection.now;
      if (cursor === this.#places[0] && mark === this.#places[1]) return; // only the mouse has moved
      this.#places = [cursor, mark];
      this.#draw();
    });
    view.on("change", () => {
      if (this.#coarse()) this.#ask(SETTLING);
      this.#draw();
    });
    addEventListener("resize", this.#draw);
    new ResizeObserver(this.#draw).observe(this.#strip);
  }

  /** Width of the strip in physical pixels, as it is drawn, but no more than it has columns. */
  #wanted() {
    const width = this.#labelling.document?.width ?? 0;
    return within(Math.round(Math.min(width * this.#view.scale * ratio(), width)), 16, WIDEST);
  }

  #coarse() {
    return this.#image !== null && this.#wanted() > COARSE * this.#image.width;
  }

  /** @param {number} wait */
  #ask(wait) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(async () => {
      const turn = ++this.#turn;
      const image = await this.#read();
      if (turn !== this.#turn) return;
      this.#image = image;
      this.#draw();
    }, wait);
  }

  async #read() {
    const { document } = this.#labelling;
    if (!document?.rows) return null;
    // the strip is a help; what is wrong is told where the photo is read
    return picture(`api/photos/${document.id}/strip?width=${this.#wanted()}`).catch(() => null);
  }

  #paint() {
    const { document, margins, legend } = this.#labelling;
    for (const one of [this.#strip, this.#margin]) {
      fit(one);
      penOf(one).clearRect(0, 0, one.width, one.height);
    }
    if (!document || !legend) return;
    this.#paintStrip({ document, margins, legend });
    this.#paintMargins({ document, margins, legend });
  }

  /** @param {Shown} shown */
  #paintStrip({ document, legend }) {
    const pen = penOf(this.#strip);
    const { height } = this.#strip;
    const [left, right] = this.#columns(0, document.width);
    const one = ratio();
    if (this.#image) {
      pen.imageSmoothingEnabled = right - left < this.#image.width;
      pen.drawImage(this.#image, left, 0, right - left, height);
    }
    this.#paintHidden(pen, document);
    this.#paintReasons(pen, document, legend);
    if (!document.rows) return;
    const row = height * legend.band / (2 * legend.band + 1); // where the line lies
    for (const x of [left, right]) {
      pen.fillStyle = legend.colours.halo;
      pen.fillRect(x - 8 * one, row - 2 * one, 16 * one, 4 * one);
      pen.fillStyle = legend.colours.line;
      pen.fillRect(x - 7 * one, row - one, 14 * one, 2 * one);
    }
    this.#paintPlaces(pen, document, legend, row);
  }

  /**
   * Bars: the taller, the less certain.
   *
   * @param {Shown} shown
   */
  #paintMargins({ document, margins, legend }) {
    const pen = penOf(this.#margin);
    const { width, height } = this.#margin;
    const room = height - 4 * ratio();
    this.#paintHidden(pen, document);
    pen.fillStyle = getComputedStyle(this.#margin).color;
    if (margins?.margins.length === document.width) {
      const across = ratio() * this.#view.scale;
      const bars = uncertainty(margins.margins, width, -this.#view.left / this.#view.scale, width / across);
      bars.forEach((unsure, x) => pen.fillRect(x, room * (1 - unsure), 1, room * unsure));
    }
    const [left, right] = this.#columns(0, document.width);
    pen.fillRect(left, height - 3 * ratio(), right - left, ratio());
    this.#paintPlaces(pen, document, legend, room - 3 * ratio());
  }

  /**
   * Ticks of anchors, and of the cursor and the mark.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Document} document
   * @param {Legend} legend
   * @param {number} row - Of the ticks, in physical pixels.
   */
  #paintPlaces(pen, document, { colours }, row) {
    const one = ratio();
    for (const [column] of document.anchors) {
      disc(pen, [this.#columns(column + 0.5, 0)[0], row], 3 * one, { fill: colours.anchor, rim: colours.halo, width: one });
    }
    const { cursor, mark } = this.#selection.now;
    for (const place of [mark, cursor]) {
      if (!place) continue;
      const [x] = this.#columns(place.column + 0.5, 0);
      for (const [style, width] of /** @type {[string, number][]} */ ([[colours.halo, 3], [colours.anchor, 1]])) {
        pen.fillStyle = style;
        pen.fillRect(x - width * one / 2, 0, width * one, pen.canvas.height);
      }
    }
  }

  /**
   * @param {CanvasRenderingContext2D} pen
   * @param {Document} document
   */
  #paintHidden(pen, document) {
    for (const [first, last] of unseen(document)) {
      const [left, right] = this.#columns(first, last + 1);
      pen.fillStyle = "rgb(0 0 0 / 35%)";
      pen.fillRect(left, 0, right - left, pen.canvas.height);
    }
  }

  /**
   * What hides the columns of each band, where there is room for it.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Document} document
   * @param {Legend} legend
   */
  #paintReasons(pen, document, { colours }) {
    pen.font = `${11 * ratio()}px system-ui, sans-serif`;
    pen.fillStyle = colours.anchor;
    for (const [first, last, why] of unseen(document)) {
      const [left, right] = this.#columns(first, last + 1);
      const from = Math.max(left, 0) + 4 * ratio();
      if (from + pen.measureText(why).width < right) pen.fillText(why, from, pen.canvas.height - 6 * ratio());
    }
  }

  /**
   * Where columns of the photo lie, in physical pixels.
   *
   * @param {number} first
   * @param {number} last
   * @returns {[number, number]}
   */
  #columns(first, last) {
    return [this.#view.toScreen(first, 0)[0] * ratio(), this.#view.toScreen(last, 0)[0] * ratio()];
  }
}
