// The module's second half: functions that the first picture does not need (web/split). It is loaded after that picture, or
// when one of its functions is called. Development builds have none.

import { noModule } from "./trouble.js";

const url = document.getElementById("rest")?.content;
/** The exports of the first half, once it is loaded. */
let first;
/** A promise of the second half while it is loaded, and the compiled module. */
let coming;
let compiled;
let there = url === undefined;

/** Sets the exports of the first half, which the second one imports. */
export function firstHalf(exports) {
  first = exports;
}

/** The first half's import: it calls `load` when it needs the second half at once. */
export const imports = { load };

function load() {
  if (there) return;
  try {
    compiled ??= new WebAssembly.Module(bytesNow());
    // It adds its functions to the first half's table.
    new WebAssembly.Instance(compiled, { primary: first });
    there = true;
  } catch (error) {
    noModule(error);
    throw error;
  }
}

/** Starts to fetch it in the background. */
export function askForRest() {
  if (there || coming !== undefined) return;
  coming = fetchRest();
  // `loadRest` reports the error; the next request tries again.
  coming.catch(() => { coming = undefined; });
}

async function fetchRest() {
  const response = await fetch(url, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return streams(response) ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** Loads the second half asynchronously. If that fails, it is requested again when it is needed. */
export async function loadRest() {
  askForRest();
  const module = await coming;
  // It may have been loaded by `load` meanwhile.
  if (there) return;
  compiled = module;
  await WebAssembly.instantiate(compiled, { primary: first });
  there = true;
}

/** The compiled second half, once it is loaded; undefined if the page has none. */
export async function restModule() {
  if (url === undefined) return undefined;
  await loadRest();
  return compiled;
}

/** Whether a module can be compiled while it is downloaded, which needs the right content type. */
export const streams = (response) => response.headers.get("content-type") === "application/wasm";

/** The file's bytes, by a synchronous request. */
function bytesNow() {
  const request = new XMLHttpRequest();
  request.open("GET", url, false);
  // Synchronous requests return text only: one character per byte.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  request.send();
  if (request.status !== 200) throw new Error(`${url}: ${request.status} ${request.statusText}`);
  const text = request.responseText;
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}
