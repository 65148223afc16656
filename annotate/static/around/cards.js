/** Cards of the sheet: a photo with its line, the straightened strip beside it, name and status. */

import { made } from "../basics/dom.js";
import { sure } from "../basics/words.js";
import { blob } from "../server/api.js";

/** @import { ShownPhoto } from "../types.js" */

const WIDTH = 800; // of a strip, in pixels

/**
 * The card of a photo; its strip comes by itself.
 *
 * @param {ShownPhoto} photo
 * @param {number} at - Its place in the sheet.
 * @param {(url: string) => void} came - Called with the address of the strip.
 */
export function cardFor(photo, at, came) {
  const whole = made("img", { className: "whole", alt: `${photo.name} with its line` });
  const image = made("img", { alt: `Straightened strip of ${photo.name}` });
  const line = made("div", { className: "line" }, made("span", { textContent: photo.name }), made("span", { className: "status" }));
  const card = made("li", { className: "card", tabIndex: 0 }, made("div", { className: "both" }, whole, image), line);
  card.dataset.at = String(at);
  labelCard(card, photo);
  fill(image, `api/photos/${photo.id}/strip?width=${WIDTH}`, came)
    .catch((error) => image.replaceWith(made("p", { className: "none", textContent: error.message })));
  fill(whole, `api/photos/${photo.id}/overview`, came).catch(() => whole.remove()); // why is said where the strip would be
  return card;
}

/**
 * @param {HTMLImageElement} image
 * @param {string} path
 * @param {(url: string) => void} came
 */
async function fill(image, path, came) {
  image.src = URL.createObjectURL(await blob(path));
  came(image.src);
}

/**
 * Say how far the photo of a card is.
 *
 * @param {Element | null} card
 * @param {ShownPhoto} photo
 */
export function labelCard(card, photo) {
  const status = card?.querySelector(".status");
  if (!(status instanceof HTMLElement)) return;
  status.textContent = [photo.status, ...sure(photo.status, photo.confidence), ...photo.tags].join(", ");
  status.dataset.status = photo.status;
}
