// The page against a page of three.js: the time to the first lit frame, and memory then. `cargo xtask bench web`.
//
// Both are served by the same server, uncompressed; each visit has a browser profile of its own, so that nothing is
// kept; visits alternate. A frame counts once a pixel of it could be read back: the graphics are done with it then. On a
// driver that is a program, gonio's first frame has one sample a pixel, three.js's has four: when gonio's picture has all
// of its samples is said too.

import { createServer } from "node:http";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { launch } from "../tests/support/chromium.mjs";
import { writeModel } from "./model.mjs";

const VISITS = Number(process.argv[2] ?? 5);
const here = fileURLToPath(new URL(".", import.meta.url));
const dist = join(here, "../../dist");
const folder = await mkdtemp(join(tmpdir(), "gonio-bench-"));

await build({
  entryPoints: [join(here, "three.mjs")], bundle: true, minify: true, format: "esm", target: ["es2022"], outfile: join(folder, "three.js"),
});
await writeFile(join(folder, "three.html"), '<!doctype html><meta charset="utf-8"><body style="margin:0"><script type="module" src="three.js"></script>');

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const server = createServer(async (request, response) => {
  const path = new URL(request.url, "http://localhost").pathname;
  const name = path === "/" ? "index.html" : path.slice(1);
  for (const place of [dist, folder]) {
    try {
      const bytes = await readFile(join(place, name));
      response.writeHead(200, { "content-type": TYPES[extname(name)] ?? "application/octet-stream", "content-length": bytes.length });
      response.end(bytes);
      return;
    } catch {
      // Not in this folder.
    }
  }
  response.writeHead(404).end();
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const top = `http://127.0.0.1:${server.address().port}`;

const browser = await launch(["--js-flags=--expose-gc", "--enable-precise-memory-info"]);

/** One visit: milliseconds from the start of the navigation to the first picture, and bytes of memory then. */
async function visit(url, mark) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, serviceWorkers: "block" });
  const page = await context.newPage();
  await page.addInitScript((mark) => {
    // A memory may be exported under several names.
    const memories = new Set();
    const Memory = WebAssembly.instantiateStreaming;
    const noted = (result) => {
      for (const item of Object.values(result.instance.exports)) if (item instanceof WebAssembly.Memory) memories.add(item);
      return result;
    };
    WebAssembly.instantiateStreaming = (...given) => Memory.apply(WebAssembly, given).then(noted);
    // As soon as the frame was handed over. Not in the next frame: the page may draw its second picture there.
    new PerformanceObserver((list) => {
      if (window.presented !== undefined || list.getEntriesByName(mark).length === 0) return;
      // The context that drew it: asking again gives the same.
      const gl = (document.getElementById("first") ?? document.querySelector("canvas")).getContext("webgl2");
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      window.presented = performance.now();
      window.wasmBytes = [...memories].reduce((sum, memory) => sum + memory.buffer.byteLength, 0);
    }).observe({ entryTypes: ["mark"] });
  }, mark);
  await page.goto(url, { waitUntil: "commit" });
  for (;;) {
    const presented = await page.evaluate(() => window.presented);
    if (presented !== undefined) break;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  // Of gonio: since when its picture has all samples. Asked for from outside, so it is known to a tenth of a second.
  let whole;
  while (whole === undefined) {
    const now = await page.evaluate(() => document.getElementById("lab") === null || (document.body.classList.contains("running") && window.gonio.state().frame.complete) ? performance.now() : undefined);
    if (now !== undefined) whole = now;
    else await new Promise((resolve) => setTimeout(resolve, 50));
  }
  const session = await context.newCDPSession(page);
  const heap = async () => {
    const { usedSize, backingStorageSize = 0 } = await session.send("Runtime.getHeapUsage");
    return { script: usedSize, buffers: backingStorageSize };
  };
  const then = await heap();
  await session.send("HeapProfiler.collectGarbage");
  const after = await heap();
  const [time, wasm] = await page.evaluate(() => [window.presented, window.wasmBytes]);
  await context.close();
  return { time, whole, wasm, then, after };
}

const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const mega = (bytes) => (bytes / 1e6).toFixed(1).padStart(8);

for (const [steps, mostTime, mostHeap] of [[50, 1.0, null], [500, 0.5, 0.4]]) {
  const triangles = await writeModel(join(folder, `ball-${steps}.obj`), steps);
  const visits = { gonio: [], three: [] };
  for (let index = 0; index < VISITS; index++) {
    visits.three.push(await visit(`${top}/three.html?open=ball-${steps}.obj`, "three-first-picture"));
    visits.gonio.push(await visit(`${top}/?open=ball-${steps}.obj`, "gonio-first-picture"));
  }
  console.log(`\n${triangles.toLocaleString("en")} triangles, OBJ, median of ${VISITS} visits each, in turn`);
  console.log("                 first frame   script  buffers     wasm    total   total after collection (MB)");
  const rows = {};
  for (const [name, all] of Object.entries(visits)) {
    const of = (pick) => median(all.map(pick));
    // A browser may or may not count WebAssembly's memory among the buffers: once is enough.
    const total = (heap, wasm) => heap.script + Math.max(heap.buffers, wasm);
    rows[name] = { time: of((v) => v.time), total: of((v) => total(v.then, v.wasm)) };
    console.log(
      `${name.padEnd(14)} ${rows[name].time.toFixed(0).padStart(10)} ms ${mega(of((v) => v.then.script))} ${mega(of((v) => v.then.buffers))}`
      + ` ${mega(of((v) => v.wasm))} ${mega(rows[name].total)} ${mega(of((v) => total(v.after, v.wasm)))}`,
    );
  }
  console.log(`gonio with all samples after ${median(visits.gonio.map((v) => v.whole)).toFixed(0)} ms`);
  const bar = (most) => (most === null ? "" : ` (at most ${most})`);
  console.log(`gonio/three    time ${(rows.gonio.time / rows.three.time).toFixed(2)}x${bar(mostTime)}, memory ${(rows.gonio.total / rows.three.total).toFixed(2)}x${bar(mostHeap)}`);
}

await browser.close();
server.closeAllConnections();
server.close();
await rm(folder, { recursive: true });
