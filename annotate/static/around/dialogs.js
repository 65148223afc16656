/** Dialogs: keys, tags, the folder (export and learning), and three sentences at the first visit. */

import { around, box, button, dialog, find, input, made } from "../basics/dom.js";
import { remember, remembered } from "../basics/theme.js";
import { counted } from "../basics/words.js";
import { ApiError, blob, get, post } from "../server/api.js";

/** @import { Entry } from "../keys.js" */
/** @import { Labelling } from "../labelled/labelling.js" */

const PATIENCE = 600_000; // milliseconds that an export may take

/**
 * Close a dialog by clicking beside it; then the keys belong to what `home` names again.
 *
 * @param {() => HTMLElement} home
 */
export function prepare(home) {
  for (const one of document.querySelectorAll("dialog")) {
    one.addEventListener("close", () => home().focus({ preventScroll: true }));
    one.addEventListener("click", (event) => {
      if (event.target === one) one.close();
    });
  }
}

/**
 * Go on from the first sentences to something else, which gets the keys.
 *
 * @param {() => void} next
 */
export function closeWelcome(next) {
  dialog("first-dialog").addEventListener("close", next, { once: true });
  dialog("first-dialog").close();
}

/** Three sentences, once. */
export function welcome() {
  if (remembered("welcomed")) return;
  dialog("first-dialog").showModal();
  remember("welcomed", "yes");
}

/**
 * Gestures, and all keys of the table, in their groups.
 *
 * @param {Entry[]} table
 * @param {readonly (readonly [string, string])[]} gestures
 */
export function showHelp(table, gestures) {
  const groups = Map.groupBy(table, ({ group }) => group);
  const keys = [...groups].map(([title, entries]) => section(title, entries.map(({ shown, says }) => [shown, says])));
  box("help-keys").replaceChildren(section("Mouse and fingers", gestures), ...keys);
  dialog("help-dialog").showModal();
  dialog("help-dialog").scrollTop = 0; // its button, which has the keys, is at the end
}

/**
 * @param {string} title
 * @param {readonly (readonly [string, string])[]} rows
 */
function section(title, rows) {
  return made("section", {}, made("h3", { textContent: title }), ...rows.map(([does, says]) => made("div", {},
    made("span", { className: "key", textContent: does }), made("span", { textContent: says }))));
}

/**
 * Tags to choose from, in an order in which their numbers stay: the usual ones, those of any photo, those of this one.
 *
 * @param {Pick<Labelling, "legend" | "photos">} labelling
 * @param {{tags: readonly string[]}} photo
 */
export function offeredTags({ legend, photos }, photo) {
  return [...new Set([...legend?.tags ?? [], ...photos.flatMap((one) => one.tags), ...photo.tags])];
}

/**
 * Tags of a photo as boxes to tick, and a field for one's own.
 *
 * @param {Labelling} labelling
 * @param {{name: string, tags: readonly string[]}} photo - Or what stands for several.
 * @param {(tag: string, on: boolean) => void} set - Called with a tag, and whether it is on.
 */
export function showTags(labelling, photo, set) {
  const offered = offeredTags(labelling, photo);
  const ticked = new Set(photo.tags);
  const draw = () => box("tags-list").replaceChildren(...offered.map((tag, at) => {
    const tick = made("input", { type: "checkbox", checked: ticked.has(tag) });
    tick.addEventListener("change", () => {
      if (tick.checked) ticked.add(tag);
      else ticked.delete(tag);
      set(tag, tick.checked);
    });
    return made("label", {}, tick, at < 9 ? made("kbd", { textContent: String(at + 1) }) : "", tag);
  }));
  draw();
  dialog("tags-dialog").onkeydown = (event) => {
    if (around(event, "input:not([type=checkbox])") || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "t") dialog("tags-dialog").close();
    const tick = /^[1-9]$/.test(event.key) && box("tags-list").querySelectorAll("input")[Number(event.key) - 1];
    if (tick) tick.click();
  };
  box("tags-title").textContent = `Tags of ${photo.name}`;
  find("tags-form", HTMLFormElement).onsubmit = (event) => {
    event.preventDefault();
    const tag = input("own-tag").value.trim();
    if (!tag) return;
    input("own-tag").value = "";
    if (!offered.includes(tag)) offered.push(tag);
    ticked.add(tag);
    set(tag, true);
    draw();
  };
  button("comment-open").hidden = !("id" in photo); // of several photos nothing is said
  dialog("tags-dialog").showModal();
}

/**
 * Ask for a sentence on a photo, and with which status it is said.
 *
 * @param {{name: string}} photo
 * @param {(status: "needs review" | "rejected", words: string) => void} say
 */
export function showComment(photo, say) {
  box("comment-title").textContent = `Say what is wrong with ${photo.name}`;
  input("comment").value = "";
  find("comment-form", HTMLFormElement).onsubmit = ({ submitter }) => {
    const words = input("comment").value.trim();
    if (words) say(submitter?.id === "comment-reject" ? "rejected" : "needs review", words);
  };
  dialog("comment-dialog").showModal();
}

/**
 * Export, learning, appearance.
 *
 * @param {Labelling} labelling
 */
export function showMore(labelling) {
  box("who").textContent = `${labelling.folder}, labelled by ${labelling.annotator}.`;
  box("formats").replaceChildren(...(labelling.legend?.formats ?? []).map(({ name, says }) => {
    const one = made("button", { type: "button", textContent: says });
    one.addEventListener("click", () => download(labelling, name));
    return one;
  }));
  dialog("more-dialog").showModal();
}

/**
 * @param {Labelling} labelling
 * @param {string} format
 */
async function download(labelling, format) {
  const words = box("learned");
  try {
    const waits = labelling.waiting;
    if (waits) words.textContent = `The export begins as soon as ${counted(waits, "edit")} ${waits === 1 ? "is" : "are"} saved.`;
    await labelling.queue.settled();
    const file = `skylines-${format}.zip`;
    const link = made("a", { href: URL.createObjectURL(await blob(`api/exports/${format}`, { patience: PATIENCE })), download: file });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
    words.textContent = `${file} is downloaded.`;
  } catch (error) {
    words.textContent = ApiError.of(error).message;
  }
}

/**
 * Learn from the accepted photos, and tell how it goes.
 *
 * @param {Labelling} labelling
 */
export async function learn(labelling) {
  const words = box("learned");
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
    words.textContent = ApiError.of(error).message;
  }
}
