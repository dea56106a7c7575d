// Loads the application and starts it in the canvas.

import { begin as beginCheck, prepare as prepareChecks } from "./checking.js";
import { trustDevicePixelRatio } from "./emulated.js";
import * as application from "./gonio.js";
import { askForRest, firstHalf, imports as rest, loadRest, streams } from "./rest.js";
import { noModule, noWebGl2, stopped } from "./trouble.js";

/** Of the canvas. No samples and no depth of its own: the application draws each picture into a texture first. */
const CONTEXT = {
  alpha: false,
  antialias: false,
  depth: false,
  stencil: false,
  powerPreference: "high-performance",
};

const canvas = document.getElementById("lab");
let started = false;
/** Files of the first scene if a link opens something else. */
let unopened = [];

/** The module, with its progress shown. It was asked for by a link in the page's head. */
async function fetchModule() {
  const response = await fetch(document.getElementById("module").href, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response;
}

/** Makes the module run. `wasm-bindgen`'s own way of doing that lets nobody add an import. */
async function begin(response) {
  const imports = Object.assign(application.moduleImports(), { rest });
  const { instance, module } = await (streams(response)
    ? WebAssembly.instantiateStreaming(response, imports)
    : WebAssembly.instantiate(await response.arrayBuffer(), imports));
  firstHalf(instance.exports);
  application.moduleReady(instance, module);
  prepareChecks(module, urlOf, application.endless_check);
}

/** The built-in files of one kind: `first` are those of the first scene, which the page's head has asked for already. */
function builtinFiles(kind) {
  return [...document.querySelectorAll(`[data-builtin][data-when=${kind}]`)].map((element) => ({
    name: element.dataset.builtin,
    url: element.getAttribute("href") ?? element.getAttribute("content"),
  }));
}

/** The URL of a built-in file. */
function urlOf(name) {
  return [...builtinFiles("first"), ...builtinFiles("later")].find((file) => file.name === name)?.url;
}

/** Hands a built-in file to the application. */
async function give({ name, url }) {
  const response = await fetch(url, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  const bytes = new Uint8Array(await response.arrayBuffer());
  return () => application.give(name, bytes);
}

/** The same for a file that is not needed yet. If it does not arrive, the application reports that when the file is
 * needed. */
function giveIfItComes(file) {
  return give(file).catch(() => () => application.give(file.name));
}

/** The file that the page's address asks for: `?open=model.obj`, a file beside the page. None: the first scene. */
function asked() {
  const url = new URLSearchParams(location.search).get("open");
  return url === null ? [] : [{ name: `page/${url.replaceAll(/^.*\//g, "")}`, url }];
}

async function run() {
  trustDevicePixelRatio();
  const module = fetchModule();
  const opened = asked();
  // A link that carries its scene may name any sample: all of them are there before it is read.
  const carried = location.hash.startsWith("#scene=") ? builtinFiles("later") : [];
  const wanted = opened.length > 0 ? opened : builtinFiles("first");
  // The page's head has asked for the first scene already: where something else is opened, it is a sample like others.
  if (opened.length > 0) unopened = builtinFiles("first").map(giveIfItComes);
  const scene = Promise.all([...wanted, ...carried].map(give));
  // The first half can read the first scene, and models in Wavefront's format. What else there is may need anything.
  const whole = carried.length > 0 || opened.some(({ name }) => !name.toLowerCase().endsWith(".obj"));
  if (whole) askForRest();
  // Reported below, after the first `await`; not twice by the browser.
  module.catch(() => {});
  scene.catch(() => {});
  if (!canvas.getContext("webgl2", CONTEXT)) {
    noWebGl2();
    return;
  }
  try {
    await begin(await module);
    if (whole) await loadRest();
    performance.mark("gonio-module");
  } catch (error) {
    noModule(error);
    return;
  }
  // The application is laid out while its first scene is still on its way, and reads it when it has come.
  for (const { name } of wanted) application.expect(name);
  scene.then((hands) => hands.forEach((hand) => hand())).catch(noModule);
  await start(opened.map(({ name }) => `builtin:${name}`));
}

/** Starts the application, or goes on with it after its graphics were gone. */
async function start(inputs = []) {
  try {
    await application.start(canvas, inputs, beginCheck);
  } catch (error) {
    stopped(error, application.last_panic());
    return;
  }
  started = true;
  performance.mark("gonio-started");
  requestAnimationFrame(untilShown);
}

/** Removes the page's placeholder once the application has drawn the scene, or has reported an error. */
function untilShown(_, frames = 0) {
  if (application.pictures() === 0 && frames < PATIENCE_FRAMES) {
    requestAnimationFrame((time) => untilShown(time, frames + 1));
    return;
  }
  performance.mark("gonio-first-picture");
  const first = !document.body.classList.contains("running");
  document.body.classList.add("running");
  if (first) fetchLater();
}

/** Frames that the first picture may take: longer than reading the first scene does. */
const PATIENCE_FRAMES = 120;

/** What the first frame did not need: the module's second half, the other samples, and the page for the next visit. */
async function fetchLater() {
  // Should it not come, then `rest.js` asks again, and complains, when something in it is called.
  await loadRest().catch((error) => console.info("the second half of gonio has not come yet:", error));
  await new Promise((resolve) => ("requestIdleCallback" in window ? requestIdleCallback(resolve, { timeout: 2000 }) : setTimeout(resolve, 500)));
  await Promise.all([...builtinFiles("later").map(giveIfItComes), ...unopened].map(async (hand) => (await hand)()));
  keepForLater();
}

// A browser takes a page's graphics away when it has too little memory, or when the driver has stopped, and gives them
// back. The application goes on with what was open.
canvas.addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  if (started) application.pause();
});
canvas.addEventListener("webglcontextrestored", () => {
  if (started) start();
});

/** Keeps the page for the next visit, also without a connection. Only where browsers allow it: https or localhost. */
function keepForLater() {
  if (!("serviceWorker" in navigator)) return;
  navigator.serviceWorker.register("worker.js").catch((error) => {
    // The page works without; a browser may forbid it, in private windows for one.
    console.info("gonio is not kept for use offline:", error);
  });
}

// A panic in the application ends as an error in whichever event it was called from.
function onError(error) {
  const said = started ? application.last_panic() : undefined;
  if (said !== undefined) stopped(error, said);
}
window.addEventListener("error", (event) => onError(event.error ?? event.message));
window.addEventListener("unhandledrejection", (event) => onError(event.reason));

/** For tests, and for whoever wants to look: the application's state as plain data. */
window.gonio = {
  state: () => JSON.parse(application.state()),
  /** A promise of the verdict on students' files, each a `name`, and `text` or `bytes`. */
  check: async (exercise, files) => {
    const packed = files.map(({ name, text, bytes }) => ({ name, bytes: bytes ?? new TextEncoder().encode(text) }));
    return JSON.parse(await beginCheck(exercise, packed).answer);
  },
};

run();
