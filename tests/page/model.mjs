/** A server after the contract, in memory, behind a network that does what it likes. */

globalThis.CustomEvent ??= class extends Event {
  constructor(name, { detail } = {}) {
    super(name);
    this.detail = detail;
  }
};
globalThis.crypto ??= (await import("node:crypto")).webcrypto;

/** Random numbers that come again: mulberry32. */
export function chance(seed) {
  let state = seed >>> 0;
  const next = () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
  return { next, below: (limit) => Math.floor(next() * limit), one: (list) => list[Math.floor(next() * list.length)] };
}

/** Labels of some photos: a log each, what can be undone, and which requests are known. */
export class Store {
  /** Of each photo: what was kept, oldest first: {id, kind, takes}; `takes` is the id that an undo took back. */
  logs = new Map();
  known = new Map();
  gone = new Set();
  number = 0;

  of(photo) {
    if (!this.logs.has(photo)) this.logs.set(photo, { rows: [], steps: [], taken: [], revision: 0, status: "to do" });
    return this.logs.get(photo);
  }

  /** Answer a change: [status, body]. */
  change(photo, what, { id, revision, operation }) {
    const log = this.of(photo);
    const text = JSON.stringify([photo, what, operation ?? null]);
    const before = this.known.get(id);
    if (before) {
      return before.text === text ? [200, this.document(photo, before.revision)]
        : [409, { detail: "the id of this request belongs to another one.", revision: log.revision }];
    }
    if (operation?.kind !== "open" && revision !== -1 && revision !== log.revision) {
      return [409, { detail: "the photo was changed in another tab.", revision: log.revision }];
    }
    if (this.gone.has(photo)) return [410, { detail: `photo ${photo} has been replaced.` }];
    if (operation?.kind === "remove" && operation.column < 0) return [422, { detail: "there is no anchor." }];
    let takes = null;
    if (what === "undo" || what === "redo") {
      const [from, to] = what === "undo" ? [log.steps, log.taken] : [log.taken, log.steps];
      if (!from.length) return [422, { detail: `there is nothing to ${what}.` }];
      takes = from.pop();
      to.push(takes);
    } else if (!["tag", "open"].includes(operation.kind)) {
      log.steps.push(id);
      log.taken = [];
    }
    log.rows.push({ id, what: operation?.kind ?? what, takes });
    this.number++;
    if (operation?.kind !== "open") log.revision = this.number;
    this.known.set(id, { text, revision: log.revision });
    return [200, this.document(photo, log.revision)];
  }

  document(photo, kept = null) {
    const { revision, status } = this.of(photo);
    return { id: photo, name: `photo ${photo}`, revision, kept, status, rows: [1, 2, 3], tags: [] };
  }
}

const JSON_TYPE = { "Content-Type": "application/json" };

/** An answer of the server of a pass. */
export function answer(status, body, pass = "the pass") {
  return new Response(JSON.stringify(body), { status, headers: { ...JSON_TYPE, "X-Skyline-Pass": pass } });
}

/** An answer that ends in the middle. */
export function broken(status = 200) {
  const body = new ReadableStream({
    start(control) {
      control.enqueue(new TextEncoder().encode('{"id": 1, "rev'));
      control.error(new TypeError("terminated"));
    },
  });
  return new Response(body, { status, headers: { ...JSON_TYPE, "X-Skyline-Pass": "the pass" } });
}

/** A page of somebody else's. */
export function stranger(status = 200) {
  return new Response("<html>A proxy.</html>", { status, headers: { "Content-Type": "text/html" } });
}

/** Ask a store as `fetch` does: [status, body]. */
export function asked(store, path, body) {
  const [, photo, what] = /photos\/(\d+)\/(\w+)/.exec(path);
  return store.change(Number(photo), what, JSON.parse(body));
}

/** Nothing, for ever. */
export const never = () => new Promise(() => {});

/** What may happen to a request; `reach` lets the server do it. */
export const FAULTS = {
  "is lost on the way there": () => { throw new TypeError("network"); },
  "is kept, and its answer is lost": ({ reach }) => { reach(); throw new TypeError("network"); },
  "is kept, and its answer breaks off": ({ reach }) => { reach(); return broken(); },
  "is kept, and its answer is no JSON": ({ reach }) => { reach(); return new Response("<html>", { headers: { "X-Skyline-Pass": "the pass" } }); },
  "is kept, and its answer is another's": ({ reach }) => { reach(); return answer(200, { ok: true }); },
  "is kept, and its answer never comes": ({ reach }) => { reach(); return never(); },
  "is never answered": never,
  "is answered when it is given up": ({ signal }) => new Promise((_, fail) => signal.addEventListener("abort", () => fail(signal.reason))),
  "meets a proxy's page": () => stranger(),
  "meets a proxy's error": () => stranger(502),
  "meets a page that was not found": () => stranger(404),
  "meets the server of another folder": () => answer(200, {}, "another pass"),
  "meets another folder that refuses it": () => answer(422, { detail: "no." }, "another pass"),
  "meets a full disk": () => answer(507, { detail: "the disk is full." }),
  "meets a fault of the server": () => new Response("Internal Server Error", { status: 500, headers: { "X-Skyline-Pass": "the pass" } }),
  "meets a server that does not know the page": () => answer(401, { detail: "the token is wrong." }),
};
