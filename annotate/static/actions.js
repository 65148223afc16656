/** What is done to a photo as a whole: its status, its tags, undo. */

import * as dialogs from "./dialogs.js";

/**
 * Everything here is done to the photo that `target` names, which is one that is seen.
 * Event: `change`, when something else would be undone.
 */
export class Actions extends EventTarget {
  #labelling;
  #sheet;
  /** What Undo takes back although its photo has been left: {id, name, status, revision}, newest last. */
  #trail = [];

  constructor(labelling, sheet) {
    super();
    this.#labelling = labelling;
    this.#sheet = sheet;
    labelling.addEventListener("document", ({ detail }) => {
      if (detail.fresh) this.#follow([]);
      else if (detail.item) this.#tellStatus(detail);
    });
    labelling.addEventListener("did", () => {
      if (!sheet.shown) this.#follow([]); // something has been done since
    });
    sheet.addEventListener("page", () => this.#follow([]));
    labelling.queue.addEventListener("kept", ({ detail: { document } }) => {
      for (const one of this.#trail) if (one.id === document.id) one.revision = document.kept ?? document.revision;
    });
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
    const waiting = this.#labelling.queue.of(photo.id).filter(({ operation }) => operation && operation.kind !== "tag");
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
    if (status === "accepted" && photo.rows === null) return labelling.say("There is no line to accept yet.", true);
    const twice = labelling.queue.of(photo.id).at(-1)?.operation;
    if (twice?.kind === "status" && twice.status === status) return; // pressed again while it is on its way
    const inSheet = this.#sheet.shown;
    if (inSheet && goOn) this.#sheet.step(1);
    const kept = await labelling.send(photo, { what: "operations", operation: { kind: "status", status }, says: `“${status}”` });
    if (kept?.status !== status) return;
    const done = { id: photo.id, name: photo.name, status, revision: kept.kept ?? kept.revision };
    let said = `${photo.name} is ${status}.`;
    const stays = labelling.document?.id === photo.id && !labelling.loading && !this.#sheet.shown;
    if (goOn && !inSheet && stays) {
      const next = labelling.following();
      if (!next) said += " No photo is to do any more.";
      else if (!await labelling.open(next.id)) return; // which has said why
      else this.#follow([done]);
      if (labelling.document.doubtful !== null && next) said += ` A diagnosis doubts the truth around column ${labelling.document.doubtful} of this one.`;
    } else if (inSheet && this.#sheet.shown) {
      this.#follow([...this.#trail, done]);
    }
    labelling.say(said, false, () => this.#takeBack(done));
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

  /** Say what else an edit, or taking one back, did. */
  #tellStatus({ before, item }) {
    const { document: now } = this.#labelling;
    if (before.status === now.status) return;
    if (item.what !== "operations") {
      this.#labelling.say(`${now.name} is ${now.status} again.`);
    } else if (before.status === "accepted" && item.operation.kind !== "status") {
      this.#labelling.say(`${now.name} is no longer accepted: it was changed. Undo takes that back.`, false, () => {
        if (this.target()?.id === now.id) this.undo();
      });
    }
  }

  #follow(trail) {
    this.#trail = trail;
    this.dispatchEvent(new Event("change"));
  }
}
