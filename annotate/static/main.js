/** Puts the page together: what buttons and keys do. */

import { get, picture, post, stagesAddress } from "./api.js";
import * as dialogs from "./dialogs.js";
import { keyTable, listen } from "./keys.js";
import { Labelling } from "./labelling.js";
import { LineLayer } from "./line_layer.js";
import { PhotoLayer } from "./photo_layer.js";
import { PhotoList } from "./photo_list.js";
import { Pointer, TOOLS } from "./pointer.js";
import { Previewer } from "./previewer.js";
import { Sheet } from "./sheet.js";
import { Strips } from "./strips.js";
import { View } from "./view.js";

const STAGES = ["none", "edges", "strength", "coherence", "orientation", "bin", "score", "cost"];
const find = (id) => document.getElementById(id);

const labelling = new Labelling();
const view = new View();
const photo = new PhotoLayer(find("photo"), view);
const lines = new LineLayer(find("lines"), find("photo"), view);
const previewer = new Previewer(labelling, (part) => {
  lines.preview = part;
  lines.draw();
});
const strips = new Strips({ strip: find("strip"), margin: find("margin"), labelling, view, go: (column) => goTo(column) });
new PhotoList(labelling, {
  list: find("list"), search: find("search"), filter: find("filter"), progress: find("progress"), words: find("progress-words"),
}, (id) => labelling.open(id));
const sheet = new Sheet(labelling, {
  sheet: find("sheet"), main: find("main"), cards: find("sheet-cards"), status: find("sheet-status"), page: find("sheet-page"),
  previous: find("sheet-previous"), next: find("sheet-next"), close: find("sheet-close"),
}, (id) => labelling.open(id));
const pointer = new Pointer({
  canvas: find("lines"), view, lines, labelling, previewer, anchor: setAnchor,
  moved: (column) => goTo(column),
});

/** Where the cursor is: its column, and its row, or that of the line. */
function place() {
  const { document } = labelling;
  const column = lines.cursor?.column ?? Math.floor(document.width / 2);
  return [column, lines.cursor?.row ?? document.rows?.[column] ?? Math.floor(document.height / 2)];
}

function setCursor(column, row) {
  const { width, height } = labelling.document;
  const inside = (value, size) => Math.min(Math.max(value, 0), size - 1);
  lines.cursor = { column: inside(column, width), row: row === null ? null : inside(row, height) };
  view.reveal(...place());
  lines.draw();
}

function goTo(column) {
  previewer.clear();
  setCursor(column, null);
  find("lines").focus({ preventScroll: true });
}

/**
 * Set an anchor. With `across`, keep the line on this side of where it runs now: a thin stroke of the
 * brush goes along the old line, up to the neighbouring anchors or an eighth of the photo away.
 */
function setAnchor(column, row, across = false) {
  if (across && labelling.document.rows) rejectAround(column, row);
  const part = across ? null : previewer.known(column, row);
  previewer.clear();
  if (lines.cursor) lines.cursor = { column, row: null };
  labelling.apply({ kind: "anchor", column, row }, part);
  labelling.say(`Anchor at column ${column}, row ${row}.`);
}

function rejectAround(column, row) {
  const { width, height, rows, anchors } = labelling.document;
  const radius = Math.max(Math.round(height / 260), 2);
  if (Math.abs(rows[column] - row) <= 2 * radius) return;
  const room = Math.round(width / 8);
  const fixed = anchors.map(([one]) => one);
  const first = Math.max(column - room, ...fixed.filter((one) => one < column).map((one) => one + room / 8), 0);
  const last = Math.min(column + room, ...fixed.filter((one) => one > column).map((one) => one - room / 8), width - 1);
  const points = [];
  for (let at = Math.ceil(first); at <= last; at += 3) points.push([at, rows[at]]);
  if (points.length) labelling.apply({ kind: "forbid", points, radius, allow: false });
}

/** Columns from the mark to the cursor, or of the cursor alone. */
function marked() {
  const [column, row] = place();
  const mark = lines.mark ?? { column, row };
  const [first, last] = [Math.min(mark.column, column), Math.max(mark.column, column)];
  return { mark, column, row, first, last };
}

