/** The list of photos: only what is in sight has elements and pictures. */

import { blob } from "./api.js";

const HEIGHT = 60; // of an item, in CSS pixels
const KEPT = 300; // thumbnails

/** List, search, filter and progress. */
export class PhotoList {
  #labelling;
  #parts;
  #found = [];
  #inner = document.createElement("div");
  #thumbnails = new Map();

  /** `parts`: {list, search, filter, progress, words}; `choose` is called with a photo's id, and whether a click chose it. */
  constructor(labelling, parts, choose) {
    this.#labelling = labelling;
    this.#parts = parts;
    this.#inner.className = "inner";
    this.#inner.setAttribute("role", "presentation");
    parts.list.append(this.#inner);
    parts.list.addEventListener("scroll", () => this.#draw());
    new ResizeObserver(() => this.#draw()).observe(parts.list);
    parts.list.addEventListener("click", (event) => {
      const item = event.target.closest(".item");
      if (item) choose(Number(item.dataset.photo), true);
    });
    parts.list.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      const at = this.#found.findIndex((photo) => photo.id === labelling.document?.id);
      const next = this.#found[Math.min(Math.max(at + step, 0), this.#found.length - 1)];
      if (next) choose(next.id, false);
    });
    parts.search.addEventListener("input", () => this.#search());
    parts.filter.addEventListener("change", () => this.#search());
    labelling.addEventListener("list", () => this.#search());
    labelling.addEventListener("document", (event) => this.#draw(event.detail.fresh));
  }

  #search() {
    const words = this.#parts.search.value.trim().toLowerCase();
    const status = this.#parts.filter.value;
    this.#found = this.#labelling.photos.filter((photo) =>
      (!status || photo.status === status) && photo.name.toLowerCase().includes(words));
    this.#inner.style.height = `${this.#found.length * HEIGHT}px`;
    this.#showProgress();
    this.#draw();
  }

  #showProgress() {
    const { done, total, seconds_a_photo: each, seconds_left: left } = this.#labelling.progress;
    Object.assign(this.#parts.progress, { value: done, max: Math.max(total, 1) });
    const share = `${done} of ${total} done (${Math.floor(100 * done / Math.max(total, 1))} %)`;
    this.#parts.words.textContent = each === null ? share : `${share}, ${each.toFixed(0)} s a photo, ${spoken(left)} left`;
  }

  #draw(reveal = false) {
    const { list } = this.#parts;
    const current = this.#labelling.document?.id;
    if (reveal) {
      const at = this.#found.findIndex((photo) => photo.id === current) * HEIGHT;
      if (at >= 0 && (at < list.scrollTop || at + HEIGHT > list.scrollTop + list.clientHeight)) {
        list.scrollTop = at - list.clientHeight / 2 + HEIGHT / 2;
      }
    }
    const first = Math.max(Math.floor(list.scrollTop / HEIGHT) - 2, 0);
    const shown = this.#found.slice(first, first + Math.ceil(list.clientHeight / HEIGHT) + 4);
    this.#inner.replaceChildren(...shown.map((photo, at) => this.#item(photo, first + at, photo.id === current)));
    if (!this.#found.length) this.#inner.append(nothing(this.#labelling.photos.length ? "No photo matches." : ""));
    const selected = this.#inner.querySelector("[aria-selected=true]");
    if (selected) list.setAttribute("aria-activedescendant", selected.id);
    else list.removeAttribute("aria-activedescendant");
  }

  #item(photo, at, selected) {
    const item = document.createElement("div");
    item.className = "item";
    item.id = `photo-${photo.id}`;
    item.dataset.photo = photo.id;
    item.style.top = `${at * HEIGHT}px`;
    item.setAttribute("role", "option");
    item.setAttribute("aria-selected", String(selected));
    item.setAttribute("aria-setsize", String(this.#found.length));
    item.setAttribute("aria-posinset", String(at + 1));
    const image = document.createElement("img");
    image.alt = "";
    this.#fill(image, photo);
    const words = document.createElement("div");
    words.className = "words";
    const title = document.createElement("div");
    title.className = "title";
    title.textContent = photo.name;
    title.title = photo.name;
    item.title = photo.problem;
    const sub = document.createElement("div");
    const lost = photo.missing ? "missing" : photo.too_large ? "too large" : photo.problem ? "cannot be read" : "";
    sub.className = `sub ${lost ? "missing" : photo.status.split(" ")[0]}`;
    sub.textContent = [lost || photo.status, photo.blind ? "blind" : "", ...photo.tags].filter(Boolean).join(", ");
    words.append(title, sub);
    item.append(image, words);
    return item;
  }

  async #fill(image, photo) {
    const kept = this.#thumbnails.get(photo.id);
    if (kept) {
      image.src = kept;
      return;
    }
    if (kept === "" || photo.missing || photo.too_large) return;
    this.#thumbnails.set(photo.id, "");
    try {
      const url = URL.createObjectURL(await blob(`api/photos/${photo.id}/thumbnail`));
      this.#thumbnails.set(photo.id, url);
      if (this.#thumbnails.size > KEPT) {
        const [oldest, old] = this.#thumbnails.entries().next().value;
        this.#thumbnails.delete(oldest);
        if (old) URL.revokeObjectURL(old);
      }
      const now = document.querySelector(`#photo-${photo.id} img`);
      if (now) now.src = url;
    } catch {
      this.#thumbnails.delete(photo.id);
    }
  }
}

function nothing(words) {
  const said = document.createElement("p");
  said.className = "nothing";
  said.setAttribute("role", "option"); // a list box holds nothing else
  said.setAttribute("aria-disabled", "true");
  said.textContent = words;
  return said;
}

/** A time as people say it. */
function spoken(seconds) {
  if (seconds < 90) return `${seconds.toFixed(0)} s`;
  return seconds < 5400 ? `${(seconds / 60).toFixed(0)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
