// The parts of a model: selected in the picture, outlined, and with materials of their own.

import assert from "node:assert/strict";
import { assertSame, differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

/** A still life, seen from above. */
const opened = async (lab) => {
  await lab.drop({ name: "parts.toml", text: `
[camera]
position = [3, 4, 6]
target = [0, 0, 0]
[[object]]
model = "builtin:still_life"
` });
  await lab.until((state) => settled(state) && state.title === "parts.toml");
};

test("a click selects a part, whose outline is shown and whose material is edited", async (lab) => {
  await opened(lab);
  await lab.click("tab-objects");
  await lab.park();
  const [whole, bare] = [await lab.saved(), await lab.picture("pane-0")];
  const { rect: [left, top, width, height] } = await lab.widget("pane-0");
  // The crate.
  await lab.clickAt([left + 0.35 * width, top + 0.3 * height]);
  const selected = await lab.until(({ selection }) => selection?.part_name === "Crate_Wood");
  assert.equal(selected.tab, "Objects");
  await lab.park();
  const outlined = differing(bare, await lab.picture("pane-0"));
  assert.ok(outlined > 0.002 && outlined < 0.2, `${outlined} of the picture has changed`);
  // The outline is no part of the picture.
  assertSame(whole, await lab.saved());
  await lab.reveal("object-0-shininess");
  const [x, y] = await lab.middle("object-0-shininess");
  const edited = await lab.drag([x, y], [x + 30, y], [x + 60, y]);
  const [object] = edited.scene.object;
  assert.equal(object.material, undefined);
  assert.deepEqual(Object.keys(object.parts), ["Crate_Wood"]);
  assert.ok(object.parts.Crate_Wood.shininess > 1, JSON.stringify(object.parts));
}, { viewport: { width: 1100, height: 720 } });

test("on a phone, the material of a part that was touched is in view", async (lab) => {
  await opened(lab);
  const { rect: [left, top, width, height] } = await lab.widget("pane-0");
  await lab.page.touchscreen.tap(left + 0.35 * width, top + 0.4 * height);
  await lab.until(({ selection }) => selection?.part_name === "Crate_Wood");
  await lab.page.touchscreen.tap(...await lab.middle("tab-objects"));
  assert.equal((await lab.rest()).tab, "Objects");
  const { rect: [, valueTop, , valueHeight], clip: [, panel, , room] } = await lab.widget("object-0-ambient");
  assert.ok(valueTop >= panel && valueTop + valueHeight <= panel + room, `the first value is at ${valueTop} in ${panel} to ${panel + room}`);
}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
