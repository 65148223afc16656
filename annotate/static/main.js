/** Puts the page together: which parts there are, and which button or key calls what. */

import { Actions } from "./actions.js";
import { signIn, stagesAddress } from "./api.js";
import * as dialogs from "./dialogs.js";
import { Header } from "./header.js";
import { keyTable, listen } from "./keys.js";
import { Labelling } from "./labelling.js";
import { lineActions } from "./line_actions.js";
import { LineLayer } from "./line_layer.js";
import { Messages, counted } from "./messages.js";
import { Overlay } from "./overlay.js";
import { PhotoLayer } from "./photo_layer.js";
import { PhotoList } from "./photo_list.js";
import { Pointer, TOOLS } from "./pointer.js";
import { Previewer } from "./previewer.js";
import { Sheet } from "./sheet.js";
import { ALIVE, Shelf } from "./shelf.js";
import { Strips } from "./strips.js";
import { View } from "./view.js";

const RECOVER = 5000; // milliseconds between two looks at what pages that are gone have left behind
const SLOW = 250; // milliseconds
const AGAIN = 2000; // milliseconds until a server that did not answer is asked again
const find = (id) => document.getElementById(id);

signIn({ location, history, storage: sessionStorage });
const labelling = new Labelling();
const { queue } = labelling;
const view = new View();
const photo = new PhotoLayer(find("photo"), view);
const lines = new LineLayer(find("lines"), find("photo"), view);
const focus = () => find("lines").focus({ preventScroll: true });
const previewer = new Previewer(labelling, (part) => {
  lines.preview = part;
  lines.draw();
});
const line = lineActions({ labelling, view, lines, previewer, focus });
const strips = new Strips({ strip: find("strip"), margin: find("margin"), labelling, view, go: line.goTo });
const overlay = new Overlay(labelling, photo);
new Messages(labelling, {
  said: find("said"), undo: find("said-undo"), trouble: find("trouble"), saving: find("saving"),
  lost: find("lost"), list: find("lost-list"), forget: find("lost-forget"), dialog: find("lost-dialog"),
});
const sheet = new Sheet(labelling, {
  sheet: find("sheet"), main: find("main"), cards: find("sheet-cards"), status: find("sheet-status"), page: find("sheet-page"),
  previous: find("sheet-previous"), next: find("sheet-next"), close: find("sheet-close"),
}, { open: (id) => labelling.open(id), finish: (status) => actions.finish(status) });
const actions = new Actions(labelling, sheet);
new Header(labelling, actions, sheet);
new PhotoList(labelling, {
  list: find("list"), search: find("search"), filter: find("filter"), progress: find("progress"), words: find("progress-words"),
}, (id, chosen) => {
  sheet.hide();
  if (chosen) focus(); // else the next key would go into the search
  labelling.open(id);
});
const pointer = new Pointer({ canvas: find("lines"), view, lines, labelling, previewer, anchor: line.setAnchor, moved: line.goTo });

