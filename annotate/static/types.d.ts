/**
 * What the server is asked and what it answers.
 *
 * Written by `python -m tools.page_types` from the server's models; do not edit it by hand.
 */

/** Lines along other ridges: second opinions, then the cheapest ones; or those of passes. */
export interface Alternatives {
  alternatives: ShownAlternative[];
}

/** Do an operation. */
export interface Apply {
  id: string;
  revision: number;
  operation: Operation;
}

/** Colours of what is drawn over a photo, as CSS writes them. */
export interface Colours {
  line: string;
  preview: string;
  anchor: string;
  halo: string;
}

/** A photo with everything that was done to it. */
export interface Document {
  id: number;
  name: string;
  width: number;
  height: number;
  revision: number;
  status: Status;
  tags: string[];
  blind: boolean;
  rows: number[] | null;
  hidden: Hidden[];
  nothing_visible: boolean;
  anchors: [number, number][];
  spans: ShownSpan[];
  forbidden: Stroke[];
  guides: [number, number][];
  sides: ShownSide[];
  can_undo: boolean;
  can_redo: boolean;
  undo_what: string | null;
  kept: number | null;
  origins: { [name: string]: number };
  doubtful: number | null;
  doubt: string;
  carried: string;
  comment: ShownComment | null;
  apart: [number, number][];
}

/** The line is drawn by hand. */
export interface Draw {
  kind: "drawn";
  first: number;
  rows: number[];
}

/** One pixel, all the way down, see `explanation.Explanation`. */
export interface Explained {
  row: number;
  column: number;
  colours: [number, number, number][][];
  edge: boolean;
  why_edge: string;
  gradient: number | null;
  score: number | null;
  filtered: ShownFilter | null;
  terms: { [name: string]: number };
  cost: number | null;
}

/** A stroke of the brush, or of its eraser. */
export interface Forbid {
  kind: "forbid";
  points: [number, number][];
  radius: number;
  allow?: boolean;
}

/** What a click came to on the photo as it was. */
export interface Found {
  row: number;
  left?: Left | null;
}

/** The line lies along a rough stroke. */
export interface Guide {
  points: [number, number][];
  radius?: number | null;
  times?: number[];
  kind: "guide";
}

export type Hidden = [number, number, string];

/** The line cannot be seen in some columns, or can be seen again. */
export interface Hide {
  kind: "hidden";
  first: number;
  last: number;
  hidden?: boolean;
  why?: string | null;
}

/** How far learning from the labels is. */
export interface Learning {
  state: "idle" | "running" | "done" | "failed";
  detail: string;
  changed: number;
}

/** The piece of the line that a click has left for another ridge, see `steering.Left`. */
export interface Left {
  points: [number, number][];
  radius: number;
}

/** What is the same for every photo: words and colours that the page shows. */
export interface Legend {
  statuses: Status[];
  tags: string[];
  hidden_by: string[];
  stages: { [name: string]: string };
  formats: ShownFormat[];
  colours: Colours;
  tile: number;
  band: number;
}

/** How sure the line is, column by column; null where its row is fixed. */
export interface Margins {
  revision: number;
  margins: (number | null)[];
  uncertain: number[];
}

/** An anchor is dragged. */
export interface MoveAnchor {
  column: number;
  row: number;
  within?: number;
  found?: Found | null;
  kind: "move";
  from_column: number;
}

/** The photo is shown: the clock starts. */
export interface Open {
  kind: "open";
}

/** What a folder says of how it is to be labelled. */
export interface OwnGuideline {
  text: string | null;
}

/** The part of a line that differs from the current one. */
export interface Part {
  first: number;
  rows: number[];
}

/** All photos, in their order. */
export interface PhotoList {
  folder: string;
  annotator: string;
  number: number;
  ahead: Status;
  photos: ShownPhoto[];
  progress: ShownProgress;
}

