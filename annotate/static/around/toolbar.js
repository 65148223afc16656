/** The buttons of the tools: one of them is chosen. */

import { icon, made } from "../basics/dom.js";
import { Events } from "../basics/events.js";
import { TOOLS } from "../gestures/tools.js";

/** @typedef {typeof TOOLS[number]} Described */

/**
 * A group of radio buttons. Event: `tool`, when another one is chosen.
 *
 * @extends {Events<{tool: Described}>}
 */
export class Toolbar extends Events {
  #at = 0;
  /** @type {HTMLButtonElement[]} */
  #buttons;

  /** @param {HTMLElement} group */
  constructor(group) {
    super();
    this.#buttons = TOOLS.map((tool, at) => {
      const one = made("button", { type: "button", title: `${tool.title} ( ${tool.key} )` }, icon(tool.id), made("span", { textContent: tool.name }));
      one.setAttribute("role", "radio");
      one.dataset.tool = tool.id;
      one.addEventListener("click", () => this.#choose(at));
      return one;
    });
    group.append(...this.#buttons);
    group.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      this.#choose((this.#at + step + TOOLS.length) % TOOLS.length);
      this.#buttons[this.#at].focus();
    });
  }

  /**
   * Choose the tool of a key.
   *
   * @param {string} key
   */
  choose(key) {
    this.#choose(TOOLS.findIndex((tool) => tool.key === key.toUpperCase()));
  }

  /** @param {number} chosen */
  #choose(chosen) {
    this.#at = chosen;
    this.#buttons.forEach((one, at) => {
      one.setAttribute("aria-checked", String(at === chosen));
      one.tabIndex = at === chosen ? 0 : -1;
    });
    this.tell("tool", TOOLS[chosen]);
  }
}
