/** Buttons for the lines along other ridges while they are shown: for the mouse and for fingers. */

import { box, button, made } from "../basics/dom.js";
import { colourOf } from "../drawn/marks.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { ShownAlternative } from "../types.js" */

/** A button for each line; the one under the mouse is shown alone. */
export class Choices {
  /** @type {readonly ShownAlternative[]} */
  #shown = [];

  /**
   * @param {Labelling} labelling
   * @param {Selection} selection
   * @param {{alternative: (number: number) => unknown, lookAtOther: (number: number | null) => unknown, leaveOthers: () => unknown}} line
   * @param {() => void} focus - Gives the photo the keys.
   */
  constructor(labelling, selection, line, focus) {
    const show = () => {
      button("others").disabled = !labelling.document || labelling.document.blind || Boolean(labelling.loading);
      const { others } = selection.now;
      if (others === this.#shown) return;
      this.#shown = others;
      button("others").setAttribute("aria-pressed", String(others.length > 0));
      box("choices").hidden = !others.length;
      const buttons = others.map((other, at) => {
        const one = made("button", { type: "button", textContent: `${at + 1}: ${words(other)}` });
        one.style.boxShadow = `inset 0 -4px 0 ${colourOf(at)}`; // that of its line
        one.addEventListener("click", () => {
          line.alternative(at + 1);
          focus();
        });
        for (const name of ["pointerenter", "focus"]) one.addEventListener(name, () => line.lookAtOther(at + 1));
        for (const name of ["pointerleave", "blur"]) one.addEventListener(name, () => line.lookAtOther(null));
        return one;
      });
      const leave = made("button", { type: "button", textContent: "Leave" });
      leave.addEventListener("click", () => {
        line.leaveOthers();
        focus();
      });
      box("choices").replaceChildren(...buttons, leave);
    };
    selection.on("change", show);
    labelling.on("document", show);
    labelling.on("loading", show);
  }
}

/** @param {ShownAlternative} other */
function words({ apart, name }) {
  return name || `${Math.round(100 * apart)} % elsewhere`;
}
