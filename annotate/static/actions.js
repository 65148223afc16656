/** What is done to a photo as a whole: its status, its tags, undo. */

import * as dialogs from "./dialogs.js";

/**
 * Everything here is done to the photo that `target` names, which is one that is seen.
 * Event: `change`, when something else would be undone.
 */
export class Actions extends EventTarget {
  #labelling;
  #sheet;
  /**
   * What Undo takes back although its photo has been left: {id, name, status, revision}, newest last.
   * The revision is that of the status itself, so that nothing that was done since is taken back for it.
   */
  #trail = [];
  #latest = null; // what was said last, and the button beside the words takes back

  constructor(labelling, sheet) {
    super();
    this.#labelling = labelling;
    this.#sheet = sheet;
    labelling.addEventListener("document", ({ detail }) => {
      if (detail.fresh) this.#follow([]);
    });
    labelling.addEventListener("did", () => {
      if (!sheet.shown) this.#follow([]); // something has been done since
    });
    sheet.addEventListener("page", () => this.#follow([]));
    labelling.addEventListener("status", ({ detail }) => this.#tellStatus(detail));
    labelling.queue.addEventListener("kept", ({ detail: { item, document } }) => this.#keepUp(item, document));
  }

  /** The photo that is worked on: that of the sheet's card, or the one that is shown; null while there is none. */
  target() {
    if (this.#sheet.shown) return this.#sheet.card;
    const { document, loading } = this.#labelling;
    return loading ? null : document;
  }

  /** What Undo would take back, in words; empty where there is nothing. */
  get undoes() {
    const last = this.#trail.at(-1);
    if (last) return `${last.name} ${last.status}`;
    const photo = this.target();
    if (!photo || this.#sheet.shown) return "";
    const waiting = this.#labelling.queue.of(photo.id).filter((item) => item.operation && isChange(item));
    return waiting.length ? waiting.at(-1).says : photo.can_undo ? photo.undo_what ?? "the last edit" : "";
  }

  /** Whether Redo does something. */
  get redoes() {
    const photo = this.#sheet.shown ? null : this.target();
    return Boolean(photo?.can_redo || (photo && this.#labelling.queue.of(photo.id).at(-1)?.what === "undo"));
  }

  /** Give the photo a status, and go on to the next one. */
  finish(status) {
    return this.#set(status, true);
  }

  /** Give the photo a status, and stay. */
  setStatus(status) {
    return this.#set(status, false);
  }

  async #set(status, goOn) {
    const labelling = this.#labelling;
    const photo = this.target();
    if (!photo) return;
    const waiting = labelling.queue.of(photo.id);
    if (status === "accepted" && photo.rows === null && !waiting.length) {
      return labelling.say(`${photo.name} has no line yet, so there is nothing to accept.`, true);
    }
    const twice = waiting.at(-1)?.operation;
    if (twice?.kind === "status" && twice.status === status) return; // pressed again while it is on its way
    const inSheet = this.#sheet.shown;
    if (inSheet && goOn) this.#sheet.step(1);
    if (!waiting.length && photo.status === status) {
      return this.#goOn(goOn && !inSheet, photo, `${photo.name} is ${status} already.`);
    }
    const done = { id: photo.id, name: photo.name, status, revision: -1 };
    const sent = labelling.send(photo, { what: "operations", operation: { kind: "status", status }, says: `“${status}”` });
    if (inSheet) this.#follow([...this.#trail, done]);
    const kept = await sent;
    if (kept?.status !== status) return this.#follow(this.#trail.filter((one) => one !== done));
    done.revision = kept.kept ?? kept.revision;
    this.#latest = done;
    if (labelling.queue.of(photo.id).some(isChange)) return; // it does not stay so: what is said is said of that
    await this.#goOn(goOn && !inSheet, photo, `${photo.name} is ${status}.`, done);
  }

  /** Go on from a photo, if it is still the one that is seen, and say what became of it. */
  async #goOn(goOn, photo, said, done = null) {
    const labelling = this.#labelling;
    if (goOn && labelling.document?.id === photo.id && !labelling.loading && !this.#sheet.shown) {
      const next = labelling.following();
      if (!next) said += " No photo is to do any more.";
      else if (!await labelling.open(next.id)) return; // which has said why
      else if (done) this.#follow([done]);
      if (labelling.document.doubtful !== null && next) said += ` A diagnosis doubts the truth around column ${labelling.document.doubtful} of this one.`;
    }
    labelling.say(said, false, done && (() => this.#takeBack(done)));
  }

  /** Take back the last thing that was done: here, or the status of the photo that was left just now. */
  undo() {
    const labelling = this.#labelling;
    const last = this.#trail.at(-1);
    if (last) return this.#takeBack(last);
    const says = this.undoes;
    if (!says) return labelling.say(this.#sheet.shown ? "Nothing was done on this page of the sheet that could be taken back." : "There is nothing to undo.");
    labelling.send(this.target(), { what: "undo", says: `undoing ${says}` });
  }

  /** Do again what was taken back. */
  redo() {
    if (this.redoes) this.#labelling.send(this.target(), { what: "redo", says: "redoing" });
    else this.#labelling.say("There is nothing to redo.");
  }

  /** Tags of the photo. */
  tags() {
    const labelling = this.#labelling;
    const photo = this.target();
    if (photo) {
      dialogs.showTags(labelling, photo, (tag, on) =>
        labelling.send(photo, { what: "operations", operation: { kind: "tag", tag, on }, says: `the tag “${tag}”` }));
    }
  }

  /** Take a status back, and go back to its photo. */
  async #takeBack(done) {
    this.#follow(this.#trail.filter((one) => one !== done));
    const labelling = this.#labelling;
    const kept = await labelling.send(done, { what: "undo", says: `taking back “${done.status}”` });
    if (!kept) return;
    if (this.#sheet.shown) this.#sheet.focus(done.id);
    else if (labelling.document?.id !== done.id) await labelling.open(done.id);
    labelling.say(`${done.name} is ${kept.status} again.`);
  }

  /** Something has been kept: what the trail holds of its photo is still the last thing done there, or is dropped. */
  #keepUp(item, document) {
    const revision = document.kept ?? document.revision;
    const here = this.#trail.filter(({ id }) => id === item.photo);
    if (!isChange(item)) {
      if (this.#latest?.id === item.photo) here.push(this.#latest);
      for (const one of here) if (!item.quiet) one.revision = revision;
    } else if (item.what !== "operations") {
      for (const one of here) one.revision = revision; // what came after it is taken back
    } else if (here.length && item.operation.kind !== "status") {
      this.#follow(this.#trail.filter(({ id }) => id !== item.photo));
    }
  }

  /** Say what else an edit, or taking one back, did. */
  #tellStatus({ before, now, item }) {
    const seen = !this.#sheet.shown && this.target()?.id === now.id;
    if (item.what !== "operations") {
      if (seen) this.#labelling.say(`${now.name} is ${now.status} again.`);
    } else if (before === "accepted" && item.operation.kind !== "status") {
      const said = `${now.name} is no longer accepted: it was changed.`;
      if (!seen) return this.#labelling.say(said);
      this.#labelling.say(`${said} Undo takes that back.`, false, () => {
        if (this.target()?.id === now.id) this.undo();
      });
    }
  }

  #follow(trail) {
    this.#trail = trail;
    this.dispatchEvent(new Event("change"));
  }
}

/** Whether an operation is one that Undo knows, or Undo itself. */
function isChange({ operation }) {
  return !["tag", "open"].includes(operation?.kind);
}
