/** What is done to the line by key: a cursor, a mark, anchors and spans between them. */

import { alongOldLine, nearest, nextUncertain } from "../basics/geometry.js";
import { counted } from "../basics/words.js";
import { ApiError, get } from "../server/api.js";
import { brushRadius } from "./strokes.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Previewer } from "../labelled/previewer.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { View } from "../labelled/view.js" */
/** @import { Document } from "../types.js" */

const PAN = 80; // screen pixels that a key moves the photo

/**
 * The line's actions by name. Nothing happens while no photo is there.
 *
 * @param {object} parts
 * @param {Labelling} parts.labelling
 * @param {View} parts.view
 * @param {Selection} parts.selection
 * @param {Pick<Previewer, "ask" | "clear" | "known">} parts.previewer
 * @param {() => void} parts.focus - Give the photo the keys.
 */
export function lineActions({ labelling, view, selection, previewer, focus }) {
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
    done();
    return columns;
  }

  function done() {
    previewer.clear();
    selection.rest();
  }

  const act = {
    /** @param {number} column */
    goTo(column) {
      previewer.clear();
      moveTo(column, null);
      focus();
    },
    /**
     * Set an anchor. With `across`, keep the line on this side of where it runs now: a thin stroke of
     * the brush goes along the old line, up to the neighbouring anchors or an eighth of the photo away.
     *
     * @param {number} column
     * @param {number} row
     * @param {boolean} [across]
     */
    setAnchor(column, row, across = false) {
      const { rows } = shown();
      if (across && rows) {
        const stroke = alongOldLine({ ...shown(), rows }, [column, row]);
        if (stroke.points.length) labelling.apply({ kind: "forbid", ...stroke, allow: false });
      }
      const part = across ? null : previewer.known(column, row);
      previewer.clear();
      if (selection.now.cursor) selection.moveTo(shown(), column);
      if (labelling.apply({ kind: "anchor", column, row }, part)) labelling.say(`Anchor at column ${column}, row ${row}.`);
    },
    /** @param {number} step */
    uncertain(step) {
      const { margins } = labelling;
      const column = nextUncertain(margins?.uncertain ?? [], selection.now.cursor?.column, step);
      if (!margins || column === undefined) return labelling.say("No column is uncertain.");
      act.goTo(column);
      labelling.say(`Column ${column}, margin ${margins.margins[column]?.toFixed(2)}.`);
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
      previewer.ask(...place());
      labelling.say(`Column ${column}, row ${place()[1]}.`);
    },
    /** @param {boolean} across */
    anchorHere(across) {
      act.setAnchor(...place(), across);
    },
    removeNearest() {
      const [column] = place();
      const found = nearest(shown().anchors, ([one]) => Math.abs(one - column));
      if (!found) return labelling.say("There is no anchor.");
      labelling.apply({ kind: "remove", column: found[0] });
      labelling.say(`The anchor at column ${found[0]} is removed.`);
    },
    /** @param {number} number */
    async alternative(number) {
      const { id } = shown();
      try {
        const { alternatives } = await get(`api/photos/${id}/alternatives`);
        if (labelling.document?.id !== id) return; // asked for a photo that is left by now
        const chosen = alternatives[number - 1];
        if (!chosen) return labelling.say(`There are ${counted(alternatives.length, "other line")}.`);
        labelling.apply({ kind: "guide", points: chosen.points, radius: chosen.radius });
      } catch (error) {
        labelling.say(ApiError.of(error).message, true);
      }
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
      done();
      labelling.apply({ kind: "straight", column: mark.column, row: mark.row, to_column: column, to_row: row });
    },
    /** @param {boolean} hidden */
    hide(hidden) {
      const { first, last } = marked();
      labelling.apply({ kind: "hidden", first, last, hidden });
      labelling.say(`Columns ${first} to ${last} are ${hidden ? "not visible" : "visible"}.`);
    },
    release() {
      labelling.apply({ kind: "release", ...marked() });
    },
    /** @param {boolean} allow */
    forbid(allow) {
      const points = [place()];
      done();
      labelling.apply({ kind: "forbid", points, radius: brushRadius(view.scale, 2), allow });
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
