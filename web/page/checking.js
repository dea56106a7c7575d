// Checks of students' files: each in a worker (`checker.js`), terminated when its answer is no longer needed.

import { restModule } from "./rest.js";

/** Seconds that a check may take: the command line's too. Loops end long before. */
const PATIENCE = 30;
/** Images that host programs may name, by their names among the samples. */
const IMAGES = ["checker.png", "planks.png", "tiles.png"];
const FOLDER = "models/textures/";

/** The arguments of `prepare`. */
let page;
/** An idle worker with compiled programs, ready for the next check. */
let idle;

/** Says what workers need: the module, compiled; `urls`: of a sample by its name; `endless`: the verdict on a check
 * that was ended after so many seconds. */
export function prepare(module, urls, endless) {
  page = { module, urls, endless };
}

async function fetchImage(name) {
  const response = await fetch(page.urls(FOLDER + name), { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return { name, bytes: new Uint8Array(await response.arrayBuffer()) };
}

/** A worker, to ask one thing at a time. */
class Checker {
  static supported = () => typeof OffscreenCanvas === "function";

  constructor() {
    this.worker = new Worker(document.getElementById("checker").content, { type: "module" });
  }

  /** Initialises it. */
  async begin() {
    const [rest, ...images] = await Promise.all([restModule(), ...IMAGES.map(fetchImage)]);
    await this.ask("begin", { first: page.module, rest, images });
  }

  ask(what, asked) {
    return new Promise((resolve, reject) => {
      this.worker.onmessage = ({ data }) => ("failed" in data ? reject(new Error(data.failed)) : resolve(data.answer));
      this.worker.onerror = (event) => {
        event.preventDefault();
        reject(new Error(event.message ?? "the checker did not start"));
      };
      this.worker.postMessage({ what, ...asked });
    });
  }

  end() {
    this.worker.terminate();
  }
}

/** A promise that `after` keeps waiting for no longer than the checks' patience. */
function within(promise, after) {
  let timer;
  const patience = new Promise((resolve) => { timer = setTimeout(() => resolve(after()), PATIENCE * 1000); });
  return Promise.race([promise, patience]).finally(() => clearTimeout(timer));
}

/** Begins to check: `files` are `{ name, bytes }`, bytes a Uint8Array. `answer` is a promise of the verdict as JSON, or
 * fails with a sentence; `end` gives the check up. */
export function begin(exercise, files, asTheLab = false) {
  let checker = idle;
  idle = undefined;
  let ended = false;
  const end = () => {
    if (ended) return;
    ended = true;
    checker?.end();
  };
  const run = async () => {
    if (!Checker.supported()) {
      const why = "this browser cannot draw beside the page (OffscreenCanvas)";
      throw new Error(`${why}; try another browser, or \`gonio lab check\``);
    }
    if (checker === undefined) {
      checker = new Checker();
      await checker.begin();
    }
    return within(checker.ask("check", { exercise, files, asTheLab }), () => {
      end();
      return page.endless(exercise, PATIENCE);
    });
  };
  const answer = run().then((verdict) => {
    if (ended) return verdict;
    ended = true;
    // One is kept: more would only hold memory.
    idle?.end();
    idle = checker;
    return verdict;
  }, (error) => {
    end();
    throw error;
  });
  return { answer, end };
}
