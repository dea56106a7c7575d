// What is said when the application cannot run.

import assert from "node:assert/strict";
import { poll, suite } from "./support/lab.mjs";

const { test } = suite();

/** Waits for the message in place of the application. */
const trouble = (lab) => poll(() => lab.trouble(), (text) => text !== null);

test("without WebGL 2 the page says what to do", async (lab) => {
  const text = await trouble(lab);
  assert.match(text, /no WebGL 2/);
  assert.match(text, /hardware acceleration/);
  assert.match(text, /gonio view/);
  assert.equal(await lab.page.locator("#trouble").getAttribute("role"), "alert");
}, {
  wait: false,
  prepare: (lab) => lab.page.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind === "webgl2" ? null : original.call(this, kind, ...rest);
    };
  }),
});

test("a module that is not there is said, and loading again helps", async (lab) => {
  lab.expect("404");
  const text = await trouble(lab);
  assert.match(text, /could not be loaded/);
  assert.match(await lab.page.locator("#trouble-details").textContent(), /404/);
  // Loading again would break off what is still on its way, and that is not what is tried here.
  await lab.page.waitForLoadState("networkidle");
  await lab.page.unroute("**/*.wasm");
  await lab.page.click("#trouble-reload");
  await lab.running();
}, {
  wait: false,
  prepare: (lab) => lab.page.route("**/*.wasm", (route) => route.fulfill({ status: 404, body: "gone" })),
});

test("a module that is cut off is said", async (lab) => {
  assert.match(await trouble(lab), /could not be loaded/);
}, {
  wait: false,
  prepare: (lab) => lab.page.route("**/*.wasm", (route) =>
    route.fulfill({ status: 200, contentType: "application/wasm", body: Buffer.from("\0asm\x01\0\0\0\x05") })),
});
