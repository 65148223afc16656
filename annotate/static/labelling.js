/** The photo that is labelled, and what is on its way to the server. */

import { ApiError, get, picture, post } from "./api.js";

const RETRY = [500, 1000, 2000, 4000, 8000]; // milliseconds

/**
 * Holds the list of photos, the current document and a queue of operations, which are sent one at a
 * time and in order. Events: `list`, `document`, `margins`, `saving`, `said` (detail: {text, bad}).
 */
export class Labelling extends EventTarget {
  photos = [];
  progress = null;
  tags = [];
  folder = "";
  annotator = "";
  document = null;
  bitmap = null;
  margins = null;
  #queue = [];
  #sending = false;
  #ahead = new Map();
  #opening = 0;

  /** Read the list of photos. */
  async load() {
    const list = await get("api/photos");
    Object.assign(this, { photos: list.photos, progress: list.progress, tags: list.tags });
    this.folder = list.folder;
    this.annotator = list.number > 1 ? `${list.annotator}, pass ${list.number}` : list.annotator;
    this.#tell("list");
  }

  /** Place of the current photo in the list, from 0. */
  get place() {
    return this.photos.findIndex((photo) => photo.id === this.document?.id);
  }

  /** Number of operations that the server has not acknowledged. */
  get waiting() {
    return this.#queue.length;
  }

  /** Show a photo, once everything before is saved. */
  async open(id) {
    const turn = ++this.#opening;
    await this.settled();
    let ready;
    try {
      ready = await (this.#ahead.get(id) ?? this.#fetch(id));
      const current = await get(`api/photos/${id}`); // cheap, and never an old revision
      ready = { ...ready, document: current };
    } catch (error) {
      this.#ahead.delete(id);
      if (turn === this.#opening) this.say(error.message, true);
      return false;
    }
    if (turn !== this.#opening) return false;
    this.#ahead.clear();
    this.document = ready.document;
    this.bitmap = ready.bitmap;
    this.margins = null;
    this.#tell("document", { fresh: true });
    this.#measure();
    this.apply({ kind: "open" });
    const next = this.following();
    if (next) this.#ahead.set(next.id, this.#fetch(next.id).catch((error) => this.#forget(next.id, error)));
    return true;
  }

  /** The next photo that is to do; undefined when all are done. */
  following() {
    const from = this.place + 1;
    return [...this.photos.slice(from), ...this.photos.slice(0, Math.max(from - 1, 0))]
      .find((photo) => photo.status === "to do" && !photo.missing && !photo.too_large);
  }

  /** Do an operation; what it will look like may be shown at once. */
  apply(operation, part = null) {
    this.#send("operations", { operation }, part);
  }

  /** Take the last edit back. */
  undo() {
    this.#send("undo", {});
  }

  /** Do again what was taken back. */
  redo() {
    this.#send("redo", {});
  }

  /** Wait until everything is acknowledged. */
  async settled() {
    while (this.#queue.length) await new Promise((done) => this.addEventListener("saving", done, { once: true }));
  }

  /** Tell the person something, on the page and to screen readers. */
  say(text, bad = false) {
    this.#tell("said", { text, bad });
  }

  #send(what, body, part = null) {
    if (!this.document) return;
    if (part?.rows.length && this.document.rows) {
      this.document.rows.splice(part.first, part.rows.length, ...part.rows);
      this.#tell("document", {});
    }
    this.#queue.push({ id: this.document.id, what, body });
    this.#tell("saving");
    if (!this.#sending) this.#work();
  }

  async #work() {
    this.#sending = true;
    let tries = 0;
    while (this.#queue.length) {
      const { id, what, body } = this.#queue[0];
      try {
        const found = await post(`api/photos/${id}/${what}`, { revision: this.document.revision, ...body });
        tries = 0;
        this.#queue.shift();
        this.#took(found);
      } catch (error) {
        if (!(error instanceof ApiError)) throw error;
        if (error.status === 0) {
          this.say(`${error.message} Your last ${this.#queue.length === 1 ? "edit is" : "edits are"} not saved yet.`, true);
          this.#tell("saving");
          await new Promise((done) => setTimeout(done, RETRY[Math.min(tries++, RETRY.length - 1)]));
          continue;
        }
        this.#queue.length = 0; // later ones were made on what was refused
        this.say(error.message, true);
        await this.#reload(id);
      }
      this.#tell("saving");
    }
    this.#sending = false;
  }

  #took(found) {
    if (found.id !== this.document.id) return;
    if (this.#queue.length) found.rows = this.document.rows; // what waits is shown already
    const changed = found.revision !== this.document.revision;
    this.document = found;
    const listed = this.photos.find((photo) => photo.id === found.id);
    if (listed && (listed.status !== found.status || listed.tags.length !== found.tags.length)) {
      Object.assign(listed, { status: found.status, tags: found.tags });
      this.load().catch((error) => this.say(error.message, true)); // progress and times
    }
    this.#tell("document", {});
    if (changed) this.#measure();
  }

  async #reload(id) {
    try {
      const found = await get(`api/photos/${id}`);
      if (id !== this.document.id) return;
      this.document = found;
      this.#tell("document", {});
      this.#measure();
    } catch (error) {
      this.say(error.message, true);
    }
  }

  async #measure() {
    const { id, revision, blind } = this.document;
    if (blind) return;
    try {
      const found = await get(`api/photos/${id}/margins`);
      if (this.document.id !== id || this.document.revision > revision) return;
      this.margins = found;
      this.#tell("margins");
    } catch {
      // margins are a help; the line itself is told about elsewhere
    }
  }

  async #fetch(id) {
    const [found, bitmap] = await Promise.all([get(`api/photos/${id}`), picture(`api/photos/${id}/image`)]);
    return { document: found, bitmap };
  }

  #forget(id, error) {
    this.#ahead.delete(id);
    throw error;
  }

  #tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}
