/** What is done to the line by key: a cursor, a mark, anchors and spans between them. */

import { doubts, nextDoubt } from "../basics/doubts.js";
import { nearest } from "../basics/geometry.js";
import { unseen } from "../basics/hidden.js";
import { done } from "../basics/operations.js";
import { guideActions } from "./guides.js";
import { otherLines } from "./other_lines.js";
import { brushRadius } from "./strokes.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Previewer } from "../labelled/previewer.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { View } from "../labelled/view.js" */
/** @import { Document, Operation } from "../types.js" */

const PAN = 80; // screen pixels that a key moves the photo

/**
 * The line's actions by name. Nothing happens while no photo is there.
 *
 * @param {object} parts
 * @param {Labelling} parts.labelling
 * @param {View} parts.view
 * @param {Selection} parts.selection
 * @param {Pick<Previewer, "ask" | "clear" | "follow" | "known">} parts.previewer
 * @param {{readonly radius: number}} parts.brush - In screen pixels.
 * @param {() => void} parts.focus - Give the photo the keys.
 */
export function lineActions({ labelling, view, selection, previewer, brush, focus }) {
  const shown = () => /** @type {Document} */ (labelling.document); // see `guarded`
  const place = () => selection.place(shown());

  /**
   * @param {number} column
   * @param {number | null} row
   */
  function moveTo(column, row) {
    selection.moveTo(shown(), column, row);
    view.reveal(...place());
  }

  /** Columns from the mark to the cursor, which both are done with. */
  function marked() {
    const columns = selection.columns(shown());
    restCursor();
    return columns;
  }

  function restCursor() {
    previewer.clear();
    selection.rest();
  }

  const guides = guideActions({ labelling, selection, view, previewer });
  const others = otherLines({ labelling, selection, previewer });

  /** Show what would come of the pixel under the cursor. */
  function showHere() {
    if (selection.now.corners.length) guides.showGuide(place());
    else previewer.ask(...place());
  }

  const act = {
    /**
     * Do something, and say that it is done.
     *
     * @param {Operation} operation
     */
    did(operation) {
      const { id } = shown();
      if (!labelling.apply(operation)) return;
      const hides = operation.kind === "hidden" && operation.hidden && !operation.why ? operation : null;
      const why = (hides && labelling.legend?.hidden_by) ?? [];
      labelling.say(done(operation), false, null, why.map((words) => ({
        words,
        run: () => hides && labelling.document?.id === id && act.did({ ...hides, why: words }),
      })));
    },
    ...guides,
    ...others,
    /** @param {number} column */
    goTo(column) {
      previewer.clear();
      moveTo(column, null);
      focus();
    },
    /**
     * Put the cursor on an anchor.
     *
     * @param {number} column
     */
    select(column) {
      act.goTo(column);
      labelling.say(`The anchor at column ${column} has the cursor: drag it, or Delete removes it. Zoom in to set another one beside it.`);
    },
    /**
     * Set an anchor on the best edge that is no more than so many rows away, or just there.
     *
     * @param {number} column
     * @param {number} row
     * @param {number} [within]
     */
    setAnchor(column, row, within = 0) {
      const part = previewer.known("preview", { column, row, within, lifted: null });
      previewer.clear();
      if (selection.now.cursor) selection.moveTo(shown(), column);
      if (labelling.apply({ kind: "anchor", column, row, within }, part)) labelling.say(`Anchor at column ${column}.`);
    },
    /** @param {number} step */
    uncertain(step) {
      const { apart } = shown();
      if (apart.length) return act.differing(apart, step);
      const { margins } = labelling;
      if (!margins) return labelling.say(shown().blind ? "The photo is labelled blind, so nothing is known to be uncertain." : "How sure the line is, is being measured.");
      const spans = doubts(margins.margins, unseen(shown()));
      const at = nextDoubt(spans, selection.now.cursor?.column, step);
      if (at < 0) return labelling.say("No span is uncertain.");
      const { first, last, column, margin } = spans[at];
      view.look(first, last, shown().rows?.[column] ?? 0);
      act.goTo(column);
      const where = first === last ? `column ${first}` : `columns ${first} to ${last}`;
      labelling.say(`Uncertain span ${at + 1} of ${spans.length}: ${where}. Another line there costs only ${margin.toFixed(2)} more.`);
    },
    /**
     * Go to a span in which passes differ.
     *
     * @param {[number, number][]} apart - All of them.
     * @param {number} step
     */
    differing(apart, step) {
      const spans = apart.map(([first, last]) => ({ first, last, column: Math.floor((first + last) / 2), margin: 0 }));
      const at = nextDoubt(spans, selection.now.cursor?.column, step);
      const { first, last, column } = spans[at];
      view.look(first, last, shown().rows?.[column] ?? 0);
      act.goTo(column);
      labelling.say(`Passes differ in span ${at + 1} of ${spans.length}: columns ${first} to ${last}. 1 shows their lines.`);
    },
    /** @param {number} step */
    moveColumn(step) {
      const [column] = place();
      previewer.clear();
      moveTo(selection.now.cursor ? column + step : column, null);
      labelling.say(`Column ${place()[0]}, row ${place()[1]}.`);
    },
    /** @param {number} step */
    moveRow(step) {
      const [column, row] = place();
      moveTo(column, row + step);
      showHere();
      labelling.say(`Column ${column}, row ${place()[1]}.`);
    },
    anchorHere() {
      if (selection.now.corners.length) act.finishGuide();
      else act.setAnchor(...place());
    },
    removeNearest() {
      if (selection.now.corners.length) return act.dropCorner();
      const [column] = place();
      const found = nearest(shown().anchors, ([one]) => Math.abs(one - column));
      if (!found) return labelling.say("There is no anchor.");
      labelling.apply({ kind: "remove", column: found[0] });
      labelling.say(`The anchor at column ${found[0]} is removed.`);
    },
    mark() {
      const [column, row] = place();
      selection.mark(shown());
      view.reveal(column, row);
      labelling.say(`Mark at column ${column}, row ${row}.`);
    },
    straight() {
      const { mark } = selection.now;
      if (!mark) return labelling.say("Put a mark at one end first: M.");
      const [column, row] = place();
      restCursor();
      act.did({ kind: "straight", column: mark.column, row: mark.row, to_column: column, to_row: row });
    },
    /** @param {boolean} hidden */
    hide(hidden) {
      const { first, last } = marked();
      act.did({ kind: "hidden", first, last, hidden });
    },
    release() {
      act.did({ kind: "release", ...marked() });
    },
    /** @param {boolean} allow */
    forbid(allow) {
      const points = [place()];
      restCursor();
      act.did({ kind: "forbid", points, radius: brushRadius(brush.radius, view.scale, 2), allow });
    },
    /** @param {string} key */
    zoom(key) {
      if (key === "0") view.fit();
      else view.zoom(key === "-" ? 1 / 1.5 : 1.5, ...(selection.now.cursor ? view.toScreen(...place()) : []));
    },
    /** @param {string} key */
    pan(key) {
      if (key === "ArrowLeft" || key === "ArrowRight") view.pan(key === "ArrowLeft" ? PAN : -PAN, 0);
      else view.pan(0, key === "ArrowUp" ? PAN : -PAN);
    },
    escape() {
      previewer.clear();
      selection.clear();
      labelling.say("");
    },
  };
  return guarded(act, () => Boolean(labelling.document && !labelling.loading));
}

/**
 * One place for the rule: without a photo, or while another one is on its way, nothing is done.
 *
 * @template {{[name: string]: (...how: any[]) => unknown}} Acts
 * @param {Acts} acts
 * @param {() => boolean} ready
 */
function guarded(acts, ready) {
  const wrapped = Object.entries(acts).map(([name, run]) =>
    [name, (/** @type {any[]} */ ...how) => (ready() ? run(...how) : undefined)]);
  return /** @type {Acts} */ (Object.fromEntries(wrapped));
}
