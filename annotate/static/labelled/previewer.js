/**
 * Asks for previews: at most one question is on its way, and only the latest is asked next. Each answer is shown,
 * so that a preview follows a hand that never rests.
 */

import { ApiError, post } from "../server/api.js";

/** @import { Labelling } from "./labelling.js" */
/** @import { Document, Part, Pixel, Rough } from "../types.js" */
/** @typedef {{what: "preview" | "guide", body: Pixel | Rough}} Wanted - The line through a pixel, or along a guide. */

/** Shows a line before it is chosen: the one through a pixel, or along a guide. */
export class Previewer {
  #labelling;
  #show;
  /** @type {Wanted | null} */
  #wanted = null; // what is to be shown, or is shown
  /** @type {{asked: string, id: number, revision: number, part: Part} | null} */
  #last = null;
  #busy = false;
  #drops = 0; // how often nothing was to be shown any more

  /**
   * @param {Labelling} labelling
   * @param {(part: Part | null) => void} show
   */
  constructor(labelling, show) {
    this.#labelling = labelling;
    this.#show = show;
    labelling.on("document", ({ fresh }) => {
      if (fresh) this.clear();
      if (!this.#last || this.#fits(this.#last)) return;
      this.#last = null; // it is of another line
      show(null);
    });
  }

  /**
   * The part that an anchor or a guide would change, when it is the last one that was shown; else null.
   *
   * @param {Wanted["what"]} what
   * @param {Pixel | Rough} body
   */
  known(what, body) {
    const last = this.#last;
    return last && last.asked === JSON.stringify({ what, body }) && this.#fits(last) ? last.part : null;
  }

  /**
   * Ask for the line through a pixel, or through the best edge some rows away; `lifted` is the column of the anchor
   * that is dragged.
   *
   * @param {number} column
   * @param {number} row
   * @param {number} [within]
   * @param {number | null} [lifted]
   */
  ask(column, row, within = 0, lifted = null) {
    this.#want({ what: "preview", body: { column, row, within, lifted } });
  }

  /**
   * Ask for the line along a guide.
   *
   * @param {Rough} rough
   */
  follow(rough) {
    this.#want({ what: "guide", body: rough });
  }

  /** Show nothing any more, whatever is still answered. */
  clear() {
    this.#drops++;
    this.#wanted = null;
    this.#last = null;
    this.#show(null);
  }

  /** @param {Wanted} wanted */
  #want(wanted) {
    this.#wanted = wanted;
    if (!this.#busy) this.#work();
  }

  async #work() {
    this.#busy = true;
    let asked = null;
    while (this.#wanted && this.#wanted !== asked && this.#labelling.document) {
      asked = this.#wanted;
      await this.#answer(asked, this.#labelling.document);
    }
    this.#busy = false;
  }

  /**
   * Show the answer to a question, also where a newer one waits, unless previews have been dropped since.
   *
   * @param {Wanted} asked
   * @param {Document} document
   */
  async #answer(asked, { id, revision }) {
    const drops = this.#drops;
    try {
      const part = await post(`api/photos/${id}/${asked.what}`, asked.body);
      const found = { asked: JSON.stringify(asked), id, revision, part };
      if (this.#drops !== drops || !this.#fits(found)) return;
      this.#last = found;
      this.#show(part);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (error.status !== 422 && !error.away) this.#labelling.say(error.message, true);
      this.#show(null);
    }
  }

  /** @param {{id: number, revision: number}} of */
  #fits({ id, revision }) {
    const { document } = this.#labelling;
    return document?.id === id && document.revision === revision;
  }
}
