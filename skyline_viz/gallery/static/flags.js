/**
 * Photos of a gallery, reviewed and commented.
 *
 * Each card compares what it shows with what the server has said is on the disk, and sends what differs, one
 * change at a time, until nothing does. "All saved" stands there only then.
 */

/** @typedef {{ reviewed: boolean, comment: string }} Flag */
/** @typedef {{ id: string, name: string, verdict: string, details: string, flag: Flag }} Photo */
/** @typedef {{ folder: string, longest: number, photos: Photo[] }} Photos */

const AGAIN = 2_000; // milliseconds until the server is asked again that did not answer
const PAUSE = 800; // milliseconds without a key after which a comment is saved

/**
 * An element of the page.
 * @template {HTMLElement} T
 * @param {ParentNode} within
 * @param {string} selector
 * @param {new () => T} kind
 * @returns {T}
 */
function find(within, selector, kind) {
  const found = within.querySelector(selector);
  if (!(found instanceof kind)) throw new Error(`The page has no ${selector}.`);
  return found;
}

/** @param {number} milliseconds */
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

/** A comment as a field shows it: with the line ends of browsers. @param {string} comment */
const asShown = (comment) => comment.replace(/\r\n?/g, "\n");

/** A photo with its flag and its comment. */
class Card {
  /** What is on the disk. @type {Flag} */
  #kept;
  /** What the comment's field showed when it was last what is on the disk. */
  #shown = "";
  #sending = false;
  /** Whether the server has refused what is shown, so that sending it again makes no sense. */
  #refused = false;
  /** Whether the server is away. */
  away = false;
  #timer = 0;

