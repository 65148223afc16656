/** Where the line is uncertain: columns put together into spans that are worth a look. */

/** @import { Hidden } from "../types.js" */

/** @typedef {{first: number, last: number, column: number, margin: number}} Doubt - `column` is the least certain one. */

const DOUBTFUL = 0.5; // a margin under which another line is nearly as good
const APART = 1 / 40; // of the photo's width: spans that are nearer are one
const RIM = 1 / 200; // of the photo's width: what is narrower and touches the rim is only that

/**
 * Uncertain spans from left to right. Hidden columns are none, and neither are slivers at the photo's rim.
 *
 * @param {(number | null)[]} margins - Of each column; null where its row is fixed.
 * @param {readonly Hidden[]} [hidden] - Spans in which the line cannot be seen.
 * @returns {Doubt[]}
 */
export function doubts(margins, hidden = []) {
  const width = margins.length;
  /** @type {Doubt[]} */
  const found = [];
  margins.forEach((margin, column) => {
    if (margin === null || margin >= DOUBTFUL || hidden.some(([first, last]) => first <= column && column <= last)) return;
    const before = found.at(-1);
    if (!before || column - before.last > width * APART) found.push({ first: column, last: column, column, margin });
    else {
      before.last = column;
      if (margin < before.margin) Object.assign(before, { column, margin });
    }
  });
  return found.filter(({ first, last }) => last - first + 1 >= width * RIM || (first > 0 && last < width - 1));
}

/**
 * Place of the next span beyond a column, around the photo; without one, of the least certain.
 *
 * @param {Doubt[]} spans - From left to right.
 * @param {number | undefined} from
 * @param {number} step - To the right where it is positive.
 * @returns {number} -1 where there is none.
 */
export function nextDoubt(spans, from, step) {
  if (!spans.length) return -1;
  if (from === undefined) return spans.reduce((least, span, at) => (span.margin < spans[least].margin ? at : least), 0);
  const found = step > 0 ? spans.findIndex(({ column }) => column > from) : spans.findLastIndex(({ column }) => column < from);
  if (found >= 0) return found;
  return step > 0 ? 0 : spans.length - 1;
}
