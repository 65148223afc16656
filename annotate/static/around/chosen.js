/** Several photos at once: chosen in the list or in the sheet, then tagged or given a status together. */

import { box, button } from "../basics/dom.js";
import { Events } from "../basics/events.js";
import { counted } from "../basics/words.js";
import { showTags } from "./dialogs.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { ShownPhoto, Status } from "../types.js" */

/**
 * The photos that are chosen, and what can be done to them. Events: `change`, and `finish` (they are given a status).
 *
 * @extends {Events<{change: undefined, finish: {photos: ShownPhoto[], status: Status}}>}
 */
export class Chosen extends Events {
  #labelling;
  #focus;
  /** @type {Set<number>} */
  #ids = new Set();
  /** @type {number | null} */
  #last = null; // from which Shift chooses
  /** @type {Set<number>} */
  #listed = new Set();
  #pressed = false; // whether fingers choose: each tap does, until none is chosen

  /**
   * @param {Labelling} labelling
   * @param {() => void} focus - Gives the keys to what is worked on.
   */
  constructor(labelling, focus) {
    super();
    this.#labelling = labelling;
    this.#focus = focus;
    const buttons = /** @type {const} */ ({ "chosen-accept": "accepted", "chosen-review": "needs review", "chosen-reject": "rejected" });
    for (const [id, status] of Object.entries(buttons)) button(id).addEventListener("click", () => this.finish(status));
    button("chosen-tags").addEventListener("click", () => this.tag());
    button("chosen-clear").addEventListener("click", () => this.clear());
  }

  /** @param {number} id */
  has(id) {
    return this.#ids.has(id);
  }

  /** The chosen photos, as they are listed. */
  get photos() {
    return this.#labelling.photos.filter(({ id }) => this.#ids.has(id));
  }

  /**
   * A click with Ctrl chooses a photo or leaves it out; with Shift all up to it.
   *
   * @param {number} id
   * @param {boolean} range
   * @param {ShownPhoto[]} among - In their order.
   */
  toggle(id, range, among) {
    const [from, to] = [this.#last, id].map((one) => among.findIndex((photo) => photo.id === one));
    if (range && from >= 0 && to >= 0) {
      for (const photo of among.slice(Math.min(from, to), Math.max(from, to) + 1)) this.#ids.add(photo.id);
    } else if (!this.#ids.delete(id)) this.#ids.add(id);
    this.#last = id;
    this.#changed();
  }

  /**
   * A finger rests on a photo: it is chosen or left out, and from now on taps choose, too.
   *
   * @param {number} id
   * @param {ShownPhoto[]} among - In their order.
   */
  press(id, among) {
    this.#pressed = true;
    this.toggle(id, false, among);
  }

  /**
   * Whether a click means that a photo is chosen, and not opened.
   *
   * @param {MouseEvent} event
   */
  means({ ctrlKey, metaKey, shiftKey }) {
    return ctrlKey || metaKey || shiftKey || this.#pressed;
  }

  /** Choose none. */
  clear() {
    this.#ids.clear();
    this.#changed();
  }

  /**
   * Others are listed now: whoever decides about chosen photos is told how many of them are not seen.
   *
   * @param {ShownPhoto[]} photos
   */
  list(photos) {
    this.#listed = new Set(photos.map(({ id }) => id));
    this.#showCount();
  }

  /**
   * Give all of them a status.
   *
   * @param {Status} status
   */
  finish(status) {
    const { photos } = this;
    this.clear();
    this.tell("finish", { photos, status });
  }

  /** Tags that all of them have are ticked; what is ticked then is ticked for all. */
  tag() {
    const { photos } = this;
    if (!photos.length) return;
    const tags = photos[0].tags.filter((tag) => photos.every((photo) => photo.tags.includes(tag)));
    showTags(this.#labelling, { name: counted(photos.length, "photo"), tags }, (tag, on) => {
      for (const photo of photos) this.#labelling.tag(photo, tag, on);
    });
  }

  #changed() {
    this.#pressed &&= this.#ids.size > 0;
    const focused = box("chosen").contains(document.activeElement);
    box("chosen").hidden = !this.#ids.size;
    if (focused && !this.#ids.size) this.#focus(); // not lost with the button
    this.#showCount();
    this.tell("change");
  }

  #showCount() {
    const away = [...this.#ids].filter((id) => !this.#listed.has(id)).length;
    box("chosen-count").textContent = `${counted(this.#ids.size, "photo")} chosen${away ? `, ${away} not listed` : ""}`;
  }
}
