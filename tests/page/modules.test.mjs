/** The page's modules import one way, and what needs no browser stays so. */

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";

const PLACE = new URL("../../annotate/static/", import.meta.url);
const MODULES = readdirSync(PLACE).filter((name) => name.endsWith(".js"));
const TEXTS = new Map(MODULES.map((name) => [name, readFileSync(new URL(name, PLACE), "utf8")]));
const IMPORTS = new Map(MODULES.map((name) => [name, [...TEXTS.get(name).matchAll(/^import .*?from "\.\/(.+?)";$/gms)].map(([, of]) => of)]));

/** Modules of layers, the lowest first; each imports from its own layer and those below it, and in no circle. */
const LAYERS = {
  "numbers, words and events": ["events", "geometry", "operations", "words", "drawing", "dom", "theme"],
  "the server and what waits for it": ["api", "senseless", "queue", "shelf", "tiles", "thumbnails"],
  "what is labelled, seen and selected": ["labelling", "view", "selection", "previewer"],
  "what is drawn": ["adjusting", "hatching", "magnifier", "waiting", "line_layer", "photo_layer", "stage", "strips"],
  "what is done": ["strokes", "tools", "pointer", "line_actions"],
  "what is around the photo": ["begin", "cards", "dialogs", "messages", "overlay", "photo_list", "sheet", "toolbar", "actions", "header"],
  "the page": ["acts", "keys", "main"],
};

const layerOf = (name) => Object.values(LAYERS).findIndex((names) => names.includes(name.replace(".js", "")));

test("every module has a layer, and every layer's modules are there", () => {
  assert.deepEqual(Object.values(LAYERS).flat().map((name) => `${name}.js`).toSorted(), MODULES.toSorted());
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
  for (const [name, text] of TEXTS) if (name !== "api.js") assert.ok(!/\bfetch\(|XMLHttpRequest|WebSocket/.test(text), name);
});

test("elements of the page are looked up in one place, where their kind is checked", () => {
  for (const [name, text] of TEXTS) if (name !== "dom.js") assert.ok(!text.includes("getElementById"), name);
});
