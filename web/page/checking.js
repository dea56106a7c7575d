// Checks of students' files: each in a worker (`checker.js`), terminated when its answer is no longer needed.

/** Seconds that a check may take, as on the command line. */
const PATIENCE = 30;
/** The arguments of `prepare`. */
let page;
/** An idle worker with compiled programs, ready for the next check. */
let idle;

/** Sets what checks need: `urls`, the URL of a sample by its name; `endless`, the verdict on a check that was stopped after a
 * number of seconds. */
export function prepare(urls, endless) {
  page = { urls, endless };
}

/** A promise of the checker's compiled module. */
let compiled;

async function compile() {
  const response = await fetch(document.getElementById("check-module").content, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  // Compiled while it arrives, if the server names its type.
  return response.headers.get("content-type") === "application/wasm"
    ? WebAssembly.compileStreaming(response)
    : WebAssembly.compile(await response.arrayBuffer());
}

/** Loads the module, once. If that fails, the next call tries again. */
async function loaded() {
  compiled ??= compile();
  try {
    return await compiled;
  } catch (error) {
    compiled = undefined;
    throw error;
  }
}

/** Loads the module ahead of the first check. If it does not arrive, the check reports that. */
export function expect() {
  loaded().catch(() => {});
}

async function fetchBuiltin(path) {
  const response = await fetch(page.urls(path), { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return { path, bytes: new Uint8Array(await response.arrayBuffer()) };
}

/** A worker that handles one request at a time. */
class Checker {
  static supported = () => typeof OffscreenCanvas === "function";

  constructor() {
    this.worker = new Worker(document.getElementById("checker").content, { type: "module" });
  }

  /** Initialises it. */
  async begin() {
    await this.ask("begin", { module: await loaded() });
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

/** The promise, or the result of `after` if it takes longer than a check may. */
function within(promise, after) {
  let timer;
  const patience = new Promise((resolve) => { timer = setTimeout(() => resolve(after()), PATIENCE * 1000); });
  return Promise.race([promise, patience]).finally(() => clearTimeout(timer));
}

/** Starts a check of `files`, each `{ name, bytes }` with a Uint8Array. `answer` is a promise of the verdict as JSON, or fails
 * with one sentence; `end` stops the check. */
export function begin(exercise, files, asTheLab = false, language = "en") {
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
      throw new Error("this browser cannot draw in workers (OffscreenCanvas): use another one, or `gonio lab check`");
    }
    if (checker === undefined) {
      checker = new Checker();
      await checker.begin();
    }
    const builtin = await Promise.all((await checker.ask("needs", { exercise })).map(fetchBuiltin));
    return within(checker.ask("check", { exercise, files, builtin, asTheLab, language }), () => {
      end();
      return page.endless(exercise, PATIENCE);
    });
  };
  const answer = run().then((verdict) => {
    if (ended) return verdict;
    ended = true;
    // One idle worker is kept; more would waste memory.
    idle?.end();
    idle = checker;
    return verdict;
  }, (error) => {
    end();
    throw error;
  });
  return { answer, end };
}
