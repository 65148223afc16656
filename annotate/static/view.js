/** Which part of the photo is seen: zoom and pan. Screen pixels are CSS pixels. */

const LARGEST = 32; // screen pixels a pixel

/** Maps pixels of the photo to the screen and back. */
export class View extends EventTarget {
  scale = 1;
  left = 0;
  top = 0;
  #size = { width: 1, height: 1 };
  #photo = { width: 1, height: 1 };
  #fitted = true;

  /** The photo changes: show all of it. */
  show(width, height) {
    this.#photo = { width, height };
    this.fit();
  }

  /** The window changes. */
  resize(width, height) {
    this.#size = { width, height };
    if (this.#fitted) this.fit();
    else this.#settle();
  }

  /** Show the whole photo. */
  fit() {
    const { width, height } = this.#size;
    this.scale = this.#smallest();
    this.left = (width - this.#photo.width * this.scale) / 2;
    this.top = (height - this.#photo.height * this.scale) / 2;
    this.#fitted = true;
    this.#tell();
  }

  /** Zoom by a factor around a point of the screen. */
  zoom(factor, x = this.#size.width / 2, y = this.#size.height / 2) {
    const scale = Math.min(Math.max(this.scale * factor, this.#smallest()), LARGEST);
    const by = scale / this.scale;
    this.left = x - (x - this.left) * by;
    this.top = y - (y - this.top) * by;
    this.scale = scale;
    this.#fitted = scale === this.#smallest();
    this.#settle();
  }

  /** Move by screen pixels. */
  pan(x, y) {
    this.left += x;
    this.top += y;
    this.#settle();
  }

  /** Bring a pixel into sight, in the middle unless it is seen already. */
  reveal(column, row) {
    const [x, y] = this.toScreen(column, row);
    const { width, height } = this.#size;
    if (x < 40 || x > width - 40) this.left += width / 2 - x;
    if (y < 40 || y > height - 40) this.top += height / 2 - y;
    this.#settle();
  }

  /** Screen position of a point of the photo. */
  toScreen(x, y) {
    return [x * this.scale + this.left, y * this.scale + this.top];
  }

  /** Column and row of the pixel under a point of the screen, within the photo. */
  toPixel(x, y) {
    const inside = (value, size) => Math.min(Math.max(Math.floor(value), 0), size - 1);
    return [
      inside((x - this.left) / this.scale, this.#photo.width),
      inside((y - this.top) / this.scale + 0.5, this.#photo.height), // the line lies on top of a pixel
    ];
  }

  /** First and last column in sight. */
  columns() {
    return [this.toPixel(0, 0)[0], this.toPixel(this.#size.width, 0)[0]];
  }

  #smallest() {
    const { width, height } = this.#size;
    return Math.min(width / this.#photo.width, height / this.#photo.height, LARGEST);
  }

  #settle() {
    const keep = (start, length, size) =>
      length <= size ? (size - length) / 2 : Math.min(Math.max(start, size - length - size / 2), size / 2);
    this.left = keep(this.left, this.#photo.width * this.scale, this.#size.width);
    this.top = keep(this.top, this.#photo.height * this.scale, this.#size.height);
    this.#tell();
  }

  #tell() {
    this.dispatchEvent(new Event("change"));
  }
}
