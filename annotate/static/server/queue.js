/**
 * What was done and is not acknowledged yet: sent one at a time, in order, each exactly once.
 *
 * Every operation has an id of its own, by which the server knows it again. So it is sent until an
 * answer says that it is kept or refused, whatever happens on the way. What is refused is named in
 * `lost`, and the rest goes on.
 */

import { Events } from "../basics/events.js";
import { ApiError, post } from "./api.js";
import { isAccept, senseless } from "./senseless.js";

/** @import { Shelf } from "./shelf.js" */
/** @import { Document, Operation } from "../types.js" */

const RETRY = [500, 1000, 2000, 4000, 8000]; // milliseconds between attempts
const PATIENCE = [10_000, 20_000, 40_000, 60_000]; // within which an attempt must be answered
const REFUSED = new Set([400, 403, 404, 405, 409, 410, 413, 415, 422]); // asking again changes nothing

/**
 * @typedef {object} Item
 * @property {string} id - By which the server knows it again.
 * @property {number} photo - The photo it is for, whatever is shown by now.
 * @property {string} name - Of the photo.
 * @property {"operations" | "undo" | "redo"} what
 * @property {Operation | null} operation - With `operations`.
 * @property {number} revision - That it was made on; -1 for any.
 * @property {string} says - What it is, for people.
 * @property {string} chain - Of the operations of a chain, each was made on what the one before it left.
 * @property {boolean} [quiet] - Nothing that somebody did: not counted, not kept over a reload, not missed.
 */

/** @typedef {{photo: number, name: string, says: string, reason: string, at: number}} Lost - What is not kept, why, and since when. */

