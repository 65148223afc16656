/** Tags of the photo that is worked on: from a list, or by a digit. */

import { offeredTags, showTags } from "./dialogs.js";

/** @import { Labelling } from "../labelled/labelling.js" */
/** @import { Document, ShownPhoto } from "../types.js" */

/**
 * What puts tags on a photo.
 *
 * @param {Labelling} labelling
 * @param {() => Document | ShownPhoto | null} target - The photo that is worked on; null while there is none.
 */
export function tagging(labelling, target) {
  return {
    /** Show all tags, to tick. */
    show() {
      const photo = target();
      if (photo) showTags(labelling, photo, (tag, on) => labelling.tag(photo, tag, on));
    },
    /**
     * Put a tag on the photo, or take it off.
     *
     * @param {number} number - Its place among those that are offered, from 1.
     */
    tick(number) {
      const photo = target();
      const tag = photo && offeredTags(labelling, photo)[number - 1];
      if (!photo || !tag) return;
      const on = !photo.tags.includes(tag);
      labelling.tag(photo, tag, on);
      labelling.say(`${photo.name} has the tag “${tag}”${on ? "" : " no more"}.`);
    },
  };
}
