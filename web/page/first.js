// Draws the first picture with a small module, then loads the application, which takes its place when it has drawn the same.
//
// The small module reads OBJ models: the first scene, and a model in the page's address. For anything else the application is
// loaded at once. It explains what is wrong with a file, so a failure here only means no early picture.

import initialise, { FirstScene } from "./gonio_first.js";
import { graphicsOf } from "./graphics.js";
import { noModule } from "./trouble.js";

const frame = document.getElementById("frame");

/** The files of the scene to draw, each `{ name, url }` with its name below `builtin:`, the model first; none if the application
 * has to draw it. */
function files() {
  const asked = new URLSearchParams(location.search).get("open");
  if (location.hash !== "") return [];
  if (asked !== null) {
    return asked.toLowerCase().endsWith(".obj") ? [{ name: `page/${asked.replaceAll(/^.*\//g, "")}`, url: asked }] : [];
  }
  const first = [...document.querySelectorAll("[data-builtin][data-when=first]")];
  return first.map((element) => ({ name: element.dataset.builtin, url: element.href }));
}

/** The response for a file. */
async function fetched(url) {
  const response = await fetch(url, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  return response;
}

/** Fetches a file. Returns a function that gives it to a scene: a texture decoded by the browser. */
async function fetchFile({ name, url }) {
  const response = await fetched(url);
  if (!/\.(png|jpe?g)$/i.test(name)) {
    const bytes = new Uint8Array(await response.arrayBuffer());
    return (scene) => scene.give(name, bytes);
  }
  const bitmap = await createImageBitmap(await response.blob(), { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  return (scene) => scene.give_texture(name, width, height, new Uint8Array(data.buffer));
}

/** Gives the canvas as many pixels as the frame's view has; the frame may change its size. */
function fit(canvas) {
  const { width, height } = frame.querySelector(".view").getBoundingClientRect();
  const size = [width, height].map((side) => Math.max(1, Math.round(side * devicePixelRatio)));
  // Setting a size, also the same one, makes new memory.
  if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
}

async function draw() {
  const module = fetched(document.getElementById("first-module").href);
  // Reported below.
  module.catch(() => {});
  const [model, ...more] = files();
  if (model === undefined) {
    // The page's head has requested it, and a browser warns of what is requested in vain. It is kept for the next visit.
    module.then((response) => response.arrayBuffer()).catch(() => {});
    return;
  }
  const arriving = Promise.all([model, ...more].map(fetchFile));
  arriving.catch(() => {});
  const canvas = document.getElementById("first");
  fit(canvas);
  // The browser's graphics start while the module arrives. The picture stays until the application's is there.
  const context = graphicsOf(canvas, { alpha: false, antialias: false, depth: true, stencil: false, preserveDrawingBuffer: true });
  if (context === null) return;
  await initialise({ module_or_path: module });
  const scene = new FirstScene();
  scene.begin(context, more.length > 0);
  // A browser hands commands to the driver when somebody waits for them.
  context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
  context.flush();
  for (const hand of await arriving) hand(scene);
  // The application was faster.
  if (!canvas.isConnected) return;
  fit(canvas);
  scene.draw(model.name);
  scene.free();
  frame.classList.add("lit");
  performance.mark("gonio-first-picture");
}

/** Removes the canvas, with its memory, once the application's picture has replaced it. */
function withdraw() {
  const canvas = document.getElementById("first");
  canvas.width = canvas.height = 1;
  canvas.remove();
}

/** Milliseconds that the first picture may take before the application is loaded beside it: its files may be on a slow way. */
const PATIENCE = 1000;
const after = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function run() {
  const drawn = draw().catch((error) => console.info("gonio draws its first picture later:", error));
  await Promise.race([drawn, after(PATIENCE)]);
  // A frame for the picture to appear in, before the application keeps the page busy.
  await new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); after(200).then(resolve); });
  let start;
  try {
    ({ start } = await import(new URL(document.getElementById("main").content, document.baseURI).href));
  } catch (error) {
    noModule(error);
    return;
  }
  await start(withdraw);
}

run();
