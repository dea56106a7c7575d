// What everybody sees first.

import assert from "node:assert/strict";
import { colors } from "./support/png.mjs";
import { test as plain } from "node:test";
import { launch } from "./support/chromium.mjs";
import { kept, Lab, PATIENCE, suite } from "./support/lab.mjs";

const shared = suite();
const { test } = shared;

test("the page opens, and nothing is amiss", async (lab) => {
  assert.equal(await lab.page.title(), "gonio, the light lab");
  assert.ok(colors(await lab.picture()) > 10, "the window is empty");
});

test("everything it asked for came from its own server, compressed, under a strict policy", async (lab) => {
  // The first visit whole: the files of the other samples too, which it asks for before it keeps itself.
  await kept(lab);
  // Scripts and modules are those of the first picture, the application's and the path tracer's. The first scene is read twice, by
  // the first two.
  const once = [...new Set(lab.asked.map((response) => new URL(response.url()).pathname))];
  const of = (kind) => once.filter((path) => path.endsWith(kind)).length;
  assert.deepEqual([of("/"), of(".css"), of(".js"), of(".wasm")], [1, 1, 3, 3], once.join(" "));
  assert.ok(of(".obj") >= 5 && of(".hdr") >= 1, "the samples");
  for (const response of lab.asked) {
    const headers = response.headers();
    const from = response.fromServiceWorker() ? "the service worker" : "the server";
    const seen = `${response.url()} from ${from}: ${response.status()} ${JSON.stringify(headers)}`;
    assert.ok(response.url().startsWith(lab.url), seen);
    assert.equal(response.status(), 200, seen);
    assert.match(headers["content-security-policy"] ?? "", /default-src 'none'/, seen);
    if (/\.(js|css|wasm|obj|hdr)$/.test(response.url())) {
      assert.equal(headers["content-encoding"], "br", seen);
      assert.match(headers["cache-control"] ?? "", /immutable/, seen);
    }
  }
}, {
  prepare: (lab) => {
    lab.asked = [];
    lab.page.on("response", (response) => lab.asked.push(response));
  },
});

test("the canvas fills a phone's screen", async (lab) => {
  const rectangle = await lab.page.evaluate(() => {
    const { left, top, width, height } = document.getElementById("lab").getBoundingClientRect();
    return [left, top, width, height];
  });
  assert.deepEqual(rectangle, [0, 0, 390, 844]);
  // Nothing of the page can be scrolled away.
  assert.deepEqual(await lab.page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]), [390, 844]);
}, { viewport: { width: 390, height: 844 } });

plain("the canvas has the screen's own pixels where a point is two of them", { timeout: 3 * PATIENCE }, async () => {
  // Not by Playwright's scale factor, which leaves the size in device pixels as it was.
  const browser = await launch(["--force-device-scale-factor=2"]);
  try {
    const lab = await Lab.open({ browser, server: shared.server }, { viewport: null });
    const [ratio, pixels, points] = await lab.page.evaluate(() => {
      const canvas = document.getElementById("lab");
      return [devicePixelRatio, [canvas.width, canvas.height], [canvas.clientWidth, canvas.clientHeight]];
    });
    assert.equal(ratio, 2);
    assert.deepEqual(pixels, points.map((value) => 2 * value));
    lab.assertNothingWrong();
  } finally {
    await browser.close();
  }
});

test("the page says in words what it is", async (lab) => {
  const canvas = lab.page.locator("#lab");
  assert.match(await canvas.getAttribute("aria-label"), /light/);
  const described = await lab.page.locator(`#${await canvas.getAttribute("aria-describedby")}`).textContent();
  assert.match(described, /light equation/);
  assert.equal(await lab.page.locator("#announcement").getAttribute("aria-live"), "polite");
});

test("the frame shown while loading is that of the window, and goes", async (lab) => {
  // Before the module is there: the frame fills the window, and a line says what is going on.
  const shown = await lab.page.evaluate(() => document.getElementById("frame").getBoundingClientRect().toJSON());
  assert.deepEqual([shown.width, shown.height], [1280, 800]);
  assert.match(await lab.page.locator("#progress").textContent(), /Loading/);
  lab.release();
  await lab.running();
  await lab.page.locator("#frame").waitFor({ state: "hidden" });
  assert.equal(await lab.page.locator("#progress").isVisible(), false);
}, {
  wait: false,
  prepare: async (lab) => {
    const gate = new Promise((resolve) => { lab.release = resolve; });
    await lab.page.route("**/*.wasm", async (route) => { await gate; await route.continue(); });
  },
});
