// Traces pictures in a worker, in a module of its own (`gonio-web-trace`). `tracing.js` starts it. The work is cut into slices, and
// between two of them a newer request is taken. A worker that gets a scene to bake does only that, in one piece; one for stations
// computes only those (`stations.js`).

import * as module from "./gonio_trace.js";
import { openStations, requestStation } from "./stations.js";

/** Milliseconds of one slice. */
const SLICE = 25;
/** Milliseconds between two pictures of one stage, some time after the request: see `picture_interval` in gonio-app. */
const interval = (since) => Math.min(Math.max(0.2 * since, 150), 1000);

let tracer;
/** A promise of the tracer while it is loaded. */
let coming;
/** The newest request, until work on it begins. */
let wanted;
/** The request whose picture is refined. */
let begun;
/** The probed pixel, column and row, or undefined. */
let pixel;
let working = false;
/** A promise that the module is loaded ahead of need. */
let prepared = Promise.resolve();

/** Lets messages arrive; a timer would wait for milliseconds. */
const channel = new MessageChannel();
const turn = () => new Promise((resolve) => {
  channel.port1.onmessage = resolve;
  channel.port2.postMessage(null);
});

async function load(url) {
  const response = await fetch(url, { credentials: "same-origin" });
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  const imports = module.moduleImports();
  // Compiled while it arrives, if the server names its type.
  const { instance, module: compiled } = await (response.headers.get("content-type") === "application/wasm"
    ? WebAssembly.instantiateStreaming(response, imports)
    : WebAssembly.instantiate(await response.arrayBuffer(), imports));
  module.moduleReady(instance, compiled);
  return new module.PageTracer();
}

/** Loads the tracer, once. If that fails, the next call tries again. */
async function loaded(url) {
  coming ??= load(url);
  try {
    const first = await coming;
    tracer ??= first;
  } catch (error) {
    coming = undefined;
    throw error;
  }
}

/** Fetches a built-in file; whether it has arrived. One that has not is reported by the scene's reader. */
async function give(name, builtin) {
  const response = await fetch(builtin[name], { credentials: "same-origin" }).catch(() => undefined);
  tracer.give(name, response?.ok ? new Uint8Array(await response.arrayBuffer()) : undefined);
  return response?.ok === true;
}

/** Reads the request's scene with all files that it needs; whether all built-in ones have arrived. */
async function open({ text, files, time, simplified, points, goal, builtin }) {
  return read(files, builtin, () => tracer.open(text, time, simplified, points, goal));
}

/** Gives the tracer what `attempt` says is missing, until nothing is. */
async function read(files, builtin, attempt) {
  for (const { name, bytes } of files) tracer.give_opened(name, bytes);
  for (let whole = true;;) {
    const missing = attempt();
    if (missing.length === 0) return whole;
    const arrived = await Promise.all(missing.map((name) => give(name, builtin)));
    whole &&= arrived.every(Boolean);
  }
}

/** The sample that the page opens first, with textures. */
const REHEARSAL = `
[[object]]
model = "builtin:still-life"
`;

/** Traces a small picture that nobody sees, because browsers compile a function when it is first called. */
async function rehearse(builtin) {
  const whole = await open({ text: REHEARSAL, files: [], time: 0, simplified: 0, points: 1, goal: 0.1, builtin });
  tracer.look([0, 1, 4, 0, 0, -1, 0, 1, 0, 0.7, 0.1, 100], 16, 16);
  for (let i = 0; i < 3 && wanted === undefined; i++) tracer.advance(16);
  tracer.probe(8, 8);
  tracer.picture();
  // A request asks again for a file that has not arrived.
  if (!whole) tracer = new module.PageTracer();
}

/** Loads the tracer before a pane needs it. Requests wait, and report what goes wrong. */
async function prepare({ load: url, builtin }) {
  working = true;
  const ready = await loaded(url).then(() => rehearse(builtin)).then(() => true, () => false);
  self.postMessage({ loaded: ready });
  working = false;
  if (wanted !== undefined) work();
}

/** Loads what the request needs, and begins its picture. */
async function begin({ url, scene, camera, width, height }) {
  await loaded(url);
  if (scene !== undefined) await open(scene);
  if (!tracer.look(camera, width, height)) throw new Error("there is no scene to trace");
}

/** Refines the picture and the light of the probed pixel, until both are finished or there is another request. The first stage is
 * always completed: otherwise nothing would be seen while something is dragged. */
async function refine({ number, width, height }) {
  const begin = performance.now();
  let [rows, sent] = [4, begin];
  let was = tracer.facts()[3] === 1;
  let covered = was;
  while (wanted === undefined || !covered) {
    const start = performance.now();
    tracer.advance(rows);
    const end = performance.now();
    rows = Math.max(1, Math.min(4096, Math.floor((rows * SLICE) / Math.max(end - start, 0.1))));
    const [paths, error, pass, is] = tracer.facts();
    const done = is === 1;
    covered ||= pass === 0 && paths > 0;
    const facts = { number, width, height, paths, error, pass, done };
    if (!was && covered && ((pass === 0 && paths <= 2) || done || end - sent >= interval(end - begin))) {
      const pixels = tracer.picture();
      sent = performance.now();
      self.postMessage({ ...facts, pixels }, [pixels.buffer]);
    }
    const light = pixel === undefined ? [] : tracer.probe(...pixel);
    if (light.length > 0) self.postMessage({ ...facts, light });
    if (done && light.length === 0) return;
    was = done;
    await turn();
  }
}

async function work() {
  working = true;
  do {
    const request = wanted;
    wanted = undefined;
    try {
      if (request !== undefined) {
        begun = undefined;
        await begin(request);
        begun = request;
      }
      if (begun !== undefined) await refine(begun);
    } catch (error) {
      const { number } = request ?? begun;
      self.postMessage({ number, failed: typeof error === "string" ? error : String(error?.message ?? error) });
      begun = undefined;
    }
  } while (wanted !== undefined);
  working = false;
}

/** Milliseconds between two messages about the progress of a bake. */
const PROGRESS_INTERVAL = 60;

/** Bakes a scene, and posts its progress and its result, or one sentence on why there is none. */
async function bake({ url, job, stem, scene: { text, files, time, builtin } }) {
  try {
    await prepared;
    await loaded(url);
    await read(files, builtin, () => tracer.open_to_bake(text, time));
    let sent = -Infinity;
    const baked = tracer.bake(job, stem, (step, share) => {
      const now = performance.now();
      if (now - sent < PROGRESS_INTERVAL) return;
      sent = now;
      self.postMessage({ step, share });
    });
    const arrays = [baked, baked.layout, ...baked.pictures, ...baked.files].flatMap(Object.values).filter(ArrayBuffer.isView);
    self.postMessage({ baked }, arrays.map(({ buffer }) => buffer));
  } catch (error) {
    self.postMessage({ failed: typeof error === "string" ? error : `the textures could not be baked: ${error?.message ?? error}` });
  }
}

self.onmessage = ({ data }) => {
  if (data.job !== undefined) {
    bake(data);
    return;
  }
  if (data.stations !== undefined) {
    openStations(prepared.then(() => loaded(data.url)), turn);
    return;
  }
  if (data.station !== undefined) {
    requestStation(data.station);
    return;
  }
  if (data.load !== undefined) {
    prepared = prepare(data);
    return;
  }
  pixel = data.pixel;
  // Without a camera it is another pixel of the same picture. A request without a scene is for the one before, which may
  // be waiting itself.
  if (data.camera !== undefined) wanted = { ...data, scene: data.scene ?? wanted?.scene };
  if (!working) work();
};
