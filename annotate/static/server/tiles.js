/** Exact parts of a photo that is larger than its view: the last ones that were asked for are kept. */

import { picture } from "./api.js";

const KEPT = 64;

/** @typedef {CanvasImageSource & {width: number, height: number}} Picture */
/** @typedef {{bitmap: ImageBitmap | null, adjusted: Picture | null}} Tile - `bitmap` is null until it has come. */

/** The tiles of one photo. */
export class Tiles {
  #photo;
  #came;
  /** @type {Map<string, Tile>} */
  #tiles = new Map();

  /**
   * @param {number} photo
   * @param {() => void} came - Called when another tile is there.
   */
  constructor(photo, came) {
    this.#photo = photo;
    this.#came = came;
  }

  /**
   * A tile, which is asked for unless it is there.
   *
   * @param {number} across
   * @param {number} down
   */
  at(across, down) {
    const key = `${across}/${down}`;
    const tile = this.#tiles.get(key) ?? this.#ask(key);
    this.#tiles.delete(key); // the order is that in which they were asked for
    this.#tiles.set(key, tile);
    const [oldest] = this.#tiles.keys();
    if (this.#tiles.size > KEPT) this.#tiles.delete(oldest);
    return tile;
  }

  /** Forget what was made of the tiles. */
  readjust() {
    for (const tile of this.#tiles.values()) tile.adjusted = null;
  }

  /** @param {string} key */
  #ask(key) {
    /** @type {Tile} */
    const tile = { bitmap: null, adjusted: null };
    picture(`api/photos/${this.#photo}/tiles/${key}`).then((bitmap) => {
      tile.bitmap = bitmap;
      this.#came();
    }, () => this.#tiles.delete(key));
    return tile;
  }
}
