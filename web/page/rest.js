// The module's second half: what the first picture did not need (web/split). It is loaded once that picture is shown, or
// at the latest when something in it is called. A page that is built for working on it has none.

import { noModule } from "./trouble.js";

const url = document.getElementById("rest")?.content;
/** What the first half exports, once that is there. */
let first;
/** The second half, compiled: a promise of it while it comes, and itself. */
let coming;
let compiled;
let there = url === undefined;

/** Sets the exports of the first half, which the second one imports. */
export function firstHalf(exports) {
  first = exports;
}

/** For the first half to import: it calls `load` when it needs the second one at once. */
export const imports = { load };

function load() {
  if (there) return;
  try {
    compiled ??= new WebAssembly.Module(bytesNow());
    // It puts its functions into the first half's table.
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
  // `loadRest` says what went wrong; whoever asks next gets another try.
  coming.catch(() => { coming = undefined; });
}

async function fetchRest() {
  const response = await fetch(url, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return streams(response) ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** Loads it without holding anything up. Fails if it does not come; then it is asked for again when it is needed. */
export async function loadRest() {
  askForRest();
  const module = await coming;
  // It may have been needed meanwhile.
  if (there) return;
  compiled = module;
  await WebAssembly.instantiate(compiled, { primary: first });
  there = true;
}

/** The second half, compiled, once it is there; nothing where the page has none. */
export async function restModule() {
  if (url === undefined) return undefined;
  await loadRest();
  return compiled;
}

/** Whether a module may be compiled while it arrives: browsers do so only with the right type. */
export const streams = (response) => response.headers.get("content-type") === "application/wasm";

/** The file's bytes, without returning to the browser before they are there. */
function bytesNow() {
  const request = new XMLHttpRequest();
  request.open("GET", url, false);
  // Such a request gives text only: one character a byte.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  request.send();
  if (request.status !== 200) throw new Error(`${url}: ${request.status} ${request.statusText}`);
  const text = request.responseText;
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}
