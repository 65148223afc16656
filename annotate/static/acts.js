/** Everything that a key or a button does, by name. */

import { box, button, input } from "./basics/dom.js";
import { stagesAddress } from "./server/api.js";

/** @import { Actions } from "./around/actions.js" */
/** @import { Labelling } from "./labelled/labelling.js" */
/** @import { Selection } from "./labelled/selection.js" */
/** @import { Stage } from "./drawn/stage.js" */
/** @import { Pointer } from "./gestures/pointer.js" */
/** @import { lineActions } from "./gestures/line_actions.js" */
/** @import { Brush } from "./around/brush.js" */
/** @import { ExplainedPanel } from "./around/explained.js" */
/** @import { HiddenList } from "./around/hidden_list.js" */
/** @import { Overlay } from "./around/overlay.js" */
/** @import { Sheet } from "./around/sheet.js" */
/** @import { tagging } from "./around/tagging.js" */
/** @import { Toolbar } from "./around/toolbar.js" */
/** @import { Status } from "./types.js" */

/**
 * @typedef {object} Parts
 * @property {Labelling} labelling
 * @property {ReturnType<typeof lineActions>} line
 * @property {Pick<Pointer, "drop">} pointer
 * @property {Actions} actions
 * @property {Toolbar} toolbar
 * @property {Overlay} overlay
 * @property {Sheet} sheet
 * @property {Selection} selection
 * @property {Stage} stage
 * @property {ExplainedPanel} explained
 * @property {Brush} brush
 * @property {HiddenList} hiddenList
 * @property {ReturnType<typeof tagging>} tags
 * @property {() => void} help - Shows all keys.
 * @property {() => void} guideline - Shows what the skyline is.
 */

/** @typedef {ReturnType<typeof makeActs>} Acts */

/**
 * What can be done on the page.
 *
 * @param {Parts} parts
 */
export function makeActs({ labelling, line, pointer, actions, toolbar, overlay, sheet, selection, stage, explained, brush, hiddenList, tags, help, guideline }) {
  return {
    ...line,
    help,
    guideline,
    escape() {
      pointer.drop();
      line.escape();
      explained.hide();
    },
    explainHere: () => labelling.document && explained.show(selection.place(labelling.document)),
    /** @param {boolean} wider */
    brush: (wider) => labelling.say(`The brush is ${2 * brush.resize(wider)} screen pixels wide.`),
    /** @param {boolean} on */
    magnify: (on) => stage.lines.magnify(on),
    /** @param {Status} status */
    finish: (status) => actions.finish(status),
    /** @param {Status} status */
    setStatus: (status) => actions.setStatus(status),
    undo: () => actions.undo(),
    redo: () => actions.redo(),
    tags: () => tags.show(),
    comment: () => actions.comment(),
    hiddenList: () => hiddenList.show(),
    /** @param {string} key */
    tool: (key) => toolbar.choose(key),
    overlay: () => overlay.next(),
    sheet: () => sheet.show(),
    stages: () => openStages(labelling),
    list: () => showList(Boolean(box("side").hidden)),
    search() {
      showList(true);
      input("search").focus();
    },
    /** @param {number} by */
    step(by) {
      const next = labelling.photos[labelling.place + by];
      if (next) labelling.open(next.id);
    },
  };
}

/** Whether the list would lie over the photo. */
export function narrow() {
  return matchMedia("(max-width: 720px)").matches;
}

/** @param {boolean} shown */
export function showList(shown) {
  box("side").hidden = !shown;
  button("list-toggle").setAttribute("aria-expanded", String(shown));
}

/**
 * Open the viewer on the stages of the photo, with its line as it is when everything is saved.
 *
 * @param {Labelling} labelling
 */
async function openStages(labelling) {
  const { document: shown, queue } = labelling;
  if (!shown) return;
  if (shown.blind) {
    labelling.say("The photo is labelled blind, so nothing of the detector is shown.", true);
    return;
  }
  const tab = open("", "_blank"); // now: later the browser would not let it open
  await queue.settled();
  if (tab) tab.location = stagesAddress(shown.id);
  labelling.say(tab ? "The stages are in another tab." : "The browser keeps tabs from opening; allow them for this page.", !tab);
}
