/** Light or dark, and what the browser remembers of that. */

/** Change between light and dark. */
export function turnTheme() {
  const dark = getComputedStyle(document.documentElement).colorScheme === "dark";
  setTheme(dark ? "light" : "dark");
  remember("theme", dark ? "light" : "dark");
}

/** Use the theme that was chosen before. */
export function restoreTheme() {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  const theme = remembered("theme");
  if (theme) setTheme(theme);
}

/** @param {string} theme */
function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  redraw();
}

/** What is drawn takes its colours from the page. */
function redraw() {
  dispatchEvent(new Event("resize"));
}

/**
 * What the browser remembers; null where it remembers nothing.
 *
 * @param {string} name
 */
export function remembered(name) {
  try {
    return localStorage.getItem(`skyline-${name}`);
  } catch {
    return null; // a browser that keeps nothing
  }
}

/**
 * Let the browser remember something, if it can.
 *
 * @param {string} name
 * @param {string} value
 */
export function remember(name, value) {
  try {
    localStorage.setItem(`skyline-${name}`, value);
  } catch {
    // then it is asked again
  }
}
