/** A first look around: one thing at a time, framed and explained. It can be skipped at any moment. */

import { box, button, find } from "../basics/dom.js";
import { within } from "../basics/geometry.js";

const GAP = 14; // screen pixels between what is shown and the words about it

/** What is shown, by its id, and what is said of it. */
const STOPS = /** @type {const} */ ([
  ["stage", "The line", "Magenta is the line as it is, yellow what a click here would make of it. Click where the skyline really is."],
  ["tools", "Another ridge?", "Drag along the right ridge, roughly: the line snaps to it. Other tools hide what cannot be seen, or keep the line away."],
  ["others", "Or choose one", "Draws up to four lines along other ridges, with numbers. A number takes one, Escape leaves."],
  ["strip", "Is it right?", "The photo along the line, pulled straight: an error is a bump. The bars below are tall where the line is uncertain; N goes there."],
  ["guideline", "What counts?", "Trees, huts, fog, people, frames: what is skyline here, and what hides it. Shift+G shows it again."],
  ["accept", "Done", "Space accepts the line, and the next photo comes. Undo takes that back, too."],
]);

/** Goes from stop to stop. */
export class Tour {
  #focus;
  #at = -1;

  /** @param {() => void} focus - Gives the photo the keys when it ends. */
  constructor(focus) {
    this.#focus = focus;
    button("tour-next").addEventListener("click", () => this.#go(this.#at + 1));
    button("tour-skip").addEventListener("click", () => this.#go(STOPS.length));
    document.addEventListener("keydown", (event) => {
      if (!this.shown || event.key !== "Escape" || document.querySelector("dialog[open]")) return;
      event.stopPropagation(); // it ends the tour alone, wherever the keys are
      event.preventDefault();
      this.#go(STOPS.length);
    }, { capture: true });
    addEventListener("resize", () => this.shown && this.#place());
  }

  /** Whether it is on; the keys of the page rest meanwhile. */
  get shown() {
    return this.#at >= 0;
  }

  /** Begin. */
  begin() {
    this.#go(0);
  }

  /** @param {number} at */
  #go(at) {
    document.querySelector(".toured")?.classList.remove("toured");
    const stop = STOPS[at];
    this.#at = stop ? at : -1;
    box("tour").hidden = !stop;
    if (!stop) return this.#focus();
    const [id, title, words] = stop;
    box(id).classList.add("toured");
    box("tour-title").textContent = title;
    box("tour-words").textContent = words;
    box("tour-place").textContent = `${at + 1} of ${STOPS.length}`;
    button("tour-next").textContent = at === STOPS.length - 1 ? "Begin" : "Next";
    this.#place();
    button("tour-next").focus();
  }

  /** Beside what is shown, within the window. */
  #place() {
    const shown = find(STOPS[this.#at][0], Element).getBoundingClientRect();
    const tour = box("tour");
    const { offsetWidth: wide, offsetHeight: high } = tour;
    const below = shown.bottom + GAP + high < innerHeight;
    const above = shown.top - GAP - high > 0;
    const top = below ? shown.bottom + GAP : above ? shown.top - GAP - high : shown.top + GAP;
    tour.style.left = `${within(shown.left, 12, Math.max(innerWidth - wide - 12, 12))}px`;
    tour.style.top = `${within(top, 12, Math.max(innerHeight - high - 12, 12))}px`;
  }
}
