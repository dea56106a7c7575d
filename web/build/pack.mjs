// Puts the page together: node pack.mjs MODULE_FOLDER DIST
//
// MODULE_FOLDER holds gonio.js and gonio_bg.wasm as wasm-bindgen and wasm-opt left them, and the same of gonio_first, which draws
// the first picture, of gonio_check, the checker, and of gonio_trace, the path tracer. DIST becomes the page: names with their
// content's hash, brotli and gzip beside each file, a service worker that knows them all. Prints one JSON object, the sizes;
// `cargo xtask web` runs this and makes a table of them.

import { createHash } from "node:crypto";
import { mkdir, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { dirname, extname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { brotliCompress, constants, gzip } from "node:zlib";
import { build, transform } from "esbuild";
import { stored } from "./chunks.mjs";

const [moduleFolder, dist] = process.argv.slice(2);
if (dist === undefined) {
  console.error("usage: node pack.mjs MODULE_FOLDER DIST");
  process.exit(2);
}
const repository = join(dirname(fileURLToPath(import.meta.url)), "../..");
const page = join(repository, "web/page");
/** What browsers with WebGL 2 and WebAssembly's SIMD understand (Safari 16.4, Chrome 91, Firefox 89). */
const TARGET = ["es2022"];

/** Every file of the page: its name in DIST, its bytes, and what waits for it: the `first` picture, the application's `start`, or
 * neither (`later`). */
const files = [];

/** Adds a file under a name that changes with its content, and gives that name. */
function addHashed(name, bytes, when) {
  // Each digit costs the page's first request half a byte for each file, and only versions of one file must differ.
  const hash = createHash("sha256").update(bytes).digest("hex").slice(0, 8);
  const end = extname(name);
  const hashed = `${name.slice(0, -end.length)}.${hash}${end}`;
  files.push({ name: hashed, bytes: Buffer.from(bytes), when });
  return hashed;
}

/** Adds a file under this very name: what is asked for by name from outside. */
function addNamed(name, text, when) {
  files.push({ name, bytes: Buffer.from(text), when });
}

/** Replaces each `from`, which must be there: a page that lost one would ask for a file that is not. */
function replaceAll(text, pairs) {
  for (const [from, to] of pairs) {
    if (!text.includes(from)) throw new Error(`pack.mjs: ${from} is not in the page`);
    text = text.replaceAll(from, to);
  }
  return text;
}

/** What wasm-bindgen's JavaScript keeps for itself, and `main.js` needs to pass the compiled module to a worker. */
const INNER = "\nexport { __wbg_get_imports as moduleImports, __wbg_finalize_init as moduleReady };\n";

/** A script of the page, what it imports, and wasm-bindgen's JavaScript, as one module. */
async function bundled(name) {
  const bundle = await build({
    entryPoints: [join(page, name)],
    bundle: true,
    minify: true,
    write: false,
    format: "esm",
    charset: "utf8",
    target: TARGET,
    legalComments: "none",
    plugins: [{
      name: "wasm-bindgen",
      setup: ({ onResolve, onLoad }) => {
        const place = ({ path }) => ({ path: join(moduleFolder, path), namespace: "wasm-bindgen" });
        onResolve({ filter: /^\.\/gonio(_first|_check|_trace)?\.js$/ }, place);
        onLoad({ filter: /.*/, namespace: "wasm-bindgen" }, async ({ path }) => ({ contents: await readFile(path, "utf8") + INNER }));
      },
    }],
  });
  return bundle.outputFiles[0].contents;
}

const read = (name) => readFile(join(page, name), "utf8");
const withoutComments = (html) => html.replaceAll(/<!--.*?-->\s*/gs, "").replaceAll(/\n\s+/g, "\n");

/** The files of the scene that is shown first (`FIRST_SCENE` in gonio-app): the page asks for them at once. */
const FIRST = ["models/still_life.obj", "models/still_life.mtl", "models/textures/checker.png", "models/textures/planks.png"];

/** The files built into gonio, which the module for the web does not carry: the list stands in gonio-scene. */
async function builtinFiles() {
  const source = await readFile(join(repository, "crates/gonio-scene/src/files/builtin.rs"), "utf8");
  const list = /builtin_files!\[(.*?)\];/s.exec(source)?.[1] ?? "";
  const names = [...list.matchAll(/"([^"]+)"/g)].map(([, name]) => name);
  for (const name of FIRST) if (!names.includes(name)) throw new Error(`pack.mjs: ${name} is not built into gonio`);
  return names;
}

let builtin = "";
/** The one built-in environment that is a file (`ROOM_FILE` in gonio-environment). */
const ROOM = "environments/room.hdr";

for (const name of [...await builtinFiles(), ROOM]) {
  const first = FIRST.includes(name);
  const bytes = await readFile(join(repository, "assets", name));
  const sample = extname(name) === ".png" ? stored(bytes) : bytes;
  const url = addHashed(`samples/${name.replaceAll("/", "-")}`, sample, first ? "first" : "later");
  builtin += first
    ? `<link rel="preload" as="fetch" crossorigin href="${url}" data-builtin="${name}" data-when="first">`
    : `<meta name="sample" content="${url}" data-builtin="${name}" data-when="later">`;
}

const icon = addHashed("icon.svg", await read("icon.svg"), "later");
const manifest = addHashed(
  "gonio.webmanifest",
  JSON.stringify(JSON.parse(replaceAll(await read("gonio.webmanifest"), [["icon.svg", icon]]))),
  "later",
);
const css = addHashed(
  "page.css",
  (await transform(await read("page.css"), { loader: "css", minify: true })).code,
  "first",
);
const firstModule = addHashed("gonio-first.wasm", await readFile(join(moduleFolder, "gonio_first_bg.wasm")), "first");
const firstScript = addHashed("first.js", await bundled("first.js"), "first");
const module = addHashed("gonio.wasm", await readFile(join(moduleFolder, "gonio_bg.wasm")), "start");
const main = addHashed("main.js", await bundled("main.js"), "start");
/** What checks students' files, in a thread and a module of its own. */
const checker = addHashed("checker.js", await bundled("checker.js"), "later");
const checkModule = addHashed("gonio-check.wasm", await readFile(join(moduleFolder, "gonio_check_bg.wasm")), "later");

/** What screen readers read, for those who ask for it. */
const access = addHashed("access.js", await bundled("access.js"), "later");

/** What traces pictures, in a thread and a module of its own. */
const tracer = addHashed("tracer.js", await bundled("tracer.js"), "later");
const traceModule = addHashed("gonio-trace.wasm", await readFile(join(moduleFolder, "gonio_trace_bg.wasm")), "later");

const index = replaceAll(withoutComments(await read("index.html")), [
  ['<meta name="builtin-files">', builtin],
  ['"gonio-first.wasm"', `"${firstModule}"`],
  ['"first.js"', `"${firstScript}"`],
  ['"gonio.wasm"', `"${module}"`],
  ['"checker.js"', `"${checker}"`],
  ['"gonio-check.wasm"', `"${checkModule}"`],
  ['"access.js"', `"${access}"`],
  ['"tracer.js"', `"${tracer}"`],
  ['"gonio-trace.wasm"', `"${traceModule}"`],
  ['"page.css"', `"${css}"`],
  ['"main.js"', `"${main}"`],
  ['"icon.svg"', `"${icon}"`],
  ['"gonio.webmanifest"', `"${manifest}"`],
]);
addNamed("index.html", index, "first");

// The page itself is kept under the name by which it is asked for.
const kept = files.map(({ name }) => (name === "index.html" ? "./" : name));
const version = createHash("sha256").update(files.map(({ name }) => name).join()).update(index).digest("hex").slice(0, 16);
const worker = replaceAll(await read("worker.js"), [
  ["%VERSION%", version],
  ['["%FILES%"]', JSON.stringify(kept)],
]);
addNamed("worker.js", (await transform(worker, { minify: true, target: TARGET })).code, "later");

// ---- write ----

await rm(dist, { recursive: true, force: true });
const sizes = [];
// The page's own file last: with it, the page is whole.
files.sort((a, b) => (a.name === "index.html") - (b.name === "index.html"));
/** Every file's bytes, compressed for the server; with the threads of Node's pool, for brotli takes seconds for a module. */
const compressed = await Promise.all(files.map(({ bytes }) => Promise.all([
  promisify(brotliCompress)(bytes, {
    params: {
      [constants.BROTLI_PARAM_QUALITY]: 11,
      [constants.BROTLI_PARAM_LGWIN]: 24,
      [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length,
    },
  }),
  promisify(gzip)(bytes, { level: 9 }),
])));
for (const [index, { name, bytes, when }] of files.entries()) {
  const path = join(dist, name);
  await mkdir(dirname(path), { recursive: true });
  const [byBrotli, byGzip] = compressed[index];
  if (byBrotli.length < bytes.length) await writeFile(`${path}.br`, byBrotli);
  if (byGzip.length < bytes.length) await writeFile(`${path}.gz`, byGzip);
  await writeFile(path, bytes);
  const least = (result) => Math.min(result.length, bytes.length);
  sizes.push({ name, bytes: bytes.length, gzip: least(byGzip), brotli: least(byBrotli), when });
}

// A file that is there and not meant to be would be served, and embedded.
const meant = new Set(files.flatMap(({ name }) => [name, `${name}.br`, `${name}.gz`]));
for (const entry of await readdir(dist, { recursive: true, withFileTypes: true })) {
  const name = relative(dist, join(entry.parentPath ?? entry.path, entry.name)).replaceAll("\\", "/");
  if (entry.isFile() && !meant.has(name)) throw new Error(`pack.mjs: ${name} is not part of the page`);
}

console.log(JSON.stringify({ version, files: sizes }));
