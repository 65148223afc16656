/** Dialogs: keys, tags, the folder (export and learning), and three sentences at the first visit. */

import { blob, get, post } from "./api.js";
import { counted } from "./messages.js";

const FORMATS = {
  csv: "CSV: column, row, visible",
  json: "JSON with everything",
  mask: "Masks",
  painted: "Painted photos, Web layout",
  ch1: "CH1 layout",
  coco: "COCO",
  labelme: "LabelMe",
  cvat: "CVAT",
};

const find = (id) => document.getElementById(id);

/** Close a dialog by clicking beside it; then the keys belong to what `home` names again. */
export function prepare(home) {
  for (const dialog of document.querySelectorAll("dialog")) {
    dialog.addEventListener("close", () => home().focus({ preventScroll: true }));
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
  }
}

/** Three sentences, once. */
export function welcome() {
  if (remembered("welcomed")) return;
  find("first-dialog").showModal();
  remember("welcomed", "yes");
}

/** All keys of the table. */
export function showHelp(table) {
  const rows = table.map(({ shown, says }) => {
    const row = document.createElement("div");
    const key = document.createElement("span");
    key.className = "key";
    key.textContent = shown;
    const words = document.createElement("span");
    words.textContent = says;
    row.append(key, words);
    return row;
  });
  find("help-keys").replaceChildren(...rows);
  find("help-dialog").showModal();
}

/** Tags of a photo as boxes to tick, and a field for one's own; `set` is called with a tag, and whether it is on. */
export function showTags(labelling, photo, set) {
  find("tags-title").textContent = `Tags of ${photo.name}`;
  const draw = (more = []) => {
    const all = [...new Set([...labelling.tags, ...labelling.photos.flatMap((one) => one.tags), ...photo.tags, ...more])];
    find("tags-list").replaceChildren(...all.map((tag) => {
      const label = document.createElement("label");
      const box = document.createElement("input");
      box.type = "checkbox";
      box.checked = photo.tags.includes(tag) || more.includes(tag);
      box.addEventListener("change", () => set(tag, box.checked));
      label.append(box, tag);
      return label;
    }));
  };
  draw();
  find("tags-form").onsubmit = (event) => {
    event.preventDefault();
    const tag = find("own-tag").value.trim();
    if (!tag) return;
    find("own-tag").value = "";
    set(tag, true);
    draw([tag]);
  };
  find("tags-dialog").showModal();
}

/** Export, learning, appearance. */
export function showMore(labelling) {
  find("who").textContent = `${labelling.folder}, labelled by ${labelling.annotator}.`;
  find("formats").replaceChildren(...Object.entries(FORMATS).map(([format, words]) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words;
    button.addEventListener("click", () => download(labelling, format));
    return button;
  }));
  find("more-dialog").showModal();
}

async function download(labelling, format) {
  try {
    const waits = labelling.waiting;
    if (waits) find("learned").textContent = `The export begins as soon as ${counted(waits, "edit")} ${waits === 1 ? "is" : "are"} saved.`;
    await labelling.queue.settled();
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await blob(`api/exports/${format}`, { patience: 600_000 }));
    link.download = `skylines-${format}.zip`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
    find("learned").textContent = `skylines-${format}.zip is downloaded.`;
  } catch (error) {
    find("learned").textContent = error.message;
  }
}

/** Learn from the accepted photos, and tell how it goes. */
export async function learn(labelling) {
  const words = find("learned");
  try {
    let now = await post("api/learn", {});
    while (now.state === "running") {
      words.textContent = `Learning: ${now.detail}`;
      await new Promise((done) => setTimeout(done, 1000));
      now = await get("api/learn");
    }
    words.textContent = now.detail;
    if (now.changed) await labelling.load();
  } catch (error) {
    words.textContent = error.message;
  }
}

/** Change between light and dark. */
export function turnTheme() {
  const dark = getComputedStyle(document.documentElement).colorScheme === "dark";
  setTheme(dark ? "light" : "dark");
  remember("theme", dark ? "light" : "dark");
}

/** Use the theme that was chosen before. */
export function restoreTheme() {
  const theme = remembered("theme");
  if (theme) setTheme(theme);
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  dispatchEvent(new Event("resize")); // what is drawn takes its colours from the page
}

function remembered(name) {
  try {
    return localStorage.getItem(`skyline-${name}`);
  } catch {
    return null; // a browser that keeps nothing
  }
}

function remember(name, value) {
  try {
    localStorage.setItem(`skyline-${name}`, value);
  } catch {
    // then it is asked again
  }
}
