/** Lines along other ridges: all of them are shown with their numbers, before one is chosen. */

import { counted } from "../basics/words.js";
import { ApiError, get } from "../server/api.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Previewer } from "../labelled/previewer.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { ShownAlternative, Take } from "../types.js" */

/** @param {Take} take */
function where({ first, rows }) {
  return `columns ${first} to ${first + rows.length - 1}`;
}

/**
 * What is offered, in words.
 *
 * @param {ShownAlternative[]} others
 */
function offering(others) {
  const take = others[0]?.take;
  if (take) return `Passes differ in ${where(take)}. A number takes the line of one there, Escape leaves.`;
  return others.length
    ? `${counted(others.length, "line")} along other ridges, the likeliest first. A number takes one, Escape leaves.`
    : "There is no other ridge to follow.";
}

/**
 * What is done with other lines by name.
 *
 * @param {object} parts
 * @param {Pick<Labelling, "document" | "apply" | "on" | "say">} parts.labelling
 * @param {Selection} parts.selection
 * @param {Pick<Previewer, "clear">} parts.previewer
 */
export function otherLines({ labelling, selection, previewer }) {
  let offered = -1; // revision of the line that they are other than
  labelling.on("document", () => {
    if (selection.now.others.length && labelling.document?.revision !== offered) selection.offer([]);
  });
  const act = {
    /** Show the lines along other ridges, or leave them. */
    async others() {
      if (selection.now.others.length) return act.leaveOthers();
      const shown = labelling.document;
      if (!shown) return;
      previewer.clear();
      try {
        const { alternatives } = await get(`api/photos/${shown.id}/alternatives?column=${selection.place(shown)[0]}`);
        const now = labelling.document;
        if (now?.id !== shown.id || now.revision !== shown.revision) return; // they are of another line
        offered = shown.revision;
        selection.offer(alternatives);
        labelling.say(offering(alternatives));
      } catch (error) {
        labelling.say(ApiError.of(error).message, true);
      }
    },
    /**
     * Take a line that is shown; where none is, show them all first.
     *
     * @param {number} number - From 1.
     */
    alternative(number) {
      const { others } = selection.now;
      if (!others.length) return act.others();
      const chosen = others[number - 1];
      if (!chosen) return labelling.say(`There ${others.length === 1 ? "is" : "are"} ${counted(others.length, "other line")}.`);
      selection.offer([]);
      const { take, points, radius, rows, name } = chosen;
      if (take) labelling.apply(take, { first: take.first, rows: take.rows });
      else labelling.apply({ kind: "guide", points, radius }, { first: 0, rows });
      labelling.say(take ? `The line of ${name} is taken in ${where(take)}.` : `Line ${number} is taken.`);
    },
    /** @param {number | null} number - Which line to look at, from 1; null for all of them. */
    lookAtOther(number) {
      selection.lookAt(number === null ? null : number - 1);
    },
    leaveOthers() {
      selection.offer([]);
      labelling.say("");
    },
  };
  return act;
}
