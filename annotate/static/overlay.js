/** What is laid over the photo, and how the photo is brightened. */

import { picture } from "./api.js";

const STAGES = ["none", "edges", "strength", "coherence", "orientation", "bin", "score", "cost"];
const NEUTRAL = { contrast: 1, gamma: 1, local: 0 };
const find = (id) => document.getElementById(id);

/** The choice of a stage, its opacity, and the sliders of *Adjust*. */
export class Overlay {
  #labelling;
  #photo;

  /**
   * @param {import("./labelling.js").Labelling} labelling
   * @param {import("./photo_layer.js").PhotoLayer} photo
   */
  constructor(labelling, photo) {
    this.#labelling = labelling;
    this.#photo = photo;
    find("overlay").append(...STAGES.map((stage) => new Option(stage)));
    find("overlay").addEventListener("change", () => this.show());
    find("opacity").addEventListener("input", () => this.show());
    for (const id of Object.keys(NEUTRAL)) find(id).addEventListener("input", () => this.#adjust());
    find("adjust").addEventListener("click", () => {
      const shown = find("adjustments").hidden;
      find("adjustments").hidden = !shown;
      find("adjust").setAttribute("aria-expanded", String(shown));
    });
    find("adjust-reset").addEventListener("click", () => {
      for (const [id, value] of Object.entries(NEUTRAL)) find(id).value = value;
      this.#adjust();
    });
  }

  /** Go to the next stage. */
  next() {
    find("overlay").selectedIndex = (find("overlay").selectedIndex + 1) % STAGES.length;
    this.show();
    this.#labelling.say(`Overlay: ${find("overlay").value}.`);
  }

  /** Lay the chosen stage over the photo. */
  async show() {
    const stage = find("overlay").value;
    const opacity = Number(find("opacity").value);
    const { document } = this.#labelling;
    if (stage === "none" || !document) return this.#photo.lay(null, opacity);
    try {
      const layer = await picture(`api/photos/${document.id}/stages/${stage}`);
      if (this.#labelling.document.id === document.id && find("overlay").value === stage) this.#photo.lay(layer, opacity);
    } catch (error) {
      find("overlay").selectedIndex = 0;
      this.#photo.lay(null, opacity);
      this.#labelling.say(error.message, true);
    }
  }

  #adjust() {
    this.#photo.adjust(Object.fromEntries(Object.keys(NEUTRAL).map((id) => [id, Number(find(id).value)])));
  }
}
