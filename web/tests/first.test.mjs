// The first picture (web/page/first.js): a small module draws it before the application is asked for, and it is the application's.

import assert from "node:assert/strict";
import { poll, settled, suite } from "./support/lab.mjs";
import { crop, decode, differing } from "./support/png.mjs";

const { test } = suite();

/** Holds the application back until `lab.release()` is called. */
const held = async (lab) => {
  const gate = new Promise((resolve) => { lab.release = resolve; });
  await lab.page.route("**/main.*.js", async (route) => { await gate; await route.continue(); });
};
const isLit = (lab) => lab.page.evaluate(() => document.getElementById("frame").classList.contains("lit"));
/** Where the first picture is: left, top, width, height. */
const place = (lab) => lab.page.evaluate(() => {
  const { left, top, width, height } = document.getElementById("first").getBoundingClientRect();
  return [left, top, width, height].map(Math.round);
});

test("the first picture is there before the application, and is its picture", async (lab) => {
  await poll(() => isLit(lab), Boolean);
  const [left, top, width, height] = await place(lab);
  const first = decode(await lab.page.screenshot());
  assert.equal(await lab.page.evaluate(() => window.gonio), undefined);
  lab.release();
  await lab.running();
  await lab.until(settled);
  await lab.page.locator("#frame").waitFor({ state: "hidden" });
  const then = decode(await lab.page.screenshot());
  // The middle, where no control of the application is.
  const middle = [left + Math.round(0.3 * width), top + Math.round(0.3 * height), Math.round(0.4 * width), Math.round(0.4 * height)];
  // A driver that is a program draws one sample per pixel first: edges differ.
  const share = differing(crop(first, ...middle), crop(then, ...middle), 8);
  assert.ok(share < 0.03, `${(100 * share).toFixed(1)} % of pixels differ`);
  await poll(() => lab.page.evaluate(() => document.getElementById("first")), (canvas) => canvas === null);
}, { wait: false, prepare: held });

test("a model in the address has a first picture too", async (lab) => {
  await poll(() => isLit(lab), Boolean);
  lab.release();
  await lab.running();
  assert.match((await lab.until(settled)).title, /cube/);
}, {
  wait: false,
  path: "?open=cube.obj",
  prepare: async (lab) => {
    await lab.page.route("**/cube.obj", (route) => route.fulfill({
      contentType: "text/plain",
      body: "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n",
    }));
    await held(lab);
  },
});

test("a small module that does not come leaves the picture to the application", async (lab) => {
  await lab.running();
  assert.equal(await isLit(lab), false);
  assert.equal((await lab.until(settled)).title, "still-life");
  assert.equal(await lab.trouble(), null);
  lab.wrong = lab.wrong.filter((text) => !/gonio-first|ERR_FAILED/.test(text));
}, {
  wait: false,
  prepare: (lab) => lab.page.route("**/gonio-first.*.wasm", (route) => route.abort()),
});
