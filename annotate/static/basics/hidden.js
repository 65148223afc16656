/** Columns in which the line cannot be seen, and what hides it. */

/** @import { Document, Hidden } from "../types.js" */

/**
 * Runs of columns that do not count: those that were hidden, or all where the photo has no visible skyline.
 *
 * @param {Pick<Document, "hidden" | "width" | "nothing_visible">} document
 * @returns {readonly Hidden[]}
 */
export function unseen({ hidden, width, nothing_visible: nothing }) {
  return nothing ? [[0, width - 1, "no skyline"]] : hidden;
}

/**
 * What stands on a band of hidden columns.
 *
 * @param {string | null} [why]
 */
export function notVisible(why) {
  return why ? `not visible: ${why}` : "not visible";
}
