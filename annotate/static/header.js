/** The header: which photo is worked on, and what can be done to it. */

const find = (id) => document.getElementById(id);

/** Shows the photo that every action is for, and leaves out what cannot be done to it. */
export class Header {
  #labelling;
  #actions;
  #sheet;

  constructor(labelling, actions, sheet) {
    this.#labelling = labelling;
    this.#actions = actions;
    this.#sheet = sheet;
    const show = () => this.show();
    for (const name of ["document", "loading", "list"]) labelling.addEventListener(name, show);
    labelling.queue.addEventListener("change", show);
    actions.addEventListener("change", show);
    sheet.addEventListener("card", show);
    find("status").addEventListener("change", ({ target }) => {
      actions.setStatus(target.value);
      target.blur();
      this.show(); // the status is what is kept, not what is wished for
    });
    this.show();
  }

  /** Bring everything up to date. */
  show() {
    const photo = this.#actions.target();
    const { loading, photos } = this.#labelling;
    const name = photo?.name ?? (loading ? `${loading} …` : "No photo");
    find("name").textContent = find("name").title = name;
    document.title = photo ? `${photo.name} - skyline-annotate` : "skyline-annotate";
    const place = photos.findIndex((one) => one.id === photo?.id);
    if (photo) find("place").textContent = `${place + 1} / ${photos.length}`;
    find("status").value = photo?.status ?? "";
    find("status").dataset.status = photo?.status ?? "";
    find("status").disabled = !photo;
    find("blind").hidden = !photo?.blind;
    for (const id of ["accept", "review", "reject", "tags"]) find(id).disabled = !photo;
    find("tag-count").textContent = photo?.tags.length ? ` ${photo.tags.length}` : "";
    const { undoes, redoes } = this.#actions;
    find("undo").disabled = !undoes;
    find("undo").title = undoes ? `Undo: ${undoes} ( U )` : "Undo ( U )";
    find("redo").disabled = !redoes;
    const [at, sheet] = [this.#labelling.place, this.#sheet.shown];
    find("previous").disabled = sheet || at <= 0;
    find("next").disabled = sheet || at < 0 || at >= photos.length - 1;
  }
}