/** An id that nothing else has; also where the page is not on this machine, and `randomUUID` is missing. */
export function newId() {
  if (crypto.randomUUID) return crypto.randomUUID();
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/**
 * @typedef {object} Told
 * @property {undefined} change - Of `waiting`, `reason` or `lost`.
 * @property {{item: Item, document: Document}} kept
 * @property {{item: Item, reason: string}} lost
 * @property {{photo: number, name: string}} stale - The photo was changed elsewhere.
 */

/**
 * Sends what was done.
 *
 * @extends {Events<Told>}
 */
export class Queue extends Events {
  /** @type {Lost[]} What could not be kept, oldest first. */
  lost = [];
  /** Why what waits is still waiting; empty while it is on its way. */
  reason = "";
  /** @type {Item[]} */
  #items = [];
  /** @type {Map<string, (document: Document | null) => void>} */
  #ends = new Map(); // by id: what is told when an item is kept or lost
  /** @type {Shelf | null} */
  #shelf = null;
  #working = false;
  /** @type {(value?: unknown) => void} */
  #wake = () => {};
  #pause;
  #patience;

  /**
   * @param {object} [how]
   * @param {(milliseconds: number) => Promise<unknown>} [how.pause] - Waits before another attempt.
   * @param {number[]} [how.patience] - How long each attempt may take.
   */
  constructor({ pause = (time) => new Promise((done) => setTimeout(done, time)), patience = PATIENCE } = {}) {
    super();
    this.#pause = pause;
    this.#patience = patience;
  }

  /** Number of operations that are not acknowledged. */
  get waiting() {
    return this.#items.filter((item) => !item.quiet).length;
  }

  /**
   * Operations on a photo that are not acknowledged, oldest first.
   *
   * @param {number} photo
   */
  of(photo) {
    return this.#items.filter((item) => item.photo === photo && !item.quiet);
  }

  /**
   * Keep what waits on a shelf as well.
   *
   * @param {Shelf} shelf
   */
  use(shelf) {
    this.#shelf = shelf;
    this.#changed();
  }

  /** Take over what pages that are gone have left on the shelf. */
  async recover() {
    if (!this.#shelf) return;
    const { items, lost } = await this.#shelf.orphans();
    if (!items.length && !lost.length) return;
    const known = new Set(this.#items.map((item) => item.id));
    this.#items.push(...items.filter((item) => !known.has(item.id)));
    this.lost.push(...lost);
    this.#changed();
    this.#work();
  }

  /**
   * Send an operation when its turn has come.
   *
   * @param {Omit<Item, "id" | "chain" | "operation"> & {operation?: Operation | null}} made
   * @returns {Promise<Document | null>} The photo's document once it is kept; null when it is refused.
   */
  add(made) {
    const chain = this.of(made.photo).at(-1)?.chain ?? newId();
    const item = { id: newId(), chain, operation: null, ...made };
    /** @type {Promise<Document | null>} */
    const ended = new Promise((done) => this.#ends.set(item.id, done));
    this.#items.push(item);
    this.#changed();
    this.#work();
    return ended;
  }

  /** Wait until nothing waits. */
  async settled() {
    while (this.#items.length) await new Promise((done) => this.on("change", done, { once: true }));
  }

  /** Try again now: the network is back. */
  wake() {
    this.#wake();
  }

  /** Forget what was named as not kept. */
  forget() {
    this.lost = [];
    this.#changed();
  }

  async #work() {
    if (this.#working) return;
    this.#working = true;
    let tries = 0;
    try {
      while (this.#items.length) {
        const item = this.#items[0];
        try {
          this.#keep(item, await this.#send(item, tries));
          tries = 0;
        } catch (caught) {
          const error = ApiError.of(caught);
          if (!this.#refused(item, error)) {
            this.reason = error.message;
            this.#changed();
            await this.#rest(RETRY[Math.min(tries++, RETRY.length - 1)]);
          }
        }
      }
    } finally {
      this.#working = false;
    }
  }

  /**
   * @param {Item} item
   * @param {number} tries
   */
  async #send(item, tries) {
    const { id, revision, operation } = item;
    const body = operation ? { id, revision, operation } : { id, revision };
    const patience = this.#patience[Math.min(tries, this.#patience.length - 1)];
    const document = await post(`api/photos/${item.photo}/${item.what}`, body, { patience });
    if (document?.id !== item.photo || !Number.isInteger(document.revision)) {
      throw new ApiError(0, "The server answers something else than what was asked."); // no acknowledgement
    }
    return document;
  }

  /**
   * @param {Item} item
   * @param {Document} document
   */
  #keep(item, document) {
    const kept = document.kept ?? document.revision;
    this.#drop([item]);
    // what was done after it was done on it, and not on what another tab has made of it since
    if (!item.quiet) for (const next of this.#after(item)) next.revision = kept;
    this.reason = "";
    this.#changed();
    this.tell("kept", { item, document });
    this.#end(item, document);
  }

  /**
   * Deal with a refusal; false where there was none, so that the item has to be sent again.
   *
   * @param {Item} item
   * @param {ApiError} error
   */
  #refused(item, error) {
    if (!REFUSED.has(error.status)) return false;
    this.reason = "";
    const waiting = this.#after(item);
    if (error.status === 409 && error.revision !== undefined && error.revision !== item.revision) {
      for (const one of waiting) one.revision = error.revision;
      this.#lose(senseless(waiting, isAccept, true), "the photo was changed meanwhile");
      this.tell("stale", { photo: item.photo, name: item.name });
    } else if (error.status === 404 || error.status === 410) {
      this.#lose(waiting, error.message);
    } else if (item.what !== "operations") {
      this.#lose([{ ...item, quiet: true }], error.message); // nothing to undo: then nothing is missed
    } else {
      this.#lose(senseless(waiting, (one) => one === item, false), error.message);
    }
    return true;
  }

  /**
   * An operation and the rest of its chain, which has not been sent yet; what another tab has left may have been.
   *
   * @param {Item} item
   */
  #after({ photo, chain }) {
    return this.#items.filter((one) => one.photo === photo && one.chain === chain);
  }

  /**
   * @param {Item[]} items
   * @param {string} reason
   */
  #lose(items, reason) {
    this.#drop(items);
    const at = Date.now();
    this.lost.push(...items.filter((item) => !item.quiet).map(({ photo, name, says }) => ({ photo, name, says, reason, at })));
    this.#changed();
    for (const item of items) {
      this.tell("lost", { item, reason });
      this.#end(item, null);
    }
  }

  /**
   * @param {Item} item
   * @param {Document | null} document
   */
  #end(item, document) {
    this.#ends.get(item.id)?.(document);
    this.#ends.delete(item.id);
  }

  /** @param {Item[]} items */
  #drop(items) {
    const ids = new Set(items.map((item) => item.id));
    this.#items = this.#items.filter((item) => !ids.has(item.id));
  }

  /** @param {number} time */
  async #rest(time) {
    await Promise.race([this.#pause(time), new Promise((done) => (this.#wake = done))]);
    this.#wake = () => {};
  }

  #changed() {
    this.#shelf?.put(this.#items.filter((item) => !item.quiet), this.lost);
    this.tell("change");
  }
}
