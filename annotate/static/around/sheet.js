/** The sheet: straightened strips of many photos, worked through by key. */

import { around, box, busy, button, made, select } from "../basics/dom.js";
import { Events } from "../basics/events.js";
import { filters, matches, offerFilters } from "../basics/filters.js";
import { within } from "../basics/geometry.js";
import { longPress } from "../basics/long_press.js";
import { ApiError } from "../server/api.js";
import { cardFor, labelCard } from "./cards.js";

/** @import { Chosen } from "./chosen.js" */
/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { ShownPhoto } from "../types.js" */

const PAGE = 24; // cards

/**
 * A page of cards over the rest of the page. One card is the current one, and stays it while a button
 * elsewhere has the focus. Events: `card` (another one, or its photo changed), `page` (other cards),
 * `finish` (the current photo is given a status), `tick` (it is given a tag, or is not, by its number).
 *
 * @extends {Events<{card: undefined, page: undefined, finish: "accepted" | "rejected", tick: number}>}
 */
export class Sheet extends Events {
  #labelling;
  #chosen;
  #focus;
  #cards = box("sheet-cards");
  #page = 0;
  #pages = 1;
  /** @type {ShownPhoto[]} */
  #photos = [];
  #at = 0;
  #turn = 0;
  /** @type {string[]} */
  #urls = [];

