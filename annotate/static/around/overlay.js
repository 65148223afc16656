/** What is laid over the photo, and how the photo is brightened. */

import { box, button, input, offer, select } from "../basics/dom.js";
import { NEUTRAL } from "../drawn/adjusting.js";
import { ApiError, picture } from "../server/api.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { PhotoLayer } from "../drawn/photo_layer.js" */

const NONE = "none";
const SLIDERS = /** @type {const} */ (["contrast", "gamma", "local"]);

/** The choice of a stage, its opacity, and the sliders of *Adjust*. */
export class Overlay {
  #labelling;
  #photo;
  #choice = select("overlay");
  /** @type {ImageBitmap | null} */
  #layer = null; // what is laid over the photo

  /**
   * @param {Labelling} labelling
   * @param {PhotoLayer} photo
   */
  constructor(labelling, photo) {
    this.#labelling = labelling;
    this.#photo = photo;
    labelling.on("legend", ({ stages }) => {
      this.#choice.append(new Option("no overlay", NONE));
      offer(this.#choice, Object.keys(stages));
    });
    labelling.on("document", ({ fresh }) => {
      if (!fresh) return;
      this.#layer = null; // it was of the photo before
      this.#show();
    });
    this.#choice.addEventListener("change", () => this.#show());
    input("opacity").addEventListener("input", () => this.#lay(this.#layer));
    for (const id of SLIDERS) input(id).addEventListener("input", () => this.#adjust());
    button("adjust").addEventListener("click", () => {
      const shown = box("adjustments").hidden;
      box("adjustments").hidden = !shown;
      button("adjust").setAttribute("aria-expanded", String(shown));
    });
    button("adjust-reset").addEventListener("click", () => {
      for (const id of SLIDERS) input(id).value = String(NEUTRAL[id]);
      this.#adjust();
    });
  }

  /** Go to the next stage. */
  next() {
    this.#choice.selectedIndex = (this.#choice.selectedIndex + 1) % this.#choice.length;
    this.#show();
    this.#labelling.say(`Overlay: ${this.#choice.value}.`);
  }

  /** Lay the chosen stage over the photo. */
  async #show() {
    const stage = this.#choice.value;
    const { document } = this.#labelling;
    if (stage === NONE || !document) return this.#lay(null);
    try {
      const layer = await picture(`api/photos/${document.id}/stages/${encodeURIComponent(stage)}`);
      if (this.#labelling.document?.id === document.id && this.#choice.value === stage) this.#lay(layer);
    } catch (error) {
      this.#choice.selectedIndex = 0;
      this.#lay(null);
      this.#labelling.say(ApiError.of(error).message, true);
    }
  }

  /** @param {ImageBitmap | null} layer */
  #lay(layer) {
    this.#layer = layer;
    for (const id of ["opacity", "legend"]) box(id).hidden = !layer;
    box("legend").textContent = this.#labelling.legend?.stages[this.#choice.value] ?? "";
    this.#photo.lay(layer, Number(input("opacity").value));
  }

  #adjust() {
    const [contrast, gamma, local] = SLIDERS.map((id) => Number(input(id).value));
    this.#photo.adjust({ contrast, gamma, local });
  }
}
