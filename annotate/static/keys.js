/** All keys, in one table: what they do, and what the help says about them. */

/** @import { Acts } from "./acts.js" */

/** @typedef {{keys: string[], shown: string, says: string, run: (event: KeyboardEvent) => unknown, group: string}} Entry */

/**
 * What each key does.
 *
 * @param {Acts} act
 * @returns {Entry[]}
 */
export function keyTable(act) {
  let group = "";
  /** @type {(shown: string, says: string, run: Entry["run"], ...keys: string[]) => Entry} */
  const one = (shown, says, run, ...keys) => ({ keys, shown, says, run, group });
  /** @type {(name: string) => Entry[]} */
  const part = (name) => {
    group = name;
    return [];
  };
  return [
    ...part("The photo is finished"),
    one("Space", "Accept, and show the next photo", () => act.finish("accepted"), " "),
    one("R", "Needs review, next photo", () => act.finish("needs review"), "r"),
    one("Shift+R", "Needs review or reject, with a sentence", () => act.comment(), "R"),
    one("Q", "Reject, next photo", () => act.finish("rejected"), "q"),
    one("C", "Set the photo back: it is to do again", () => act.setStatus("to do"), "c"),
    one("T", "Tags; there a digit ticks one, and T closes them", () => act.tags(), "t"),
    one("U, Ctrl+Z", "Undo", () => act.undo(), "u", "Ctrl+z"),
    one("Y, Ctrl+Shift+Z", "Redo", () => act.redo(), "y", "Ctrl+y", "Ctrl+Z"),
    ...part("Where to look"),
    one("N, Shift+N", "Next, previous uncertain span", (event) => act.uncertain(event.shiftKey ? -1 : 1), "n", "N"),
    one("[ ]", "Previous, next photo", (event) => act.step(event.key === "[" || event.key === "PageUp" ? -1 : 1), "[", "]", "PageUp", "PageDown"),
    one("+ − 0", "Zoom in, out, whole photo", (event) => act.zoom(event.key), "+", "=", "-", "0"),
    one("Alt+arrows", "Move the photo", (event) => act.pan(event.key), "Alt+ArrowLeft", "Alt+ArrowRight", "Alt+ArrowUp", "Alt+ArrowDown"),
    one("Z", "Magnify what is under the mouse, while it is held", () => act.magnify(true), "z"),
    one("O", "Next overlay: the stages of the detector", () => act.overlay(), "o"),
    one("Shift+E", "Explain the pixel at the cursor", () => act.explainHere(), "E"),
    one("G", "Stages in Rerun, with this line as truth", () => act.stages(), "g"),
    one("W", "Sheet: photos and strips, many at once", () => act.sheet(), "w"),
    one("P", "Show or hide the list of photos", () => act.list(), "p"),
    one("/", "Search photos", () => act.search(), "/"),
    one("Shift+G", "Guideline: what the skyline is", () => act.guideline(), "G"),
    one("?", "These keys", () => act.help(), "?"),
    ...part("The line, with a cursor"),
    one("← →", "Move the column cursor; with Shift 10, with Ctrl 100 columns", (event) =>
      act.moveColumn((event.key === "ArrowLeft" ? -1 : 1) * pace(event)), "ArrowLeft", "ArrowRight"),
    one("↑ ↓", "Move its row; with Shift 10, with Ctrl 100 rows", (event) =>
      act.moveRow((event.key === "ArrowUp" ? -1 : 1) * pace(event)), "ArrowUp", "ArrowDown"),
    one("Enter", "Set an anchor just at the cursor", () => act.anchorHere(), "Enter"),
    one("Delete", "Remove the anchor nearest the cursor", () => act.removeNearest(), "Delete", "Backspace"),
    one("J", "A corner of a guide at the cursor; Enter ends the guide", () => act.corner(), "j"),
    one("1 2 3 4", "Show lines along other ridges; then take one", (event) => act.alternative(Number(event.key)), "1", "2", "3", "4"),
    one("M", "Put a mark at the cursor", () => act.mark(), "m"),
    one("L", "Straight line from the mark to the cursor", () => act.straight(), "l"),
    one("K", "The line cannot be seen from the mark to the cursor", () => act.hide(true), "k"),
    one("V", "It can be seen again there", () => act.hide(false), "v"),
    one("Shift+K", "List of hidden columns: what hides them", () => act.hiddenList(), "K"),
    one("X", "Drop all that was asked for there", () => act.release(), "x"),
    one("F, Shift+F", "Keep the line away from the cursor; allow it again", (event) => act.forbid(event.shiftKey), "f", "F"),
    one("Escape", "Drop the mark and what is being shown", () => act.escape(), "Escape"),
    ...part("Tools"),
    one("A I B 5 S D H E", "Line, guide, brush, sky, straight, draw, hide, explain", (event) => act.tool(event.key), "a", "i", "b", "5", "s", "d", "h", "e"),
    one(", .", "Smaller, larger brush", (event) => act.brush(event.key === "."), ",", "."),
  ];
}

