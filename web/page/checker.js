// Checks students' files in a worker with the page's module and an OpenGL context of its own, so that a shader cannot block
// the page and is stopped with the worker. `checking.js` starts it.

import * as application from "./gonio.js";

let checker;

/** Instantiates the module that the page has compiled, with both halves. */
function begin({ first, rest, images }) {
  const load = () => {};
  const instance = new WebAssembly.Instance(first, Object.assign(application.moduleImports(), { rest: { load } }));
  if (rest !== undefined) new WebAssembly.Instance(rest, { primary: instance.exports });
  application.moduleReady(instance, first);
  checker = new application.PageChecker(new OffscreenCanvas(1, 1));
  for (const { name, bytes } of images) checker.give_image(name, bytes);
}

function check({ exercise, files, asTheLab }) {
  return checker.check(exercise, files.map(({ name }) => name), files.map(({ bytes }) => bytes), asTheLab);
}

/** The requests. An error is one sentence. */
const DO = { begin, check };

self.onmessage = ({ data: { what, ...asked } }) => {
  try {
    self.postMessage({ answer: DO[what](asked) });
  } catch (error) {
    self.postMessage({ failed: typeof error === "string" ? error : String(error) });
  }
};
