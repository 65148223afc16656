/** A labelling server in memory, whose documents can be looked at and changed. */

import { answer } from "./model.mjs";
import { photo } from "./stubs.mjs";
import { me } from "../../annotate/static/server/api.js";

const LEGEND = { statuses: ["to do"], tags: [], hidden_by: [], stages: {}, formats: [], colours: {}, tile: 512, band: 40 };

/** A photo as the list has it. */
export const listed = (id, how = {}) =>
  ({ id, name: `hill-${id}.png`, status: "to do", tags: [], missing: false, too_large: false, blind: false, ...how });

/** Answers what the page asks, as long as it is the last one that was made. */
export class Server {
  /** What is known of each photo. */
  documents = new Map([1, 2, 3].map((id) => [id, photo({ id, name: `hill-${id}.png`, rows: [5, 5, 5], width: 3 })]));
  list = [listed(1), listed(2), listed(3)];
  asked = []; // paths, the latest last
  refusals = []; // of the next changes: [status, body]
  held = null; // where it is a list: functions that let go the changes that wait

  constructor() {
    Object.assign(me, { token: "token", pass: "the pass" });
    globalThis.createImageBitmap = async () => ({ width: 3, height: 2 });
    globalThis.fetch = async (path, { body }) => {
      this.asked.push(path);
      if (path.endsWith("/image")) return new Response("pixels", { headers: { "X-Skyline-Pass": "the pass" } });
      if (body && this.held) await new Promise((done) => this.held.push(done));
      return answer(...this.#respond(path, body && JSON.parse(body)));
    };
  }

  /** Let go the changes that wait, and hold no more. */
  release() {
    this.held.forEach((done) => done());
    this.held = null;
  }

  /** Do an operation, or undo the last one that is left. */
  change(id, operation) {
    const known = this.documents.get(id);
    const before = { rows: [...known.rows], status: known.status };
    if (!operation) Object.assign(known, known.steps.pop());
    else if (!["open", "tag"].includes(operation.kind)) (known.steps ??= []).push(before);
    if (operation?.kind === "status") known.status = operation.status;
    else if (operation?.kind === "anchor") {
      known.rows[operation.column] = operation.row;
      known.status = "in progress";
    }
    if (operation?.kind === "tag") known.tags = [...known.tags.filter((tag) => tag !== operation.tag), ...(operation.on ? [operation.tag] : [])];
    if (operation?.kind !== "open") known.revision++;
    Object.assign(this.list.find((one) => one.id === id), { status: known.status, tags: known.tags });
    known.can_undo = Boolean(known.steps?.length);
    return { ...structuredClone(known), kept: known.revision };
  }

  /** Why a change is refused; undefined where it is not. */
  #refusal(id, { revision, operation }) {
    if (operation?.kind === "open") return undefined;
    const now = this.documents.get(id).revision;
    const stale = revision !== -1 && revision !== now;
    return this.refusals.shift() ?? (stale ? [409, { detail: "the photo was changed.", revision: now }] : undefined);
  }

  #respond(path, body) {
    if (path === "api/legend") return [200, LEGEND];
    if (path === "api/photos") return [200, { folder: "alps", annotator: "ann", number: 2, ahead: "to do", photos: this.list.map((one) => ({ ...one })), progress: {} }];
    const id = Number(/photos\/(\d+)/.exec(path)[1]);
    if (path.endsWith("/margins")) return [200, { revision: 0, margins: [1, 2, 3], uncertain: [0] }];
    if (!this.documents.has(id)) return [410, { detail: `hill-${id}.png has vanished.` }];
    if (!body) return [200, structuredClone(this.documents.get(id))];
    return this.#refusal(id, body) ?? [200, this.change(id, body.operation)];
  }
}
