// The frame taken apart, on the web as on the desktop.

import assert from "node:assert/strict";
import { colors } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

test("the frame lists its passes and draws, and nothing is wrong with it", async (lab) => {
  const opened = await lab.until(settled);
  assert.equal(opened.recorded_frame, null);
  const shown = await lab.click("tab-frame");
  const taken = shown.recorded_frame;
  assert.deepEqual(taken.findings, []);
  assert.equal(taken.picture, shown.frame.pictures);
  assert.ok(taken.passes.length >= 1 && taken.passes.every(({ name }) => name !== ""));
  assert.equal(taken.passes.reduce((sum, { draws }) => sum + draws, 0), taken.draws.length);
  // All triangles of the scene are drawn.
  const drawn = taken.draws.filter(({ pass }) => pass === taken.draws[0].pass).reduce((sum, { vertices }) => sum + vertices, 0);
  assert.ok(drawn >= 3 * shown.triangles, `${drawn} vertices for ${shown.triangles} triangles`);
  // Two textures, each read through a unit of its own that has one.
  const samplers = taken.draws.flatMap((draw) => draw.samplers);
  assert.ok(new Set(samplers.map(({ texture }) => texture)).size >= 2, JSON.stringify(samplers));
  assert.ok(samplers.every(({ unit, texture }) => unit >= 0 && texture !== null), JSON.stringify(samplers));
  // Every draw is a row; the chosen one is shown below it.
  const rows = shown.widgets.filter(({ id }) => /^draw-\d+$/.test(id));
  assert.equal(rows.length, taken.draws.length);
  assert.equal(rows[0].value, "true");
  const chosen = await lab.click("draw-1");
  assert.equal(chosen.recorded_frame.chosen, 1);
  assert.ok(colors(await lab.picture()) > 500);
  // Another picture, another record.
  await lab.park();
  const changed = await lab.key("1");
  const again = await lab.until((state) => state.recorded_frame.picture === state.frame.pictures);
  assert.ok(again.recorded_frame.picture > taken.picture, JSON.stringify(changed.frame));
  assert.deepEqual(again.recorded_frame.findings, []);
});
