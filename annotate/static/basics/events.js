/** Who tells others what has happened, typed: `EventTarget` knows neither names nor details. */

/**
 * Something that others listen to.
 *
 * @template {object} Told - What is told with each event, by its name.
 */
export class Events {
  #target = new EventTarget();

  /**
   * Call `hear` whenever something happens, or the next time alone.
   *
   * @template {keyof Told & string} Name
   * @param {Name} name
   * @param {(detail: Told[Name]) => void} hear
   * @param {{once?: boolean}} [how]
   */
  on(name, hear, how = {}) {
    this.#target.addEventListener(name, (event) => hear(/** @type {CustomEvent} */ (event).detail), how);
  }

  /**
   * Tell what has happened.
   *
   * @protected
   * @template {keyof Told & string} Name
   * @param {Name} name
   * @param {Told[Name]} [detail]
   */
  tell(name, detail) {
    this.#target.dispatchEvent(new CustomEvent(name, { detail }));
  }
}
