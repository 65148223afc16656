/**
 * Calls to the server. Nothing else on the page uses the network.
 *
 * A call ends in time with a whole answer of the right server, or with an `ApiError`: an answer that
 * never comes, breaks off while it is read, is no JSON, or is somebody else's is no answer.
 */

/** @import { Alternatives, Apply, Document, Learning, Legend, Explained, Margins, OwnGuideline, Part, PhotoList, Pixel, Rough, Step } from "../types.js" */

const PATIENCE = 60_000; // milliseconds within which a whole answer must be there
const TOKEN = "X-Skyline-Token";
const PASS = "X-Skyline-Pass";

/** `ApiError.status` where no whole answer came. */
export const SILENT = 0;

/** `ApiError.status` where something else answered: another program, or the server of another pass. */
export const STRANGER = -1;

/** Who this page is: the token that it was given, and the pass (one annotator's labels of a folder) that it shows. */
export const me = { token: "", pass: "" };

/** What the server refused, or why there is no answer. */
export class ApiError extends Error {
  /**
   * @param {number} status - HTTP status, `SILENT` or `STRANGER`.
   * @param {string} detail - One sentence for people.
   * @param {number} [revision] - With 409: the revision that the photo has by now.
   */
  constructor(status, detail, revision) {
    super(detail);
    this.status = status;
    this.revision = revision;
  }

  /**
   * What was caught, which is one of these; any other error is a fault of the page, and thrown on.
   *
   * @param {unknown} error
   */
  static of(error) {
    if (error instanceof ApiError) return error;
    throw error;
  }

  /** Whether the server is away, so that asking again later makes sense and saying it twice does not. */
  get away() {
    return this.status === SILENT || this.status === STRANGER || this.status === 401;
  }
}

/**
 * Take the token out of the address, where others could read it, and remember it for this tab alone.
 *
 * @param {{location: Pick<Location, "search" | "pathname">, history: Pick<History, "replaceState">, storage: Pick<Storage, "getItem" | "setItem">}} browser
 */
export function signIn({ location, history, storage }) {
  const given = new URLSearchParams(location.search).get("token");
  try {
    if (given) storage.setItem("skyline-token", given);
    me.token = given ?? storage.getItem("skyline-token") ?? "";
  } catch {
    me.token = given ?? ""; // a browser that keeps nothing: the address has to keep it
    return;
  }
  if (given) history.replaceState(null, "", location.pathname);
}

/**
 * @typedef {object} How
 * @property {number} [patience] - Milliseconds within which a whole answer must be there.
 */

/**
 * What each path of the server answers. `N` is a photo.
 *
 * @template {string} Path
 * @typedef {Path extends "api/legend" ? Legend
 *   : Path extends "api/photos" ? PhotoList
 *   : Path extends "api/guideline" ? OwnGuideline
 *   : Path extends "api/learn" ? Learning
 *   : Path extends `api/photos/${number}/margins` ? Margins
 *   : Path extends `api/photos/${number}/alternatives?column=${number}` ? Alternatives
 *   : Path extends `api/photos/${number}/preview` | `api/photos/${number}/guide` ? Part
 *   : Path extends `api/photos/${number}/pixels/${number}/${number}` ? Explained
 *   : Path extends `api/photos/${number}` | `api/photos/${number}/${Change}` ? Document
 *   : never} Answer
 */
/** @typedef {"operations" | "undo" | "redo"} Change - What changes a photo. */

/**
 * Get JSON.
 *
 * @template {string} Path
 * @param {Path} path
 * @param {How} [how]
 * @returns {Promise<Answer<Path>>}
 */
export async function get(path, how = {}) {
  return call("GET", path, (answer) => answer.json(), how);
}

/**
 * Send JSON, and get JSON.
 *
 * @template {string} Path
 * @param {Path} path
 * @param {Apply | Step | Pixel | Rough | {}} body
 * @param {How} [how]
 * @returns {Promise<Answer<Path>>}
 */
export async function post(path, body, how = {}) {
  return call("POST", path, (answer) => answer.json(), how, JSON.stringify(body));
}

/**
 * Get bytes.
 *
 * @param {string} path
 * @param {How} [how]
 */
export async function blob(path, how = {}) {
  return call("GET", path, (answer) => answer.blob(), how);
}

/**
 * Get a picture that can be drawn.
 *
 * @param {string} path
 * @param {How} [how]
 */
export async function picture(path, how = {}) {
  const data = await blob(path, how);
  try {
    return await createImageBitmap(data);
  } catch {
    throw new ApiError(SILENT, "A picture came damaged.");
  }
}

/**
 * @template Read
 * @param {string} method
 * @param {string} path
 * @param {(answer: Response) => Promise<Read>} read
 * @param {How} how
 * @param {string} [body]
 * @returns {Promise<Read>}
 */
async function call(method, path, read, { patience = PATIENCE }, body) {
  const leave = new AbortController();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let clock;
  /** @type {Promise<never>} */
  const late = new Promise((_, fail) => {
    clock = setTimeout(() => {
      fail(new ApiError(SILENT, "The server does not answer."));
      leave.abort();
    }, patience);
  });
  try {
    // raced, not only aborted: whatever hangs, this ends
    return await Promise.race([late, answered(path, { method, body, signal: leave.signal }, read)]);
  } finally {
    clearTimeout(clock);
  }
}

/**
 * @template Read
 * @param {string} path
 * @param {RequestInit} request
 * @param {(answer: Response) => Promise<Read>} read
 * @returns {Promise<Read>}
 */
async function answered(path, request, read) {
  /** @type {Record<string, string>} */
  const headers = { [TOKEN]: me.token };
  if (me.pass) headers[PASS] = me.pass;
  if (request.body !== undefined) headers["Content-Type"] = "application/json";
  let answer;
  try {
    answer = await fetch(path, { ...request, headers });
  } catch {
    throw new ApiError(SILENT, "The server does not answer.");
  }
  const pass = passOf(answer);
  if (!answer.ok) throw await refusal(answer);
  let found;
  try {
    found = await read(answer);
  } catch {
    throw new ApiError(SILENT, "An answer of the server broke off.");
  }
  me.pass = pass;
  return found;
}

/**
 * The pass that an answer is about, which is the one that is shown.
 *
 * @param {Response} answer
 */
function passOf(answer) {
  const pass = answer.headers.get(PASS);
  if (!pass) throw new ApiError(STRANGER, "Something else than the labelling server answers here.");
  if (me.pass && pass !== me.pass) {
    throw new ApiError(STRANGER, "The server here shows another folder or another annotator's labels by now; start it again for this one.");
  }
  return pass;
}

/**
 * Why the server refuses.
 *
 * @param {Response} answer
 */
async function refusal(answer) {
  if (answer.status === 401) {
    return new ApiError(401, "The server does not know this page any more: open the address that it printed.");
  }
  const said = await answer.json().catch(() => null); // a refusal without a reason is one
  const detail = typeof said?.detail === "string" ? said.detail : `The server answers ${answer.status}.`;
  return new ApiError(answer.status, detail, said?.revision);
}

/**
 * Address of a page with the stages of a photo; behind its `#`, which no request carries, stands the token.
 *
 * @param {number} photo
 */
export function stagesAddress(photo) {
  const asked = new URLSearchParams({ recording: `../../api/photos/${photo}/recording`, token: me.token });
  return new URL(`static/stages/#${asked}`, location.href).href;
}
