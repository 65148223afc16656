/** The stage: the photo, the line over it, and words in place of a photo that cannot be seen. */

import { box, canvas } from "../basics/dom.js";
import { fit } from "../basics/drawing.js";
import { LineLayer } from "./line_layer.js";
import { PhotoLayer } from "./photo_layer.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { Document } from "../types.js" */
/** @import { View } from "../labelled/view.js" */

const SLOW = 250; // milliseconds: a photo that is there within a blink is not worth a word

/** Shows the document of the labelling, through a view. */
export class Stage {
  #labelling;
  #view;
  #selection;
  /** The layer of the photo. */
  photo;
  /** The layer of the line. */
  lines;

  /**
   * @param {Labelling} labelling
   * @param {View} view
   * @param {Selection} selection
   */
  constructor(labelling, view, selection) {
    this.#labelling = labelling;
    this.#view = view;
    this.#selection = selection;
    this.photo = new PhotoLayer(canvas("photo"), view);
    this.lines = new LineLayer(canvas("lines"), canvas("photo"), view, selection);
    labelling.on("document", ({ fresh }) => this.#show(fresh));
    labelling.queue.on("change", () => this.#showWaiting());
    this.#tellLoading();
    const resize = () => this.#resize();
    addEventListener("resize", resize);
    new ResizeObserver(resize).observe(box("stage"));
  }

  /**
   * Words in place of the photo; none where it can be seen.
   *
   * @param {string} words
   */
  instead(words) {
    box("empty").textContent = words;
    box("empty").hidden = !words;
  }

  /** @param {boolean} fresh */
  #show(fresh) {
    const { document: shown, bitmap, legend, loading } = this.#labelling;
    if (!shown || !bitmap || !legend) return;
    if (fresh) {
      this.#selection.clear();
      this.#view.show(shown.width, shown.height);
      this.photo.show(shown, bitmap, legend.tile);
    }
    this.lines.show(shown, legend.colours);
    this.#showWaiting();
    if (!loading) this.instead(unlabelled(shown));
  }

  #showWaiting() {
    const { document: shown, queue } = this.#labelling;
    if (shown) this.lines.showWaiting(queue.of(shown.id));
  }

  #tellLoading() {
    const tell = () => {
      const name = this.#labelling.loading;
      box("stage").classList.toggle("loading", Boolean(name));
      if (name) this.instead(`${name} is being read…`);
      else if (this.#labelling.document) this.instead(unlabelled(this.#labelling.document));
    };
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    let slow;
    this.#labelling.on("loading", () => {
      clearTimeout(slow);
      if (this.#labelling.loading) slow = setTimeout(tell, SLOW);
      else tell();
    });
  }

  #resize() {
    const { clientWidth, clientHeight } = box("stage");
    if (!clientWidth) return; // the sheet is shown
    fit(canvas("photo"));
    fit(canvas("lines"));
    this.#view.resize(clientWidth, clientHeight);
  }
}

/** @param {Document} shown */
function unlabelled({ rows }) {
  return rows ? "" : "This photo is labelled blind: nothing is proposed. Click along the skyline; anchors are joined by straight lines.";
}
