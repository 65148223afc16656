/** Random schedules of clicks, faults, crashes and other tabs: nothing is lost, doubled or out of order. */

import assert from "node:assert/strict";
import { AsyncLocalStorage } from "node:async_hooks";
import { test } from "node:test";

import { FAULTS, Store, answer, asked, chance, never } from "./model.mjs";
import { me } from "../../annotate/static/server/api.js";
import { Queue } from "../../annotate/static/server/queue.js";
import { Shelf } from "../../annotate/static/server/shelf.js";

const SCHEDULES = Number(process.env.SCHEDULES ?? 200);
const CLICKS = 30;
const PHOTOS = [1, 2, 3];
const instant = () => new Promise((done) => setImmediate(done));

/** What a browser keeps between pages: the storage, and which tabs live. */
class Browser {
  held = new Set();
  storage = Object.create({
    getItem(key) { return this[key] ?? null; },
    setItem(key, text) { this[key] = text; },
    removeItem(key) { delete this[key]; },
  });

  /** Locks as one page sees them. */
  locks(page) {
    return {
      request: async (name) => {
        page.name = name;
        this.held.add(name);
        return never();
      },
      query: async () => ({ held: [...this.held].map((name) => ({ name })) }),
    };
  }
}

const whose = new AsyncLocalStorage(); // which page asks, wherever `fetch` is called

/** A page with a queue; a page that has crashed hears and sends nothing any more. */
class Page {
  alive = true;
  kept = new Set();
  shown = new Map();

  constructor(browser) {
    this.browser = browser;
    this.queue = new Queue({ pause: () => (this.alive ? instant() : never()), patience: [3] });
    this.queue.on("kept", ({ item }) => this.alive && this.kept.add(item.id));
    this.shelf = new Shelf({ pass: "the pass", folder: "alps", storage: browser.storage, locks: browser.locks(this) });
    this.queue.use(this.shelf);
  }

  run(what) {
    return whose.run(this, what);
  }

  crash() {
    this.alive = false;
    this.shelf.put = () => true; // it is dead
    this.browser.held.delete(this.name);
  }
}

/** What a person might do next to a photo. */
function click(random, number) {
  const kind = random.one(["anchor", "anchor", "anchor", "undo", "redo", "tag", "accepted", "rejected", "remove"]);
  const operation = {
    anchor: { kind: "anchor", column: number, row: 1 },
    tag: { kind: "tag", tag: "x", on: true },
    accepted: { kind: "status", status: "accepted" },
    rejected: { kind: "status", status: "rejected" },
    remove: { kind: "remove", column: random.next() < 0.5 ? -1 : 3 }, // the server refuses half of them
  }[kind] ?? null;
  return { kind, what: operation ? "operations" : kind, operation };
}

/** One schedule. Every click has words of its own, by which it is found again. */
async function schedule(seed) {
  const random = chance(seed);
  const store = new Store();
  const browser = new Browser();
  const met = { faults: 0, crashes: 0 };
  let bad = true;
  me.pass = "the pass";
  globalThis.fetch = async (path, { body, signal }) => {
    const page = whose.getStore();
    await instant();
    if (!page.alive) return never();
    const reach = () => asked(store, path, body);
    if (bad && random.next() < 0.45) {
      met.faults++;
      return random.one(Object.values(FAULTS))({ path, body, signal, reach });
    }
    return answer(...reach());
  };
  const pages = [new Page(browser), new Page(browser)]; // two tabs of one person
  const every = [...pages];
  const clicked = [];
  for (let number = 0; number < CLICKS; number++) {
    const at = random.below(2);
    const page = pages[at];
    const photo = random.one(PHOTOS);
    if (!page.queue.of(photo).length) page.shown.set(photo, store.of(photo).revision);
    const { kind, ...act } = click(random, number);
    const says = `click ${number}`;
    const seen = new Set([...store.of(photo).rows, ...page.queue.of(photo)].map((one) => one.id));
    page.run(() => page.queue.add({ photo, name: `photo ${photo}`, revision: page.shown.get(photo), says, ...act }));
    clicked.push({ page, photo, kind, says, id: page.queue.of(photo).at(-1).id, seen });
    if (random.next() < 0.3) await new Promise((done) => setTimeout(done, random.below(4)));
    if (random.next() < 0.08) {
      met.crashes++;
      page.crash();
      pages[at] = new Page(browser);
      every.push(pages[at]);
    }
    if (random.next() < 0.2) await pages[at].run(() => pages[at].queue.recover());
  }
  bad = false;
  for (let round = 0; round < 2; round++) {
    for (const page of pages) {
      await page.run(() => page.queue.recover());
      await page.queue.settled();
    }
  }
  const lost = new Map();
  for (const page of pages) for (const { says, reason } of page.queue.lost) lost.set(says, reason);
  return { store, clicked, lost, met, kept: new Set(every.flatMap((page) => [...page.kept])), left: Object.values(browser.storage) };
}

