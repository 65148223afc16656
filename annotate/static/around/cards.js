/** Cards of the sheet: the straightened strip of a photo, its name and its status. */

import { made } from "../basics/dom.js";
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
  const image = made("img", { alt: `Straightened strip of ${photo.name}` });
  const line = made("div", { className: "line" }, made("span", { textContent: photo.name }), made("span", { className: "status" }));
  const card = made("li", { className: "card", tabIndex: 0 }, image, line);
  card.dataset.at = String(at);
  labelCard(card, photo);
  blob(`api/photos/${photo.id}/strip?width=${WIDTH}`).then((data) => {
    image.src = URL.createObjectURL(data);
    came(image.src);
  }, (error) => image.replaceWith(made("p", { className: "none", textContent: error.message })));
  return card;
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
  status.textContent = [photo.status, ...photo.tags].join(", ");
  status.dataset.status = photo.status;
}
