/** How the page begins: the photos are listed, what was not sent is taken over, and a photo is opened. */

import { counted } from "../basics/words.js";
import { ApiError } from "../server/api.js";
import { ALIVE, Shelf } from "../server/shelf.js";

/** @import { Labelling } from "../labelled/labelling.js" */

const RECOVER = 5000; // milliseconds between two looks at what pages that are gone have left behind
const AGAIN = 2000; // milliseconds until a server that did not answer is asked again

/**
 * Begin as soon as the server answers.
 *
 * @param {Labelling} labelling
 * @param {(words: string) => void} instead - Shows words in place of a photo.
 * @returns {Promise<boolean>} Whether it has begun; if not, only loading the page again helps.
 */
export async function begin(labelling, instead) {
  instead("The photos are being listed…");
  for (;;) {
    try {
      await start(labelling, instead);
      return true;
    } catch (caught) {
      const error = ApiError.of(caught);
      instead(error.message);
      if (!error.away || error.status === 401) return false;
      await new Promise((done) => setTimeout(done, AGAIN));
    }
  }
}

/**
 * @param {Labelling} labelling
 * @param {(words: string) => void} instead
 */
async function start(labelling, instead) {
  await labelling.load();
  await recover(labelling);
  const open = labelling.photos.filter((one) => !one.missing && !one.too_large);
  const first = open.find((one) => one.status === labelling.ahead || one.status === "in progress") ?? labelling.photos[0];
  if (first) await labelling.open(first.id);
  else instead("There is no photo to label.");
}

/**
 * Keep what waits in the browser, and send what pages that are gone could not send.
 *
 * @param {Labelling} labelling
 */
async function recover(labelling) {
  const { pass, folder, queue } = labelling;
  const shelf = new Shelf({ pass, folder, storage: kept(), locks: navigator.locks });
  queue.use(shelf);
  addEventListener("pagehide", () => shelf.leave());
  setInterval(() => shelf.live(), ALIVE);
  setInterval(() => queue.recover(), RECOVER);
  await queue.recover();
  const [other] = shelf.elsewhere();
  if (other) labelling.say(`${counted(other.count, "edit")} in ${other.folder} could not be sent; open that folder at this address again.`, true);
}

/** What outlives the page; nothing in a browser that keeps nothing. */
function kept() {
  try {
    return localStorage;
  } catch {
    return NOWHERE;
  }
}

/** @type {Pick<Storage, "getItem" | "setItem" | "removeItem">} */
const NOWHERE = {
  getItem: () => null,
  setItem() {
    throw new Error("Nothing is kept.");
  },
  removeItem() {},
};
