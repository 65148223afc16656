/** Numbers, times and troubles in words. */

/**
 * A number of things.
 *
 * @param {number} number
 * @param {string} thing
 */
export function counted(number, thing) {
  return `${number} ${thing}${number === 1 ? "" : "s"}`;
}

/**
 * A time as people say it.
 *
 * @param {number} seconds
 */
export function spoken(seconds) {
  if (seconds < 90) return `${seconds.toFixed(0)} s`;
  return seconds < 5400 ? `${(seconds / 60).toFixed(0)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

/**
 * Why edits wait, and what will become of them, and of the line where they change it.
 *
 * @param {string} reason - Empty while nothing is wrong.
 * @param {number} waiting
 * @param {boolean} [line] - Whether they change it.
 */
export function trouble(reason, waiting, line = false) {
  if (!reason) return "";
  if (!waiting) return reason;
  const sent = waiting === 1 ? "waits and is sent as soon as it can be" : "wait and are sent as soon as they can be";
  return `${reason} ${counted(waiting, "edit")} ${sent}${line ? "; the line follows then" : ""}.`;
}

/**
 * What was said of a photo, and by whom.
 *
 * @param {{text: string, by: string} | null | undefined} comment
 */
export function remark(comment) {
  return comment ? `${comment.by}: ${comment.text}` : "";
}

/**
 * How surely the proposal of a photo that nobody has looked at is right, in words; nothing of others.
 *
 * @param {string} status
 * @param {number | null} confidence - Probability that the line is no gross miss.
 */
export function sure(status, confidence) {
  return status === "to do" && confidence !== null ? [`${Math.min(Math.round(100 * confidence), 99)} % sure`] : [];
}
