// The module's second half (web/page/rest.js): it comes after the first picture, and when it is needed at the latest.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { poll, suite } from "./support/lab.mjs";

const { test } = suite();
const REST = "**/gonio-rest.*.wasm";

// A page that is built for working on it (`cargo xtask web --dev`) is in one piece.
const split = readFileSync(new URL("../../dist/index.html", import.meta.url), "utf8").includes('id="rest"');

if (split) {
  test("the second half is asked for after the first picture", async (lab) => {
    const [picture, asked, bytes] = await poll(() => lab.page.evaluate(() => {
      const rest = performance.getEntriesByType("resource").find(({ name }) => name.includes("gonio-rest"));
      return [performance.getEntriesByName("gonio-first-picture")[0]?.startTime, rest?.startTime, rest?.encodedBodySize];
    }), ([, , bytes]) => bytes > 0);
    assert.ok(asked >= picture, `the picture came at ${picture} ms, and the second half was asked for at ${asked} ms`);
    assert.ok(bytes > 100_000, `${bytes} bytes are not half of it`);
  });

  test("what is needed before the second half came is there at once", async (lab) => {
    // The application's state is asked for by nobody but tests: that code is in the second half.
    await poll(() => lab.asked.join(), (asked) => asked === "fetch");
    const state = await lab.until((state) => state !== null && state.loaded);
    assert.equal(state.title, "still-life");
    assert.deepEqual(lab.asked, ["fetch", "xhr"]);
    // And what was on its way does no harm when it comes.
    const arrived = lab.page.waitForResponse((response) => response.request().resourceType() === "fetch" && response.url().includes("gonio-rest"));
    lab.release();
    await (await arrived).finished();
    await poll(() => lab.page.evaluate(() => navigator.serviceWorker.getRegistration().then((found) => found !== undefined)), Boolean);
    assert.equal((await lab.state()).title, "still-life");
    assert.equal(await lab.trouble(), null);
  }, {
    prepare: async (lab) => {
      lab.asked = [];
      const gate = new Promise((resolve) => { lab.release = resolve; });
      await lab.page.route(REST, async (route) => {
        const kind = route.request().resourceType();
        lab.asked.push(kind);
        if (kind === "fetch") await gate;
        await route.continue();
      });
    },
  });

  test("a second half that does not come is said when it is needed", async (lab) => {
    lab.expect("net::ERR_FAILED");
    assert.equal(await lab.trouble(), null, "nothing of it was needed yet");
    await assert.rejects(lab.state());
    assert.match(await lab.trouble(), /could not be loaded[^]*Check the connection/);
    assert.match(await lab.page.locator("#trouble-details").textContent(), /gonio-rest/);
    await lab.page.unroute(REST);
    await lab.page.click("#trouble-reload");
    await lab.running();
    assert.equal((await lab.until((state) => state !== null && state.loaded)).title, "still-life");
    // Until then events went on coming to the application; each that needed the second half said the same to the console.
    lab.wrong = lab.wrong.filter((text) => !/Failed to load .*gonio-rest/.test(text));
  }, { prepare: (lab) => lab.page.route(REST, (route) => route.abort()) });
}

const PLY = `ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 1 2 3
3 0 3 2
`;

test("a link to a model that the first half cannot read has the whole module before", async (lab) => {
  const state = await lab.until((state) => state.loaded && state.busy === null && state.frame.pictures > 0);
  assert.equal(state.title, "tetrahedron.ply");
  assert.equal(state.triangles, 4);
  const kinds = await lab.page.evaluate(() => performance.getEntriesByType("resource")
    .filter(({ name }) => name.includes("gonio-rest")).map(({ initiatorType }) => initiatorType));
  assert.deepEqual(kinds, split ? ["fetch"] : []);
  // And the first scene is one of the samples then.
  await poll(() => lab.page.evaluate(() => navigator.serviceWorker.getRegistration().then((found) => found !== undefined)), Boolean);
  await lab.click("samples");
  await lab.until((state) => state.widgets.some((widget) => widget.id === "sample-still-life"));
  await lab.click("sample-still-life");
  const still = await lab.until((state) => state.title === "still-life" && state.loaded && state.busy === null);
  assert.equal(still.error, null);
  assert.deepEqual(still.messages, []);
}, {
  path: "?open=models/tetrahedron.ply",
  prepare: (lab) => lab.page.route("**/models/tetrahedron.ply", (route) => route.fulfill({ body: PLY })),
});
