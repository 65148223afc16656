/** Operations in words, and what kind of thing each of them is. */

import { notVisible } from "./hidden.js";

/** @import { Operation } from "../types.js" */

/**
 * @template {Operation["kind"]} Kind
 * @typedef {Extract<Operation, {kind: Kind}>} Of - The operation of a kind.
 */

/** @type {{[Kind in Operation["kind"]]: (how: Of<Kind>) => string}} */
const WORDS = {
  anchor: (how) => `the anchor at column ${how.column}, row ${how.row}`,
  move: (how) => `moving the anchor from column ${how.from_column} to ${how.column}`,
  remove: (how) => `removing the anchor at column ${how.column}`,
  forbid: (how) => `the stroke of the ${how.allow ? "eraser" : "brush"} at column ${how.points[0][0]}`,
  guide: (how) => `the guide from column ${how.points[0][0]}`,
  side: (how) => `“all ${how.ground === "sky" ? "above is sky" : "below is terrain"}” from column ${how.points[0][0]}`,
  straight: (how) => `the straight line from column ${how.column} to ${how.to_column}`,
  drawn: (how) => `the drawn line from column ${how.first} to ${how.first + how.rows.length - 1}`,
  hidden: (how) => `${how.hidden ? "hiding" : "showing"} columns ${how.first} to ${how.last}${how.why ? `: ${how.why}` : ""}`,
  release: (how) => `dropping what was asked for in columns ${how.first} to ${how.last}`,
  taken: (how) => `taking the line of ${how.of.join(" and ")} in columns ${how.first} to ${how.first + how.rows.length - 1}`,
  tag: (how) => `${how.on ? "the tag" : "taking off the tag"} “${how.tag}”`,
  status: (how) => `“${how.status}”`,
  open: () => "open",
};

/**
 * An operation in a few words.
 *
 * @param {Operation} operation
 */
export function described(operation) {
  return /** @type {(how: Operation) => string} */ (WORDS[operation.kind])(operation);
}

/** @type {{[Kind in Operation["kind"]]?: (how: Of<Kind>) => string}} */
const DONE = {
  move: (how) => `The anchor is at column ${how.column}, row ${how.row}.`,
  remove: (how) => `The anchor at column ${how.column} is removed.`,
  forbid: (how) => (how.allow ? "The line may go there again." : "The line stays out of there."),
  side: (how) => (how.ground === "sky" ? "All above is sky there." : "All below is terrain there."),
  straight: (how) => `The line is straight from column ${Math.min(how.column, how.to_column)} to ${Math.max(how.column, how.to_column)}.`,
  drawn: (how) => `The line lies as drawn from column ${how.first} to ${how.first + how.rows.length - 1}.`,
  hidden: (how) => `Columns ${how.first} to ${how.last} are ${how.hidden ? notVisible(how.why) : "visible"}.`,
  release: (how) => `What was asked for in columns ${how.first} to ${how.last} is dropped.`,
  taken: (how) => `The line of ${how.of.join(" and ")} is taken in columns ${how.first} to ${how.first + how.rows.length - 1}.`,
};

/**
 * What an operation has come to, in a sentence.
 *
 * @param {Operation} operation
 */
export function done(operation) {
  return /** @type {((how: Operation) => string) | undefined} */ (DONE[operation.kind])?.(operation) ?? `${described(operation)} is done.`;
}

/**
 * Whether something is known to Undo, or is Undo or Redo itself.
 *
 * @param {{operation: Operation | null}} item
 */
export function isChange({ operation }) {
  return operation?.kind !== "tag" && operation?.kind !== "open";
}

/**
 * Whether the line will follow when these have been sent.
 *
 * @param {{operation: Operation | null}[]} items
 */
export function changesLine(items) {
  return items.some((item) => isChange(item) && item.operation?.kind !== "status");
}
