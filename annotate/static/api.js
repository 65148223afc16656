/**
 * Calls to the server. Nothing else on the page uses the network.
 *
 * A call ends in time with a whole answer of the right server, or with an `ApiError`: an answer that
 * never comes, breaks off while it is read, is no JSON, or is somebody else's is no answer.
 */

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

  /** Whether the server is away, so that asking again later makes sense and saying it twice does not. */
  get away() {
    return this.status === SILENT || this.status === STRANGER || this.status === 401;
  }
}

/**
 * Take the token out of the address, where others could read it, and remember it for this tab alone.
 *
 * @param {{location: Location, history: History, storage: Storage}} browser
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

/** Get JSON. */
export function get(path, options = {}) {
  return call("GET", path, "json", options);
}

/** Send JSON, and get JSON. */
export function post(path, body, options = {}) {
  return call("POST", path, "json", { ...options, body });
}

/** Get bytes. */
export function blob(path, options = {}) {
  return call("GET", path, "blob", options);
}

/** Get a picture that can be drawn. */
export async function picture(path, options = {}) {
  const data = await blob(path, options);
  try {
    return await createImageBitmap(data);
  } catch {
    throw new ApiError(SILENT, "A picture came damaged.");
  }
}

async function call(method, path, kind, { body, patience = PATIENCE }) {
  const leave = new AbortController();
  let clock;
  const late = new Promise((_, fail) => {
    clock = setTimeout(() => {
      fail(new ApiError(SILENT, "The server does not answer."));
      leave.abort();
    }, patience);
  });
  try {
    // raced, not only aborted: whatever hangs, this ends
    return await Promise.race([late, answered(method, path, kind, body, leave.signal)]);
  } finally {
    clearTimeout(clock);
  }
}

async function answered(method, path, kind, body, signal) {
  const headers = { [TOKEN]: me.token };
  if (me.pass) headers[PASS] = me.pass;
  if (body !== undefined) headers["Content-Type"] = "application/json";
  let answer;
  try {
    answer = await fetch(path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body), signal });
  } catch {
    throw new ApiError(SILENT, "The server does not answer.");
  }
  const pass = answer.headers.get(PASS);
  if (!pass) throw new ApiError(STRANGER, "Something else than the labelling server answers here.");
  if (me.pass && pass !== me.pass) {
    throw new ApiError(STRANGER, "The server here shows another folder or another annotator's labels by now; start it again for this one.");
  }
  if (answer.status === 401) {
    throw new ApiError(401, "The server does not know this page any more: open the address that it printed.");
  }
  let read;
  try {
    read = await answer[answer.ok ? kind : "json"]();
  } catch {
    if (!answer.ok) throw new ApiError(answer.status, `The server answers ${answer.status}.`);
    throw new ApiError(SILENT, "An answer of the server broke off.");
  }
  if (answer.ok) {
    me.pass = pass;
    return read;
  }
  const detail = typeof read?.detail === "string" ? read.detail : `The server answers ${answer.status}.`;
  throw new ApiError(answer.status, detail, read?.revision);
}

/** Address of a page with the stages of a photo; behind its `#`, which no request carries, stands the token. */
export function stagesAddress(photo) {
  const asked = new URLSearchParams({ recording: `../../api/photos/${photo}/recording`, token: me.token });
  return new URL(`static/stages/#${asked}`, location.href).href;
}
