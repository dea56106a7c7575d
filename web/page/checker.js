// Checks students' files in a worker with a module of its own (`gonio-web-check`) and an OpenGL context of its own, so that a shader
// cannot block the page and is stopped with the worker. `checking.js` starts it.

import * as bindings from "./gonio_check.js";

let checker;

/** Instantiates the module that the page has compiled. */
function begin({ module }) {
  bindings.moduleReady(new WebAssembly.Instance(module, bindings.moduleImports()), module);
  checker = new bindings.PageChecker(new OffscreenCanvas(1, 1));
}

const given = new Set();

/** The built-in files that a check of an exercise reads and that were not given yet. */
function needs({ exercise }) {
  return checker.needed_files(exercise).filter((path) => !given.has(path));
}

function check({ exercise, files, builtin, asTheLab, language }) {
  for (const { path, bytes } of builtin) {
    checker.give_file(path, bytes);
    given.add(path);
  }
  return checker.check(exercise, files.map(({ name }) => name), files.map(({ bytes }) => bytes), asTheLab, language);
}

/** The requests. An error is one sentence. */
const DO = { begin, needs, check };

self.onmessage = ({ data: { what, ...asked } }) => {
  try {
    self.postMessage({ answer: DO[what](asked) });
  } catch (error) {
    self.postMessage({ failed: typeof error === "string" ? error : String(error) });
  }
};
