/** Draws the photo: its view, exact tiles when zoomed in, adjustments, and a stage laid over it. */

import { picture } from "./api.js";

const TILE = 512;
const KEPT = 64; // tiles

/** The lower canvas of the stage. */
export class PhotoLayer {
  #canvas;
  #view;
  #shown = null; // {id, width, height, bitmap}
  #adjusted = null;
  #blurred = null;
  #tiles = new Map();
  #overlay = null;
  #opacity = 0.7;
  #how = { contrast: 1, gamma: 1, local: 0 };
  #drawing = false;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("./view.js").View} view
   */
  constructor(canvas, view) {
    this.#canvas = canvas;
    this.#view = view;
    view.addEventListener("change", () => this.draw());
  }

  /** Show another photo. */
  show(document, bitmap) {
    this.#shown = { id: document.id, width: document.width, height: document.height, bitmap };
    this.#tiles.clear();
    this.#overlay = null;
    this.#blurred = reduced(bitmap, 48);
    this.#adjusted = this.#adjust(bitmap, 0, 0, 1, 1);
    this.draw();
  }

  /** Change contrast, gamma or local contrast. */
  adjust(how) {
    this.#how = how;
    if (!this.#shown) return;
    for (const tile of this.#tiles.values()) tile.adjusted = null;
    this.#adjusted = this.#adjust(this.#shown.bitmap, 0, 0, 1, 1);
    this.draw();
  }

  /** Lay a picture over the photo, or nothing. */
  lay(bitmap, opacity) {
    this.#overlay = bitmap;
    this.#opacity = opacity;
    this.draw();
  }

  /** Draw with the next frame. */
  draw() {
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => {
      this.#drawing = false;
      this.#paint();
    });
  }

  #paint() {
    const ratio = devicePixelRatio || 1;
    const pen = this.#canvas.getContext("2d", { alpha: false });
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = getComputedStyle(this.#canvas.parentElement).backgroundColor;
    pen.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (!this.#shown) return;
    const { width, height, bitmap } = this.#shown;
    const { scale, left, top } = this.#view;
    pen.setTransform(ratio * scale, 0, 0, ratio * scale, ratio * left, ratio * top);
    pen.imageSmoothingEnabled = scale * ratio < 2;
    pen.imageSmoothingQuality = "high";
    pen.drawImage(this.#adjusted, 0, 0, width, height);
    if (bitmap.width < width && scale * ratio > 1.1 * bitmap.width / width) this.#paintTiles(pen);
    if (this.#overlay) {
      pen.globalAlpha = this.#opacity;
      pen.drawImage(this.#overlay, 0, 0, width, height);
      pen.globalAlpha = 1;
    }
  }

  #paintTiles(pen) {
    const { id, width, height } = this.#shown;
    const [first, last] = this.#view.columns();
    const [, top] = this.#view.toPixel(0, 0);
    const [, bottom] = this.#view.toPixel(0, this.#canvas.clientHeight);
    for (let down = Math.floor(top / TILE); down <= bottom / TILE; down++) {
      for (let across = Math.floor(first / TILE); across <= last / TILE; across++) {
        const tile = this.#tile(id, across, down);
        if (!tile.bitmap) continue;
        const [x, y] = [across * TILE, down * TILE];
        tile.adjusted ??= this.#adjust(
          tile.bitmap, x / width, y / height, tile.bitmap.width / width, tile.bitmap.height / height);
        pen.drawImage(tile.adjusted, x, y);
      }
    }
  }

  #tile(id, across, down) {
    const key = `${across}/${down}`;
    let tile = this.#tiles.get(key);
    if (tile) {
      this.#tiles.delete(key); // the last ones asked for are kept
      this.#tiles.set(key, tile);
      return tile;
    }
    tile = { bitmap: null, adjusted: null };
    this.#tiles.set(key, tile);
    if (this.#tiles.size > KEPT) this.#tiles.delete(this.#tiles.keys().next().value);
    picture(`api/photos/${id}/tiles/${key}`).then((bitmap) => {
      tile.bitmap = bitmap;
      if (this.#shown.id === id) this.draw();
    }, () => this.#tiles.delete(key));
    return tile;
  }

  /** A picture with the adjustments applied; the last four say which part of the photo it is. */
  #adjust(bitmap, x, y, width, height) {
    const { contrast, gamma, local } = this.#how;
    if (contrast === 1 && gamma === 1 && local === 0) return bitmap;
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    let around = null;
    if (local > 0) {
      const soft = this.#blurred;
      pen.imageSmoothingQuality = "high";
      pen.drawImage(soft, x * soft.width, y * soft.height, width * soft.width, height * soft.height, 0, 0, canvas.width, canvas.height);
      around = pen.getImageData(0, 0, canvas.width, canvas.height).data;
    }
    pen.drawImage(bitmap, 0, 0);
    const image = pen.getImageData(0, 0, canvas.width, canvas.height);
    const curve = Uint8ClampedArray.from({ length: 256 }, (_, level) =>
      255 * Math.pow(Math.min(Math.max((level / 255 - 0.5) * contrast + 0.5, 0), 1), 1 / gamma));
    const data = image.data;
    for (let at = 0; at < data.length; at++) {
      if (at % 4 === 3) continue;
      const level = around ? data[at] + local * (data[at] - around[at]) : data[at];
      data[at] = curve[level < 0 ? 0 : level > 255 ? 255 : level | 0];
    }
    pen.putImageData(image, 0, 0);
    return canvas;
  }
}

/** A small copy of a picture: what surrounds each of its pixels. */
function reduced(bitmap, width) {
  const canvas = new OffscreenCanvas(width, Math.max(Math.round(width * bitmap.height / bitmap.width), 2));
  const pen = canvas.getContext("2d");
  pen.imageSmoothingQuality = "high";
  pen.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  return canvas;
}
