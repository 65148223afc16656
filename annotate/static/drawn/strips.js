/** Under the photo: the straightened strip, and the uncertainty of each column. */

import { canvas } from "../basics/dom.js";
import { disc, fit, penOf, ratio } from "../basics/drawing.js";
import { columnAt, uncertainty, within } from "../basics/geometry.js";
import { picture } from "../server/api.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Document, Legend, Margins } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

const SETTLING = 120; // milliseconds after an edit until the strip is asked for

/** @typedef {{document: Document, margins: Margins | null, legend: Legend}} Shown */

/** Both strips. */
export class Strips {
  #strip = canvas("strip");
  #margin = canvas("margin");
  #labelling;
  #view;
  /** @type {ImageBitmap | null} */
  #image = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #turn = 0;

  /**
   * @param {Labelling} labelling
   * @param {View} view
   * @param {(column: number) => void} goTo - Called with the column that is clicked.
   */
  constructor(labelling, view, goTo) {
    this.#labelling = labelling;
    this.#view = view;
    for (const strip of [this.#strip, this.#margin]) {
      strip.addEventListener("click", (event) => {
        const width = labelling.document?.width;
        if (width) goTo(columnAt(event.offsetX, strip.clientWidth, width));
      });
    }
    labelling.on("document", ({ fresh }) => this.#ask(fresh ? 0 : SETTLING));
    labelling.on("margins", () => this.#drawMargins());
    view.on("change", () => this.#drawMargins());
    const draw = () => {
      this.#drawStrip();
      this.#drawMargins();
    };
    addEventListener("resize", draw);
    new ResizeObserver(draw).observe(this.#strip);
  }

  /** @param {number} wait */
  #ask(wait) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(async () => {
      const turn = ++this.#turn;
      const image = await this.#read();
      if (turn !== this.#turn) return;
      this.#image = image;
      this.#drawStrip();
    }, wait);
  }

  async #read() {
    const { document } = this.#labelling;
    if (!document?.rows) return null;
    const width = within(Math.round(this.#strip.clientWidth * ratio()), 16, 4096);
    // the strip is a help; what is wrong is told where the photo is read
    return picture(`api/photos/${document.id}/strip?width=${width}`).catch(() => null);
  }

  #drawStrip() {
    fit(this.#strip);
    const pen = penOf(this.#strip);
    const { width, height } = this.#strip;
    pen.clearRect(0, 0, width, height);
    const { legend } = this.#labelling;
    if (!this.#image || !legend) return;
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.#image, 0, 0, width, height);
    const { line, halo } = legend.colours;
    const one = ratio();
    const row = height * legend.band / (2 * legend.band + 1); // where the line lies
    for (const x of [6, width - 6 - 14 * one]) {
      pen.fillStyle = halo;
      pen.fillRect(x - one, row - 2 * one, 16 * one, 4 * one);
      pen.fillStyle = line;
      pen.fillRect(x, row - one, 14 * one, 2 * one);
    }
  }

  #drawMargins() {
    fit(this.#margin);
    const pen = penOf(this.#margin);
    pen.clearRect(0, 0, this.#margin.width, this.#margin.height);
    const { document, margins, legend } = this.#labelling;
    if (document && legend) this.#paintMargins(pen, { document, margins, legend });
  }

  /**
   * Bars: the taller, the less certain; below them, which part of the photo is in sight.
   *
   * @param {CanvasRenderingContext2D} pen
   * @param {Shown} shown
   */
  #paintMargins(pen, { document, margins, legend }) {
    const { width, height } = this.#margin;
    const one = ratio();
    const room = height - 7 * one;
    pen.fillStyle = getComputedStyle(this.#margin).color;
    if (margins?.margins.length === document.width) {
      uncertainty(margins.margins, width).forEach((unsure, x) => pen.fillRect(x, room * (1 - unsure), 1, room * unsure));
    }
    const [first, last] = this.#view.columns();
    pen.fillRect(first / document.width * width, height - 4 * one, Math.max((last + 1 - first) / document.width * width, 4), 3 * one);
    const { anchor, halo } = legend.colours;
    for (const [column] of document.anchors) {
      const x = (column + 0.5) / document.width * width;
      disc(pen, [x, room - 3 * one], 3 * one, { fill: anchor, rim: halo, width: one });
    }
  }
}