  /**
   * @param {Labelling} labelling
   * @param {Chosen} chosen
   * @param {() => void} focus - Gives the photo the keys.
   */
  constructor(labelling, chosen, focus) {
    super();
    this.#labelling = labelling;
    this.#chosen = chosen;
    chosen.on("change", () => this.#frame());
    this.#cards.addEventListener("click", (event) => {
      const card = around(event, ".card");
      if (card && chosen.means(event)) this.#toggle(Number(card.dataset.at), event.shiftKey);
    });
    longPress(this.#cards, ".card", (card) => {
      const photo = this.#photos[Number(card.dataset.at)];
      if (photo) chosen.press(photo.id, this.#photos);
    });
    this.#focus = focus;
    select("sheet-filter").addEventListener("change", () => this.#show(0));
    button("sheet-previous").addEventListener("click", () => this.#show(this.#page - 1));
    button("sheet-next").addEventListener("click", () => this.#show(this.#page + 1));
    button("sheet-close").addEventListener("click", () => this.hide());
    document.addEventListener("keydown", (event) => this.shown && this.#key(event));
    this.#cards.addEventListener("focusin", (event) => this.#choose(around(event, ".card")));
    labelling.on("list", () => {
      offerFilters(select("sheet-filter"), filters(labelling.legend?.statuses ?? [], labelling.photos));
      this.#renew();
    });
    labelling.on("legend", () => {
      offerFilters(select("sheet-filter"), filters(labelling.legend?.statuses ?? [], []));
      select("sheet-filter").value = "is:to do"; // all others are one choice away
    });
  }

  /** Whether it is shown. */
  get shown() {
    return !box("sheet").hidden;
  }

  /** Photo of the current card; null where there is none. */
  get card() {
    return this.#photos[this.#at] ?? null;
  }

  /** What has the keys while it is shown. */
  get home() {
    return this.#card(this.#at) ?? button("sheet-close");
  }

  /** Show it instead of the photo. */
  async show() {
    if (this.shown) return;
    box("sheet").hidden = false;
    box("main").hidden = true;
    this.#labelling.say(""); // what was said was of a photo that is not seen any more
    await this.#show(0);
  }

  /** Go back to the photo. */
  hide() {
    if (!this.shown) return;
    this.#turn++;
    box("sheet").hidden = true;
    box("main").hidden = false;
    this.#put([]);
    dispatchEvent(new Event("resize"));
    this.#focus();
  }

  /**
   * Go some cards on.
   *
   * @param {number} by
   */
  step(by) {
    this.#card(this.#at + by)?.focus();
  }

  /**
   * Go to the card of a photo, if it is on this page.
   *
   * @param {number} id
   */
  focus(id) {
    this.#card(this.#photos.findIndex((photo) => photo.id === id))?.focus();
  }

  /** @param {number} page */
  async #show(page) {
    const turn = ++this.#turn;
    this.#put([], "Reading the strips…");
    try {
      await this.#labelling.load(); // others may have been at work
    } catch (error) {
      if (turn === this.#turn) this.#put([], ApiError.of(error).message);
      return;
    }
    if (turn !== this.#turn) return;
    const { value, selectedOptions: [chosen] } = select("sheet-filter");
    const found = this.#labelling.photos.filter((photo) => matches(photo, value));
    this.#pages = Math.max(Math.ceil(found.length / PAGE), 1);
    this.#page = within(page, 0, this.#pages - 1);
    const none = value ? `No photo matches “${chosen.text}”.` : "There is no photo.";
    this.#put(found.slice(this.#page * PAGE, (this.#page + 1) * PAGE), none);
    (this.#card(0) ?? button("sheet-close")).focus();
  }

  /**
   * Lay out cards, or words where there are none.
   *
   * @param {ShownPhoto[]} photos
   * @param {string} [words]
   */
  #put(photos, words = "") {
    this.#urls.splice(0).forEach((url) => URL.revokeObjectURL(url));
    this.#photos = photos;
    this.#at = 0;
    box("sheet-page").textContent = `${this.#page + 1} / ${this.#pages}`;
    button("sheet-previous").disabled = this.#page === 0;
    button("sheet-next").disabled = this.#page >= this.#pages - 1;
    const cards = photos.map((photo, at) => {
      const card = cardFor(photo, at, (url) => this.#urls.push(url));
      card.addEventListener("dblclick", () => this.#openPhoto(photo));
      return card;
    });
    this.#cards.replaceChildren(...(cards.length ? cards : [made("li", { textContent: words })]));
    this.#frame();
    this.tell("page");
    this.tell("card");
  }

  /**
   * @param {number} at
   * @returns {HTMLElement | null}
   */
  #card(at) {
    return this.#cards.querySelector(`[data-at="${at}"]`);
  }

  /** The list has changed: show what it says about the photos of the cards. */
  #renew() {
    if (!this.shown) return;
    const listed = new Map(this.#labelling.photos.map((photo) => [photo.id, photo]));
    this.#photos = this.#photos.map((photo) => listed.get(photo.id) ?? photo);
    this.#photos.forEach((photo, at) => labelCard(this.#card(at), photo));
    this.tell("card");
  }

  /** @param {HTMLElement | null} card */
  #choose(card) {
    if (!card) return;
    this.#at = Number(card.dataset.at);
    for (const one of this.#cards.querySelectorAll(".card")) one.classList.toggle("current", one === card);
    this.tell("card");
  }

  /**
   * @param {number} at
   * @param {boolean} range
   */
  #toggle(at, range) {
    const photo = this.#photos[at];
    if (photo) this.#chosen.toggle(photo.id, range, this.#photos);
  }

  /** Frame the cards that are chosen. */
  #frame() {
    this.#photos.forEach((photo, at) => this.#card(at)?.classList.toggle("chosen-one", this.#chosen.has(photo.id)));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const { key, ctrlKey, metaKey, altKey } = event;
    const elsewhere = key !== "Escape" && around(event, "select, input, [role=listbox]");
    if (ctrlKey || metaKey || altKey || elsewhere || busy()) return;
    if (this.#keyOfSheet(key) || this.#keyOfCards(key, event)) event.preventDefault();
  }

  /** @param {string} key */
  #keyOfSheet(key) {
    if (key === "a" || key === "d") this.tell("finish", key === "a" ? "accepted" : "rejected");
    else if (key === "x") this.#toggle(this.#at, false);
    else if (/^[1-9]$/.test(key)) this.tell("tick", Number(key));
    else if (key === "Escape" || key === "w") this.hide();
    else return false;
    return true;
  }

  /**
   * Keys that do something else on a button.
   *
   * @param {string} key
   * @param {KeyboardEvent} event
   */
  #keyOfCards(key, event) {
    if (around(event, "button")) return false;
    const across = getComputedStyle(this.#cards).gridTemplateColumns.split(" ").length;
    const step = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: across, ArrowUp: -across }[key];
    if (step) this.step(step);
    else if (key === "Enter" && this.card) this.#openPhoto(this.card);
    else return false;
    return true;
  }

  /** @param {ShownPhoto} photo */
  #openPhoto(photo) {
    this.hide();
    this.#labelling.open(photo.id);
  }
}