function needsMark() {
  if (lines.mark) return false;
  labelling.say("Put a mark at one end first: M.");
  return true;
}

function dropMark() {
  lines.mark = null;
  previewer.clear();
  if (lines.cursor) lines.cursor = { ...lines.cursor, row: null };
}

const act = {
  async finish(status) {
    if (!labelling.document) return;
    const name = labelling.document.name;
    if (status === "accepted" && !labelling.document.rows) return labelling.say("There is no line to accept yet.", true);
    labelling.apply({ kind: "status", status });
    await labelling.settled();
    if (labelling.document.status !== status) return;
    const next = labelling.following();
    if (next) await labelling.open(next.id);
    labelling.say(next ? `${name} is ${status}.` : `${name} is ${status}. No photo is to do any more.`);
  },
  async uncertain(step) {
    const found = (labelling.margins?.uncertain ?? []).toSorted((a, b) => a - b);
    if (!found.length) return labelling.say("No column is uncertain.");
    const least = labelling.margins.uncertain[0];
    const from = lines.cursor?.column;
    const beyond = step > 0 ? found.find((one) => one > from) ?? found[0] : found.findLast((one) => one < from) ?? found.at(-1);
    const column = from === undefined ? least : beyond;
    goTo(column);
    labelling.say(`Column ${column}, margin ${labelling.margins.margins[column]?.toFixed(2)}.`);
  },
  moveColumn(step) {
    const [column] = place();
    previewer.clear();
    setCursor(lines.cursor ? column + step : column, null);
    labelling.say(`Column ${lines.cursor.column}, row ${place()[1]}.`);
  },
  moveRow(step) {
    const [column, row] = place();
    setCursor(column, row + step);
    previewer.ask(column, lines.cursor.row);
    labelling.say(`Column ${column}, row ${lines.cursor.row}.`);
  },
  anchorHere(across) {
    setAnchor(...place(), across);
  },
  removeNearest() {
    const [column] = place();
    const nearest = labelling.document.anchors.toSorted((a, b) => Math.abs(a[0] - column) - Math.abs(b[0] - column))[0];
    if (!nearest) return labelling.say("There is no anchor.");
    labelling.apply({ kind: "remove", column: nearest[0] });
    labelling.say(`The anchor at column ${nearest[0]} is removed.`);
  },
  async alternative(number) {
    const { document } = labelling;
    const [column] = place();
    try {
      const { alternatives } = await get(`api/photos/${document.id}/alternatives/${column}`);
      const chosen = alternatives[number - 1];
      if (!chosen) return labelling.say(`There are ${alternatives.length} other lines through column ${column}.`);
      setCursor(column, null);
      setAnchor(column, chosen.row);
    } catch (error) {
      labelling.say(error.message, true);
    }
  },
  undo: () => labelling.document?.can_undo && labelling.undo(),
  redo: () => labelling.document?.can_redo && labelling.redo(),
  mark() {
    const [column, row] = place();
    setCursor(column, lines.cursor?.row ?? null);
    lines.mark = { column, row };
    lines.draw();
    labelling.say(`Mark at column ${column}, row ${row}.`);
  },
  straight() {
    if (needsMark()) return;
    const { mark, column, row } = marked();
    dropMark();
    labelling.apply({ kind: "straight", column: mark.column, row: mark.row, to_column: column, to_row: row });
  },
  hide(hidden) {
    const { first, last } = marked();
    dropMark();
    labelling.apply({ kind: "hidden", first, last, hidden });
    labelling.say(`Columns ${first} to ${last} are ${hidden ? "not visible" : "visible"}.`);
  },
  release() {
    const { first, last } = marked();
    dropMark();
    labelling.apply({ kind: "release", first, last });
  },
  forbid(allow) {
    const [column, row] = place();
    const radius = Math.min(Math.max(Math.round(12 / view.scale), 2), 1000);
    dropMark();
    labelling.apply({ kind: "forbid", points: [[column, row]], radius, allow });
  },
  tool(key) {
    const chosen = TOOLS.find((tool) => tool.key === key.toUpperCase());
    pointer.tool = chosen.id;
    previewer.clear();
    for (const button of find("tools").children) {
      const on = button.dataset.tool === chosen.id;
      button.setAttribute("aria-checked", String(on));
      button.tabIndex = on ? 0 : -1;
    }
    find("lines").style.cursor = chosen.id === "forbid" ? "cell" : "crosshair";
    labelling.say(`${chosen.name}. ${chosen.title}`);
  },
  tags: () => labelling.document && dialogs.showTags(labelling),
  step(by) {
    const next = labelling.photos[labelling.place + by];
    if (next) labelling.open(next.id);
  },
  zoom(key) {
    if (key === "0") view.fit();
    else view.zoom(key === "-" ? 1 / 1.5 : 1.5, ...(lines.cursor ? view.toScreen(...place()) : []));
  },
  pan(key) {
    const [x, y] = { ArrowLeft: [80, 0], ArrowRight: [-80, 0], ArrowUp: [0, 80], ArrowDown: [0, -80] }[key];
    view.pan(x, y);
  },
  overlay() {
    find("overlay").selectedIndex = (find("overlay").selectedIndex + 1) % STAGES.length;
    showOverlay();
    labelling.say(`Overlay: ${find("overlay").value}.`);
  },
  async stages() {
    if (labelling.document.blind) {
      labelling.say("The photo is labelled blind, so nothing of the detector is shown.", true);
      return;
    }
    const tab = open("", "_blank"); // now: later the browser would not let it open
    await labelling.settled();
    const address = stagesAddress(labelling.document.id);
    if (tab) tab.location = address;
    labelling.say(tab ? "The stages are in another tab." : "The browser keeps tabs from opening; allow them for this page.", !tab);
  },
  sheet: () => sheet.show(),
  list() {
    const side = find("side");
    side.hidden = !side.hidden;
    find("list-toggle").setAttribute("aria-expanded", String(!side.hidden));
  },
  search() {
    if (find("side").hidden) act.list();
    find("search").focus();
  },
  help: () => dialogs.showHelp(table),
  escape() {
    dropMark();
    lines.cursor = null;
    lines.stroke = null;
    lines.draw();
  },
};

