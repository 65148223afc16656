/** The header: which photo is worked on, and what can be done to it. */

import { box, button, offer, select } from "../basics/dom.js";

/** @import { Actions } from "./actions.js" */
/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { Sheet } from "./sheet.js" */
/** @import { Status } from "../types.js" */

/** Shows the photo that every action is for, and leaves out what cannot be done to it. */
export class Header {
  #labelling;
  #actions;
  #sheet;

  /**
   * @param {object} parts
   * @param {Labelling} parts.labelling
   * @param {Actions} parts.actions
   * @param {Sheet} parts.sheet
   * @param {Selection} parts.selection
   */
  constructor({ labelling, actions, sheet, selection }) {
    this.#labelling = labelling;
    this.#actions = actions;
    this.#sheet = sheet;
    const show = () => this.#show();
    labelling.on("legend", ({ statuses }) => {
      offer(select("status"), statuses);
      for (const option of select("status").options) option.disabled = option.value === "in progress"; // an edit makes it so
      show();
    });
    for (const name of /** @type {const} */ (["document", "loading", "list"])) labelling.on(name, show);
    labelling.queue.on("change", show);
    actions.on("change", show);
    sheet.on("card", show);
    let corners = 0;
    selection.on("change", () => { // which most often means that only the mouse has moved
      if (corners === selection.now.corners.length) return;
      corners = selection.now.corners.length;
      show();
    });
    select("status").addEventListener("change", () => {
      actions.setStatus(/** @type {Status} */ (select("status").value));
      select("status").blur();
      show(); // the status is what is kept, not what is wished for
    });
    show();
  }

  #show() {
    this.#showPhoto();
    this.#showSteps();
    const { undoes, redoes } = this.#actions;
    button("undo").disabled = !undoes;
    button("undo").title = undoes ? `Undo: ${undoes} ( U )` : "Undo ( U )";
    button("redo").disabled = !redoes;
  }

  #showPhoto() {
    const photo = this.#actions.target();
    const { loading } = this.#labelling;
    const { name, status, blind, tags } = photo ?? { name: loading ? `${loading} …` : "No photo", status: "", blind: false, tags: [] };
    box("name").textContent = box("name").title = name;
    document.title = photo ? `${name} - skyline-annotate` : "skyline-annotate";
    select("status").value = select("status").dataset.status = status;
    box("blind").hidden = !blind;
    box("tag-count").textContent = tags.length ? ` ${tags.length}` : "";
    select("status").disabled = !photo;
    for (const id of ["accept", "review", "reject", "tags"]) button(id).disabled = !photo;
  }

  #showSteps() {
    const { photos, place } = this.#labelling;
    const photo = this.#actions.target();
    const seen = photos.findIndex((one) => one.id === photo?.id);
    if (photo) box("place").textContent = `${seen + 1} / ${photos.length}`;
    button("previous").disabled = this.#sheet.shown || place <= 0;
    button("next").disabled = this.#sheet.shown || place < 0 || place >= photos.length - 1;
  }
}
