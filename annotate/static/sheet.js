/** The sheet: straightened strips of many photos, worked through by key. */

import { blob, get } from "./api.js";

/**
 * A page of cards over the rest of the page. One card is the current one, and stays it while a button
 * elsewhere has the focus. Events: `card` (another one, or its photo changed), `page` (other cards).
 */
export class Sheet extends EventTarget {
  #parts; // {sheet, main, cards, status, page, previous, next, close}
  #labelling;
  #act; // {open(id), finish(status)}
  #page = 0;
  #pages = 1;
  #photos = [];
  #at = 0;
  #turn = 0;
  #urls = [];

  constructor(labelling, parts, act) {
    super();
    this.#labelling = labelling;
    this.#parts = parts;
    this.#act = act;
    parts.status.addEventListener("change", () => this.#show(0));
    parts.previous.addEventListener("click", () => this.#show(this.#page - 1));
    parts.next.addEventListener("click", () => this.#show(this.#page + 1));
    parts.close.addEventListener("click", () => this.hide());
    document.addEventListener("keydown", (event) => this.shown && this.#key(event));
    parts.cards.addEventListener("focusin", (event) => this.#choose(event.target.closest(".card")));
    labelling.addEventListener("list", () => this.#renew());
  }

  /** Whether it is shown. */
  get shown() {
    return !this.#parts.sheet.hidden;
  }

  /** Photo of the current card; null where there is none. */
  get card() {
    return this.#photos[this.#at] ?? null;
  }

  /** Show it instead of the photo. */
  async show() {
    if (this.shown) return;
    this.#parts.sheet.hidden = false;
    this.#parts.main.hidden = true;
    this.#labelling.say(""); // what was said was of a photo that is not seen any more
    await this.#show(0);
  }

  /** Go back to the photo. */
  hide() {
    if (!this.shown) return;
    this.#turn++;
    this.#parts.sheet.hidden = true;
    this.#parts.main.hidden = false;
    this.#put([]);
    dispatchEvent(new Event("resize"));
    this.#parts.main.querySelector("#lines").focus();
  }

  /** Go some cards on. */
  step(by) {
    this.#card(this.#at + by)?.focus();
  }

  /** Go to the card of a photo, if it is on this page. */
  focus(id) {
    this.#card(this.#photos.findIndex((photo) => photo.id === id))?.focus();
  }

  async #show(page) {
    const turn = ++this.#turn;
    const status = this.#parts.status.value;
    this.#put([], "Reading the strips…");
    let found;
    try {
      found = await get(`api/sheet?status=${encodeURIComponent(status)}&page=${Math.max(page, 0)}`);
    } catch (error) {
      if (turn === this.#turn) this.#put([], error.message);
      return;
    }
    if (turn !== this.#turn) return;
    this.#pages = found.pages;
    this.#page = Math.min(Math.max(page, 0), found.pages - 1);
    this.#put(found.photos, status === "all" ? "There is no photo." : `No photo is ${status}.`);
    (this.#card(0) ?? this.#parts.close).focus();
  }

  /** Lay out cards, or words where there are none. */
  #put(photos, words = "") {
    this.#urls.splice(0).forEach((url) => URL.revokeObjectURL(url));
    this.#photos = photos;
    this.#at = 0;
    const { page, previous, next, cards } = this.#parts;
    page.textContent = `${this.#page + 1} / ${this.#pages}`;
    previous.disabled = this.#page === 0;
    next.disabled = this.#page >= this.#pages - 1;
    const none = document.createElement("li");
    none.textContent = words;
    cards.replaceChildren(...(photos.length ? photos.map((photo, at) => this.#made(photo, at)) : [none]));
    this.dispatchEvent(new Event("page"));
    this.dispatchEvent(new Event("card"));
  }

  #made(photo, at) {
    const card = document.createElement("li");
    card.className = "card";
    card.tabIndex = 0;
    card.dataset.at = at;
    const image = document.createElement("img");
    image.alt = `Straightened strip of ${photo.name}`;
    const line = document.createElement("div");
    line.className = "line";
    const name = document.createElement("span");
    name.textContent = photo.name;
    const status = document.createElement("span");
    status.className = "status";
    line.append(name, status);
    card.append(image, line);
    this.#say(card, photo);
    card.addEventListener("dblclick", () => this.#openPhoto(photo));
    blob(`api/photos/${photo.id}/strip?width=800`).then((data) => {
      image.src = URL.createObjectURL(data);
      this.#urls.push(image.src);
    }, (error) => {
      const words = document.createElement("p");
      words.className = "none";
      words.textContent = error.message;
      image.replaceWith(words);
    });
    return card;
  }

  #card(at) {
    return this.#parts.cards.querySelector(`[data-at="${at}"]`);
  }

  #say(card, photo) {
    const status = card.querySelector(".status");
    status.textContent = [photo.status, ...photo.tags].join(", ");
    status.dataset.status = photo.status;
  }

  /** The list has changed: show what it says about the photos of the cards. */
  #renew() {
    if (!this.shown) return;
    const listed = new Map(this.#labelling.photos.map((photo) => [photo.id, photo]));
    this.#photos = this.#photos.map((photo) => listed.get(photo.id) ?? photo);
    this.#photos.forEach((photo, at) => this.#say(this.#card(at), photo));
    this.dispatchEvent(new Event("card"));
  }

  #choose(card) {
    if (!card) return;
    this.#at = Number(card.dataset.at);
    for (const one of this.#parts.cards.querySelectorAll(".card")) one.classList.toggle("current", one === card);
    this.dispatchEvent(new Event("card"));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const elsewhere = event.target.closest("select, input, [role=listbox]");
    if (elsewhere && event.key !== "Escape") return;
    const pressing = event.target.closest("button");
    const across = getComputedStyle(this.#parts.cards).gridTemplateColumns.split(" ").length;
    const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: across, ArrowUp: -across }[event.key];
    const status = { a: "accepted", d: "rejected" }[event.key];
    if (event.key === "Escape" || event.key === "w") this.hide();
    else if (step && !pressing) this.step(step);
    else if (event.key === "Enter" && !pressing && this.card) this.#openPhoto(this.card);
    else if (status) this.#act.finish(status);
    else return;
    event.preventDefault();
  }

  #openPhoto(photo) {
    this.hide();
    this.#act.open(photo.id);
  }
}
