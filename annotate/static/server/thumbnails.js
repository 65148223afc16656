/** Small pictures of the photos of the list: the last ones that were asked for are kept. */

import { blob } from "./api.js";

const KEPT = 300;

/** Addresses of small pictures. */
export class Thumbnails {
  /** @type {Map<number, string>} */
  #urls = new Map(); // by the photo's id; empty while it is on its way

  /**
   * The address of a photo's picture; empty where it is on its way, and `came` is called with it then.
   *
   * @param {number} photo
   * @param {(url: string) => void} came
   */
  of(photo, came) {
    const kept = this.#urls.get(photo);
    if (kept === undefined) this.#ask(photo, came);
    return kept ?? "";
  }

  /**
   * @param {number} photo
   * @param {(url: string) => void} came
   */
  async #ask(photo, came) {
    this.#urls.set(photo, "");
    try {
      const url = URL.createObjectURL(await blob(`api/photos/${photo}/thumbnail`));
      this.#urls.set(photo, url);
      if (this.#urls.size > KEPT) this.#drop();
      came(url);
    } catch {
      this.#urls.delete(photo); // asked for again when it is in sight again
    }
  }

  #drop() {
    for (const [oldest, url] of this.#urls) {
      this.#urls.delete(oldest);
      if (url) URL.revokeObjectURL(url);
      return;
    }
  }
}
