// Which functions of the module run until the first picture is shown: node profile.mjs PAGE MODULE OUT
//
// PAGE: a page that `pack.mjs` made. MODULE: its module as `gonio-web-split instrument` made it; it is served in the
// place of the page's own. OUT: a `1` for each function that ran in one of the visits below, in the order of the file, a
// `0` for each other. Without a Chromium nothing is written and one line says so.

import { createServer } from "node:http";
import { readFile, writeFile } from "node:fs/promises";
import { extname, join } from "node:path";
import { modelText } from "../bench/model.mjs";
import { found, launch } from "../tests/support/chromium.mjs";

const [page, module, out] = process.argv.slice(2);
if (out === undefined) {
  console.error("usage: node profile.mjs PAGE MODULE OUT");
  process.exit(2);
}
if (found() === undefined) {
  console.log("no Chromium: the page is not split, and its first visit loads all of it");
  process.exit(0);
}

/** Models that a link opens: small and large (more than 65536 vertices: large ones are worked on in pieces), with normals and without, of triangles and of more corners, with a texture's coordinates. */
const MODELS = {
  "ball.obj": modelText(300),
  "quads.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 2 3 4\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n",
  "triangles.obj": "# one\no thing\nv 0 0 0\nv 1 0 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\ns 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 2//1\n",
};

/** Who comes, for the first time and for the second. Links with scenes and to other kinds of models have the whole module loaded at once:
 * `main.js`. */
const VISITS = [
  { path: "?open=ball.obj", viewport: { width: 1280, height: 800 } },
  { path: "?open=quads.obj", viewport: { width: 1280, height: 800 } },
  { path: "?open=triangles.obj", viewport: { width: 1280, height: 800 } },
  { viewport: { width: 1280, height: 800 }, colorScheme: "light" },
  { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true, colorScheme: "dark" },
];
/** Milliseconds that the application runs on after its first picture: its panels find their sizes, and it falls still. */
const A_MOMENT = 1500;
/** Milliseconds after which a visit has failed. */
const PATIENCE = 180_000;

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm" };
const instrumented = await readFile(module);

const server = createServer(async (request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
  const name = path === "/" ? "index.html" : path.slice(1);
  const kind = extname(name);
  const bytes = kind === ".wasm" ? instrumented : MODELS[name] ?? await readFile(join(page, name)).catch(() => undefined);
  response.writeHead(bytes ? 200 : 404, { "content-type": TYPES[kind] ?? "application/octet-stream" }).end(bytes);
});

/** Keeps the module's exports where `whatRan` finds them. */
function keepExports() {
  for (const name of ["instantiate", "instantiateStreaming"]) {
    const original = WebAssembly[name];
    WebAssembly[name] = async (...rest) => {
      const result = await original.apply(WebAssembly, rest);
      window.profiled = (result.instance ?? result).exports;
      return result;
    };
  }
}

/** For each function, whether it ran. */
function whatRan() {
  const exports = window.profiled;
  return Array.from({ length: exports["ran:functions"].value }, (_, n) => (exports[`ran:${n >> 5}`].value >> (n & 31)) & 1);
}

/** What the page says in place of the application. */
function said() {
  const trouble = document.getElementById("trouble");
  return trouble === null || trouble.hidden ? null : trouble.innerText;
}

/** Visits the page twice, and gives what of `whatRan` ran in either. */
async function visit(browser, top, { path = "", ...options }) {
  const context = await browser.newContext({ ...options, serviceWorkers: "block" });
  const tab = await context.newPage();
  await tab.addInitScript(keepExports);
  await tab.goto(top + path, { waitUntil: "commit" });
  const first = await untilStill(tab, options);
  // Who comes again has settings that are read.
  await tab.reload({ waitUntil: "commit" });
  const second = await untilStill(tab, options);
  await context.close();
  return first.map((value, n) => value | second[n]);
}

/** Waits until the first picture is shown and nothing moves any more, and gives `whatRan`. */
async function untilStill(tab, options) {
  const end = Date.now() + PATIENCE;
  const shown = () => performance.getEntriesByName("gonio-first-picture").length > 0;
  while (!await tab.evaluate(shown)) {
    const trouble = await tab.evaluate(said);
    if (trouble !== null) throw new Error(`the page says: ${trouble}`);
    if (Date.now() > end) throw new Error(`no picture in ${PATIENCE / 1000} s`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  // A pointer that comes by; the picture and the panels answer.
  if (!options.isMobile) await tab.mouse.move(options.viewport.width / 2, options.viewport.height / 2, { steps: 5 });
  await new Promise((resolve) => setTimeout(resolve, A_MOMENT));
  return tab.evaluate(whatRan);
}

await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const top = `http://127.0.0.1:${server.address().port}/`;
const browser = await launch();
let union = [];
try {
  for (const options of VISITS) {
    const ran = await visit(browser, top, options);
    union = ran.map((value, n) => value | (union[n] ?? 0));
    const { path = "", viewport: { width, height } } = options;
    const sum = (flags) => flags.filter(Boolean).length;
    console.log(`${width}x${height} ${path}: ${sum(ran)} of ${ran.length} functions ran; in all visits so far: ${sum(union)}`);
  }
} finally {
  await browser.close();
  server.close();
}
await writeFile(out, union.join(""));