const table = keyTable(act);
listen(table, (event) => {
  const inside = event.target.closest("input:not([type=range]), select, textarea");
  const pressing = event.key === " " || event.key === "Enter" ? event.target.closest("button, [role=option]") : null;
  const arrows = event.key.startsWith("Arrow") && event.target.closest("input, [role=listbox], [role=radiogroup]");
  return Boolean(inside || pressing || arrows || document.querySelector("dialog[open]") || sheet.shown);
});

async function showOverlay() {
  const stage = find("overlay").value;
  const opacity = Number(find("opacity").value);
  const { document } = labelling;
  if (stage === "none" || !document) return photo.lay(null, opacity);
  try {
    const layer = await picture(`api/photos/${document.id}/stages/${stage}`);
    if (labelling.document.id === document.id && find("overlay").value === stage) photo.lay(layer, opacity);
  } catch (error) {
    find("overlay").selectedIndex = 0;
    photo.lay(null, opacity);
    labelling.say(error.message, true);
  }
}

function adjust() {
  photo.adjust({ contrast: Number(find("contrast").value), gamma: Number(find("gamma").value), local: Number(find("local").value) });
}

function resize() {
  const { clientWidth, clientHeight } = find("stage");
  if (!clientWidth) return;
  const ratio = devicePixelRatio || 1;
  for (const canvas of [find("photo"), find("lines")]) {
    Object.assign(canvas, { width: Math.round(clientWidth * ratio), height: Math.round(clientHeight * ratio) });
  }
  view.resize(clientWidth, clientHeight);
  strips.draw();
}

