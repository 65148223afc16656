/** Several photos at once: chosen in the list or in the sheet, then tagged or given a status together. */

import { box, button } from "../basics/dom.js";
import { Events } from "../basics/events.js";
import { counted } from "../basics/words.js";
import { showTags } from "./dialogs.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { ShownPhoto, Status } from "../types.js" */

/**
 * The photos that are chosen, and what can be done to them. Event: `change`.
 *
 * @extends {Events<{change: undefined}>}
 */
export class Chosen extends Events {
  #labelling;
  /** @type {Set<number>} */
  #ids = new Set();
  /** @type {number | null} */
  #last = null; // from which Shift chooses

  /** @param {Labelling} labelling */
  constructor(labelling) {
    super();
    this.#labelling = labelling;
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

  /** Choose none. */
  clear() {
    this.#ids.clear();
    this.#changed();
  }

  /**
   * Give all of them a status. One Undo takes all of it back.
   *
   * @param {Status} status
   */
  async finish(status) {
    const labelling = this.#labelling;
    const photos = this.photos.filter((photo) => photo.status !== status);
    const sent = photos.map((photo) => labelling.send(photo, { what: "operations", operation: { kind: "status", status }, says: `“${status}”` }));
    this.clear();
    const kept = (await Promise.all(sent)).map((now, at) => ({ ...photos[at], revision: now?.kept ?? now?.revision ?? -1, now }))
      .filter(({ now }) => now?.status === status);
    const words = `${counted(kept.length, "photo")} ${kept.length === 1 ? "is" : "are"} ${status}.`;
    labelling.say(words, false, kept.length ? () => {
      for (const photo of kept) labelling.send(photo, { what: "undo", says: `taking back “${status}”` });
      labelling.say(`${counted(kept.length, "photo")} as before.`);
    } : null);
  }

  /** Tags that all of them have are ticked; what is ticked then is ticked for all. */
  tag() {
    const { photos } = this;
    if (!photos.length) return;
    const tags = photos[0].tags.filter((tag) => photos.every((photo) => photo.tags.includes(tag)));
    showTags(this.#labelling, { name: counted(photos.length, "photo"), tags }, (tag, on) => {
      for (const photo of photos) {
        this.#labelling.send(photo, { what: "operations", operation: { kind: "tag", tag, on }, says: `the tag “${tag}”` });
      }
    });
  }

  #changed() {
    box("chosen").hidden = !this.#ids.size;
    box("chosen-count").textContent = `${counted(this.#ids.size, "photo")} chosen`;
    this.tell("change");
  }
}
