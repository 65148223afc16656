/** Elements of the page: found, typed, and made. */

/** Namespace of drawings. */
export const SVG = "http://www.w3.org/2000/svg";

/**
 * An element of the page.
 *
 * @template {Element} Kind
 * @param {string} id
 * @param {new () => Kind} kind
 * @returns {Kind}
 */
export function find(id, kind) {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`The page has no ${kind.name} #${id}.`);
  return found;
}

/** @param {string} id */
export const button = (id) => find(id, HTMLButtonElement);

/** @param {string} id */
export const input = (id) => find(id, HTMLInputElement);

/** @param {string} id */
export const select = (id) => find(id, HTMLSelectElement);

/** @param {string} id */
export const dialog = (id) => find(id, HTMLDialogElement);

/** @param {string} id */
export const canvas = (id) => find(id, HTMLCanvasElement);

/** @param {string} id */
export const box = (id) => find(id, HTMLElement);

/**
 * A new element with some properties, and what is in it.
 *
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Partial<HTMLElementTagNameMap[Tag]>} [how]
 * @param {...(Node | string)} inside
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function made(tag, how = {}, ...inside) {
  const element = Object.assign(document.createElement(tag), how);
  element.append(...inside);
  return element;
}

/**
 * A picture that says the same as the words beside it.
 *
 * @param {string} id - Of a symbol of the page.
 */
export function icon(id) {
  const picture = document.createElementNS(SVG, "svg");
  const use = document.createElementNS(SVG, "use");
  use.setAttribute("href", `#icon-${id}`);
  picture.setAttribute("class", "icon");
  picture.setAttribute("aria-hidden", "true");
  picture.append(use);
  return picture;
}

/** Whether a dialog or the tour has the keys, and those of the page rest. */
export const busy = () => document.querySelector("dialog[open], #tour:not([hidden])") !== null;

/**
 * The element of a kind in which something happened; null where there is none.
 *
 * @param {Event} event
 * @param {string} selector
 * @returns {HTMLElement | null}
 */
export function around(event, selector) {
  return event.target instanceof Element ? event.target.closest(selector) : null;
}

/**
 * Give a choice more options.
 *
 * @param {HTMLSelectElement} choice
 * @param {readonly string[]} words
 */
export function offer(choice, words) {
  choice.append(...words.map((word) => new Option(word)));
}