/** What the mouse and fingers do; keys have a table of their own. */
export const GESTURES = /** @type {const} */ ([
  ["Click", "The line passes through the edge here, and leaves the ridge that it was on"],
  ["Drag along a ridge", "A guide: the line snaps to the ridge"],
  ["Drag an anchor", "Move it; a right click removes it"],
  ["Wheel", "Zoom; sideways, move the photo"],
  ["Right or middle drag, Alt+drag", "Move the photo"],
  ["Click into a strip", "Go to that column"],
  ["Shift+click", "The line passes just through this pixel"],
  ["Alt with brush, hide or sky", "The other way: erase, show again, all below is terrain"],
  ["Finger: tap, or aim and let go", "The line passes through there; what is under the finger is magnified"],
  ["Finger: draw along a ridge", "A guide"],
  ["Two fingers", "Zoom and move the photo"],
  ["Ctrl+click, Shift+click in the list or sheet", "Choose several photos"],
  ["Finger: rest on one in the list or sheet", "Choose it, and with taps from then on others"],
]);

/** Keys that work in the sheet, too, on the photo of its card. */
const EVERYWHERE = new Set([" ", "r", "R", "q", "c", "u", "Ctrl+z", "y", "Ctrl+y", "Ctrl+Z", "t", "p", "/", "?", "G"]);

/**
 * What a key does where nothing is being typed; undefined where it does nothing.
 *
 * @param {Entry[]} table
 * @param {Pressed} event
 * @param {boolean} sheet - Whether the sheet is shown, where few keys work.
 */
export function entryFor(table, event, sheet) {
  const find = (/** @type {string} */ key) => table.find(({ keys }) => keys.includes(key));
  const entry = find(named(event)) ?? (event.altKey ? undefined : find(plain(event)));
  return sheet && !entry?.keys.some((key) => EVERYWHERE.has(key)) ? undefined : entry;
}

/**
 * Let the keys of a table work.
 *
 * @param {Entry[]} table
 * @param {(event: KeyboardEvent) => boolean} quiet - Where they do not, since something is being typed.
 * @param {() => boolean} sheet - Whether the sheet is shown.
 */
export function listen(table, quiet, sheet) {
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || quiet(event)) return;
    const entry = entryFor(table, event, sheet());
    if (!entry) return;
    event.preventDefault();
    entry.run(event);
  });
}

/**
 * Call `up` when a key is let go.
 *
 * @param {string} key
 * @param {() => void} up
 */
export function letGo(key, up) {
  document.addEventListener("keyup", (event) => event.key.toLowerCase() === key && up());
  addEventListener("blur", up);
}

/** @typedef {Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">} Pressed */

/** @param {Pressed} event */
function named(event) {
  const control = event.ctrlKey || event.metaKey;
  return `${control ? "Ctrl+" : ""}${event.altKey ? "Alt+" : ""}${event.key}`;
}

/** @param {Pressed} event */
function plain(event) {
  const arrow = event.key.startsWith("Arrow");
  return (event.ctrlKey || event.metaKey) && !arrow ? "" : event.key;
}

/** @param {Pressed} event */
function pace(event) {
  return event.ctrlKey || event.metaKey ? 100 : event.shiftKey ? 10 : 1;
}