const act = {
  ...line,
  finish: (status) => actions.finish(status),
  setStatus: (status) => actions.setStatus(status),
  undo: () => actions.undo(),
  redo: () => actions.redo(),
  tags: () => actions.tags(),
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
  step(by) {
    const next = labelling.photos[labelling.place + by];
    if (next) labelling.open(next.id);
  },
  overlay: () => overlay.next(),
  async stages() {
    if (!labelling.document) return;
    if (labelling.document.blind) {
      labelling.say("The photo is labelled blind, so nothing of the detector is shown.", true);
      return;
    }
    const tab = open("", "_blank"); // now: later the browser would not let it open
    await queue.settled();
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
};

const table = keyTable(act);
listen(table, (event) => {
  const inside = event.target.closest("input:not([type=range]), select, textarea");
  const pressing = event.key === " " || event.key === "Enter" ? event.target.closest("button, [role=option]") : null;
  const arrows = event.key.startsWith("Arrow") && event.target.closest("input, [role=listbox], [role=radiogroup]");
  return Boolean(inside || pressing || arrows || document.querySelector("dialog[open]"));
}, () => sheet.shown);

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

/** Words in place of the photo; none where it can be seen. */
function instead(words) {
  find("empty").textContent = words;
  find("empty").hidden = !words;
}

let slow; // a photo that is there within a blink is not worth a word
labelling.addEventListener("loading", () => {
  clearTimeout(slow);
  const show = () => {
    find("stage").classList.toggle("loading", Boolean(labelling.loading));
    if (labelling.loading) instead(`${labelling.loading} is being read…`);
    else if (labelling.document) instead(unlabelled(labelling.document));
  };
  if (labelling.loading) slow = setTimeout(show, SLOW);
  else show();
});

function unlabelled({ rows }) {
  return rows ? "" : "This photo is labelled blind: nothing is proposed. Click along the skyline; anchors are joined by straight lines.";
}

labelling.addEventListener("document", ({ detail }) => {
  const { document: shown } = labelling;
  if (detail.fresh) {
    previewer.clear();
    lines.cursor = lines.mark = lines.stroke = null;
    view.show(shown.width, shown.height);
    photo.show(shown, labelling.bitmap);
    overlay.show();
  }
  lines.show(shown);
  if (!labelling.loading) instead(unlabelled(shown));
  if (detail.fresh && shown.doubtful !== null) {
    line.goTo(shown.doubtful);
    labelling.say(`A diagnosis doubts the truth around column ${shown.doubtful}.`);
  }
});
for (const [source, name] of [[labelling, "document"], [queue, "change"]]) {
  source.addEventListener(name, () => labelling.document && lines.showWaiting(queue.of(labelling.document.id)));
}
addEventListener("online", () => queue.wake());
addEventListener("beforeunload", (event) => queue.waiting && event.preventDefault());
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
const buttons = {
  "list-toggle": act.list, previous: () => act.step(-1), next: () => act.step(1), undo: act.undo, redo: act.redo,
  accept: () => act.finish("accepted"), review: () => act.finish("needs review"), reject: () => act.finish("rejected"),
  tags: act.tags, help: act.help, fit: () => view.fit(), "sheet-open": act.sheet, stages: act.stages,
  more: () => dialogs.showMore(labelling), learn: () => dialogs.learn(labelling), theme: dialogs.turnTheme,
};
for (const [id, run] of Object.entries(buttons)) find(id).addEventListener("click", () => run());

/** What outlives the page; nothing in a browser that keeps nothing. */
function kept() {
  try {
    return localStorage;
  } catch {
    return {};
  }
}

/** Keep what waits in the browser, and send what pages that are gone could not send. */
async function recover() {
  const shelf = new Shelf({ pass: labelling.pass, folder: labelling.folder, storage: kept(), locks: navigator.locks });
  queue.use(shelf);
  addEventListener("pagehide", () => shelf.leave());
  setInterval(() => shelf.live(), ALIVE);
  setInterval(() => queue.recover(), RECOVER);
  await queue.recover();
  const [other] = shelf.elsewhere();
  if (other) labelling.say(`${counted(other.count, "edit")} in ${other.folder} could not be sent; open that folder at this address again.`, true);
}

dialogs.restoreTheme();
dialogs.prepare(() => (sheet.shown ? find("sheet-cards").querySelector(".current") ?? find("sheet-close") : find("lines")));
act.tool("a");
find("said").textContent = "";
instead("The photos are being listed…");
async function begin() {
  await labelling.load();
  await recover();
  const first = labelling.photos.find((one) => ["to do", "in progress"].includes(one.status) && !one.missing && !one.too_large) ?? labelling.photos[0];
  if (first) await labelling.open(first.id);
  else instead("There is no photo to label.");
  dialogs.welcome();
}

for (let begun = false; !begun;) {
  try {
    await begin();
    begun = true;
  } catch (error) {
    instead(error.message);
    if (!error.away || error.status === 401) break;
    await new Promise((done) => setTimeout(done, AGAIN));
  }
}
