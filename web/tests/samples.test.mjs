// Samples come over the network after the first picture; who opens one before waits for it.

import assert from "node:assert/strict";
import { fetched, poll, settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 740, height: 560 } };

test("every sample opens", async (lab) => {
  await lab.until(settled);
  await lab.click("samples");
  const ids = (await lab.until((state) => state.widgets.some((widget) => widget.id.startsWith("sample-")))).widgets
    .map((widget) => widget.id).filter((id) => id.startsWith("sample-"));
  assert.ok(ids.length >= 10, ids.join(" "));
  await lab.page.keyboard.press("Escape");
  await fetched(lab);
  for (const id of ids) {
    const shut = (state) => !state.widgets.some((widget) => widget.id === id);
    await lab.until(shut);
    await lab.click("samples");
    await lab.until((state) => !shut(state));
    await lab.click(id);
    const name = id.replace("sample-", "");
    const state = await lab.until((state) => state.title === name && settled(state));
    assert.equal(state.error, null, `${name}: ${state.error}`);
    assert.deepEqual(state.messages.filter((message) => message.severity !== "note"), [], name);
    assert.ok(state.triangles > 0, name);
  }
}, options);

/** The sphere itself is made in the page; its materials are a file. */
const SCENE = { name: "ball.toml", text: '[[object]]\nmodel = "builtin:sphere-128"\n' };
const MATERIALS = "**/models-sphere_smooth.*.mtl";

{
  let hold;
  const gate = new Promise((resolve) => { hold = resolve; });
  test("a scene waits for a sample's materials, and is read with them", async (lab) => {
    await lab.until((state) => state?.loaded && state.busy === null);
    await lab.drop(SCENE);
    await lab.until((state) => state.busy?.includes("ball.toml"));
    // It still waits when the samples that nothing keeps back have come.
    await lab.until(() => lab.page.evaluate(() => performance.getEntriesByType("resource").some(({ name }) => name.includes("suzanne"))));
    const waiting = await lab.state();
    assert.deepEqual([waiting.title, waiting.busy !== null, waiting.messages], ["still-life", true, []]);
    hold();
    const state = await lab.until((state) => settled(state) && state.title === "ball.toml");
    assert.deepEqual([state.triangles, state.messages, state.error], [128, [], null]);
  }, {
    ...options,
    prepare: (lab) => lab.page.route(MATERIALS, async (route) => { await gate; await route.continue(); }),
  });
}

test("materials that cannot be fetched are named, and the scene is shown without them", async (lab) => {
  lab.expect("404");
  await lab.until((state) => state?.loaded && state.busy === null);
  await lab.drop(SCENE);
  const state = await lab.until((state) => settled(state) && state.title === "ball.toml");
  assert.equal(state.triangles, 128);
  assert.ok(state.messages.some(({ text }) => text.includes("sphere_smooth.mtl")), JSON.stringify(state.messages));
}, {
  ...options,
  prepare: (lab) => lab.page.route(MATERIALS, (route) => route.fulfill({ status: 404, body: "gone" })),
});

test("a sample that cannot be fetched is said when it is opened", async (lab) => {
  lab.expect("404");
  await lab.until((state) => state?.loaded && state.busy === null);
  await lab.drop({ name: "ape.toml", text: '[[object]]\nmodel = "builtin:suzanne"\n' });
  const state = await lab.until((state) => state.error !== null && state.busy === null);
  assert.match(state.error, /suzanne.*was not downloaded; load the page again/);
  assert.equal(state.title, "still-life");
}, {
  ...options,
  prepare: (lab) => lab.page.route("**/models-suzanne.*.obj", (route) => route.fulfill({ status: 404, body: "gone" })),
});

{
  let hold;
  const gate = new Promise((resolve) => { hold = resolve; });
  test("the application is laid out before the model of a link has come", async (lab) => {
    const waiting = await lab.until((state) => state?.busy !== null);
    assert.match(waiting.busy, /tetrahedron\.obj/);
    assert.deepEqual([waiting.loaded, waiting.error, waiting.frame.pictures], [false, null, 0]);
    hold();
    const state = await lab.until((state) => settled(state));
    assert.deepEqual([state.title, state.triangles, state.messages], ["tetrahedron.obj", 4, []]);
  }, {
    ...options,
    path: "?open=models/tetrahedron.obj",
    prepare: (lab) => lab.page.route("**/models/tetrahedron.obj", async (route) => {
      await gate;
      await route.fulfill({ body: "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n" });
    }),
  });
}

test("a model of a link that is not there is said", async (lab) => {
  lab.expect("404");
  const text = await poll(() => lab.trouble(), (text) => text !== null);
  assert.match(text, /could not be loaded/);
  assert.match(await lab.page.locator("#trouble-details").textContent(), /nothing\.obj.*404/);
}, { ...options, path: "?open=models/nothing.obj", wait: false });
