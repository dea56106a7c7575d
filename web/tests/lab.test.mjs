// The application in the page: the scene, its graphics taken away and given back.

import assert from "node:assert/strict";
import { assertSame, colors } from "./support/png.mjs";
import { poll, settled, suite } from "./support/lab.mjs";

const { test } = suite();

test("the first scene is shown, lit, with all its files", async (lab) => {
  const state = await lab.until(settled);
  assert.equal(state.title, "still-life");
  assert.equal(state.triangles, 4618);
  assert.deepEqual(state.messages, []);
  assert.equal(state.error, null);
  const picture = await lab.picture("pane-0");
  // Shading and textures: many colours; and light from above: the top of the white ball outshines its lower side.
  assert.ok(colors(picture) > 500, `${colors(picture)} colours`);
});

test("it draws when something changes, and only then", async (lab) => {
  const before = await lab.until(settled);
  // The frame that took the page's own frame away may be followed by some in which panels find their sizes.
  const calm = await poll(async () => {
    const first = (await lab.state()).frame.frames;
    await new Promise((resolve) => setTimeout(resolve, 1000));
    return [first, (await lab.state()).frame.frames];
  }, ([first, second]) => first === second);
  assert.equal((await lab.state()).frame.frames, calm[1]);
  assert.equal((await lab.state()).frame.pictures, before.frame.pictures);
  const [x, y] = await lab.middle("pane-0");
  await lab.page.mouse.move(x, y);
  await lab.page.mouse.down();
  await lab.page.mouse.move(x + 80, y + 20, { steps: 4 });
  await lab.page.mouse.up();
  const after = await lab.until((state) => state.frame.pictures > before.frame.pictures);
  assert.notDeepEqual(after.scene.camera, before.scene.camera);
});

test("graphics that are taken away and given back bring the same picture", async (lab) => {
  const before = await lab.until(settled);
  await lab.click("tab-camera");
  await lab.until((state) => state.tab === "Camera");
  const [x, y] = await lab.middle("pane-0");
  await lab.page.mouse.move(x, y);
  await lab.page.mouse.down();
  await lab.page.mouse.move(x + 60, y, { steps: 3 });
  await lab.page.mouse.up();
  const turned = await lab.until((state) => state.frame.pictures > before.frame.pictures + 1 && settled(state));
  await lab.page.mouse.move(2, 2);
  const picture = await lab.still("pane-0");
  await lab.page.evaluate(() => {
    // The page's own context has the extensions alone that it uses.
    const context = document.getElementById("lab").getContext("webgl2");
    window.lose = WebGL2RenderingContext.prototype.getExtension.call(context, "WEBGL_lose_context");
    window.lose.loseContext();
  });
  await poll(() => lab.page.evaluate(() => document.getElementById("lab").getContext("webgl2").isContextLost()), Boolean);
  await lab.page.evaluate(() => window.lose.restoreContext());
  const again = await lab.until((state) => state !== null && state.frame.pictures > turned.frame.pictures && settled(state));
  assert.deepEqual(again.scene, turned.scene);
  assert.equal(again.tab, "Camera");
  assert.equal(await lab.trouble(), null);
  // The same machine and the same numbers: at most the panels' sizes had to be found anew.
  assertSame(picture, await lab.still("pane-0"), "another picture");
  // And it goes on: what was undone before can be undone now.
  await lab.click("undo");
  await lab.until((state) => JSON.stringify(state.scene.camera) === JSON.stringify(before.scene.camera));
});

test("what changed is said to those who hear the screen", async (lab) => {
  await lab.until(settled);
  assert.match(await lab.page.locator("#announcement").textContent(), /opened still-life/);
});

test("the page follows the browser's light or dark look", async (lab) => {
  assert.equal((await lab.until(settled)).dark, true);
  const [x, y] = [640, 795];
  assert.ok((await lab.picture()).at(x, y).every((value) => value < 80), "the status line is dark");
}, { colorScheme: "dark" });

test("a model beside the page is opened by a link", async (lab) => {
  const state = await lab.until(settled);
  assert.equal(state.title, "tetrahedron.obj");
  assert.equal(state.triangles, 4);
}, {
  path: "?open=models/tetrahedron.obj",
  prepare: (lab) => lab.page.route("**/models/tetrahedron.obj", (route) => route.fulfill({
    body: "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
  })),
});
