// A page that was opened from the file system may not start workers, and the search is one. Here it runs in
// a hidden frame instead, which shows the same `postMessage` and `onmessage`.
class FrameWorker extends EventTarget {
  #frame = document.createElement("iframe");
  #loaded;

  constructor(url) {
    super();
    this.#frame.hidden = true;
    document.body.append(this.#frame);
    const inside = this.#frame.contentWindow;
    inside.document.open();
    inside.document.write("<!doctype html><body></body>");
    inside.document.close();
    inside.postMessage = (data) => {
      const event = new MessageEvent("message", { data });
      this.dispatchEvent(event);
      this.onmessage?.(event);
    };
    inside.importScripts = async (...scripts) => {
      for (const script of scripts) await load(inside, script);
    };
    this.#loaded = load(inside, url);
  }

  postMessage(data) {
    this.#loaded.then(() => {
      const { contentWindow } = this.#frame;
      contentWindow.dispatchEvent(new contentWindow.MessageEvent("message", { data: structuredClone(data) }));
    });
  }

  terminate() {
    this.#frame.remove();
  }
}

function load(inside, url) {
  return new Promise((done, failed) => {
    const script = inside.document.createElement("script");
    script.onload = done;
    script.onerror = failed;
    script.src = url;
    inside.document.body.append(script);
  });
}

if (location.protocol === "file:") window.Worker = FrameWorker;
