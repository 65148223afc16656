/**
 * Photos of a report, in the order and of the kind that was asked for; flags to copy.
 *
 * Without this script all of the page can be read: cards stand there, the worst first, and open by themselves.
 */

/**
 * An element of the page.
 * @template {Element} T
 * @param {ParentNode} within
 * @param {string} selector
 * @param {new () => T} kind
 * @returns {T | undefined}
 */
function find(within, selector, kind) {
  const found = within.querySelector(selector);
  return found instanceof kind ? found : undefined;
}

/** A number of an attribute or a field; nothing where it is empty. @param {string | undefined} text */
const numbered = (text) => (text ? Number(text) : undefined);

/** A photo with what it is ordered and chosen by. */
class Card {
  /** @param {HTMLElement} element */
  constructor(element) {
    const { name = "", titles = "", tags = "", error, margin, confidence } = element.dataset;
    this.element = element;
    this.name = name;
    this.titles = titles ? titles.split("|") : [];
    this.tags = tags ? tags.split("|") : [];
    this.error = numbered(error);
    this.margin = numbered(margin) ?? Infinity;
    this.confidence = numbered(confidence) ?? Infinity;
  }
}

/** The largest error first, what has no truth last. @type {(a: Card, b: Card) => number} */
const byError = (a, b) => (b.error ?? -1) - (a.error ?? -1) || byMargin(a, b);
/** @type {(a: Card, b: Card) => number} */
const byMargin = (a, b) => (a.margin === b.margin ? byName(a, b) : a.margin - b.margin);
/** What has no confidence comes last. @type {(a: Card, b: Card) => number} */
const byConfidence = (a, b) => (a.confidence === b.confidence ? byMargin(a, b) : a.confidence - b.confidence);
/** @type {(a: Card, b: Card) => number} */
const byName = (a, b) => a.name.localeCompare(b.name, undefined, { numeric: true });
/** Photos without a cause come last. @type {(a: Card, b: Card) => number} */
const byCause = (a, b) =>
  Number(!a.titles.length) - Number(!b.titles.length) || (a.titles[0] ?? "").localeCompare(b.titles[0] ?? "") || byError(a, b);

const ORDERS = new Map([
  ["error", byError], ["confidence", byConfidence], ["margin", byMargin], ["name", byName], ["cause", byCause],
]);

/** All cards, and what is above them. */
class Page {
  /** @param {HTMLFormElement} form */
  constructor(form) {
    this.form = form;
    const elements = /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("#cards > article"));
    this.cards = [...elements].map((element) => new Card(element));
    form.addEventListener("input", () => this.show());
    form.addEventListener("submit", (event) => event.preventDefault());
    addEventListener("pageshow", () => this.show()); // a browser puts back what was typed
  }

  /** What a field says. @param {string} id */
  said(id) {
    const field = this.form.elements.namedItem(id);
    return field instanceof HTMLInputElement || field instanceof HTMLSelectElement ? field.value : "";
  }

  /** Whether a card is asked for. @param {Card} card */
  fits(card) {
    const cause = this.said("cause");
    const tag = this.said("tag");
    const most = (/** @type {string} */ id) => numbered(this.said(id)) ?? Infinity;
    return [
      !cause || card.titles.includes(cause),
      !tag || card.tags.includes(tag),
      card.name.toLowerCase().includes(this.said("name").trim().toLowerCase()),
      (card.error ?? -1) >= (numbered(this.said("least")) ?? -1),
      card.confidence <= most("confidence"),
      card.margin <= most("margin"),
    ].every(Boolean);
  }

  /** Show the cards that are asked for, in the order that is. */
  show() {
    const order = ORDERS.get(this.said("order")) ?? byError;
    const sorted = [...this.cards].sort(order);
    for (const card of sorted) card.element.hidden = !this.fits(card);
    document.getElementById("cards")?.append(...sorted.map((card) => card.element));
    const shown = sorted.filter((card) => !card.element.hidden).length;
    const all = `${sorted.length} photos`;
    const count = find(this.form, "#count", HTMLOutputElement);
    if (count) count.textContent = shown === sorted.length ? all : `${shown} of ${all}`;
    const nothing = document.getElementById("nothing");
    if (nothing) nothing.hidden = shown > 0;
  }

  /** Show the photos of one cause. @param {string} cause */
  choose(cause) {
    const field = find(this.form, "#cause", HTMLSelectElement);
    if (!field) return;
    field.value = cause;
    this.show();
    this.form.scrollIntoView();
  }
}

/** Copy what a button is for; where that is not allowed, select it to be copied by hand. @param {HTMLElement} button */
async function copy(button) {
  try {
    await navigator.clipboard.writeText(button.dataset.text ?? "");
    button.textContent = "Copied";
  } catch {
    const text = button.parentElement?.querySelector(".codes");
    if (text) getSelection()?.selectAllChildren(text);
  }
}

/** Open or close the rest of a card. @param {Element | null} card */
function turn(card) {
  const rest = card ? find(card, ".inside", HTMLDetailsElement) : undefined;
  if (rest) rest.open = !rest.open;
}

const form = find(document, "#controls", HTMLFormElement);
const page = form && new Page(form);
document.addEventListener("click", ({ target }) => {
  if (!(target instanceof Element)) return;
  const button = target.closest("button");
  if (button?.matches(".copy")) copy(button);
  else if (button) page?.choose(button.dataset.cause ?? "");
  else if (target.closest(".top .picture")) turn(target.closest("article"));
});

export {};
