/** What waits, and makes no sense any more since something before it was lost or came between. */

import { isChange } from "../basics/operations.js";

/** @import { Item } from "./queue.js" */

/**
 * Another tab's line would be accepted, which nobody has looked at.
 *
 * @param {Item} item
 */
export function isAccept({ operation }) {
  return operation?.kind === "status" && operation.status === "accepted";
}

/**
 * Which of the operations that wait for a photo cannot be sent any more: those that `out` names, and
 * each undo and redo that would now take back, or do again, something else than it was meant for.
 *
 * @param {Item[]} waiting - For one photo, oldest first.
 * @param {(item: Item) => boolean} out
 * @param {boolean} stale - What came before has changed, and must not be undone by what waits.
 */
export function senseless(waiting, out, stale) {
  /** @type {boolean[]} */
  const done = []; // whether each thing that can be undone, made by what waits, is sent
  /** @type {boolean[]} */
  const undone = [];
  let first = true; // whether Redo still does again what was taken back before
  /** @type {Record<Item["what"], (sent: boolean) => boolean>} */
  const take = {
    undo(sent) {
      const made = done.pop();
      const now = sent && (made ?? !stale);
      undone.push(made ?? now);
      return now;
    },
    redo(sent) {
      const taken = undone.pop();
      const now = sent && (taken ?? (first && !stale));
      done.push(taken ?? now);
      return now;
    },
    operations(sent) {
      done.push(sent);
      undone.length = 0;
      first = false;
      return sent;
    },
  };
  return waiting.filter((item) => {
    const sent = !out(item);
    return !(isChange(item) ? take[item.what](sent) : sent);
  });
}
