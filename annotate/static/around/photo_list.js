/** The list of photos: only what is in sight has elements and pictures. */

import { around, box, find, input, made, select } from "../basics/dom.js";
import { filters, matches, offerFilters } from "../basics/filters.js";
import { longPress } from "../basics/long_press.js";
import { remark, spoken, sure } from "../basics/words.js";
import { Thumbnails } from "../server/thumbnails.js";

/** @import { Chosen } from "./chosen.js" */
/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { ShownPhoto } from "../types.js" */

const HEIGHT = 60; // of an item, in CSS pixels

/** List, search, filter and progress. */
export class PhotoList {
  #labelling;
  #chosen;
  #list = box("list");
  #inner = made("div", { className: "inner" });
  #thumbnails = new Thumbnails();
  /** @type {ShownPhoto[]} */
  #found = [];

  /**
   * @param {Labelling} labelling
   * @param {Chosen} chosen
   * @param {(id: number, clicked: boolean) => void} choose - Called with a photo, and whether a click chose it.
   */
  constructor(labelling, chosen, choose) {
    this.#labelling = labelling;
    this.#chosen = chosen;
    chosen.on("change", () => this.#draw());
    this.#inner.setAttribute("role", "presentation");
    this.#list.append(this.#inner);
    this.#list.addEventListener("scroll", () => this.#draw());
    new ResizeObserver(() => this.#draw()).observe(this.#list);
    this.#list.addEventListener("click", (event) => {
      const item = around(event, ".item");
      if (!item) return;
      const photo = Number(item.dataset.photo);
      if (chosen.means(event)) chosen.toggle(photo, event.shiftKey, this.#found);
      else choose(photo, true);
    });
    longPress(this.#list, ".item", (item) => chosen.press(Number(item.dataset.photo), this.#found));
    this.#list.addEventListener("keydown", (event) => {
      const { document: shown } = this.#labelling;
      if (event.key === " " && shown && !event.defaultPrevented) {
        event.preventDefault();
        return chosen.toggle(shown.id, event.shiftKey, this.#found);
      }
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      const next = this.#found[Math.min(Math.max(this.#place + step, 0), this.#found.length - 1)];
      if (next) choose(next.id, false);
    });
    input("search").addEventListener("input", () => this.#search());
    select("filter").addEventListener("change", () => this.#search());
    labelling.on("list", () => {
      offerFilters(select("filter"), filters(labelling.legend?.statuses ?? [], labelling.photos));
      this.#search();
    });
    labelling.on("document", ({ fresh }) => {
      if (fresh) this.#reveal();
      this.#draw();
    });
  }

  /** Place of the current photo among those that were found; -1 where it is none of them. */
  get #place() {
    return this.#found.findIndex((photo) => photo.id === this.#labelling.document?.id);
  }

  #search() {
    const words = input("search").value.trim().toLowerCase();
    const wanted = select("filter").value;
    this.#found = this.#labelling.photos.filter((photo) =>
      matches(photo, wanted) && photo.name.toLowerCase().includes(words));
    this.#chosen.list(this.#found);
    this.#inner.style.height = `${this.#found.length * HEIGHT}px`;
    this.#showProgress();
    this.#draw();
  }

  #showProgress() {
    const { progress } = this.#labelling;
    if (!progress) return;
    const { done, total, seconds_a_photo: each, seconds_left: left } = progress;
    Object.assign(find("progress", HTMLProgressElement), { value: done, max: Math.max(total, 1) });
    const share = `${done} of ${total} done (${Math.floor(100 * done / Math.max(total, 1))} %)`;
    const time = each === null || left === null ? "" : `, ${each.toFixed(0)} s a photo, ${spoken(left)} left`;
    box("progress-words").textContent = `${share}${time}`;
  }

  /** Scroll to the current photo, unless it is in sight. */
  #reveal() {
    const { scrollTop, clientHeight } = this.#list;
    const at = this.#place * HEIGHT;
    if (at >= 0 && (at < scrollTop || at + HEIGHT > scrollTop + clientHeight)) {
      this.#list.scrollTop = at - clientHeight / 2 + HEIGHT / 2;
    }
  }

  #draw() {
    const { scrollTop, clientHeight } = this.#list;
    const first = Math.max(Math.floor(scrollTop / HEIGHT) - 2, 0);
    const shown = this.#found.slice(first, first + Math.ceil(clientHeight / HEIGHT) + 4);
    this.#inner.replaceChildren(...shown.map((photo, at) => this.#item(photo, first + at)));
    if (!this.#found.length) this.#inner.append(nothing(this.#labelling.photos.length ? "No photo matches." : ""));
    const selected = this.#inner.querySelector("[aria-selected=true]");
    if (selected) this.#list.setAttribute("aria-activedescendant", selected.id);
    else this.#list.removeAttribute("aria-activedescendant");
  }

  /**
   * @param {ShownPhoto} photo
   * @param {number} at - Its place among those that were found.
   */
  #item(photo, at) {
    const lost = trouble(photo);
    const image = made("img", { alt: "" });
    const url = photo.missing || photo.too_large ? "" : this.#thumbnails.of(photo.id, (came) => show(photo.id, came));
    if (url) image.src = url;
    const sub = [lost || photo.status, ...besides(photo)].join(", ");
    const words = made("div", { className: "words" },
      made("div", { className: "title", textContent: photo.name, title: photo.name }),
      made("div", { className: `sub ${lost ? "missing" : photo.status.split(" ")[0]}`, textContent: sub, title: explained(photo, sub) }));
    const item = made("div", { className: `item${this.#chosen.has(photo.id) ? " chosen-one" : ""}`, id: `photo-${photo.id}`, title: photo.problem }, image, words);
    item.dataset.photo = String(photo.id);
    item.style.top = `${at * HEIGHT}px`;
    const said = {
      role: "option", "aria-selected": photo.id === this.#labelling.document?.id,
      "aria-setsize": this.#found.length, "aria-posinset": at + 1,
    };
    for (const [name, value] of Object.entries(said)) item.setAttribute(name, String(value));
    return item;
  }
}

/**
 * What else there is to say of a photo.
 *
 * @param {ShownPhoto} photo
 */
function besides({ status, blind, seconds, tags, confidence, comment }) {
  const time = status !== "to do" && seconds >= 1 ? [spoken(seconds)] : [];
  return [...(blind ? ["blind"] : []), ...sure(status, confidence), ...time, ...tags, ...(comment ? [remark(comment)] : [])];
}

/**
 * What is wrong with a photo, in a word; empty where nothing is.
 *
 * @param {ShownPhoto} photo
 */
function trouble({ missing, too_large: tooLarge, problem }) {
  if (missing) return "missing";
  if (tooLarge) return "too large";
  return problem ? "cannot be read" : "";
}

/**
 * All that there is to say of a photo, where its line is too short for it.
 *
 * @param {ShownPhoto} photo
 * @param {string} sub
 */
function explained({ problem }, sub) {
  return problem || sub;
}

/**
 * Put a small picture that has come where its photo is listed by now.
 *
 * @param {number} photo
 * @param {string} url
 */
function show(photo, url) {
  const image = document.querySelector(`#photo-${photo} img`);
  if (image instanceof HTMLImageElement) image.src = url;
}

/** @param {string} words */
function nothing(words) {
  const said = made("p", { className: "nothing", textContent: words });
  said.setAttribute("role", "option"); // a list box holds nothing else
  said.setAttribute("aria-disabled", "true");
  return said;
}
