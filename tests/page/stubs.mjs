/** Stand-ins for the parts of the page that a test leaves out. */

import { Events } from "../../annotate/static/basics/events.js";

/** A photo with a level line. */
export function photo(how = {}) {
  return {
    id: 1, name: "hill.png", width: 400, height: 240, revision: 3, status: "to do", tags: [], blind: false,
    rows: Array(400).fill(100), hidden: [], nothing_visible: false, anchors: [], spans: [], forbidden: [], guides: [], sides: [], can_undo: false, can_redo: false,
    undo_what: null, kept: null, origins: {}, doubtful: null, doubt: "", carried: "", comment: null, apart: [], ...how,
  };
}

/** The photos of a folder without a server: what is applied and said is remembered. */
export class Labelled extends Events {
  loading = "";
  waiting = 0;
  margins = null;
  applied = [];
  said = [];

  constructor(document = photo()) {
    super();
    this.document = document;
  }

  apply(operation, part = null) {
    this.applied.push(part ? [operation, part] : operation);
    return Promise.resolve(this.document);
  }

  reasons(_, tags) {
    return tags.map((words) => ({ words, run: () => this.said.push(words) }));
  }

  say(text) {
    this.said.push(text);
  }

  /** Show another state of the photo, or another photo. */
  show(document, fresh = false) {
    this.document = document;
    this.tell("document", { fresh });
  }
}

/** Previews that are asked for, and never answered. */
export class Asked {
  asked = [];
  followed = [];
  cleared = 0;
  part = null;

  ask(...pixel) {
    this.asked.push(pixel);
  }

  follow(rough) {
    this.followed.push(rough);
  }

  clear() {
    this.cleared++;
  }

  known() {
    return this.part;
  }
}

/** Let everything that is due happen. */
export const soon = () => new Promise((done) => setImmediate(done));

/** Let what is asked meanwhile be answered. */
export async function quiet() {
  for (let turn = 0; turn < 30; turn++) await soon();
}
