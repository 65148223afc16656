/** The sheet: straightened strips of many photos, accepted or rejected by key. */

import { blob, get, post } from "./api.js";

/** A page of cards over the rest of the page. */
export class Sheet {
  #parts; // {sheet, main, cards, status, page, previous, next, close}
  #labelling;
  #open;
  #page = 0;
  #pages = 1;
  #photos = [];
  #urls = [];

  /** `open` is called with the id of the photo to label. */
  constructor(labelling, parts, open) {
    this.#labelling = labelling;
    this.#parts = parts;
    this.#open = open;
    parts.status.addEventListener("change", () => this.#show(0));
    parts.previous.addEventListener("click", () => this.#show(this.#page - 1));
    parts.next.addEventListener("click", () => this.#show(this.#page + 1));
    parts.close.addEventListener("click", () => this.hide());
    parts.sheet.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Whether it is shown. */
  get shown() {
    return !this.#parts.sheet.hidden;
  }

  /** Show it instead of the photo. */
  async show() {
    await this.#labelling.settled();
    this.#parts.sheet.hidden = false;
    this.#parts.main.hidden = true;
    await this.#show(0);
  }

  /** Go back to the photo. */
  hide() {
    this.#parts.sheet.hidden = true;
    this.#parts.main.hidden = false;
    this.#forget();
    dispatchEvent(new Event("resize"));
    this.#parts.main.querySelector("#lines").focus();
  }

  async #show(page) {
    const status = this.#parts.status.value;
    let found;
    try {
      found = await get(`api/sheet?status=${encodeURIComponent(status)}&page=${Math.max(page, 0)}`);
    } catch (error) {
      this.#labelling.say(error.message, true);
      return;
    }
    this.#forget();
    this.#pages = found.pages;
    this.#page = Math.min(Math.max(page, 0), found.pages - 1);
    this.#photos = found.photos;
    this.#parts.page.textContent = `${this.#page + 1} / ${this.#pages}`;
    this.#parts.previous.disabled = this.#page === 0;
    this.#parts.next.disabled = this.#page >= this.#pages - 1;
    const cards = this.#photos.map((photo, at) => this.#card(photo, at));
    if (!cards.length) {
      const none = document.createElement("li");
      none.textContent = `No photo is ${status}.`;
      cards.push(none);
    }
    this.#parts.cards.replaceChildren(...cards);
    (this.#parts.cards.querySelector(".card") ?? this.#parts.close).focus();
  }

  #card(photo, at) {
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
      image.alt = error.message;
    });
    return card;
  }

  #say(card, photo) {
    const status = card.querySelector(".status");
    status.textContent = photo.status;
    status.dataset.status = photo.status;
  }

  #key(event) {
    const card = event.target.closest(".card");
    const at = card ? Number(card.dataset.at) : -1;
    const across = getComputedStyle(this.#parts.cards).gridTemplateColumns.split(" ").length;
    const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: across, ArrowUp: -across }[event.key];
    const status = { a: "accepted", d: "rejected" }[event.key];
    if (event.key === "Escape" || event.key === "w") this.hide();
    else if (!card || event.ctrlKey || event.metaKey || event.altKey) return;
    else if (step) this.#focus(at + step);
    else if (event.key === "Enter") this.#openPhoto(this.#photos[at]);
    else if (status) this.#set(card, this.#photos[at], status);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #focus(at) {
    this.#parts.cards.querySelector(`[data-at="${at}"]`)?.focus();
  }

  async #set(card, photo, status) {
    this.#focus(Number(card.dataset.at) + 1);
    try {
      const body = { revision: -1, operation: { kind: "status", status } };
      photo.status = (await post(`api/photos/${photo.id}/operations`, body)).status;
      this.#say(card, photo);
      await this.#labelling.load();
      this.#labelling.say(`${photo.name} is ${photo.status}.`);
    } catch (error) {
      this.#labelling.say(error.message, true);
    }
  }

  #openPhoto(photo) {
    this.hide();
    this.#open(photo.id);
  }

  #forget() {
    this.#urls.splice(0).forEach((url) => URL.revokeObjectURL(url));
  }
}
