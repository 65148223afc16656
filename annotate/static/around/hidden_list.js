/** The columns of a photo that are not visible, one below the other: what hides them, and showing them again. */

import { box, button, dialog, made } from "../basics/dom.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Hidden, Operation } from "../types.js" */

/** A button with their number, which opens their list. */
export class HiddenList {
  #labelling;
  #line;

  /**
   * @param {Labelling} labelling
   * @param {{did: (operation: Operation) => unknown, goTo: (column: number) => unknown}} line
   */
  constructor(labelling, line) {
    this.#labelling = labelling;
    this.#line = line;
    labelling.on("document", () => this.#renew());
  }

  /** Open the list. */
  show() {
    if (!this.#labelling.document?.hidden.length) return this.#labelling.say("No columns are hidden.");
    this.#draw();
    dialog("hidden-dialog").showModal();
  }

  #renew() {
    const { hidden = [] } = this.#labelling.document ?? {};
    button("hidden-open").disabled = !hidden.length;
    box("hidden-count").textContent = hidden.length ? `${hidden.length}` : "";
    if (!dialog("hidden-dialog").open) return;
    if (hidden.length) this.#draw();
    else dialog("hidden-dialog").close();
  }

  #draw() {
    const { hidden = [] } = this.#labelling.document ?? {};
    const list = box("hidden-list");
    const at = [...list.querySelectorAll("button, select")].indexOf(/** @type {Element} */ (document.activeElement));
    list.replaceChildren(...hidden.map((one) => this.#row(one)));
    const again = [...list.querySelectorAll("button, select")][at];
    if (again instanceof HTMLElement) again.focus(); // the rows are new, and the keys stay where they were
  }

  /** @param {Hidden} one */
  #row([first, last, why]) {
    const where = made("button", { type: "button", textContent: first === last ? `Column ${first}` : `Columns ${first} to ${last}` });
    where.addEventListener("click", () => {
      dialog("hidden-dialog").close();
      this.#line.goTo(Math.floor((first + last) / 2));
    });
    const reasons = new Set(["", ...this.#labelling.legend?.hidden_by ?? [], why]);
    const by = made("select", {}, ...[...reasons].map((one) => new Option(one || "not said", one)));
    by.value = why;
    by.setAttribute("aria-label", `What hides columns ${first} to ${last}`);
    by.addEventListener("change", () => this.#line.did({ kind: "hidden", first, last, hidden: true, why: by.value || null }));
    const again = made("button", { type: "button", textContent: "Show again" });
    again.addEventListener("click", () => this.#line.did({ kind: "hidden", first, last, hidden: false }));
    return made("li", {}, where, by, again);
  }
}
