/** A guide: a rough stroke along a ridge, to which the line snaps; drawn at once, or corner by corner. */

import { thinned, within } from "../basics/geometry.js";
import { touch } from "./strokes.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Previewer } from "../labelled/previewer.js" */
/** @import { Selection, Stroke } from "../labelled/selection.js" */
/** @import { View } from "../labelled/view.js" */
/** @import { Document, Rough } from "../types.js" */
/** @import { Bench, Contact } from "./strokes.js" */

const HAND = { mouse: 6, finger: 12 }; // screen pixels that a slow hand is uncertain by; the server doubles it for a fast one
const CORNERS = 2; // times as much between corners, which are joined by straight lines
const WIDEST = 1000; // radius in pixels of the photo, as the server takes it
const SAME = 8; // screen pixels within which a second click means the last corner

/**
 * What a hand is uncertain by, in pixels of the photo, at some zoom.
 *
 * @param {number} scale
 * @param {boolean} [finger]
 */
export function handRadius(scale, finger = false) {
  return within(Math.round((finger ? HAND.finger : HAND.mouse) / scale), 2, WIDEST);
}

/**
 * A stroke as it is sent. Its times begin with 0.
 *
 * @param {Pick<Stroke, "points" | "radius" | "times">} stroke
 * @returns {Rough}
 */
export function roughly({ points, radius, times }) {
  const timed = times.length === points.length && points.length > 1;
  const kept = thinned(points);
  return { points: kept, radius, times: timed ? thinned(times).map((time) => Math.round(time - times[0])) : [] };
}

/** A stroke along a ridge, shown as the line that would come of it. It begins where the hand was put down. */
export class GuideStroke {
  #bench;

  /**
   * @param {Bench} bench
   * @param {Contact} contact - The first one.
   */
  constructor(bench, { pixel, finger, time }) {
    this.#bench = bench;
    bench.previewer.clear();
    bench.selection.begin("guide", pixel, { radius: handRadius(bench.view.scale, finger), time });
  }

  /** @param {Contact} contact */
  move(contact) {
    const { selection, previewer } = this.#bench;
    if (!selection.now.stroke) return; // dropped on the way
    selection.extend(contact.pixel, contact.time);
    touch(this.#bench, contact);
    previewer.follow(roughly(selection.now.stroke));
  }

  end() {
    const { stroke } = this.#bench.selection.now;
    if (stroke) this.#bench.guide(roughly(stroke));
  }
}

/**
 * What is done with guides by name.
 *
 * @param {object} parts
 * @param {Pick<Labelling, "document" | "apply" | "say">} parts.labelling
 * @param {Selection} parts.selection
 * @param {View} parts.view
 * @param {Pick<Previewer, "clear" | "follow" | "known">} parts.previewer
 */
export function guideActions({ labelling, selection, view, previewer }) {
  const place = () => selection.place(/** @type {Document} */ (labelling.document));
  /** @param {Point[]} points */
  const along = (points) => ({ points, radius: handRadius(view.scale / CORNERS), times: [] });
  /** @type {(one: Point, other: Point) => boolean} */
  const close = (one, other) => Math.hypot(one[0] - other[0], one[1] - other[1]) * view.scale <= SAME;

  const act = {
    /**
     * Let the line lie along a stroke.
     *
     * @param {Rough} rough
     */
    guide(rough) {
      const part = previewer.known("guide", rough);
      previewer.clear();
      selection.corner([]);
      if (labelling.document?.blind) {
        labelling.say("The photo is labelled blind, so a guide has nothing to snap to. Click along the skyline, or draw it.", true);
      } else if (labelling.apply({ kind: "guide", ...rough }, part)) labelling.say("The line follows the guide.");
    },
    /**
     * Go on to another corner; the last one once more ends the guide.
     *
     * @param {Point} [pixel] - The cursor's unless given; the cursor is there from then on.
     */
    corner(pixel) {
      const { corners, cursor } = selection.now;
      const at = pixel ?? place();
      const last = corners.at(-1);
      if (last && close(last, at)) return act.finishGuide();
      selection.corner([...corners, at]);
      if (!pixel && !cursor) selection.moveTo(/** @type {Document} */ (labelling.document), at[0]);
      act.showGuide();
      const said = corners.length ? "The next corner; the last one again, or Enter, ends the guide. Escape drops it." : "The guide begins here. Now the next corner along the ridge.";
      labelling.say(said);
    },
    /**
     * Show the line along the corners, and on to a pixel.
     *
     * @param {Point} [pixel]
     */
    showGuide(pixel) {
      const points = [...selection.now.corners, ...(pixel ? [pixel] : [])];
      if (points.length > 1) previewer.follow(along(points));
    },
    finishGuide() {
      const { corners } = selection.now;
      if (corners.length > 1) act.guide(along(corners));
      else labelling.say("A guide needs two corners at least.");
    },
    dropCorner() {
      selection.corner(selection.now.corners.slice(0, -1));
      previewer.clear();
      act.showGuide();
    },
  };
  return act;
}
