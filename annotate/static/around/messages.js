/** What the page says: messages, whether everything is saved, and what could not be kept. */

import { box, button, dialog, made } from "../basics/dom.js";
import { changesLine } from "../basics/operations.js";
import { trouble } from "../basics/words.js";

/** @import { Choice, Labelling, Undo } from "../labelled/labelling.js" */
/** @import { Lost } from "../server/queue.js" */

const SLOW = 400; // milliseconds: what is saved within a blink is not worth a word

/** The message line and its Undo, the word *saved*, and the list of what is not kept. */
export class Messages {
  #labelling;
  #said = box("said");
  #takeBack = button("said-undo");
  #choices = box("said-choices");
  #trouble = box("trouble");
  #saving = box("saving");
  #lost = button("lost");
  /** @type {Undo | null} */
  #undo = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #slow = false;

  /**
   * @param {Labelling} labelling
   * @param {() => void} focus - Gives the photo the keys.
   */
  constructor(labelling, focus) {
    this.#labelling = labelling;
    labelling.on("said", ({ text, bad, undo, choices }) => this.#say(text, bad, undo, focus, choices));
    labelling.on("loading", () => labelling.loading && this.#say("", false, null, focus)); // what was said was of another photo
    labelling.queue.on("change", () => this.#show());
    this.#takeBack.addEventListener("click", () => {
      const undo = this.#undo;
      this.#say("", false, null, focus);
      undo?.();
    });
    this.#lost.addEventListener("click", () => dialog("lost-dialog").showModal());
    button("lost-forget").addEventListener("click", () => {
      labelling.queue.forget();
      dialog("lost-dialog").close();
    });
  }

  /**
   * @param {string} text
   * @param {boolean} bad
   * @param {Undo | null} undo
   * @param {() => void} focus
   * @param {Choice[]} [choices]
   */
  #say(text, bad, undo, focus, choices = []) {
    const focused = document.activeElement?.closest(".said");
    this.#said.textContent = this.#said.title = text;
    this.#said.classList.toggle("bad", bad);
    this.#takeBack.hidden = !undo;
    this.#choices.replaceChildren(choices.length ? "Why?" : "", ...choices.map(({ words, run }) => {
      const one = made("button", { type: "button", textContent: words });
      one.addEventListener("click", () => {
        run();
        focus();
      });
      return one;
    }));
    this.#undo = undo;
    if (focused && !undo) focus(); // not lost with the button
  }

  #show() {
    const { document: shown, queue } = this.#labelling;
    const { waiting, reason } = queue;
    this.#measure(waiting > 0);
    this.#saving.dataset.state = waiting ? "unsaved" : "saved";
    if (!waiting) this.#saving.textContent = "saved";
    else if (this.#slow || reason) this.#saving.textContent = `${waiting} not saved`;
    const words = trouble(waiting ? reason : "", waiting, changesLine(shown ? queue.of(shown.id) : []));
    if (this.#trouble.textContent !== words) this.#trouble.textContent = words;
    this.#trouble.hidden = !words;
    this.#list(queue.lost);
  }

  /**
   * Notice when something has waited for a while.
   *
   * @param {boolean} waits
   */
  #measure(waits) {
    if (!waits) {
      clearTimeout(this.#timer);
      this.#timer = undefined;
      this.#slow = false;
    } else if (!this.#slow) {
      this.#timer ??= setTimeout(() => {
        this.#slow = true;
        this.#show();
      }, SLOW);
    }
  }

  /** @param {Lost[]} lost */
  #list(lost) {
    this.#lost.hidden = !lost.length;
    this.#lost.textContent = `${lost.length} not kept`;
    box("lost-list").replaceChildren(...lost.map(({ name, says, reason, at }) => made("li", {},
      made("b", { textContent: `${name}: ${says}` }),
      made("span", { textContent: `${new Date(at).toLocaleTimeString()}: ${reason}${reason.endsWith(".") ? "" : "."}` }))));
  }
}