  /**
   * @param {Photo} photo
   * @param {number} longest - Characters that a comment may have.
   * @param {() => void} changed - Called when the page has something else to tell.
   */
  constructor(photo, longest, changed) {
    const copy = find(document, "#card", HTMLTemplateElement).content.cloneNode(true);
    if (!(copy instanceof DocumentFragment)) throw new Error("The page's template is none.");
    this.element = find(copy, "article", HTMLElement);
    this.box = find(copy, "input", HTMLInputElement);
    this.field = find(copy, "textarea", HTMLTextAreaElement);
    this.trouble = find(copy, ".trouble", HTMLElement);
    this.id = photo.id;
    this.changed = changed;
    this.#kept = photo.flag;
    find(copy, "h2", HTMLElement).textContent = photo.name;
    find(copy, "h2", HTMLElement).title = photo.name;
    find(copy, ".verdict", HTMLElement).textContent = photo.verdict;
    find(copy, ".details", HTMLElement).textContent = photo.details;
    const picture = find(copy, "img", HTMLImageElement);
    picture.src = `thumbnails/${photo.id}.jpg`;
    picture.alt = `${photo.name} with its path in magenta and its truth, if there is one, in turquoise`;
    this.element.setAttribute("aria-label", photo.name);
    this.field.setAttribute("aria-label", `Comment on ${photo.name}`);
    this.box.setAttribute("aria-label", `${photo.name} is reviewed`);
    this.field.maxLength = longest;
    this.#show(photo.flag);
    this.box.addEventListener("change", () => this.save());
    this.field.addEventListener("change", () => this.save());
    this.field.addEventListener("input", () => {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.save(), PAUSE);
      this.changed();
    });
  }

  get reviewed() {
    return this.box.checked;
  }

  get commented() {
    return this.field.value.trim() !== "";
  }

  /** The change that is to be sent next; nothing where all is on the disk. */
  get #next() {
    if (this.box.checked !== this.#kept.reviewed) return { reviewed: this.box.checked };
    if (this.field.value === this.#shown) return undefined;
    return { comment: this.field.value, instead_of: this.#kept.comment };
  }

  /** Whether the disk may hold something else than is shown: also while a change that was taken back is on its way. */
  get unsaved() {
    return this.#sending || this.#next !== undefined;
  }

  /** Take over what is on the disk, but for what is being edited here. @param {Flag} flag */
  take(flag) {
    if (this.unsaved) return;
    this.#show(flag);
  }

  /** Send what is not on the disk yet, until it is, or the server says why it cannot be. */
  async save() {
    clearTimeout(this.#timer);
    this.#refused = false;
    if (this.#sending) return;
    this.#sending = true;
    for (let change = this.#next; change && !this.#refused; change = this.#next) {
      this.changed();
      await this.#send(change);
    }
    this.#sending = false;
    if (!this.#refused) this.#tell("");
    this.changed();
  }

  /** @param {{ reviewed?: boolean, comment?: string, instead_of?: string }} change */
  async #send(change) {
    const how = { "Content-Type": "application/json" };
    let answer, said;
    try {
      const address = `flags/${this.id}`;
      answer = await fetch(address, { method: "PUT", headers: how, body: JSON.stringify(change), keepalive: true });
      said = await answer.json();
    } catch {
      this.away = true;
      this.changed();
      await pause(AGAIN);
      return;
    }
    this.away = false;
    if (answer.ok) {
      this.#kept = change.comment === undefined ? { ...this.#kept, reviewed: said.reviewed } : said;
      if (change.comment !== undefined) this.#shown = change.comment;
    } else if (answer.status === 409) {
      this.#kept = { ...this.#kept, comment: said.now.comment };
      this.#shown = asShown(said.now.comment); // so that it is unsaved as long as it differs from that
      this.#refused = true;
      const other = said.now.comment ? `says “${said.now.comment}”` : "has been taken away";
      this.#tell(`The comment was changed elsewhere, and ${other} now. Enter keeps yours instead.`);
    } else {
      this.#refused = true;
      this.#tell(`Not saved: ${said.detail ?? answer.status}`);
    }
  }

  /** @param {string} sentence */
  #tell(sentence) {
    this.trouble.textContent = sentence;
    this.trouble.hidden = !sentence;
  }

  /** @param {Flag} flag */
  #show(flag) {
    this.#kept = flag;
    this.box.checked = flag.reviewed;
    this.#shown = asShown(flag.comment);
    if (this.field.value !== this.#shown) this.field.value = this.#shown; // else the cursor would jump
  }
}

/** All cards, and what is above them. */
class Page {
  /** @type {Card[]} */
  cards = [];
  count = find(document, "#count", HTMLElement);
  saving = find(document, "#saving", HTMLElement);
  shown = find(document, "#shown", HTMLSelectElement);

  async open() {
    const { folder, longest, photos } = await this.#photos();
    find(document, "#folder", HTMLElement).textContent = `Flags of ${folder}`;
    this.cards = photos.map((photo) => new Card(photo, longest, () => this.tell()));
    find(document, "#cards", HTMLElement).replaceChildren(...this.cards.map((card) => card.element));
    this.shown.addEventListener("change", () => this.filter());
    document.addEventListener("keydown", (event) => this.key(event));
    window.addEventListener("focus", () => this.refresh());
    window.addEventListener("pagehide", () => this.cards.forEach((card) => card.save()));
    window.addEventListener("beforeunload", (event) => {
      if (this.cards.some((card) => card.unsaved)) event.preventDefault();
    });
    this.tell();
  }

  /** @returns {Promise<Photos>} */
  async #photos() {
    const answer = await fetch("photos");
    const said = await answer.json();
    if (!answer.ok) throw new Error(said.detail);
    return said;
  }

  /** Show what was said elsewhere meanwhile. */
  async refresh() {
    try {
      const { photos } = await this.#photos();
      const flags = new Map(photos.map((photo) => [photo.id, photo.flag]));
      for (const card of this.cards) {
        const flag = flags.get(card.id);
        if (flag) card.take(flag);
      }
      this.tell();
    } catch {
      // what is shown stays; saving says when the server is away
    }
  }

  /** Say how many photos are reviewed, and whether all is on the disk. */
  tell() {
    const reviewed = this.cards.filter((card) => card.reviewed).length;
    this.count.textContent = `${reviewed} of ${this.cards.length} reviewed`;
    const unsaved = this.cards.filter((card) => card.unsaved);
    const away = unsaved.some((card) => card.away);
    const stuck = unsaved.some((card) => !card.trouble.hidden);
    this.saving.dataset.state = away || stuck ? "unsaved" : unsaved.length ? "saving" : "saved";
    this.saving.textContent = away
      ? "Not saved: the server does not answer. Asking again…"
      : stuck ? "Not all is saved" : unsaved.length ? "Saving…" : "All saved";
  }

  /** Show the photos that were asked for; those that change stay until something else is asked. */
  filter() {
    /** @type {Record<string, (card: Card) => boolean>} */
    const kinds = { open: (card) => !card.reviewed, reviewed: (card) => card.reviewed, commented: (card) => card.commented };
    const fits = kinds[this.shown.value] ?? (() => true);
    for (const card of this.cards) card.element.hidden = !fits(card);
    find(document, "#nothing", HTMLElement).hidden = this.cards.some((card) => !card.element.hidden);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
    const visible = this.cards.filter((card) => !card.element.hidden);
    const at = visible.findIndex((card) => card.element.contains(document.activeElement));
    const card = visible[at];
    if (event.target instanceof HTMLTextAreaElement) {
      if (!card || (event.key !== "Escape" && (event.key !== "Enter" || event.shiftKey))) return;
      card.save();
      card.element.focus();
    } else if (event.target instanceof HTMLSelectElement) {
      return;
    } else if (event.key === "j" || event.key === "k") {
      const next = visible[event.key === "j" ? at + 1 : Math.max(at - 1, 0)];
      next?.element.focus();
    } else if (card && event.key === "r") {
      card.box.click();
    } else if (card && event.key === "c") {
      card.field.focus();
    } else {
      return;
    }
    event.preventDefault();
  }
}

const page = new Page();
page.open().catch((error) => {
  page.saving.dataset.state = "unsaved";
  page.saving.textContent = error instanceof TypeError ? "The server does not answer." : error.message;
});
