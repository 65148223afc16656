/** A finger that rests on something, which chooses it as Ctrl does with the mouse. */

import { around } from "./dom.js";

const LONG = 500; // milliseconds from which on a press is a long one
const STILL = 10; // pixels within which a finger rests

/**
 * Call `run` with what a finger rests on. The click at the end of such a press does nothing.
 *
 * @param {HTMLElement} place
 * @param {string} selector - Of what can be pressed in it.
 * @param {(pressed: HTMLElement) => void} run
 */
export function longPress(place, selector, run) {
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  let from = { x: 0, y: 0 };
  let pressed = false;
  const stop = () => clearTimeout(timer);
  place.addEventListener("pointerdown", (event) => {
    stop();
    pressed = false;
    const found = around(event, selector);
    if (event.pointerType !== "touch" || !event.isPrimary || !found) return;
    from = { x: event.clientX, y: event.clientY };
    timer = setTimeout(() => {
      pressed = true;
      run(found);
    }, LONG);
  });
  place.addEventListener("pointermove", (event) => {
    if (Math.hypot(event.clientX - from.x, event.clientY - from.y) > STILL) stop(); // it scrolls
  });
  for (const name of /** @type {const} */ (["pointerup", "pointercancel", "pointerleave"])) place.addEventListener(name, stop);
  place.addEventListener("contextmenu", (event) => pressed && event.preventDefault());
  place.addEventListener("click", (event) => {
    if (!pressed) return;
    pressed = false;
    event.stopPropagation();
  }, { capture: true });
}
