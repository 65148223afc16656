/** Calls to the server. Nothing else on the page uses the network. */

const token = new URLSearchParams(location.search).get("token") ?? "";

/** What the server refused, or `status` 0 when it did not answer. */
export class ApiError extends Error {
  /**
   * @param {number} status - HTTP status.
   * @param {string} detail - One sentence for people.
   */
  constructor(status, detail) {
    super(detail);
    this.status = status;
  }
}

async function call(method, path, body, signal) {
  const headers = { "X-Skyline-Token": token };
  if (body !== undefined) headers["Content-Type"] = "application/json";
  let answer;
  try {
    answer = await fetch(path, { method, headers, body: body === undefined ? undefined : JSON.stringify(body), signal });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new ApiError(0, "The server does not answer; is it still running?");
  }
  if (answer.ok) return answer;
  let detail = `The server answers ${answer.status}.`;
  try {
    detail = (await answer.json()).detail;
  } catch {
    // an answer that is no JSON: the number has to do
  }
  throw new ApiError(answer.status, detail);
}

/** Get JSON. */
export async function get(path, signal) {
  return (await call("GET", path, undefined, signal)).json();
}

/** Send JSON, and get JSON. */
export async function post(path, body, signal) {
  return (await call("POST", path, body, signal)).json();
}

/** Get bytes. */
export async function blob(path, signal) {
  return (await call("GET", path, undefined, signal)).blob();
}

/** Get a picture that can be drawn. */
export async function picture(path, signal) {
  return createImageBitmap(await blob(path, signal));
}

/** Address of a page with the stages of a photo; behind its `#`, which no request carries, stands the token. */
export function stagesAddress(photo) {
  const asked = new URLSearchParams({ recording: `../../api/photos/${photo}/recording`, token });
  return new URL(`static/stages/#${asked}`, location.href).href;
}
