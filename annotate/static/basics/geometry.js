/** Pixels, strokes and columns as numbers: nothing here knows a screen or a server. */

/** @typedef {[number, number]} Point - Column and row of a pixel, or x and y on the screen. */

const MOST = 2000; // points of a stroke that are sent
const SURE = 4; // a margin above which a column counts as sure

/**
 * A number, or the nearest one from `low` to `high`.
 *
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export function within(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/**
 * A stroke with at most some 2,000 points, the last one among them; or its times, one a point.
 *
 * @template Kind
 * @param {Kind[]} points
 */
export function thinned(points) {
  const step = Math.ceil(points.length / MOST);
  return points.filter((_, at) => at % step === 0 || at === points.length - 1);
}

/**
 * Where the brush goes: through the middle of pixels. A dot has two points, since a line of no length is not drawn.
 *
 * @param {Point[]} points - Pixels.
 * @returns {Point[]}
 */
export function brushed(points) {
  const middles = points.map(([column, row]) => /** @type {Point} */ ([column + 0.5, row + 0.5]));
  const [x, y] = middles[0];
  return middles.length > 1 ? middles : [[x, y], [x + 0.01, y]];
}

/**
 * First column and a row a column of a drawn stroke; where it goes back, what was drawn last counts.
 *
 * @param {Point[]} points
 */
export function drawn(points) {
  /** @type {Map<number, number>} */
  const rows = new Map();
  points.forEach(([column, row], at) => {
    const [from, high] = points[Math.max(at - 1, 0)];
    const steps = Math.max(Math.abs(column - from), 1);
    for (let step = 0; step <= steps; step++) {
      const share = step / steps;
      rows.set(Math.round(from + share * (column - from)), Math.round(high + share * (row - high)));
    }
  });
  const columns = [...rows.keys()].sort((a, b) => a - b); // all of them, since every step is one column
  return { first: columns[0], rows: columns.map((column) => rows.get(column) ?? 0) };
}

/**
 * The anchor nearest to a place; undefined where none is within reach.
 *
 * @param {Point[]} anchors
 * @param {(anchor: Point) => number} away - How far an anchor is.
 * @param {number} [reach]
 */
export function nearest(anchors, away, reach = Infinity) {
  const found = anchors.toSorted((a, b) => away(a) - away(b))[0];
  return found && away(found) <= reach ? found : undefined;
}

/**
 * How uncertain the columns under each of some bars are, from 0 (sure) to 1: the least certain one counts.
 *
 * @param {(number | null)[]} margins - Of each column; null where its row is fixed.
 * @param {number} bars
 * @param {number} [from] - Column at which the first bar begins; it may lie between two.
 * @param {number} [across] - Columns under all bars together.
 */
export function uncertainty(margins, bars, from = 0, across = margins.length) {
  return Array.from({ length: bars }, (_, bar) => {
    const first = Math.floor(from + bar * across / bars);
    const stop = Math.max(Math.floor(from + (bar + 1) * across / bars), first + 1);
    let least = Infinity;
    for (let column = first; column < stop; column++) least = Math.min(least, margins[column] ?? Infinity);
    return Math.max(1 - least / SURE, 0) ** 2;
  });
}
