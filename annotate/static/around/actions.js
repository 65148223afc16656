/** What is done to a photo as a whole: its status, what is said of it, undo. */

import { Events } from "../basics/events.js";
import { isChange } from "../basics/operations.js";
import { counted, remark } from "../basics/words.js";
import { showComment } from "./dialogs.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Item } from "../server/queue.js" */
/** @import { Sheet } from "./sheet.js" */
/** @import { Document, ShownPhoto, Status } from "../types.js" */

/** @typedef {{id: number, name: string, status: Status, revision: number}} Done - A status that a photo was given. */

/**
 * @typedef {object} Draft - What is being made on the photo, and is known to nobody else yet.
 * @property {() => string} says - What Undo takes back of it first; empty where there is none.
 * @property {() => unknown} drop - Take that back.
 */

/** @type {Draft} */
const NO_DRAFT = { says: () => "", drop() {} };

/**
 * Everything here is done to the photo that `target` names, which is one that is seen.
 * Event: `change`, when something else would be undone.
 *
 * @extends {Events<{change: undefined}>}
 */
export class Actions extends Events {
  #labelling;
  #sheet;
  /**
   * What Undo takes back although its photo has been left, newest last, each with all that was done at once. The
   * revision is that of the status itself, so that nothing that was done since is taken back for it.
   *
   * @type {Done[][]}
   */
  #trail = [];
  /** @type {Done[]} */
  #latest = []; // what was said last, and the button beside the words takes back
  #draft;

