/** Which photos are shown, in the list and on the sheet: by status, confidence, tag, and what others have finished. */

import { made } from "./dom.js";

/** @import { ShownPhoto, Status } from "../types.js" */

const SURE = [0.5, 0.9]; // confidences under which a proposal may be wanted

/** @type {{[kind: string]: (photo: ShownPhoto, value: string) => boolean}} */
const KINDS = {
  is: ({ status }, value) => status === value,
  sure: ({ status, confidence }, value) => status === "to do" && confidence !== null && confidence < Number(value),
  tag: ({ tags }, value) => tags.includes(value),
  by: ({ finished_by: others }, value) => others.includes(value),
  not: ({ finished_by: others }, value) => !others.includes(value),
};

/**
 * Whether a photo is wanted.
 *
 * @param {ShownPhoto} photo
 * @param {string} wanted - A kind and a value, with a colon between; empty for all photos.
 */
export function matches(photo, wanted) {
  const [, kind, value] = /^(\w+):(.*)$/s.exec(wanted) ?? [];
  return !kind || KINDS[kind](photo, value);
}

/**
 * All filters of some photos, in groups: what to choose, and its words.
 *
 * @param {readonly Status[]} statuses
 * @param {ShownPhoto[]} photos
 * @returns {[string, [string, string][]][]}
 */
export function filters(statuses, photos) {
  /** @param {(photo: ShownPhoto) => string[]} of */
  const all = (of) => [...new Set(photos.flatMap(of))].toSorted();
  const measured = photos.some(({ confidence }) => confidence !== null);
  /** @type {[string, [string, string][]][]} */
  const groups = [
    ["Status", statuses.map((one) => [`is:${one}`, one])],
    ["Proposal", measured ? SURE.map((one) => [`sure:${one}`, `under ${100 * one} % sure`]) : []],
    ["Tag", all(({ tags }) => tags).map((one) => [`tag:${one}`, `tag: ${one}`])],
    ["Others", all(({ finished_by: others }) => others).flatMap((one) =>
      /** @type {[string, string][]} */ ([[`by:${one}`, `finished by ${one}`], [`not:${one}`, `not finished by ${one}`]]))],
  ];
  return groups.filter(([, options]) => options.length);
}

/**
 * Offer filters. What is chosen stays, also where no photo has it any more.
 *
 * @param {HTMLSelectElement} choice
 * @param {ReturnType<typeof filters>} groups
 */
export function offerFilters(choice, groups) {
  const { value } = choice;
  const words = choice.selectedOptions[0]?.text ?? "";
  const known = !value || groups.some(([, options]) => options.some(([one]) => one === value));
  const parts = groups.map(([label, options]) => made("optgroup", { label }, ...options.map(([one, says]) => new Option(says, one))));
  choice.replaceChildren(new Option("all", ""), ...parts, ...(known ? [] : [new Option(words, value)]));
  choice.value = value;
}
