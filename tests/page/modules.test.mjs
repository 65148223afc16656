/** The page's modules import one way, and what needs no browser stays so. */

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";

const PLACE = new URL("../../annotate/static/", import.meta.url);
const MODULES = readdirSync(PLACE, { recursive: true }).filter((name) => name.endsWith(".js"));
const TEXTS = new Map(MODULES.map((name) => [name, readFileSync(new URL(name, PLACE), "utf8")]));
const IMPORTS = new Map(MODULES.map((name) => [name, [...TEXTS.get(name).matchAll(/^import .*?from "(\.{1,2}\/.+?)";$/gms)]
  .map(([, of]) => new URL(of, new URL(name, PLACE)).href.slice(PLACE.href.length))]));

/** Folders of modules, the lowest first; each imports from itself and those below it, and in no circle. */
const LAYERS = {
  basics: "numbers, words and events",
  server: "the server, and what waits for it",
  labelled: "what is labelled, seen and selected",
  drawn: "what is drawn",
  gestures: "what is done on the photo",
  around: "what is around the photo",
  "": "the page",
};

const folderOf = (name) => name.split("/").slice(0, -1).join("/");
const layerOf = (name) => Object.keys(LAYERS).indexOf(folderOf(name));

test("every folder has a layer, and every layer a folder", () => {
  assert.deepEqual([...new Set(MODULES.map(folderOf))].toSorted(), Object.keys(LAYERS).toSorted());
});

test("imports go one way", () => {
  for (const [name, from] of IMPORTS) {
    for (const other of from) assert.ok(layerOf(other) <= layerOf(name), `${name} imports ${other}, which is above it`);
  }
});

test("no module imports itself, however far around", () => {
  const reached = (name, seen = new Set()) => {
    for (const other of IMPORTS.get(name)) if (!seen.has(other)) reached(other, seen.add(other));
    return seen;
  };
  for (const name of MODULES) assert.ok(!reached(name).has(name), `${name} imports itself`);
  assert.deepEqual([...reached("main.js"), "main.js"].toSorted(), MODULES.toSorted()); // nothing is left over
});

test("the network is used in one place", () => {
  for (const [name, text] of TEXTS) if (name !== "server/api.js") assert.ok(!/\bfetch\(|XMLHttpRequest|WebSocket/.test(text), name);
});

test("elements of the page are looked up in one place, where their kind is checked", () => {
  for (const [name, text] of TEXTS) if (name !== "basics/dom.js") assert.ok(!text.includes("getElementById"), name);
});
