/** Under the photo: the straightened strip, and the uncertainty of each column. */

import { picture } from "./api.js";

const SURE = 4; // a margin above which a column counts as sure

/** Both strips; clicking one of them calls `go` with a column. */
export class Strips {
  #strip;
  #margin;
  #labelling;
  #view;
  #image = null;
  #timer = 0;
  #turn = 0;

  constructor({ strip, margin, labelling, view, go }) {
    this.#strip = strip;
    this.#margin = margin;
    this.#labelling = labelling;
    this.#view = view;
    for (const canvas of [strip, margin]) {
      canvas.addEventListener("click", (event) => {
        const width = labelling.document?.width;
        if (width) go(Math.min(Math.floor(event.offsetX / canvas.clientWidth * width), width - 1));
      });
    }
    labelling.addEventListener("document", (event) => this.#ask(event.detail.fresh ? 0 : 120));
    labelling.addEventListener("margins", () => this.drawMargins());
    view.addEventListener("change", () => this.drawMargins());
  }

  /** Draw both, as large as they are now. */
  draw() {
    this.#drawStrip();
    this.drawMargins();
  }

  #ask(wait) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(async () => {
      const turn = ++this.#turn;
      const { id, rows } = this.#labelling.document;
      this.#image = null;
      if (rows) {
        try {
          const width = Math.min(Math.max(Math.round(this.#strip.clientWidth * (devicePixelRatio || 1)), 16), 4096);
          const image = await picture(`api/photos/${id}/strip?width=${width}`);
          if (turn !== this.#turn) return;
          this.#image = image;
        } catch {
          // the strip is a help; what is wrong is told where the photo is read
        }
      }
      this.#drawStrip();
    }, wait);
  }

  #drawStrip() {
    const pen = sized(this.#strip);
    const { width, height } = this.#strip;
    pen.clearRect(0, 0, width, height);
    if (!this.#image) return;
    pen.imageSmoothingEnabled = false;
    pen.drawImage(this.#image, 0, 0, width, height);
    const ratio = devicePixelRatio || 1;
    for (const x of [6, width - 6 - 14 * ratio]) { // where the line lies
      pen.fillStyle = "#141414";
      pen.fillRect(x - ratio, height * 40 / 81 - 2 * ratio, 16 * ratio, 4 * ratio);
      pen.fillStyle = "#ff2d95";
      pen.fillRect(x, height * 40 / 81 - ratio, 14 * ratio, 2 * ratio);
    }
  }

  /** Bars: the taller, the less certain; below them, which part of the photo is in sight. */
  drawMargins() {
    const pen = sized(this.#margin);
    const { width, height } = this.#margin;
    pen.clearRect(0, 0, width, height);
    const { document, margins } = this.#labelling;
    if (!document) return;
    const style = getComputedStyle(this.#margin);
    pen.fillStyle = style.color;
    const ratio = devicePixelRatio || 1;
    const room = height - 7 * ratio;
    if (margins && margins.margins.length === document.width) {
      for (let x = 0; x < width; x++) {
        const first = Math.floor(x * document.width / width);
        const stop = Math.max(Math.floor((x + 1) * document.width / width), first + 1);
        let least = Infinity;
        for (let column = first; column < stop; column++) least = Math.min(least, margins.margins[column] ?? Infinity);
        const unsure = Math.max(1 - least / SURE, 0) ** 2;
        pen.fillRect(x, room * (1 - unsure), 1, room * unsure);
      }
    }
    for (const [column] of document.anchors) {
      pen.beginPath();
      pen.arc((column + 0.5) / document.width * width, room - 3 * ratio, 3 * ratio, 0, 2 * Math.PI);
      pen.fillStyle = "#fff";
      pen.fill();
      pen.strokeStyle = "#141414";
      pen.lineWidth = ratio;
      pen.stroke();
    }
    const [first, last] = this.#view.columns();
    pen.fillStyle = style.color;
    pen.fillRect(first / document.width * width, height - 4 * ratio, Math.max((last + 1 - first) / document.width * width, 4), 3 * ratio);
  }
}

function sized(canvas) {
  const ratio = devicePixelRatio || 1;
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return canvas.getContext("2d");
}
