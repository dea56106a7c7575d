// Traced pictures: each pane that shows one has a worker (`tracer.js`), started when it is needed.

/** Set by `prepare`: the URLs of built-in files by their names. */
let urls;

/** Sets the function that gives the URLs of all built-in files: an array of `{ name, url }`. */
export function prepare(builtin) {
  urls = () => Object.fromEntries(builtin().map(({ name, url }) => [name, absolute(url)]));
}

/** Workers resolve URLs by their own. */
const absolute = (url) => new URL(url, document.baseURI).href;

/** Starts a worker. `receive` gets each picture, or `{ number, failed }` with one sentence. Returns an object: `trace` requests a
 * picture in place of the one before, `end` ends the worker. */
export function begin(receive) {
  const worker = new Worker(document.getElementById("tracer").content, { type: "module" });
  worker.onmessage = ({ data }) => receive(data);
  worker.onerror = (event) => {
    event.preventDefault();
    receive({ failed: `the scene could not be traced: ${event.message ?? "the worker did not start"}` });
  };
  const url = absolute(document.getElementById("trace-module").content);
  return {
    trace: (request) => {
      if (request.scene !== undefined) request.scene.builtin = urls();
      worker.postMessage({ ...request, url });
    },
    end: () => worker.terminate(),
  };
}
