/** The photos of the folder, the one that is labelled, and what is done to it. */

import { get, me, picture } from "./api.js";
import { Queue } from "./queue.js";

const OPENING = 300_000; // milliseconds that the first look at a large photo may take

/**
 * Holds the list of photos and the current document, which follows what the queue gets acknowledged.
 * Events: `list`, `document` (detail.fresh: another photo), `status` (detail: {before, now, item}: the status
 * that a photo had, seen or not, and its document since an operation was acknowledged), `margins`, `loading`,
 * `did` (an operation is sent), `said` (detail: {text, bad, undo}: what to say, and what takes back what was said).
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
  /** Name of the photo that is on its way; empty while none is. */
  loading = "";
  queue = new Queue();
  #acknowledged = null; // rows of the document while it shows more than that
  #statuses = new Map(); // by id: the status that was acknowledged last
  #ahead = new Map();
  #opening = 0;

  constructor() {
    super();
    this.queue.addEventListener("kept", ({ detail }) => this.#took(detail));
    this.queue.addEventListener("lost", ({ detail }) => this.#lost(detail));
    this.queue.addEventListener("stale", ({ detail }) => this.#stale(detail));
  }

  /** Read the list of photos. */
  async load() {
    const list = await get("api/photos");
    Object.assign(this, { photos: list.photos, progress: list.progress, tags: list.tags });
    this.folder = list.folder;
    this.annotator = list.number > 1 ? `${list.annotator}, pass ${list.number}` : list.annotator;
    this.#tell("list");
  }

  /** Which pass over which folder this is, for what is kept in the browser. */
  get pass() {
    return me.pass;
  }

  /** Number of operations that the server has not acknowledged. */
  get waiting() {
    return this.queue.waiting;
  }

  /** Place of the current photo in the list, from 0. */
  get place() {
    return this.photos.findIndex((photo) => photo.id === this.document?.id);
  }

  /** Show a photo; what waits for another one is sent meanwhile. */
  async open(id) {
    const turn = ++this.#opening;
    this.loading = this.photos.find((photo) => photo.id === id)?.name ?? "photo";
    this.#tell("loading");
    let ready;
    try {
      ready = await (this.#ahead.get(id) ?? this.#fetch(id));
      ready = { ...ready, document: await get(`api/photos/${id}`, { patience: OPENING }) }; // never an old revision
    } catch (error) {
      this.#ahead.delete(id);
      if (turn === this.#opening) {
        this.loading = "";
        this.#tell("loading");
        this.say(error.message, true);
        if (error.status === 410) this.load().catch(() => {}); // it is listed as missing
      }
      return false;
    }
    if (turn !== this.#opening) return false;
    this.#ahead.clear();
    this.loading = "";
    this.document = ready.document;
    this.bitmap = ready.bitmap;
    this.margins = this.#acknowledged = null;
    this.#tell("document", { fresh: true });
    this.#tell("loading");
    this.#measure();
    this.queue.add({ photo: id, name: this.document.name, what: "operations", operation: { kind: "open" }, revision: -1, says: "open", quiet: true });
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

  /** Do an operation on the photo that is shown; what it will look like may be shown at once. */
  apply(operation, part = null) {
    if (!this.document || this.loading) return null;
    if (part?.rows.length && this.document.rows) {
      this.#acknowledged ??= [...this.document.rows];
      this.document.rows.splice(part.first, part.rows.length, ...part.rows);
      this.#tell("document", {});
    }
    return this.send(this.document, { what: "operations", operation, says: described(operation) });
  }

  /**
   * Do something to a photo, shown or not; the promise is that of `Queue.add`.
   *
   * @param {{id: number, name: string, revision?: number}} photo
   * @param {{what: string, operation?: object, says: string}} act
   */
  send({ id, name, revision = -1 }, act) {
    this.#tell("did");
    return this.queue.add({ photo: id, name, revision, ...act });
  }

  /** Tell the person something, on the page and to screen readers. */
  say(text, bad = false, undo = null) {
    this.#tell("said", { text, bad, undo });
  }

  #took({ item, document: found }) {
    const listed = this.photos.find((photo) => photo.id === found.id);
    const shown = found.id === this.document?.id;
    const status = shown ? this.document.status : this.#statuses.get(found.id) ?? listed?.status;
    this.#statuses.set(found.id, found.status);
    if (listed && (listed.status !== found.status || String(listed.tags) !== String(found.tags))) {
      Object.assign(listed, { status: found.status, tags: found.tags });
      this.#tell("list");
      this.load().catch(() => {}); // progress and times; they come with the next one, too
    }
    if (shown) this.#show(found);
    if (status !== found.status) this.#tell("status", { before: status, now: found, item });
  }

  /** Show the photo that is shown as it is now. */
  #show(found) {
    const before = this.document;
    if (this.#acknowledged && this.queue.of(found.id).length) { // what waits is shown already
      this.#acknowledged = found.rows;
      found.rows = before.rows;
    } else this.#acknowledged = null;
    this.document = found;
    this.#tell("document", {});
    if (found.revision !== before.revision) this.#measure();
  }

  #lost({ item, reason }) {
    if (item.photo === this.document?.id) {
      if (this.#acknowledged) { // what was shown ahead of its time does not come
        this.document.rows = this.#acknowledged;
        this.#acknowledged = null;
        this.#tell("document", {});
      }
      this.#reload(item.photo);
    }
    const sentence = `${reason}${reason.endsWith(".") ? "" : "."}`;
    if (!item.quiet) this.say(`${item.name}: ${item.says} is not kept: ${sentence}`, true);
    else if (item.photo === this.document?.id) this.say(sentence, true);
  }

  #stale({ photo, name }) {
    const left = this.queue.of(photo).length;
    const again = left ? "; what you did since is sent on top of it" : "";
    this.say(`${name} was changed in another tab, and is shown as it is now${again}.`, true);
    if (photo === this.document?.id) this.#reload(photo);
  }

  async #reload(id) {
    try {
      const found = await get(`api/photos/${id}`);
      if (id !== this.document.id || found.revision < this.document.revision) return;
      this.document = found;
      this.#acknowledged = null;
      this.#tell("document", {});
      this.#measure();
    } catch {
      // why is said where it matters: what waits is not kept, or is sent on
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
    const [found, bitmap] = await Promise.all([
      get(`api/photos/${id}`, { patience: OPENING }), picture(`api/photos/${id}/image`, { patience: OPENING })]);
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

/** An operation in a few words. */
export function described({ kind, ...how }) {
  const across = `columns ${how.first} to ${how.last}`;
  return {
    anchor: () => `the anchor at column ${how.column}, row ${how.row}`,
    move: () => `moving the anchor from column ${how.from_column} to ${how.column}`,
    remove: () => `removing the anchor at column ${how.column}`,
    forbid: () => `the stroke of the ${how.allow ? "eraser" : "brush"} at column ${how.points[0][0]}`,
    straight: () => `the straight line from column ${how.column} to ${how.to_column}`,
    drawn: () => `the drawn line from column ${how.first} to ${how.first + how.rows.length - 1}`,
    hidden: () => `${how.hidden ? "hiding" : "showing"} ${across}`,
    release: () => `dropping what was asked for in ${across}`,
    tag: () => `${how.on ? "the tag" : "taking off the tag"} “${how.tag}”`,
    status: () => `“${how.status}”`,
  }[kind]?.() ?? kind;
}
