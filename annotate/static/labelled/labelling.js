/** The photos of the folder, the one that is labelled, and what is done to it. */

import { Events } from "../basics/events.js";
import { described } from "../basics/operations.js";
import { ApiError, get, me, picture } from "../server/api.js";
import { Queue } from "../server/queue.js";

/** @import { Item } from "../server/queue.js" */
/** @import { Document, Legend, Margins, Operation, Part, ShownPhoto, ShownProgress, Status } from "../types.js" */

const OPENING = 300_000; // milliseconds that the first look at a large photo may take

/** @typedef {{document: Document, bitmap: ImageBitmap}} Ready */
/** @typedef {() => void} Undo - Takes back what was said. */
/** @typedef {{words: string, run: () => unknown}} Choice - What can be added to what was said. */

/**
 * @typedef {object} Told
 * @property {Legend} legend - Words and colours are known.
 * @property {undefined} list
 * @property {{fresh: boolean}} document - `fresh`: another photo.
 * @property {{before: Status | undefined, now: Document, item: Item}} status - The status that a photo had, seen
 *   or not, and its document since an operation was acknowledged.
 * @property {undefined} margins
 * @property {undefined} loading
 * @property {undefined} did - An operation is sent.
 * @property {{text: string, bad: boolean, undo: Undo | null, choices: Choice[]}} said
 */

/**
 * Holds the list of photos and the current document, which follows what the queue gets acknowledged.
 *
 * @extends {Events<Told>}
 */
export class Labelling extends Events {
  /** @type {Legend | null} */
  legend = null;
  /** @type {ShownPhoto[]} */
  photos = [];
  /** @type {ShownProgress | null} */
  progress = null;
  folder = "";
  annotator = "";
  /** @type {Status} - Status of the photos that are to be worked on. */
  ahead = "to do";
  /** @type {Document | null} */
  document = null;
  /** @type {ImageBitmap | null} */
  bitmap = null;
  /** @type {Margins | null} */
  margins = null;
  /** Name of the photo that is on its way; empty while none is. */
  loading = "";
  queue = new Queue();
  /** @type {{rows: number[] | null} | null} */
  #acknowledged = null; // what is acknowledged while the document shows more than that
  /** @type {Map<number, Status>} */
  #statuses = new Map(); // by id: the status that was acknowledged last
  /** @type {Map<number, Promise<Ready | null>>} */
  #ahead = new Map();
  #opening = 0;
  #sought = 0; // id of the photo that was asked for last

