/** The corridor of a guide: what a disc covers that is led along it, wider where the hand was fast. */

import { within } from "../basics/geometry.js";

/** @import { Point } from "../basics/geometry.js" */
/** @import { Stroke } from "../labelled/selection.js" */

const FAST = 40; // radii a second, as the server has it: a disc of twice the radius

/**
 * Radius of the disc at each point, as the server finds it.
 *
 * @param {Pick<Stroke, "points" | "radius" | "times">} stroke
 */
export function radiiOf({ points, radius, times }) {
  if (times.length !== points.length || points.length < 2) return points.map(() => radius);
  const speeds = points.slice(1).map(([column, row], at) => {
    const length = Math.hypot(column - points[at][0], row - points[at][1]);
    return within(length / (Math.max(times[at + 1] - times[at], 1) / 1000) / (FAST * radius), 0, 1);
  });
  return points.map((_, at) => radius * (1 + Math.max(speeds[Math.max(at - 1, 0)], speeds[Math.min(at, speeds.length - 1)])));
}

/**
 * The corridor as one shape in pixels of the photo, to be filled at once.
 *
 * @param {Pick<Stroke, "points" | "radius" | "times">} stroke
 */
export function corridor(stroke) {
  const path = new Path2D();
  const radii = radiiOf(stroke);
  stroke.points.forEach((point, at) => {
    const [x, y] = middle(point);
    path.moveTo(x + radii[at], y);
    path.arc(x, y, radii[at], 0, 2 * Math.PI);
    if (at) join(path, middle(stroke.points[at - 1]), radii[at - 1], [x, y], radii[at]);
  });
  return path;
}

/**
 * What lies between two discs. It turns the way that discs do, so that shapes add up where they overlap.
 *
 * @param {Path2D} path
 * @param {Point} from
 * @param {number} wide
 * @param {Point} to
 * @param {number} wider
 */
function join(path, [x, y], wide, [tox, toy], wider) {
  const length = Math.hypot(tox - x, toy - y) || 1;
  const [across, down] = [-(toy - y) / length, (tox - x) / length];
  path.moveTo(x - across * wide, y - down * wide);
  path.lineTo(tox - across * wider, toy - down * wider);
  path.lineTo(tox + across * wider, toy + down * wider);
  path.lineTo(x + across * wide, y + down * wide);
  path.closePath();
}

/**
 * @param {Point} pixel
 * @returns {Point}
 */
function middle([column, row]) {
  return [column + 0.5, row];
}
