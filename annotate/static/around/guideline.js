/** What counts as the skyline: the page's own words and pictures, or those of the folder. */

import { box, dialog } from "../basics/dom.js";
import { ApiError, get } from "../server/api.js";

/** Show it. What a folder says beside its photos takes the place of ours, as plain text. */
export async function showGuideline() {
  show("", "");
  dialog("guideline-dialog").showModal();
  dialog("guideline-dialog").scrollTop = 0; // its button, which has the keys, is at the end
  try {
    show((await get("api/guideline")).text ?? "", "");
  } catch (error) {
    show("", `Whether the folder has a guideline of its own is not known: ${ApiError.of(error).message}`);
  }
}

/**
 * @param {string} own
 * @param {string} trouble
 */
function show(own, trouble) {
  box("guideline-own").textContent = own; // as text: whoever wrote it, nothing of it is run
  box("guideline-own").hidden = !own;
  box("guideline-ours").hidden = Boolean(own);
  box("guideline-trouble").textContent = trouble;
  box("guideline-trouble").hidden = !trouble;
}
