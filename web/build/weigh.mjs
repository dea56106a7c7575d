// Where the bytes of a module go: node web/build/weigh.mjs MODULE.wasm [CRATE]
//
// MODULE: with its names, as wasm-bindgen leaves it (target/web-page/gonio_bg.unoptimised.wasm, or gonio_first_bg). Prints the
// code's bytes by crate, then the largest functions, of one crate if it is named. A generic function counts for the crate it stands
// in, not for the one that made it.

import { readFileSync } from "node:fs";

const [file, wanted] = process.argv.slice(2);
const bytes = readFileSync(file);
let at = 8;

/** An unsigned number of variable length (LEB128). */
function number() {
  let value = 0, shift = 0, byte;
  do {
    byte = bytes[at++];
    value += (byte & 0x7f) * 2 ** shift;
    shift += 7;
  } while (byte & 0x80);
  return value;
}

function text() {
  const length = number();
  at += length;
  return bytes.toString("utf8", at - length, at);
}

const sections = {};
const names = new Map();
const sizes = [];
let imported = 0;

while (at < bytes.length) {
  const id = bytes[at++];
  const length = number();
  const end = at + length;
  const label = id === 0 ? text() : { 1: "types", 2: "imports", 3: "functions", 9: "elements", 10: "code", 11: "data" }[id] ?? `section ${id}`;
  sections[label] = (sections[label] ?? 0) + length;
  if (id === 2) imported = functionsImported();
  if (id === 10) {
    for (let count = number(); count > 0; count--) {
      const size = number();
      sizes.push(size);
      at += size;
    }
  }
  if (id === 0 && label === "name") {
    while (at < end) {
      const kind = bytes[at++];
      const stop = number() + at;
      if (kind === 1) for (let count = number(); count > 0; count--) names.set(number(), text());
      at = stop;
    }
  }
  at = end;
}

function functionsImported() {
  let functions = 0;
  for (let count = number(); count > 0; count--) {
    text();
    text();
    const kind = bytes[at++];
    if (kind === 0) {
      functions++;
      number();
    } else if (kind === 1) {
      at++;
      limits();
    } else if (kind === 2) {
      limits();
    } else {
      at += 2;
    }
  }
  return functions;
}

function limits() {
  const flags = bytes[at++];
  number();
  if (flags & 1) number();
}

/** `<alloc::vec::Vec<T> as Drop>::drop` counts for `alloc`. */
function crateOf(name) {
  const start = name.replace(/^[<&*( ]*(?:(?:mut|dyn|const) )*/, "");
  return /^([A-Za-z_]\w*)(?:\[[0-9a-f]+\])?::/.exec(start)?.[1] ?? "(other)";
}

const functions = sizes.map((size, index) => ({ size, name: names.get(index + imported) ?? "(no name)" }));
const crates = new Map();
for (const { size, name } of functions) crates.set(crateOf(name), (crates.get(crateOf(name)) ?? 0) + size);

const print = (rows) => rows.forEach(([name, size]) => console.log(String(size).padStart(10), name.slice(0, 150)));
print(Object.entries(sections).sort((a, b) => b[1] - a[1]).slice(0, 6));
console.log("\nby crate");
print([...crates].sort((a, b) => b[1] - a[1]).slice(0, 40));
console.log("\nlargest functions");
print(functions.filter(({ name }) => !wanted || crateOf(name) === wanted).sort((a, b) => b.size - a.size).slice(0, 50).map(({ name, size }) => [name, size]));