/** Where the cursor is, and which anchor it drags, if any. */
export interface Pixel {
  column: number;
  row: number;
  lifted?: number | null;
  within?: number;
}

/** What was asked for in some columns is dropped. */
export interface Release {
  kind: "release";
  first: number;
  last: number;
}

/** An anchor is taken away. */
export interface RemoveAnchor {
  kind: "remove";
  column: number;
}

/** A rough stroke, along which the line snaps. */
export interface Rough {
  points: [number, number][];
  radius?: number | null;
  times?: number[];
}

/** The line passes through a pixel. */
export interface SetAnchor {
  column: number;
  row: number;
  within?: number;
  found?: Found | null;
  kind: "anchor";
}

/** The photo is accepted, rejected, or to be looked at again. */
export interface SetStatus {
  kind: "status";
  status: Status;
  comment?: string;
  by?: string;
}

/** A tag is put on the photo, or taken off. */
export interface SetTag {
  kind: "tag";
  tag: string;
  on?: boolean;
}

/** Another line. A guide along its points, with its radius, chooses it, or what `take` says. */
export interface ShownAlternative {
  rows: number[];
  detour: number;
  apart: number;
  points: [number, number][];
  radius: number;
  name?: string;
  take?: Take | null;
}

/** What was said with a status, and who said it. */
export interface ShownComment {
  text: string;
  by: string;
}

/** How a pixel's score comes about, see `explanation.Filtered`. */
export interface ShownFilter {
  strength: number;
  coherence: number;
  orientation: number;
  axes: [number, number];
  bin: number;
  why: [string, string, string];
  samples: number;
  starved: boolean;
  patch: number[][];
  taps: number[][];
  product: number[][];
  score: number;
}

/** A format in which labels leave. */
export interface ShownFormat {
  name: string;
  says: string;
}

/** A photo in the list. */
export interface ShownPhoto {
  id: number;
  name: string;
  width: number;
  height: number;
  status: Status;
  tags: string[];
  confidence: number | null;
  blind: boolean;
  missing: boolean;
  too_large: boolean;
  seconds: number;
  comment: ShownComment | null;
  problem: string;
  nothing_visible: boolean;
  finished_by: string[];
}

/** How far a pass is. */
export interface ShownProgress {
  done: number;
  total: number;
  seconds_a_photo: number | null;
  seconds_left: number | null;
}

/** Columns in which all above a stroke is sky, or all below it is terrain. */
export interface ShownSide {
  first: number;
  rows: number[];
  ground: "sky" | "terrain";
}

/** A span. */
export interface ShownSpan {
  kind: string;
  first: number;
  last: number;
}

/** All above a stroke is sky, or all below it is terrain: the line keeps to the other side. */
export interface Side {
  kind: "side";
  points: [number, number][];
  ground: "sky" | "terrain";
}

/** Undo or redo. */
export interface Step {
  id: string;
  revision: number;
}

/** The line is straight between two pixels. */
export interface Straight {
  kind: "straight";
  column: number;
  row: number;
  to_column: number;
  to_row: number;
}

/** A stroke of the brush: where the line must not go, or, of the eraser, may go again. */
export interface Stroke {
  points: [number, number][];
  radius: number;
  allow?: boolean;
}

/** The line of another pass is taken over in some columns. */
export interface Take {
  first: number;
  rows: number[];
  origins: (["proposal" | "solved" | "straight" | "drawn", number])[];
  hidden?: [number, number][];
  of: string[];
  kind: "taken";
}

/** Anything that the page does to a photo. */
export type Operation =
  | SetAnchor
  | MoveAnchor
  | RemoveAnchor
  | Forbid
  | Guide
  | Side
  | Straight
  | Draw
  | Hide
  | Release
  | Take
  | SetTag
  | SetStatus
  | Open;

/** How far a photo is. */
export type Status =
  | "to do"
  | "in progress"
  | "accepted"
  | "needs review"
  | "rejected";
