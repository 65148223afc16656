/** Asks for previews: at most one question is on its way, and only the latest is asked next. */

import { post } from "./api.js";

/** Shows the line through a pixel before it is chosen. */
export class Previewer {
  #labelling;
  #show;
  #wanted = null;
  #busy = false;
  #last = null;

  /**
   * @param {import("./labelling.js").Labelling} labelling
   * @param {(part: {first: number, rows: number[]} | null) => void} show
   */
  constructor(labelling, show) {
    this.#labelling = labelling;
    this.#show = show;
  }

  /** The part for a pixel, when it is the last one that was shown; else null. */
  known(column, row) {
    const last = this.#last;
    const { id, revision } = this.#labelling.document;
    return last?.column === column && last.row === row && last.id === id && last.revision === revision && last.lifted === null
      ? last.part : null;
  }

  /** Ask for the line through a pixel; `lifted` is the column of the anchor that is dragged. */
  ask(column, row, lifted = null) {
    this.#wanted = { column, row, lifted };
    if (!this.#busy) this.#work();
  }

  /** Show nothing any more. */
  clear() {
    this.#wanted = null;
    this.#last = null;
    this.#show(null);
  }

  async #work() {
    this.#busy = true;
    while (this.#wanted) {
      const asked = this.#wanted;
      this.#wanted = null;
      const { id, revision } = this.#labelling.document;
      try {
        const part = await post(`api/photos/${id}/preview`, asked);
        const current = this.#labelling.document;
        if (this.#wanted === null && current.id === id && current.revision === revision) {
          this.#last = { ...asked, id, revision, part };
          this.#show(part);
        }
      } catch (error) {
        if (error.status !== 422 && !error.away) this.#labelling.say(error.message, true);
        this.#show(null);
      }
    }
    this.#busy = false;
  }
}
