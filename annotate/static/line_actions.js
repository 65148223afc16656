/** What is done to the line by key: a cursor, a mark, anchors and spans between them. */

import { get } from "./api.js";

/**
 * The line's actions by name. Nothing happens while no photo is there.
 *
 * @param {object} parts - {labelling, view, lines, previewer, focus}
 */
export function lineActions({ labelling, view, lines, previewer, focus }) {
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
    goTo(column) {
      previewer.clear();
      setCursor(column, null);
      focus();
    },
    /**
     * Set an anchor. With `across`, keep the line on this side of where it runs now: a thin stroke of
     * the brush goes along the old line, up to the neighbouring anchors or an eighth of the photo away.
     */
    setAnchor(column, row, across = false) {
      if (across && labelling.document.rows) rejectAround(column, row);
      const part = across ? null : previewer.known(column, row);
      previewer.clear();
      if (lines.cursor) lines.cursor = { column, row: null };
      if (labelling.apply({ kind: "anchor", column, row }, part)) labelling.say(`Anchor at column ${column}, row ${row}.`);
    },
    uncertain(step) {
      const found = (labelling.margins?.uncertain ?? []).toSorted((a, b) => a - b);
      if (!found.length) return labelling.say("No column is uncertain.");
      const least = labelling.margins.uncertain[0];
      const from = lines.cursor?.column;
      const beyond = step > 0 ? found.find((one) => one > from) ?? found[0] : found.findLast((one) => one < from) ?? found.at(-1);
      const column = from === undefined ? least : beyond;
      act.goTo(column);
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
      act.setAnchor(...place(), across);
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
        if (labelling.document.id !== document.id) return; // asked for a photo that is left by now
        const chosen = alternatives[number - 1];
        if (!chosen) return labelling.say(`There are ${alternatives.length} other lines through column ${column}.`);
        setCursor(column, null);
        act.setAnchor(column, chosen.row);
      } catch (error) {
        labelling.say(error.message, true);
      }
    },
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
    zoom(key) {
      if (key === "0") view.fit();
      else view.zoom(key === "-" ? 1 / 1.5 : 1.5, ...(lines.cursor ? view.toScreen(...place()) : []));
    },
    pan(key) {
      const [x, y] = { ArrowLeft: [80, 0], ArrowRight: [-80, 0], ArrowUp: [0, 80], ArrowDown: [0, -80] }[key];
      view.pan(x, y);
    },
    escape() {
      dropMark();
      lines.cursor = null;
      lines.stroke = null;
      lines.draw();
    },
  };
  // one place for the rule: without a photo, or while another one is on its way, nothing is done
  const guarded = (run) => (...how) => (labelling.document && !labelling.loading ? run(...how) : undefined);
  return Object.fromEntries(Object.entries(act).map(([name, run]) => [name, guarded(run)]));
}
