/** The brush: how wide it is, and its ring at the mouse. */

import { box, input } from "../basics/dom.js";
import { within } from "../basics/geometry.js";

/** @import { LineLayer } from "../drawn/line_layer.js" */

const STEP = 1.25; // a key makes it so much wider

/** Radius of the brush in screen pixels, from the slider and from keys. */
export class Brush {
  #lines;
  #slider = input("brush");

  /** @param {LineLayer} lines - Draws the ring. */
  constructor(lines) {
    this.#lines = lines;
    this.#slider.addEventListener("input", () => this.show(true));
  }

  get radius() {
    return Number(this.#slider.value);
  }

  /**
   * Show the slider and the ring, or leave them.
   *
   * @param {boolean} shown
   */
  show(shown) {
    box("brush-size").hidden = !shown;
    this.#lines.ring(shown ? this.radius : 0);
  }

  /** @param {boolean} wider */
  resize(wider) {
    const { min, max } = this.#slider;
    this.#slider.value = String(within(Math.round(this.radius * (wider ? STEP : 1 / STEP)), Number(min), Number(max)));
    this.show(true);
    return this.radius;
  }
}