  constructor() {
    super();
    this.queue.on("kept", (kept) => this.#took(kept.item, kept.document));
    this.queue.on("lost", (lost) => this.#lost(lost));
    this.queue.on("stale", (stale) => this.#stale(stale));
  }

  /** Read the legend, once, and the list of photos. */
  async load() {
    if (!this.legend) {
      this.legend = await get("api/legend");
      this.tell("legend", this.legend);
    }
    const list = await get("api/photos");
    this.photos = list.photos;
    this.progress = list.progress;
    this.folder = list.folder;
    this.ahead = list.ahead;
    this.annotator = list.number > 1 ? `${list.annotator}, pass ${list.number}` : list.annotator;
    this.tell("list");
  }

  /** Which pass over which folder this is, for what is kept in the browser. */
  get pass() {
    return me.pass;
  }

  /** Number of operations that the server has not acknowledged. */
  get waiting() {
    return this.queue.waiting;
  }

  /** Place in the list, from 0, of the photo that is on its way, or else of the current one. */
  get place() {
    const sought = this.loading ? this.#sought : this.document?.id;
    return this.photos.findIndex((photo) => photo.id === sought);
  }

  /**
   * Show a photo; what waits for another one is sent meanwhile.
   *
   * @param {number} id
   * @returns {Promise<boolean>} Whether it is shown.
   */
  async open(id) {
    const turn = ++this.#opening;
    this.#sought = id;
    this.loading = this.photos.find((photo) => photo.id === id)?.name ?? "photo";
    this.tell("loading");
    let ready;
    try {
      const { bitmap } = (await this.#ahead.get(id)) ?? (await this.#read(id));
      ready = { bitmap, document: await get(`api/photos/${id}`, { patience: OPENING }) }; // never an old revision
    } catch (error) {
      if (turn === this.#opening) this.#cannotOpen(ApiError.of(error));
      return false;
    }
    if (turn !== this.#opening) return false;
    this.#show(ready);
    return true;
  }

  /** The next photo that is to be worked on; undefined when all are done. */
  following() {
    const from = this.place + 1;
    return [...this.photos.slice(from), ...this.photos.slice(0, Math.max(from - 1, 0))]
      .find((photo) => photo.status === this.ahead && !photo.missing && !photo.too_large);
  }

  /**
   * Do an operation on the photo that is shown; what it will look like may be shown at once.
   *
   * @param {Operation} operation
   * @param {Part | null} [part]
   */
  apply(operation, part = null) {
    if (!this.document || this.loading) return null;
    if (part?.rows.length && this.document.rows) {
      this.#acknowledged ??= { rows: [...this.document.rows] };
      this.document.rows.splice(part.first, part.rows.length, ...part.rows);
      this.tell("document", { fresh: false });
    }
    return this.send(this.document, { what: "operations", operation, says: described(operation) });
  }

  /**
   * Do something to a photo, shown or not; the promise is that of `Queue.add`.
   *
   * @param {{id: number, name: string, revision?: number}} photo
   * @param {Pick<Item, "what" | "says"> & {operation?: Operation}} act
   */
  send({ id, name, revision = -1 }, act) {
    this.tell("did");
    return this.queue.add({ photo: id, name, revision, ...act });
  }

  /**
   * Put a tag on a photo, or take it off, whatever its revision is by then: a tag fits any.
   *
   * @param {{id: number, name: string}} photo
   * @param {string} tag
   * @param {boolean} on
   */
  tag({ id, name }, tag, on) {
    return this.send({ id, name }, { what: "operations", operation: { kind: "tag", tag, on }, says: `the tag “${tag}”` });
  }

  /**
   * Tell the person something, on the page and to screen readers.
   *
   * @param {string} text
   * @param {boolean} [bad]
   * @param {Undo | null} [undo]
   * @param {Choice[]} [choices]
   */
  say(text, bad = false, undo = null, choices = []) {
    this.tell("said", { text, bad, undo, choices });
  }

  /**
   * Reasons to choose from, each of which becomes a tag of a photo. They are taken later, when the photo may have
   * another revision, and a tag fits any.
   *
   * @param {{id: number, name: string}} photo
   * @param {readonly string[]} tags - None where none is offered.
   * @returns {Choice[]}
   */
  reasons({ id, name }, tags) {
    return tags.map((tag) => ({
      words: tag,
      run: () => {
        this.tag({ id, name }, tag, true);
        this.say(`${name} has the tag “${tag}”.`);
      },
    }));
  }

  /** @param {Ready} ready */
  #show({ document, bitmap }) {
    this.#ahead.clear();
    this.loading = "";
    this.document = document;
    this.bitmap = bitmap;
    this.margins = this.#acknowledged = null;
    this.tell("document", { fresh: true });
    this.tell("loading");
    this.#measure(document);
    this.queue.add({ photo: document.id, name: document.name, what: "operations", operation: { kind: "open" }, revision: -1, says: "open", quiet: true });
    const next = this.following();
    if (next) this.#ahead.set(next.id, this.#read(next.id).catch(() => null)); // asked for again when it is opened
  }

  /** @param {ApiError} error */
  #cannotOpen(error) {
    this.loading = "";
    this.tell("loading");
    this.say(error.message, true);
    if (error.status === 410) this.load().catch(() => {}); // it is listed as missing
  }

  /**
   * @param {Item} item
   * @param {Document} found
   */
  #took(item, found) {
    const shown = found.id === this.document?.id ? this.document : null;
    const before = shown?.status ?? this.#statuses.get(found.id) ?? this.photos.find(({ id }) => id === found.id)?.status;
    this.#statuses.set(found.id, found.status);
    this.#relist(found);
    if (shown) this.#renew(shown, found);
    if (before !== found.status) this.tell("status", { before, now: found, item });
  }

  /** @param {Document} found */
  #relist({ id, status, tags, nothing_visible }) {
    const listed = this.photos.find((photo) => photo.id === id);
    if (!listed || (listed.status === status && String(listed.tags) === String(tags))) return;
    Object.assign(listed, { status, tags, nothing_visible });
    this.tell("list");
    this.load().catch(() => {}); // progress and times; they come with the next one, too
  }

  /**
   * Show the photo that is shown as it is now.
   *
   * @param {Document} before
   * @param {Document} found
   */
  #renew(before, found) {
    if (this.#acknowledged && this.queue.of(found.id).length) { // what waits is shown already
      this.#acknowledged = { rows: found.rows };
      found.rows = before.rows;
    } else this.#acknowledged = null;
    this.document = found;
    this.tell("document", { fresh: false });
    if (found.revision !== before.revision) this.#measure(found);
  }

  /** @param {{item: Item, reason: string}} lost */
  #lost({ item, reason }) {
    const shown = item.photo === this.document?.id ? this.document : null;
    if (shown) {
      if (this.#acknowledged) { // what was shown ahead of its time does not come
        shown.rows = this.#acknowledged.rows;
        this.#acknowledged = null;
        this.tell("document", { fresh: false });
      }
      this.#reload(item.photo);
    }
    const sentence = `${reason}${reason.endsWith(".") ? "" : "."}`;
    if (!item.quiet) this.say(`${item.name}: ${item.says} is not kept: ${sentence}`, true);
    else if (shown) this.say(sentence, true);
  }

  /** @param {{photo: number, name: string}} changed */
  #stale({ photo, name }) {
    const left = this.queue.of(photo).length;
    const again = left ? "; what you did since is sent on top of it" : "";
    this.say(`${name} was changed in another tab, and is shown as it is now${again}.`, true);
    if (photo === this.document?.id) this.#reload(photo);
  }

  /** @param {number} id */
  async #reload(id) {
    try {
      const found = await get(`api/photos/${id}`);
      if (!this.document || id !== this.document.id || found.revision < this.document.revision) return;
      this.document = found;
      this.#acknowledged = null;
      this.tell("document", { fresh: false });
      this.#measure(found);
    } catch {
      // why is said where it matters: what waits is not kept, or is sent on
    }
  }

  /** @param {Document} shown */
  async #measure({ id, revision, blind }) {
    if (blind) return;
    try {
      const found = await get(`api/photos/${id}/margins`);
      if (this.document?.id !== id || this.document.revision > revision) return;
      this.margins = found;
      this.tell("margins");
    } catch {
      // margins are a help; the line itself is told about elsewhere
    }
  }

  /**
   * @param {number} id
   * @returns {Promise<Ready>}
   */
  async #read(id) {
    const [document, bitmap] = await Promise.all([
      get(`api/photos/${id}`, { patience: OPENING }), picture(`api/photos/${id}/image`, { patience: OPENING })]);
    return { document, bitmap };
  }
}
