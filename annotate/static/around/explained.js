/** The panel of *Explain*: what the detector thought of a pixel, beside the pixel of the line in its column. */

import { SVG, box, button, made } from "../basics/dom.js";
import { penOf } from "../basics/drawing.js";
import { ApiError, get } from "../server/api.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Selection } from "../labelled/selection.js" */
/** @import { Explained, ShownFilter } from "../types.js" */

const FULL = 220; // gradient strength, in grey levels a pixel, that reaches the rim of the patch, as in the viewer

/** Shows the explanation of a pixel beside the photo. */
export class ExplainedPanel {
  #labelling;
  #selection;
  #focus;
  #turn = 0;

  /**
   * @param {Labelling} labelling
   * @param {Selection} selection
   * @param {() => void} focus - Gives the photo the keys.
   */
  constructor(labelling, selection, focus) {
    this.#labelling = labelling;
    this.#selection = selection;
    this.#focus = focus;
    button("explained-close").addEventListener("click", () => this.hide());
    labelling.on("document", ({ fresh }) => fresh && this.hide());
  }

  /**
   * Explain a pixel.
   *
   * @param {[number, number]} pixel
   */
  async show([column, row]) {
    const { document: shown } = this.#labelling;
    if (!shown) return;
    const turn = ++this.#turn;
    const line = shown.rows?.[column] ?? row;
    try {
      const both = await Promise.all([...new Set([row, line])].map((one) => get(`api/photos/${shown.id}/pixels/${column}/${one}`)));
      if (turn !== this.#turn) return;
      this.#selection.explain([column, row]);
      box("explained-title").textContent = `Column ${column}, row ${row}`;
      box("explained-words").replaceChildren(...told(both[0], both[1] ?? null, this.#colours));
      box("explained").hidden = false;
    } catch (error) {
      if (turn === this.#turn) this.#labelling.say(ApiError.of(error).message, true);
    }
  }

  /** Colours of what is drawn into a patch. */
  get #colours() {
    const { legend } = this.#labelling;
    return legend ? [legend.colours.halo, legend.colours.line] : [];
  }

  /** Close it. */
  hide() {
    this.#turn++;
    if (box("explained").hidden) return;
    box("explained").hidden = true;
    this.#selection.explain(null);
    this.#focus();
  }
}

/**
 * All that is told of a pixel.
 *
 * @param {Explained} here
 * @param {Explained | null} line - The line's pixel in its column, where it is another one.
 * @param {string[]} colours - Of what is drawn into its patch: halo and line.
 */
function told(here, line, colours) {
  const { filtered } = here;
  return [
    made("p", { textContent: sentence(here.why_edge || (here.edge ? "an edge pixel" : "no edge pixel")) }),
    made("div", { className: "patches" }, ...(filtered ? patches(filtered, colours) : []), colourPatch(here)),
    table("What it is", line, [
      ...(filtered ? filterRows(here, filtered, line) : []),
      ["score, 0 to 1", number(here.score), number(line?.score)],
    ]),
    ...(filtered ? [made("p", { className: "why", textContent: sentence(`Filter ${filtered.bin}, since ${filtered.why.join("; ")}`) })] : []),
    table("What it pays", line, [
      ...Object.entries(here.terms).map(([name, paid]) => [name, number(paid), number(line?.terms[name])]),
      ["nodal cost", number(here.cost), number(line?.cost)],
    ]),
    made("p", { className: "why", textContent: verdict(here, line) }),
  ];
}

/**
 * @param {Explained} here
 * @param {ShownFilter} filtered
 * @param {Explained | null} line
 */
function filterRows(here, filtered, line) {
  const there = [filtered, ...(line?.filtered ? [line.filtered] : [])];
  return [
    ["gradient (Canny's)", number(here.gradient, 0), number(line?.gradient, 0)],
    ["strength, grey levels a pixel", ...there.map((one) => number(one.strength, 1))],
    ["coherence, 0 to 1", ...there.map((one) => number(one.coherence))],
    ["orientation, degrees", ...there.map((one) => number(one.orientation, 0))],
    ["filter, by bin", ...there.map((one) => String(one.bin))],
    ["its training samples", ...there.map(samples)],
    ["patch times filter", ...there.map((one) => number(one.score))],
  ];
}

/** @param {ShownFilter} filtered */
function samples({ samples: found, starved }) {
  return `${found.toLocaleString("en")}${starved ? ", starved" : ""}`;
}

/**
 * What costs decide between two pixels, in words.
 *
 * @param {Explained} here
 * @param {Explained | null} line
 */
function verdict(here, line) {
  if (!line) return "The line runs through this pixel.";
  if (here.cost === null || line.cost === null) return "";
  const more = here.cost - line.cost;
  const [worst] = Object.entries(here.terms).map(([name, paid]) => /** @type {[string, number]} */ ([name, paid - (line.terms[name] ?? 0)]))
    .toSorted((one, other) => Math.abs(other[1]) - Math.abs(one[1]));
  if (more > 0) return `It pays ${more.toFixed(3)} more than the line's pixel, most of all for ${worst[0]} (${signed(worst[1])}).`;
  return `It pays ${(-more).toFixed(3)} less than the line's pixel: the line runs there for the sake of its neighbours.`;
}

/**
 * @param {string} title
 * @param {Explained | null} line
 * @param {string[][]} rows
 */
function table(title, line, rows) {
  const columns = line ? ["here", `line, row ${line.row}`] : ["here"];
  const head = made("tr", {}, made("th", { textContent: title }), ...columns.map((words) => made("th", { className: "number", textContent: words })));
  return made("table", {}, made("thead", {}, head), made("tbody", {}, ...rows.map(([name, ...values]) => made("tr", {},
    made("td", { textContent: name }), ...columns.map((_, at) => made("td", { className: "number", textContent: values[at] }))))));
}

/**
 * @param {ShownFilter} filtered
 * @param {string[]} colours
 */
function patches(filtered, colours) {
  const { patch, taps, product } = filtered;
  const most = Math.max(...product.flat().map(Math.abs), 1e-9);
  const strongest = Math.max(...taps.flat().map(Math.abs), 1e-9);
  const grey = figure("grey levels, with the structure tensor", pixels(patch, (value) => [value, value, value]));
  grey.firstElementChild?.append(ellipse(filtered, colours));
  return [
    grey,
    figure(`filter of bin ${filtered.bin}`, pixels(taps, (value) => twoSided(value / strongest))),
    figure(`product: sum ${product.flat().reduce((sum, value) => sum + value, 0).toFixed(3)}`, pixels(product, (value) => twoSided(value / most))),
  ];
}

/** @param {Explained} here */
function colourPatch({ colours }) {
  return figure("colours", pixels(colours, (value) => value));
}

/**
 * @param {string} words
 * @param {HTMLCanvasElement} picture
 */
function figure(words, picture) {
  return made("figure", {}, made("div", { className: "patch" }, picture), made("figcaption", { textContent: words }));
}

/**
 * A small picture, a pixel a value.
 *
 * @template Value
 * @param {Value[][]} values
 * @param {(value: Value) => number[]} colour - Red, green and blue.
 */
function pixels(values, colour) {
  const canvas = made("canvas", { width: values[0].length, height: values.length });
  const data = new ImageData(Uint8ClampedArray.from(values.flat().flatMap((value) => [...colour(value), 255])), values[0].length);
  penOf(canvas).putImageData(data, 0, 0);
  return canvas;
}

/**
 * Red where a value is positive, blue where it is negative, white at 0: as scores are shown.
 *
 * @param {number} share - From -1 to 1.
 */
function twoSided(share) {
  const pale = Math.round(255 * (1 - Math.abs(share)));
  return share > 0 ? [255, pale, pale] : [pale, pale, 255];
}

/**
 * The structure tensor in its patch, as the viewer draws it.
 *
 * @param {ShownFilter} filtered
 * @param {string[]} colours - Of the halo and of itself.
 */
function ellipse({ axes, orientation }, [halo, own]) {
  const drawing = document.createElementNS(SVG, "svg");
  drawing.setAttribute("viewBox", "-1 -1 2 2");
  const [along, across] = axes.map((axis) => axis / Math.max(axes[0], FULL));
  for (const [colour, width] of /** @type {[string, number][]} */ ([[halo, 0.12], [own, 0.06]])) {
    const one = document.createElementNS(SVG, "ellipse");
    const how = { rx: along, ry: across, transform: `rotate(${orientation})`, fill: "none", stroke: colour, "stroke-width": width };
    for (const [name, value] of Object.entries(how)) one.setAttribute(name, String(value));
    drawing.append(one);
  }
  return drawing;
}

/**
 * @param {number | null | undefined} value
 * @param {number} [digits]
 */
function number(value, digits = 3) {
  return value === null || value === undefined ? "–" : value.toFixed(digits);
}

/** @param {number} value */
function signed(value) {
  return `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(3)}`;
}

/** @param {string} words */
function sentence(words) {
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}${words.endsWith(".") ? "" : "."}`;
}
