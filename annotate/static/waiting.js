/** What waits for the server, as it can be drawn before the line is known that follows from it. */

const SKETCH = "#ffd400";
const HALO = "rgb(20 20 20 / 70%)";
const ANCHOR = 6; // radius, in screen pixels

/**
 * What to draw for operations that wait: `discs` at pixels, `crosses` in columns whose anchor goes, `paths`
 * along pixels, `bands` of columns, `strokes` of the brush. What a waiting undo takes back is left out.
 *
 * @param {import("./queue.js").Item[]} items - For one photo, oldest first.
 */
export function sketched(items) {
  const done = [];
  const undone = [];
  for (const { what, operation } of items) {
    if (what === "undo") {
      if (done.length) undone.push(done.pop());
    } else if (what === "redo") {
      if (undone.length) done.push(undone.pop());
    } else if (operation.kind !== "tag") done.push(operation);
  }
  const found = { discs: new Map(), crosses: new Set(), paths: [], bands: [], strokes: [] };
  const remove = (column) => {
    found.discs.delete(column);
    found.crosses.add(column);
  };
  const set = (column, row) => {
    found.crosses.delete(column);
    found.discs.set(column, [column, row]);
  };
  const add = {
    anchor: ({ column, row }) => set(column, row),
    remove: ({ column }) => remove(column),
    move: ({ from_column: from, column, row }) => {
      remove(from);
      set(column, row);
    },
    straight: (one) => found.paths.push([[one.column, one.row], [one.to_column, one.to_row]]),
    drawn: ({ first, rows }) => found.paths.push(rows.map((row, at) => [first + at, row])),
    hidden: ({ first, last, hidden }) => found.bands.push({ first, last, words: hidden ? "not visible" : "visible" }),
    release: ({ first, last }) => found.bands.push({ first, last, words: "dropped" }),
    forbid: ({ points, radius, allow }) => found.strokes.push({ points, radius, allow }),
  };
  for (const operation of done) add[operation.kind]?.(operation);
  return { ...found, discs: [...found.discs.values()], crosses: [...found.crosses] };
}

/** Whether the line will follow when these have been sent. */
export function changesLine(items) {
  return items.some(({ operation }) => !["tag", "status", "open"].includes(operation?.kind));
}

/**
 * Draw it, hollow and dashed, on a canvas in screen pixels.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {ReturnType<typeof sketched>} what
 * @param {import("./view.js").View} view
 * @param {(column: number) => number | undefined} rowOf - Of the anchor in a column.
 */
export function paintWaiting(pen, { discs, crosses, paths, bands, strokes }, view, rowOf) {
  const at = ([column, row], down = 0) => view.toScreen(column + 0.5, row + down);
  const line = (points, down = 0) => {
    pen.beginPath();
    points.forEach((point, place) => pen[place ? "lineTo" : "moveTo"](...at(point, down)));
  };
  const dashed = () => {
    for (const [colour, width] of [[HALO, 4.5], [SKETCH, 2]]) {
      Object.assign(pen, { strokeStyle: colour, lineWidth: width });
      pen.stroke();
    }
  };
  for (const { points, radius, allow } of strokes) {
    line(points.length > 1 ? points : [points[0], points[0]], 0.5);
    pen.strokeStyle = allow ? "rgb(255 255 255 / 35%)" : "rgb(0 0 0 / 55%)";
    pen.lineWidth = (2 * radius + 1) * view.scale;
    pen.stroke();
  }
  pen.setLineDash([3, 4]);
  for (const path of paths) {
    line(path);
    dashed();
  }
  for (const { first, last, words } of bands) {
    const [left, right] = [view.toScreen(first, 0)[0], view.toScreen(last + 1, 0)[0]];
    pen.beginPath();
    pen.rect(left, 4, right - left, 18);
    dashed();
    pen.fillStyle = SKETCH;
    pen.font = "12px sans-serif";
    pen.fillText(words, left + 6, 17, Math.max(right - left - 12, 1));
  }
  pen.setLineDash([]);
  for (const disc of discs) {
    pen.beginPath();
    pen.arc(...at(disc), ANCHOR, 0, 2 * Math.PI);
    dashed();
  }
  for (const column of crosses) {
    const row = rowOf(column);
    if (row === undefined) continue;
    const [x, y] = at([column, row]);
    pen.beginPath();
    for (const side of [-1, 1]) {
      pen.moveTo(x - ANCHOR, y - side * ANCHOR);
      pen.lineTo(x + ANCHOR, y + side * ANCHOR);
    }
    dashed();
  }
}
