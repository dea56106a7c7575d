// Loads the application and starts it in the canvas, after the first picture (`first.js`).

import { begin as beginCheck, expect as expectCheck, prepare as prepareChecks } from "./checking.js";
import { trustDevicePixelRatio } from "./emulated.js";
import * as application from "./gonio.js";
import { graphicsOf } from "./graphics.js";
import { begin as beginTrace, prefetch as prefetchTracer, prepare as prepareTraces } from "./tracing.js";
import { noModule, noWebGl2, stopped } from "./trouble.js";

/** Attributes of the context. The canvas needs no samples and no depth, because pictures are drawn into textures first. */
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

/** The module. */
async function fetchModule() {
  const response = await fetch(document.getElementById("module").content, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response;
}

/** Whether a module can be compiled while it is downloaded, which needs the right content type. */
const streams = (response) => response.headers.get("content-type") === "application/wasm";

/** Instantiates the module. */
async function begin(response) {
  const imports = application.moduleImports();
  const { instance, module } = await (streams(response)
    ? WebAssembly.instantiateStreaming(response, imports)
    : WebAssembly.instantiate(await response.arrayBuffer(), imports));
  application.moduleReady(instance, module);
  prepareChecks(urlOf, application.endless_check);
  prepareTraces(() => [...builtinFiles("first"), ...builtinFiles("later")]);
}

/** The built-in files of one kind: `first` are those of the first scene. */
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

/** Fetches a built-in file. Returns a function that gives it to the application. */
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

/** The file in the page's address (`?open=model.obj`, a file beside the page). None means the first scene. */
function asked() {
  const url = new URLSearchParams(location.search).get("open");
  return url === null ? [] : [{ name: `page/${url.replaceAll(/^.*\//g, "")}`, url }];
}

/** Function to call when the application's first picture is there. */
let takenOver = () => {};

/** The button that turns support for screen readers on and off, and the mirror while it is on (`access.js`). */
const accessSwitch = document.getElementById("access-switch");
let mirror = null;
/** Where the choice is kept. */
const ACCESS_KEY = "gonio-access";

/** Whether support for screen readers is on from the start: by the address, or by the last choice. */
function wantsAccess() {
  if (new URLSearchParams(location.search).has("access")) return true;
  try {
    return localStorage.getItem(ACCESS_KEY) === "on";
  } catch {
    return false;
  }
}

/** Turns support for screen readers on or off. */
async function switchAccess(on) {
  if (on === (mirror !== null)) return;
  if (on) {
    try {
      const { Mirror } = await import(new URL(document.getElementById("access").content, document.baseURI).href);
      mirror ??= new Mirror(application, canvas);
    } catch (error) {
      // The rest of the page works without it.
      console.error("support for screen readers could not be loaded:", error);
      return;
    }
  } else {
    mirror.end();
    mirror = null;
  }
  const [off, turnedOn] = document.documentElement.lang === "fr"
    ? ["Désactiver la prise en charge des lecteurs d'écran", "Activer la prise en charge des lecteurs d'écran"]
    : ["Turn off screen reader support", "Turn on screen reader support"];
  accessSwitch.textContent = on ? off : turnedOn;
}

/** Turns it on or off as the user asks, and keeps the choice. */
async function chooseAccess() {
  await switchAccess(mirror === null);
  try {
    localStorage.setItem(ACCESS_KEY, mirror === null ? "off" : "on");
  } catch {
    // The choice holds for this visit.
  }
}

/** Shows the button to the Tab key. The canvas takes every Tab; before anything else is done, the first one goes to the button. */
function offerAccess() {
  accessSwitch.hidden = false;
  accessSwitch.addEventListener("click", chooseAccess);
  const listen = { capture: true };
  const first = (event) => {
    for (const kind of ["pointerdown", "keydown"]) window.removeEventListener(kind, first, listen);
    if (event.key !== "Tab" || event.shiftKey || mirror !== null) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    accessSwitch.focus();
  };
  for (const kind of ["pointerdown", "keydown"]) window.addEventListener(kind, first, listen);
}

/** Loads and starts the application. `shown` is called when its first picture is there. */
export async function start(shown) {
  takenOver = shown;
  trustDevicePixelRatio();
  const module = fetchModule();
  const opened = asked();
  // A link with a scene may name any sample, so all are fetched before it is read.
  const carried = location.hash.startsWith("#scene=") ? builtinFiles("later") : [];
  const requested = opened.length > 0 ? opened : builtinFiles("first");
  // If another file is opened, the first scene is a sample like the others.
  if (opened.length > 0) unopened = builtinFiles("first").map(giveIfItComes);
  const scene = Promise.all([...requested, ...carried].map(give));
  // Errors are reported below, after the first `await`, and not also by the browser.
  module.catch(() => {});
  scene.catch(() => {});
  if (graphicsOf(canvas, CONTEXT) === null) {
    noWebGl2();
    return;
  }
  try {
    await begin(await module);
    performance.mark("gonio-module");
  } catch (error) {
    noModule(error);
    return;
  }
  // The application starts while its first scene is fetched, and reads it when it has arrived.
  for (const { name } of requested) application.expect(name);
  scene.then((hands) => hands.forEach((hand) => hand())).catch(noModule);
  await startApplication(opened.map(({ name }) => `builtin:${name}`));
}

/** Starts the application, or resumes it after its graphics context was lost. */
async function startApplication(inputs = []) {
  try {
    await application.start(canvas, inputs, beginCheck, expectCheck, beginTrace);
  } catch (error) {
    stopped(error, application.last_panic());
    return;
  }
  mirror?.resumed();
  if (!started) {
    offerAccess();
    if (wantsAccess()) await switchAccess(true);
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
  performance.mark("gonio-running");
  const first = !document.body.classList.contains("running");
  document.body.classList.add("running");
  if (!first) return;
  // The frame fades.
  setTimeout(takenOver, FADE_MS);
  fetchLater();
}

/** Frames that the first picture may take: more than reading the first scene takes. */
const PATIENCE_FRAMES = 120;
/** Milliseconds until the page's frame has faded (`page.css`). */
const FADE_MS = 200;

/** Fetches what the first frame does not need: the other samples, the path tracer, and the cache for the next visit. */
async function fetchLater() {
  // A click or a key may be on its way to a traced picture.
  for (const kind of ["pointerdown", "keydown"]) window.addEventListener(kind, prefetchTracer, { capture: true, once: true });
  await new Promise((resolve) => ("requestIdleCallback" in window ? requestIdleCallback(resolve, { timeout: 2000 }) : setTimeout(resolve, 500)));
  await Promise.all([...builtinFiles("later").map(giveIfItComes), ...unopened].map(async (hand) => (await hand)()));
  await prefetchTracer();
  keepForLater();
}

// A browser resets a page's graphics when it lacks memory or the driver has crashed. The application resumes with the open
// document.
canvas.addEventListener("webglcontextlost", (event) => {
  event.preventDefault();
  if (started) application.pause();
});
canvas.addEventListener("webglcontextrestored", () => {
  if (started) startApplication();
});

/** Caches the page for the next visit, also offline. Browsers allow it on https and localhost only. */
function keepForLater() {
  if (!("serviceWorker" in navigator)) return;
  navigator.serviceWorker.register("worker.js").catch((error) => {
    // The page works without it; browsers may forbid it, for example in private windows.
    console.info("gonio is not available offline:", error);
  });
}

// A panic in the application becomes an error of the event that called it.
function onError(error) {
  const panic = started ? application.last_panic() : undefined;
  if (panic !== undefined) stopped(error, panic);
}
window.addEventListener("error", (event) => onError(event.error ?? event.message));
window.addEventListener("unhandledrejection", (event) => onError(event.reason));

/** The application's state as plain data, for tests and for inspection. */
window.gonio = {
  state: () => JSON.parse(application.state()),
  /** A promise of the verdict on students' files, each a `name`, and `text` or `bytes`. */
  check: async (exercise, files) => {
    const packed = files.map(({ name, text, bytes }) => ({ name, bytes: bytes ?? new TextEncoder().encode(text) }));
    return JSON.parse(await beginCheck(exercise, packed).answer);
  },
};
