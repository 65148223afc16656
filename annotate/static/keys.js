/** All keys, in one table: what they do, and what the help says about them. */

/**
 * @param {object} act - Functions by name, see `actions.js` and `line_actions.js`.
 * @returns {{keys: string[], shown: string, says: string, run: (event: KeyboardEvent) => void}[]}
 */
export function keyTable(act) {
  const one = (shown, says, run, ...keys) => ({ keys, shown, says, run });
  return [
    one("Space", "Accept, and show the next photo", () => act.finish("accepted"), " "),
    one("R", "Needs review, next photo", () => act.finish("needs review"), "r"),
    one("Q", "Reject, next photo", () => act.finish("rejected"), "q"),
    one("C", "Set the photo back: it is to do again", () => act.setStatus("to do"), "c"),
    one("N, Shift+N", "Next, previous uncertain column", (event) => act.uncertain(event.shiftKey ? -1 : 1), "n", "N"),
    one("← →", "Move the column cursor; with Shift 10, with Ctrl 100 columns", (event) =>
      act.moveColumn((event.key === "ArrowLeft" ? -1 : 1) * pace(event)), "ArrowLeft", "ArrowRight"),
    one("↑ ↓", "Move its row; with Shift 10, with Ctrl 100 rows", (event) =>
      act.moveRow((event.key === "ArrowUp" ? -1 : 1) * pace(event)), "ArrowUp", "ArrowDown"),
    one("Enter, Shift+Enter", "Set an anchor at the cursor; and leave the old line around it", (event) => act.anchorHere(event.shiftKey), "Enter"),
    one("Delete", "Remove the anchor nearest the cursor", () => act.removeNearest(), "Delete", "Backspace"),
    one("1 2 3 4", "Other lines through the cursor's column, the likeliest first", (event) => act.alternative(Number(event.key)), "1", "2", "3", "4"),
    one("U, Ctrl+Z", "Undo", () => act.undo(), "u", "Ctrl+z"),
    one("Y, Ctrl+Shift+Z", "Redo", () => act.redo(), "y", "Ctrl+y", "Ctrl+Z"),
    one("M", "Put a mark at the cursor", () => act.mark(), "m"),
    one("L", "Straight line from the mark to the cursor", () => act.straight(), "l"),
    one("K", "The line cannot be seen from the mark to the cursor", () => act.hide(true), "k"),
    one("V", "It can be seen again there", () => act.hide(false), "v"),
    one("X", "Drop all that was asked for there", () => act.release(), "x"),
    one("F, Shift+F", "Keep the line away from the cursor; allow it again", (event) => act.forbid(event.shiftKey), "f", "F"),
    one("A B S D H", "Tools: anchor, brush, straight, draw, hide", (event) => act.tool(event.key), "a", "b", "s", "d", "h"),
    one("T", "Tags", () => act.tags(), "t"),
    one("[ ]", "Previous, next photo", (event) => act.step(event.key === "[" || event.key === "PageUp" ? -1 : 1), "[", "]", "PageUp", "PageDown"),
    one("+ − 0", "Zoom in, out, whole photo", (event) => act.zoom(event.key), "+", "=", "-", "0"),
    one("Alt+arrows", "Move the photo", (event) => act.pan(event.key), "Alt+ArrowLeft", "Alt+ArrowRight", "Alt+ArrowUp", "Alt+ArrowDown"),
    one("O", "Next overlay: the stages of the detector", () => act.overlay(), "o"),
    one("G", "Stages in Rerun, with this line as truth", () => act.stages(), "g"),
    one("W", "Sheet: strips of many photos", () => act.sheet(), "w"),
    one("P", "Show or hide the list of photos", () => act.list(), "p"),
    one("/", "Search photos", () => act.search(), "/"),
    one("?", "These keys", () => act.help(), "?"),
    one("Escape", "Drop the mark and what is being shown", () => act.escape(), "Escape"),
  ];
}

/** Keys that work in the sheet, too, on the photo of its card. */
const EVERYWHERE = new Set([" ", "r", "q", "c", "u", "Ctrl+z", "y", "Ctrl+y", "Ctrl+Z", "t", "p", "/", "?"]);

/** Let the keys of a table work wherever nothing is being typed: `quiet` says where, `sheet` whether it is shown. */
export function listen(table, quiet, sheet) {
  const known = new Map(table.flatMap((entry) => entry.keys.map((key) => [key, entry])));
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || quiet(event)) return;
    const entry = known.get(named(event)) ?? (event.altKey ? undefined : known.get(plain(event)));
    if (!entry || (sheet() && !entry.keys.some((key) => EVERYWHERE.has(key)))) return;
    event.preventDefault();
    entry.run(event);
  });
}

function named(event) {
  const control = event.ctrlKey || event.metaKey;
  return `${control ? "Ctrl+" : ""}${event.altKey ? "Alt+" : ""}${event.key}`;
}

function plain(event) {
  const arrow = event.key.startsWith("Arrow");
  return (event.ctrlKey || event.metaKey) && !arrow ? "" : event.key;
}

function pace(event) {
  return event.ctrlKey || event.metaKey ? 100 : event.shiftKey ? 10 : 1;
}
