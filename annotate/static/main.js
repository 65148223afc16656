/**
 * Puts the page together: which parts there are, and which button or key calls what.
 *
 * What a click does: `Pointer` gives it to a tool, the tool makes an operation, `Labelling.apply` puts that into
 * the `Queue`, which sends it until the server has kept it. The answer is told as `document`, and drawn.
 */

import { makeActs, narrow, showList } from "./acts.js";
import { Actions } from "./around/actions.js";
import { begin } from "./around/begin.js";
import { Brush } from "./around/brush.js";
import { Choices } from "./around/choices.js";
import { Chosen } from "./around/chosen.js";
import { closeWelcome, learn, prepare, showHelp, showMore, welcome } from "./around/dialogs.js";
import { ExplainedPanel } from "./around/explained.js";
import { showGuideline } from "./around/guideline.js";
import { Header } from "./around/header.js";
import { HiddenList } from "./around/hidden_list.js";
import { Messages } from "./around/messages.js";
import { Overlay } from "./around/overlay.js";
import { PhotoList } from "./around/photo_list.js";
import { Sheet } from "./around/sheet.js";
import { tagging } from "./around/tagging.js";
import { Toolbar } from "./around/toolbar.js";
import { Tour } from "./around/tour.js";
import { around, box, busy, button, canvas } from "./basics/dom.js";
import { restoreTheme, turnTheme } from "./basics/theme.js";
import { remark } from "./basics/words.js";
import { Stage } from "./drawn/stage.js";
import { Strips } from "./drawn/strips.js";
import { lineActions } from "./gestures/line_actions.js";
import { Pointer } from "./gestures/pointer.js";
import { GESTURES, keyTable, letGo, listen } from "./keys.js";
import { Labelling } from "./labelled/labelling.js";
import { Previewer } from "./labelled/previewer.js";
import { Selection } from "./labelled/selection.js";
import { View } from "./labelled/view.js";
import { signIn } from "./server/api.js";

signIn({ location, history, storage: sessionStorage });
restoreTheme();
const lines = canvas("lines");
const focus = () => lines.focus({ preventScroll: true });
const home = () => (sheet.shown ? sheet.home : lines);
const goHome = () => home().focus({ preventScroll: true });

const labelling = new Labelling();
const view = new View();
const selection = new Selection();
const previewer = new Previewer(labelling, (part) => selection.preview(part));
const stage = new Stage(labelling, view, selection);
const brush = new Brush(stage.lines);
const line = lineActions({ labelling, view, selection, previewer, brush, focus });
const explained = new ExplainedPanel(labelling, selection, focus);
new Choices(labelling, selection, line, focus);
const overlay = new Overlay(labelling, stage.photo);
new Strips(labelling, view, selection, line.goTo);
new Messages(labelling, goHome);
const chosen = new Chosen(labelling, goHome);
const sheet = new Sheet(labelling, chosen, focus);
const actions = new Actions(labelling, sheet, {
  says: () => (selection.now.corners.length ? "the last corner of the guide" : ""), drop: () => line.dropCorner(),
});
new Header({ labelling, actions, sheet, selection });
const hiddenList = new HiddenList(labelling, line);
new PhotoList(labelling, chosen, (id, clicked) => {
  sheet.hide();
  if (clicked) {
    if (narrow()) showList(false); // it lies over the photo
    focus(); // else the next key would go into the search
  }
  labelling.open(id);
});
const toolbar = new Toolbar(box("tools"));
const pointer = new Pointer({ canvas: lines, view, selection, labelling, previewer, brush, line: { ...line, anchor: line.setAnchor, goTo: line.select, explain: (pixel) => explained.show(pixel) } });
const tags = tagging(labelling, () => actions.target());
const act = makeActs({ labelling, selection, stage, line, pointer, actions, toolbar, overlay, sheet, explained, brush, hiddenList, tags, help: () => showHelp(table, GESTURES), guideline: showGuideline });
const table = keyTable(act);
const tour = new Tour(focus);

sheet.on("finish", (status) => actions.finish(status));
sheet.on("tick", (number) => tags.tick(number));
chosen.on("finish", ({ photos, status }) => actions.finishAll(photos, status));
toolbar.on("tool", ({ id, name, title }) => {
  pointer.use(id);
  brush.show(id === "forbid");
  lines.style.cursor = id === "forbid" ? "cell" : "crosshair";
  labelling.say(`${name}. ${title}`);
});
labelling.on("document", ({ fresh }) => {
  const { document: shown } = labelling;
  if (!fresh || !shown) return;
  const { doubtful, doubt, carried, comment } = shown;
  if (comment) labelling.say(remark(comment));
  else if (doubtful !== null) {
    line.goTo(doubtful);
    labelling.say(`A diagnosis doubts the truth around column ${doubtful}.`);
  } else if (carried) labelling.say(`The line is carried over from ${carried}; Undo gives the detector's own.`);
  else if (doubt) labelling.say(doubt);
});

listen(table, (event) => {
  const typing = around(event, "input:not([type=range]), select, textarea");
  const pressing = (event.key === " " || event.key === "Enter") && around(event, "button, [role=option]");
  const moving = event.key.startsWith("Arrow") && around(event, "input, [role=listbox], [role=radiogroup]");
  return Boolean(busy() || typing || pressing || moving);
}, () => sheet.shown);
letGo("z", () => act.magnify(false));
const buttons = {
  "list-toggle": act.list, previous: () => act.step(-1), next: () => act.step(1), undo: act.undo, redo: act.redo,
  accept: () => act.finish("accepted"), review: () => act.finish("needs review"), reject: () => act.finish("rejected"),
  tags: act.tags, "comment-open": act.comment, "hidden-open": act.hiddenList, guideline: act.guideline, help: act.help, others: act.others, fit: () => view.fit(), "sheet-open": act.sheet, stages: act.stages,
  more: () => showMore(labelling), learn: () => learn(labelling), theme: turnTheme,
};
for (const [id, run] of Object.entries(buttons)) button(id).addEventListener("click", () => run());
button("tour-begin").addEventListener("click", () => closeWelcome(() => tour.begin()));
addEventListener("online", () => labelling.queue.wake());
addEventListener("beforeunload", (event) => labelling.queue.waiting && event.preventDefault());
prepare(home);

if (narrow()) showList(false);
toolbar.choose("a");
labelling.say("");
if (await begin(labelling, (words) => stage.instead(words))) welcome();
