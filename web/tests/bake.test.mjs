// Baking on the page: by a worker, with the atlas beside the model, and saved as a download.

import assert from "node:assert/strict";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const bake = async (lab) => {
  await lab.until(settled);
  await lab.key("Control+b");
  await lab.click("bake-size-256");
  await lab.click("bake-start");
  const state = await lab.until(({ bake }) => bake.failed !== null || bake.result !== null);
  assert.equal(state.bake.failed, null);
  return lab.rest();
};

test("textures are baked in a worker, a texel is marked on the model, and all is saved", async (lab) => {
  const { bake: { result, view } } = await bake(lab);
  assert.deepEqual([result.maps, result.overlaps, view.background], [["diffuse"], 0, "diffuse"]);
  // A place of the model is a texel, and the texel that place.
  await lab.clickAt(await lab.middle("pane-0"));
  const { bake: { place }, tab } = await lab.until((state) => state.bake.place !== null);
  assert.equal(tab, "Bake");
  const [left, top, side] = (await lab.state()).bake.view.square;
  await lab.page.mouse.move(left + side * place.uv[0], top + side * (1 - place.uv[1]));
  const there = await lab.until((state) => state.bake.place?.uv.join() !== place.uv.join());
  assert.equal(there.bake.place.chart, place.chart);
  // The second pane shows the baked model.
  const wipe = await lab.click("bake-wipe");
  assert.deepEqual(wipe.pane_settings.map((pane) => pane.baked), [null, "materials"]);
  const { name, bytes } = await lab.download(() => lab.click("save-baked-zip"));
  assert.equal(name, "still-life_baked.zip");
  for (const file of result.files) assert.ok(bytes.includes(file), file);
  const glb = await lab.download(() => lab.click("save-baked-glb"));
  assert.equal(glb.bytes.subarray(0, 4).toString(), "glTF");
});

test("on a phone the atlas has a page of its own, and a bake can be cancelled", async (lab) => {
  const { bake: before, widgets } = await bake(lab);
  const ids = widgets.map(({ id }) => id);
  assert.ok(ids.includes("atlas") && ids.includes("bake-page-settings"), ids.join(" "));
  await lab.click("bake-page-settings");
  await lab.click("bake-map-ambient-occlusion");
  await lab.click("bake-size-2048");
  // The button is above what is seen of the panel.
  await lab.page.mouse.wheel(0, -3000);
  await lab.rest();
  await lab.clickAt(await lab.middle("bake-start"));
  await lab.until(({ bake }) => bake.running && bake.share > 0);
  await lab.reveal("bake-cancel");
  await lab.clickAt(await lab.middle("bake-cancel"));
  const { bake: after } = await lab.until(({ bake }) => !bake.running);
  assert.equal(after.result.serial, before.result.serial);
}, { viewport: { width: 390, height: 844 }, hasTouch: true });
