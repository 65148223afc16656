/**
 * Starts Rerun's viewer on recordings of this server.
 *
 * The address says which, behind its `#`: `recording=ADDRESS` once or several times, and `token=TOKEN` where the
 * server wants one. The token is sent as a header, and is neither left in the address nor in the history.
 */

/** @param {string} id */
const element = (id) => /** @type {HTMLElement} */ (document.getElementById(id));
const said = element("said");
const STORE = "skyline-viewer";

/**
 * Say something in place of the viewer.
 *
 * @param {string} sentence
 */
function say(sentence) {
  said.textContent = sentence;
  said.hidden = !sentence;
}

/** What the address asks for; kept for a reload of this tab, and taken out of the address. */
function asked() {
  const given = location.hash.slice(1) || sessionStorage.getItem(STORE) || "";
  sessionStorage.setItem(STORE, given);
  history.replaceState(null, "", location.pathname);
  const words = new URLSearchParams(given);
  return { recordings: words.getAll("recording"), token: words.get("token") ?? "" };
}

/**
 * Whether an address is one of this server.
 *
 * @param {string} address
 */
function isOurs(address) {
  return new URL(address, location.href).origin === location.origin;
}

/** The viewer asks for news and reports its use to its makers; here it contacts this server, or nobody. */
function keepAtHome() {
  const send = window.fetch.bind(window);
  window.fetch = (what, how) =>
    isOurs(what instanceof Request ? what.url : String(what))
      ? send(what, how)
      : Promise.reject(new TypeError("This page contacts no other server."));
}

/**
 * A recording as bytes; throws an `Error` with a sentence.
 *
 * @param {string} address
 * @param {string} token
 */
async function read(address, token) {
  if (!isOurs(address)) throw new Error("A recording of another server is not shown here.");
  let answer;
  try {
    answer = await fetch(address, { headers: token ? { "X-Skyline-Token": token } : {} });
    if (answer.ok) return new Uint8Array(await answer.arrayBuffer());
  } catch {
    throw new Error("The server does not answer; is it still running?");
  }
  const { detail } = await answer.json().catch(() => ({}));
  throw new Error(detail ?? `The server answers ${answer.status}.`);
}

/** Start the viewer's program in the canvas. */
async function viewer() {
  await wasm_bindgen({ module_or_path: fetch("re_viewer_bg.wasm") });
  const handle = new wasm_bindgen.WebHandle({
    hide_welcome_screen: true,
    persist: false,
    enable_history: false,
    render_backend: new URLSearchParams(location.search).get("renderer"),
  });
  await handle.start(element("viewer"));
  return handle;
}

async function start() {
  const { recordings, token } = asked();
  if (!recordings.length) {
    say("This address names no recording; open the one that was printed, or press G on the labelling page.");
    return;
  }
  keepAtHome();
  try {
    const starting = viewer();
    starting.catch(() => undefined); // told below, after what is wrong with a recording
    const found = [];
    say("Computing the stages…");
    for (const address of recordings) found.push(await read(address, token));
    say("Starting the viewer…");
    const handle = await starting;
    found.forEach((bytes, place) => {
      handle.open_channel(recordings[place], recordings[place]);
      handle.send_rrd_to_channel(recordings[place], bytes);
      handle.close_channel(recordings[place]);
    });
    say("");
  } catch (error) {
    say(error instanceof Error ? error.message : `The viewer does not start: ${error}`);
    element("viewer").hidden = true;
  }
}

start();
