/** Mouse, pen and fingers on the photo: tools, zoom and pan. */

const STILL = 4; // screen pixels within which a press is a click
const BRUSH = 12; // radius of the brush, in screen pixels

/** The tools, in the order of their buttons. */
export const TOOLS = [
  { id: "anchor", name: "Anchor", key: "A", title: "Click: the line passes through here; with Shift, it leaves the old line around. Drag an anchor to move it, right-click to remove it." },
  { id: "forbid", name: "Brush", key: "B", title: "Paint where the line must not go; with Alt, erase." },
  { id: "straight", name: "Straight", key: "S", title: "Drag from one end of a straight piece to the other." },
  { id: "drawn", name: "Draw", key: "D", title: "Drag along the line." },
  { id: "hidden", name: "Hide", key: "H", title: "Drag across columns in which the line cannot be seen; with Alt, show them again." },
];

/** Turns what pointers do into operations. */
export class Pointer {
  tool = "anchor";
  #parts; // {canvas, view, lines, labelling, previewer, moved}
  #down = new Map();
  #press = null;
  #pinch = null;

  constructor(parts) {
    this.#parts = parts;
    const { canvas, view } = parts;
    canvas.addEventListener("pointerdown", (event) => this.#start(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#end(event));
    canvas.addEventListener("pointercancel", (event) => this.#cancel(event));
    canvas.addEventListener("pointerleave", (event) => this.#leave(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      view.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.002)), event.offsetX, event.offsetY);
    }, { passive: false });
  }

  #at(event) {
    const box = this.#parts.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #start(event) {
    const { canvas, lines, labelling, view } = this.#parts;
    if (!labelling.document) return;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const at = this.#at(event);
    this.#down.set(event.pointerId, at);
    if (this.#down.size === 2) {
      this.#drop();
      this.#pinch = this.#fingers();
      return;
    }
    if (this.#down.size > 2) return;
    const anchor = lines.anchorAt(...at, event.pointerType === "touch" ? 24 : 10);
    if (event.button === 2 && anchor !== undefined) {
      labelling.apply({ kind: "remove", column: anchor });
      return;
    }
    const pans = event.button !== 0;
    const kind = pans ? "pan" : this.tool === "anchor" && anchor !== undefined ? "drag" : this.tool;
    this.#press = { kind, from: at, last: at, anchor, moved: false, touch: event.pointerType === "touch", allow: event.altKey };
    const pixel = view.toPixel(...at);
    if (kind === "forbid") {
      const radius = Math.min(Math.max(Math.round(BRUSH / view.scale), 1), 1000);
      lines.stroke = { kind, points: [pixel], radius, allow: event.altKey };
    } else if (["straight", "drawn", "hidden"].includes(kind)) {
      lines.stroke = { kind, points: [pixel] };
    }
    if (this.#press.touch && kind !== "pan") this.#show(at, pixel);
    lines.draw();
  }

  #move(event) {
    const { view, lines, labelling, previewer } = this.#parts;
    if (!labelling.document) return;
    const at = this.#at(event);
    if (this.#down.has(event.pointerId)) this.#down.set(event.pointerId, at);
    if (this.#pinch) return this.#pinched();
    const pixel = view.toPixel(...at);
    const press = this.#press;
    if (!press) {
      if (this.tool === "anchor" && event.pointerType !== "touch" && !labelling.waiting) {
        if (lines.anchorAt(...at, 10) === undefined) previewer.ask(...pixel);
        else previewer.clear();
      }
      return;
    }
    press.moved ||= Math.hypot(at[0] - press.from[0], at[1] - press.from[1]) > STILL;
    if (press.kind === "pan" || (press.kind === "anchor" && press.moved && !press.touch)) {
      previewer.clear();
      view.pan(at[0] - press.last[0], at[1] - press.last[1]);
    } else if (press.kind === "drag" && press.moved) {
      lines.dragged = press.anchor;
      this.#show(at, pixel, press.anchor);
    } else if (press.kind === "anchor") {
      if (press.touch) this.#show(at, pixel);
    } else if (lines.stroke) {
      const points = lines.stroke.points;
      if (press.kind === "straight" || press.kind === "hidden") points.splice(1, 1, pixel);
      else if (String(points.at(-1)) !== String(pixel)) points.push(pixel);
    }
    press.last = at;
    lines.draw();
  }

  #show(at, pixel, lifted = null) {
    const { lines, previewer } = this.#parts;
    if (this.#press.touch) lines.finger = at;
    if (this.#press.kind === "anchor" || this.#press.kind === "drag") {
      lines.cursor = { column: pixel[0], row: pixel[1] };
      previewer.ask(...pixel, lifted);
    }
  }

  #end(event) {
    const { view, lines, labelling } = this.#parts;
    this.#down.delete(event.pointerId);
    if (this.#pinch) {
      if (this.#down.size === 0) this.#pinch = null;
      return;
    }
    const press = this.#press;
    if (!press) return;
    const [column, row] = view.toPixel(...this.#at(event));
    const points = lines.stroke?.points ?? [];
    const allow = lines.stroke?.allow ?? false;
    const radius = lines.stroke?.radius;
    this.#drop();
    if (press.kind === "anchor" && (press.touch || !press.moved)) {
      this.#parts.anchor(column, row, event.shiftKey);
    } else if (press.kind === "drag" && press.moved) {
      labelling.apply({ kind: "move", from_column: press.anchor, column, row });
    } else if (press.kind === "drag") {
      this.#parts.moved(press.anchor);
    } else if (press.kind === "forbid") {
      labelling.apply({ kind: "forbid", points: thinned(points), radius, allow });
    } else if (press.kind === "straight" && points.length > 1 && points[0][0] !== points[1][0]) {
      const [[first, high], [last, low]] = points;
      labelling.apply({ kind: "straight", column: first, row: high, to_column: last, to_row: low });
    } else if (press.kind === "drawn" && points.length > 1) {
      labelling.apply({ kind: "drawn", ...drawn(points) });
    } else if (press.kind === "hidden" && points.length > 1) {
      const ends = [points[0][0], points[1][0]];
      labelling.apply({ kind: "hidden", first: Math.min(...ends), last: Math.max(...ends), hidden: !press.allow });
    }
  }

  #cancel(event) {
    this.#down.delete(event.pointerId);
    if (this.#down.size === 0) this.#pinch = null;
    this.#drop();
  }

  #leave(event) {
    if (!this.#press && event.pointerType !== "touch") this.#parts.previewer.clear();
  }

  /** Forget what is being done. */
  #drop() {
    const { lines, previewer } = this.#parts;
    this.#press = null;
    lines.stroke = lines.finger = lines.dragged = null;
    if (lines.cursor) lines.cursor = { ...lines.cursor, row: null };
    if (this.#down.size) previewer.clear();
    lines.draw();
  }

  #fingers() {
    const [[ax, ay], [bx, by]] = [...this.#down.values()];
    return { x: (ax + bx) / 2, y: (ay + by) / 2, apart: Math.max(Math.hypot(ax - bx, ay - by), 1) };
  }

  #pinched() {
    if (this.#down.size < 2) return;
    const before = this.#pinch;
    const now = this.#fingers();
    this.#parts.view.zoom(now.apart / before.apart, before.x, before.y);
    this.#parts.view.pan(now.x - before.x, now.y - before.y);
    this.#pinch = now;
  }
}

/** A stroke with at most 2,000 points. */
function thinned(points) {
  const step = Math.ceil(points.length / 2000);
  return points.filter((_, at) => at % step === 0 || at === points.length - 1);
}

/** First column and a row a column of a drawn stroke; where it goes back, what was drawn last counts. */
function drawn(points) {
  const rows = new Map();
  points.forEach(([column, row], at) => {
    const [from, high] = points[Math.max(at - 1, 0)];
    const steps = Math.max(Math.abs(column - from), 1);
    for (let step = 0; step <= steps; step++) {
      const share = step / steps;
      rows.set(Math.round(from + share * (column - from)), Math.round(high + share * (row - high)));
    }
  });
  const first = Math.min(...rows.keys());
  const last = Math.max(...rows.keys());
  return { first, rows: Array.from({ length: last - first + 1 }, (_, at) => rows.get(first + at)) };
}
