// Traced pictures, bakes and stations. Each pane with a traced picture, each bake and the stations have a worker (`tracer.js`). The
// first one is started ahead of need.

/** Set by `prepare`: the URLs of built-in files by their names. */
let urls;

/** Sets the function that gives the URLs of all built-in files: an array of `{ name, url }`. */
export function prepare(builtin) {
  urls = () => Object.fromEntries(builtin().map(({ name, url }) => [name, absolute(url)]));
}

/** Workers resolve URLs by their own. */
const absolute = (url) => new URL(url, document.baseURI).href;

/** A worker that waits for a pane, with the module that it has loaded. */
let idle;
/** A promise of the module in that worker, and the function that resolves it. */
let prefetched;
let settle;

const start = () => new Worker(document.getElementById("tracer").content, { type: "module" });
const moduleUrl = () => absolute(document.getElementById("trace-module").content);

/** Starts the first pane's worker, once: fetching and compiling the module takes longer than a first picture may. Resolves when
 * that is done, or has failed: then the pane's request tries again. */
export function prefetch() {
  prefetched ??= new Promise((resolve) => {
    settle = resolve;
    const worker = start();
    idle = worker;
    worker.addEventListener("message", resolve, { once: true });
    worker.addEventListener("error", (event) => {
      event.preventDefault();
      if (idle === worker) idle = undefined;
      resolve();
    }, { once: true });
    worker.postMessage({ load: moduleUrl(), builtin: urls() });
  });
  return prefetched;
}

/** Takes the idle worker or starts one. `receive` gets each picture, or `{ number, failed }` with one sentence. Returns an object:
 * `trace` requests a picture in place of the one before, a bake or a station; `end` ends the worker. */
export function begin(receive) {
  const worker = idle ?? start();
  idle = undefined;
  worker.onmessage = ({ data }) => { if (data.loaded === undefined) receive(data); };
  worker.onerror = (event) => {
    event.preventDefault();
    receive({ failed: `the worker of the path tracer failed: ${event.message ?? "it did not start"}` });
  };
  const url = moduleUrl();
  return {
    trace: (request) => {
      if (request.scene !== undefined) request.scene.builtin = urls();
      worker.postMessage({ ...request, url });
    },
    end: () => {
      worker.terminate();
      // It may have been on its way.
      settle?.();
    },
  };
}