  /**
   * @param {Labelling} labelling
   * @param {Sheet} sheet
   * @param {Draft} [draft]
   */
  constructor(labelling, sheet, draft = NO_DRAFT) {
    super();
    this.#labelling = labelling;
    this.#sheet = sheet;
    this.#draft = draft;
    labelling.on("document", ({ fresh }) => {
      if (fresh) this.#follow([]);
    });
    labelling.on("did", () => {
      if (!sheet.shown) this.#follow([]); // something has been done since
    });
    sheet.on("page", () => this.#follow([]));
    labelling.on("status", (change) => this.#tellStatus(change));
    labelling.queue.on("kept", ({ item, document }) => this.#keepUp(item, document));
  }

  /**
   * The photo that is worked on: that of the sheet's card, or the one that is shown; null while there is none.
   *
   * @returns {Document | ShownPhoto | null}
   */
  target() {
    if (this.#sheet.shown) return this.#sheet.card;
    const { document, loading } = this.#labelling;
    return loading ? null : document;
  }

  /** What Undo would take back, in words; empty where there is nothing. */
  get undoes() {
    const drafted = this.#drafted;
    if (drafted) return drafted;
    const last = this.#trail.at(-1);
    if (last) return `${named(last)} ${last[0].status}`;
    const photo = this.#shown();
    if (!photo) return "";
    const waiting = this.#labelling.queue.of(photo.id).filter((item) => item.operation && isChange(item)).at(-1);
    if (waiting) return waiting.says;
    return photo.can_undo ? photo.undo_what ?? "the last edit" : "";
  }

  get #drafted() {
    return this.#sheet.shown ? "" : this.#draft.says();
  }

  /** Whether Redo does something. */
  get redoes() {
    const photo = this.#shown();
    return Boolean(photo?.can_redo || (photo && this.#labelling.queue.of(photo.id).at(-1)?.what === "undo"));
  }

  /**
   * Give the photo a status, and go on to the next one.
   *
   * @param {Status} status
   */
  finish(status) {
    return this.#set(status, true);
  }

  /**
   * Give the photo a status, and stay.
   *
   * @param {Status} status
   */
  setStatus(status) {
    return this.#set(status, false);
  }

  /** Ask for a sentence, and give the photo a status with it. */
  comment() {
    const photo = this.target();
    if (photo) showComment(photo, (status, comment) => this.#set(status, true, comment));
  }

  /**
   * Give several photos a status. One Undo takes all of it back.
   *
   * @param {ShownPhoto[]} photos
   * @param {Status} status
   */
  async finishAll(photos, status) {
    const others = photos.filter((photo) => photo.status !== status);
    const act = others.map((photo) => statusOf(photo, status));
    const sent = act.map((done, at) => this.#give(others[at], done));
    if (act.length) this.#follow([...this.#trail, act]);
    const given = await Promise.all(sent);
    const kept = act.filter((_, at) => given[at]);
    this.#latest = kept;
    const words = `${counted(kept.length, "photo")} ${kept.length === 1 ? "is" : "are"} ${status}.`;
    this.#labelling.say(words, false, kept.length ? () => this.#takeBack(kept) : null);
  }

  /** The photo that is shown; null where the sheet is, or another photo is on its way. */
  #shown() {
    return this.#sheet.shown || this.#labelling.loading ? null : this.#labelling.document;
  }

  /**
   * @param {Status} status
   * @param {boolean} goOn
   * @param {string} [comment]
   */
  async #set(status, goOn, comment = "") {
    const photo = this.target();
    if (!photo || !this.#makesSense(photo, status)) return;
    const leaves = goOn && !this.#sheet.shown;
    if (goOn && !leaves) this.#sheet.step(1);
    if (!comment && this.#has(photo, status)) await this.#goOn(leaves, photo, `${photo.name} is ${status} already.`);
    else await this.#send(photo, status, leaves, comment);
  }

  /**
   * Whether a photo has a status, and nothing waits that would change it.
   *
   * @param {Document | ShownPhoto} photo
   * @param {Status} status
   */
  #has(photo, status) {
    return photo.status === status && !this.#labelling.queue.of(photo.id).length;
  }

  /**
   * Whether a photo can be given a status; if not, why is said.
   *
   * @param {Document | ShownPhoto} photo
   * @param {Status} status
   */
  #makesSense(photo, status) {
    const waiting = this.#labelling.queue.of(photo.id);
    const last = waiting.at(-1)?.operation;
    if (last?.kind === "status" && last.status === status) return false; // pressed again while it is on its way
    const empty = "rows" in photo && photo.rows === null && !waiting.length;
    if (status !== "accepted" || !empty) return true;
    this.#labelling.say(`${photo.name} has no line yet, so there is nothing to accept.`, true);
    return false;
  }

  /**
   * @param {Document | ShownPhoto} photo
   * @param {Status} status
   * @param {boolean} goOn
   * @param {string} comment
   */
  async #send(photo, status, goOn, comment) {
    const labelling = this.#labelling;
    const done = statusOf(photo, status);
    const sent = this.#give(photo, done, comment);
    if (this.#sheet.shown) this.#follow([...this.#trail, [done]]);
    if (!await sent) return;
    this.#latest = [done];
    if (labelling.queue.of(photo.id).some(isChange)) return; // it does not stay so: what is said is said of that
    const nothing = status === "accepted" && photo.nothing_visible;
    await this.#goOn(goOn, photo, `${photo.name} is ${status}${nothing ? ", with no visible skyline: its line does not count" : ""}.`, done);
  }

  /**
   * Send a status.
   *
   * @param {Document | ShownPhoto} photo
   * @param {Done} done
   * @param {string} [comment] - What is said with it.
   * @returns {Promise<boolean>} Whether the photo has it now.
   */
  async #give(photo, done, comment = "") {
    const { status } = done;
    const said = comment ? { comment } : {};
    const kept = await this.#labelling.send(photo, { what: "operations", operation: { kind: "status", status, ...said }, says: `“${status}”` });
    if (kept?.status === status) done.revision = kept.kept ?? kept.revision;
    else this.#forget([done]);
    return kept?.status === status;
  }

  /**
   * Go on from a photo, if it is still the one that is seen, and say what became of it.
   *
   * @param {boolean} goOn
   * @param {{id: number}} photo
   * @param {string} said
   * @param {Done | null} [done]
   */
  async #goOn(goOn, photo, said, done = null) {
    const labelling = this.#labelling;
    const seen = labelling.document?.id === photo.id && !labelling.loading && !this.#sheet.shown;
    const more = goOn && seen ? await this.#openNext(done) : "";
    if (more === null) return;
    labelling.say(`${said}${more}`, false, done && (() => this.#takeBack([done])), this.#reasons(done));
  }

  /**
   * Why a photo is rejected: tags to choose from.
   *
   * @param {Done | null} done
   */
  #reasons(done) {
    return done?.status === "rejected" ? this.#labelling.reasons(done, this.#labelling.legend?.tags ?? []) : [];
  }

  /**
   * What there is to say of the next photo; null where it could not be opened, which has been said.
   *
   * @param {Done | null} done - What was done to the last one.
   */
  async #openNext(done) {
    const labelling = this.#labelling;
    const next = labelling.following();
    if (!next) return ` No photo ${labelling.ahead === "to do" ? "is to do" : "needs review"} any more.`;
    if (!await labelling.open(next.id)) return null;
    if (done && !labelling.document?.carried) this.#follow([[done]]); // else Undo is of what was carried over
    return this.#doubts();
  }

  /** What a diagnosis or the detector doubts of the photo that is open, or where its line is from; nothing most often. */
  #doubts() {
    const { document: shown } = this.#labelling;
    if (!shown) return "";
    const { doubtful, doubt, carried, comment } = shown;
    if (comment) return ` Of this one says ${remark(comment)}`;
    if (doubtful !== null) return ` A diagnosis doubts the truth around column ${doubtful} of this one.`;
    if (carried) return ` The line of this one is carried over from ${carried}; Undo gives the detector's own.`;
    return doubt && ` The detector says of this one: ${doubt}`;
  }

  /** Take back the last thing that was done: here, or the status of the photo that was left just now. */
  undo() {
    if (this.#drafted) return this.#draft.drop();
    const labelling = this.#labelling;
    const last = this.#trail.at(-1);
    const photo = this.#shown();
    const says = this.undoes;
    if (last) this.#takeBack(last);
    else if (photo && says) {
      labelling.say(""); // what was said was of what is taken back
      labelling.send(photo, { what: "undo", says: `undoing ${says}` });
    } else labelling.say(this.#sheet.shown ? "Nothing was done on this page of the sheet that could be taken back." : "There is nothing to undo.");
  }

  /** Do again what was taken back. */
  redo() {
    const photo = this.#shown();
    if (photo && this.redoes) {
      this.#labelling.say("");
      this.#labelling.send(photo, { what: "redo", says: "redoing" });
    } else this.#labelling.say("There is nothing to redo.");
  }

  /**
   * Take back what was done at once: the statuses of several photos, or that of one, to which this goes back.
   *
   * @param {Done[]} act
   */
  async #takeBack(act) {
    this.#forget(act);
    const labelling = this.#labelling;
    const sent = act.map((done) => labelling.send(done, { what: "undo", says: `taking back “${done.status}”` }));
    const kept = (await Promise.all(sent)).filter((now) => now !== null);
    if (!kept.length) return;
    const [{ id, name, status }] = kept;
    if (act.length > 1) return labelling.say(`${counted(kept.length, "photo")} as before.`);
    if (this.#sheet.shown) this.#sheet.focus(id);
    else if (labelling.document?.id !== id) await labelling.open(id);
    labelling.say(`${name} is ${status} again.`);
  }

  /**
   * Something has been kept: what the trail holds of its photo is still the last thing done there, or is dropped.
   *
   * @param {Item} item
   * @param {Document} document
   */
  #keepUp(item, document) {
    const here = this.#trail.flat().filter(({ id }) => id === item.photo);
    const { operation, quiet } = item;
    if (operation && isChange(item)) {
      if (operation.kind !== "status") this.#forget(here);
    } else if (!quiet) {
      for (const one of [...here, ...this.#latestBehind(item)]) one.revision = document.kept ?? document.revision;
    }
  }

  /**
   * What was said last, where it is behind a tag on the same photo, which leaves it in place.
   *
   * @param {Item} item
   */
  #latestBehind({ operation, photo }) {
    return operation ? this.#latest.filter(({ id }) => id === photo) : [];
  }

  /** @param {Done[]} past - What cannot be taken back any more. */
  #forget(past) {
    const left = this.#trail.map((act) => act.filter((one) => !past.includes(one)));
    if (past.length) this.#follow(left.filter((act) => act.length));
  }

  /**
   * Say what else an edit, or taking one back, did.
   *
   * @param {{before: Status | undefined, now: Document, item: Item}} change
   */
  #tellStatus({ before, now, item }) {
    const seen = !this.#sheet.shown && this.target()?.id === now.id;
    if (item.what !== "operations") {
      if (seen) this.#labelling.say(`${now.name} is ${now.status} again.`);
    } else if (before === "accepted" && item.operation?.kind !== "status") {
      const said = `${now.name} is no longer accepted: it was changed.`;
      if (!seen) return this.#labelling.say(said);
      this.#labelling.say(`${said} Undo takes that back.`, false, () => {
        if (this.target()?.id === now.id) this.undo();
      });
    }
  }

  /** @param {Done[][]} trail */
  #follow(trail) {
    this.#trail = trail;
    this.tell("change");
  }
}

/**
 * @param {Document | ShownPhoto} photo
 * @param {Status} status
 * @returns {Done}
 */
function statusOf({ id, name }, status) {
  return { id, name, status, revision: -1 };
}

/** @param {Done[]} act */
function named(act) {
  return act.length === 1 ? act[0].name : counted(act.length, "photo");
}
