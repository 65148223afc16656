/** What the page says: messages, whether everything is saved, and what could not be kept. */

import { changesLine } from "./waiting.js";

const SLOW = 400; // milliseconds: what is saved within a blink is not worth a word

/** A number of things. */
export function counted(number, thing) {
  return `${number} ${thing}${number === 1 ? "" : "s"}`;
}

/** Why edits wait, and what will become of them, and of the line where they change it. */
export function trouble(reason, waiting, line = false) {
  if (!reason) return "";
  if (!waiting) return reason;
  const sent = waiting === 1 ? "waits and is sent as soon as it can be" : "wait and are sent as soon as they can be";
  return `${reason} ${counted(waiting, "edit")} ${sent}${line ? "; the line follows then" : ""}.`;
}

/** The message line and its Undo, the word *saved*, and the list of what is not kept. */
export class Messages {
  #labelling;
  #parts; // {said, undo, trouble, saving, lost, list, forget, dialog}
  #undo = null;
  #timer;
  #slow = false;

  constructor(labelling, parts) {
    this.#labelling = labelling;
    this.#parts = parts;
    labelling.addEventListener("said", ({ detail }) => this.#say(detail));
    labelling.addEventListener("loading", () => labelling.loading && this.#say({ text: "" })); // what was said was of another photo
    labelling.queue.addEventListener("change", () => this.#show());
    parts.undo.addEventListener("click", () => {
      const undo = this.#undo;
      this.#say({ text: "" });
      undo();
    });
    parts.lost.addEventListener("click", () => parts.dialog.showModal());
    parts.forget.addEventListener("click", () => {
      labelling.queue.forget();
      parts.dialog.close();
    });
  }

  #say({ text, bad = false, undo = null }) {
    const { said, undo: button } = this.#parts;
    const focused = document.activeElement === button;
    said.textContent = said.title = text;
    said.classList.toggle("bad", bad);
    button.hidden = !undo;
    this.#undo = undo;
    if (focused && !undo) document.getElementById("lines").focus({ preventScroll: true }); // not lost with the button
  }

  #show() {
    const { document: shown, queue } = this.#labelling;
    const { waiting, reason, lost } = queue;
    const { saving, trouble: line } = this.#parts;
    saving.dataset.state = waiting ? "unsaved" : "saved";
    if (!waiting) {
      clearTimeout(this.#timer);
      [this.#timer, this.#slow] = [undefined, false];
    } else if (!this.#slow) {
      this.#timer ??= setTimeout(() => {
        this.#slow = true;
        this.#show();
      }, SLOW);
    }
    if (!waiting) saving.textContent = "saved";
    else if (this.#slow || reason) saving.textContent = `${waiting} not saved`;
    const items = shown ? queue.of(shown.id) : [];
    const words = trouble(waiting ? reason : "", waiting, changesLine(items));
    if (line.textContent !== words) line.textContent = words;
    line.hidden = !words;
    this.#list(lost);
  }

  #list(lost) {
    const { lost: button, list } = this.#parts;
    button.hidden = !lost.length;
    button.textContent = `${lost.length} not kept`;
    list.replaceChildren(...lost.map(({ name, says, reason, at }) => {
      const item = document.createElement("li");
      const what = document.createElement("b");
      what.textContent = `${name}: ${says}`;
      const why = document.createElement("span");
      why.textContent = `${new Date(at).toLocaleTimeString()}: ${reason}${reason.endsWith(".") ? "" : "."}`;
      item.append(what, why);
      return item;
    }));
  }
}