/** Everything that must hold at the end of a schedule. */
function check({ store, clicked, lost, kept, left }) {
  for (const entry of left) assert.deepEqual(JSON.parse(entry).items, [], "something still waits");
  for (const photo of PHOTOS) {
    const rows = store.of(photo).rows;
    const ids = rows.map(({ id }) => id);
    assert.equal(new Set(ids).size, ids.length, "doubled");
    for (const { kind, says, id } of clicked.filter((one) => one.photo === photo)) {
      const there = ids.includes(id);
      assert.ok(!(there && lost.has(says)), `${says} is kept, and named as lost`);
      assert.ok(there || !kept.has(id), `${says} is acknowledged, and not there`);
      const nothing = kind === "undo" || kind === "redo"; // there may have been nothing to undo
      assert.ok(there || nothing || lost.has(says), `${says} (${kind}) is lost without a word`);
    }
    // of one tab, in order; of a tab that took over from another one, each part in order
    for (const page of new Set(clicked.map((one) => one.page))) {
      const mine = clicked.filter((one) => one.page === page && one.photo === photo).map((one) => one.id);
      const order = ids.filter((id) => mine.includes(id)).map((id) => mine.indexOf(id));
      assert.deepEqual(order, order.toSorted((a, b) => a - b), "out of order");
    }
    // an undo takes back what its tab did, or what it had seen
    for (const { id, takes } of rows.filter(({ what }) => what === "undo")) {
      const undo = clicked.find((one) => one.id === id);
      const undone = clicked.find((one) => one.id === takes);
      assert.ok(undone.page === undo.page || undo.seen.has(takes), `${undo.says} takes back ${undone.says} of another tab`);
    }
  }
}

if (process.env.SEED) {
  const found = await schedule(Number(process.env.SEED));
  console.log(found.clicked.map(({ says, photo, kind, id, page }) => `${says} ${kind} on ${photo} ${id.slice(0, 8)} ${page.name?.slice(14, 18)}`).join("\n"), found.lost);
  for (const photo of PHOTOS) console.log(photo, found.store.of(photo).rows.map((row) => `${row.what} ${row.id.slice(0, 8)} ${row.takes?.slice(0, 8) ?? ""}`));
}

test(`${SCHEDULES} random schedules`, async () => {
  const all = { faults: 0, crashes: 0, lost: 0, kept: 0 };
  for (let seed = 0; seed < SCHEDULES; seed++) {
    const found = await schedule(seed);
    try {
      check(found);
    } catch (error) {
      error.message = `schedule ${seed}: ${error.message}`;
      throw error;
    }
    all.faults += found.met.faults;
    all.crashes += found.met.crashes;
    all.lost += found.lost.size;
    all.kept += found.kept.size;
  }
  assert.ok(all.faults > 10 * SCHEDULES && all.crashes > SCHEDULES && all.lost > SCHEDULES / 2 && all.kept > 10 * SCHEDULES, JSON.stringify(all));
  console.log(`${SCHEDULES * CLICKS} clicks, ${JSON.stringify(all)}`);
});