labelling.addEventListener("document", ({ detail }) => {
  const { document: shown } = labelling;
  if (detail.fresh) {
    previewer.clear();
    lines.cursor = lines.mark = lines.stroke = null;
    view.show(shown.width, shown.height);
    photo.show(shown, labelling.bitmap);
    showOverlay();
    find("empty").hidden = Boolean(shown.rows);
    find("empty").textContent = "This photo is labelled blind: nothing is proposed. Click along the skyline; anchors are joined by straight lines.";
  }
  if (detail.fresh && shown.doubtful !== null) {
    setCursor(shown.doubtful, null);
    labelling.say(`A diagnosis doubts the truth around column ${shown.doubtful}.`);
  }
  if (shown.rows) find("empty").hidden = true;
  lines.show(shown);
  find("name").textContent = find("name").title = shown.name;
  find("place").textContent = `${labelling.place + 1} / ${labelling.photos.length}`;
  find("status").textContent = shown.status + (shown.blind ? ", blind" : "");
  find("status").dataset.status = shown.status;
  find("undo").disabled = !shown.can_undo;
  find("redo").disabled = !shown.can_redo;
  find("tag-count").textContent = shown.tags.length ? ` ${shown.tags.length}` : "";
  document.title = `${shown.name} - skyline-annotate`;
});
let slow; // what is saved within a blink is not worth a word
labelling.addEventListener("saving", () => {
  find("saving").dataset.state = labelling.waiting ? "unsaved" : "saved";
  if (labelling.waiting) slow ??= setTimeout(() => (find("saving").textContent = "not saved"), 400);
  else {
    clearTimeout(slow);
    slow = undefined;
    find("saving").textContent = "saved";
  }
});
labelling.addEventListener("said", ({ detail }) => {
  find("said").textContent = detail.text;
  find("said").classList.toggle("bad", detail.bad);
});
addEventListener("beforeunload", (event) => labelling.waiting && event.preventDefault());
addEventListener("resize", resize);
new ResizeObserver(resize).observe(find("stage"));

for (const tool of TOOLS) {
  const button = document.createElement("button");
  Object.assign(button, { type: "button", textContent: tool.name, title: `${tool.title} ( ${tool.key} )` });
  button.dataset.tool = tool.id;
  button.setAttribute("role", "radio");
  button.addEventListener("click", () => act.tool(tool.key));
  find("tools").append(button);
}
find("tools").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!step) return;
  const at = TOOLS.findIndex((tool) => tool.id === pointer.tool);
  act.tool(TOOLS[(at + step + TOOLS.length) % TOOLS.length].key);
  find("tools").querySelector("[aria-checked=true]").focus();
});
find("overlay").append(...STAGES.map((stage) => new Option(stage)));
find("overlay").addEventListener("change", showOverlay);
find("opacity").addEventListener("input", showOverlay);
for (const id of ["contrast", "gamma", "local"]) find(id).addEventListener("input", adjust);
find("adjust").addEventListener("click", () => {
  const shown = find("adjustments").hidden;
  find("adjustments").hidden = !shown;
  find("adjust").setAttribute("aria-expanded", String(shown));
});
find("adjust-reset").addEventListener("click", () => {
  for (const [id, value] of [["contrast", 1], ["gamma", 1], ["local", 0]]) find(id).value = value;
  adjust();
});
const buttons = {
  "list-toggle": act.list, previous: () => act.step(-1), next: () => act.step(1), undo: act.undo, redo: act.redo,
  accept: () => act.finish("accepted"), review: () => act.finish("needs review"), reject: () => act.finish("rejected"),
  tags: act.tags, help: act.help, fit: () => view.fit(), "sheet-open": act.sheet, stages: act.stages,
  more: () => dialogs.showMore(labelling), learn: () => dialogs.learn(labelling), theme: dialogs.turnTheme,
};
for (const [id, run] of Object.entries(buttons)) find(id).addEventListener("click", () => run());

dialogs.restoreTheme();
dialogs.prepare();
act.tool("a");
find("said").textContent = "";
try {
  await labelling.load();
  const first = labelling.photos.find((one) => ["to do", "in progress"].includes(one.status) && !one.missing && !one.too_large) ?? labelling.photos[0];
  if (first) await labelling.open(first.id);
  dialogs.welcome();
} catch (error) {
  find("empty").hidden = false;
  find("empty").textContent = error.message;
}
