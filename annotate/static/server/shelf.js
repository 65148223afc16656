/**
 * What waits is kept in the browser until it is acknowledged, so that it outlives a reload or a crash.
 *
 * Each tab has a place of its own, by pass and tab, and holds a lock as long as it lives: what a tab
 * left behind is taken over by another one, and what a living tab has is not. Where there are no locks
 * (a page that is not on this machine), a tab says every now and then that it lives. Taking over what
 * is not left after all does no harm: the server knows each operation by its id.
 */

import { newId } from "./queue.js";

/** @import { Item, Lost } from "./queue.js" */
/** @typedef {{items: Item[], lost: Lost[]}} Held - What waits, and what is not kept. */
/** @typedef {Held & {folder: string, seen: number, left: boolean}} Entry - What a tab keeps. */

const PREFIX = "skyline-queue";
/** Milliseconds between two signs of life. */
export const ALIVE = 20_000;
const DEAD = 150_000; // without one; the timers of a tab in the background may be a minute late

/** A shelf for what waits in this tab. */
export class Shelf {
  #storage;
  #locks;
  #pass;
  #folder;
  #tab = newId();
  /** @type {Held} */
  #held = { items: [], lost: [] };
  /** @type {Set<string | undefined>} */
  #living = new Set();

  /**
   * @param {object} where
   * @param {string} where.pass
   * @param {string} where.folder
   * @param {Pick<Storage, "getItem" | "setItem" | "removeItem">} where.storage
   * @param {Pick<LockManager, "request" | "query">} [where.locks]
   */
  constructor({ pass, folder, storage, locks }) {
    this.#storage = storage;
    this.#locks = locks;
    this.#pass = pass;
    this.#folder = folder;
    locks?.request(`${PREFIX}/${this.#tab}`, () => new Promise(() => {})).catch(() => {}); // held until the page is gone
  }

  /**
   * Keep this; false where the browser keeps nothing, or no more.
   *
   * @param {Item[]} items
   * @param {Lost[]} lost
   */
  put(items, lost) {
    this.#held = { items, lost };
    return this.#write(false);
  }

  /** Say that this tab lives, where that cannot be seen by its lock. */
  live() {
    if (!this.#locks && this.#held.items.length) this.#write(false);
  }

  /** The page is being left. */
  leave() {
    if (!this.#locks) this.#write(true);
  }

  /** What tabs of this pass have left behind. It is on this shelf alone from now on. */
  async orphans() {
    /** @type {Held} */
    const found = { items: [], lost: [] };
    if (this.#locks) {
      const { held = [] } = await this.#locks.query();
      this.#living = new Set(held.map((lock) => lock.name));
    }
    for (const [key, entry] of this.#entries()) {
      const [, pass, tab] = key.split("/");
      if (pass !== this.#pass || tab === this.#tab || this.#lives(tab, entry)) continue;
      found.items.push(...entry.items);
      found.lost.push(...entry.lost);
      const taken = this.put([...this.#held.items, ...entry.items], [...this.#held.lost, ...entry.lost]);
      if (taken) this.#storage.removeItem(key);
    }
    return found;
  }

  /** What waits for other folders or annotators: {folder, count} each. */
  elsewhere() {
    return [...this.#entries()]
      .filter(([key, { items }]) => key.split("/")[1] !== this.#pass && items.length)
      .map(([, { folder, items }]) => ({ folder, count: items.length }));
  }

  /**
   * @param {string} tab
   * @param {Entry} entry
   */
  #lives(tab, entry) {
    if (this.#locks) return this.#living.has(`${PREFIX}/${tab}`);
    return !entry.left && Date.now() - entry.seen < DEAD;
  }

  /** @param {boolean} left */
  #write(left) {
    const key = `${PREFIX}/${this.#pass}/${this.#tab}`;
    try {
      if (!this.#held.items.length && !this.#held.lost.length) this.#storage.removeItem(key);
      else this.#storage.setItem(key, JSON.stringify({ ...this.#held, folder: this.#folder, seen: Date.now(), left }));
      return true;
    } catch {
      return false; // full, or a browser that keeps nothing: what waits is in this page alone
    }
  }

  /** @returns {Generator<[string, Entry]>} */
  *#entries() {
    /** @type {string[]} */
    let keys = [];
    try {
      keys = Object.keys(this.#storage).filter((key) => key.startsWith(`${PREFIX}/`));
    } catch {
      // a browser that keeps nothing
    }
    for (const key of keys) {
      try {
        const entry = JSON.parse(this.#storage.getItem(key) ?? "");
        if (Array.isArray(entry.items) && Array.isArray(entry.lost)) yield [key, entry];
      } catch {
        // not ours, or gone
      }
    }
  }
}
