// The lights: rows of the sum, and bulbs in the picture.

import assert from "node:assert/strict";
import { assertSame, differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 740, height: 560 } };

test("a light is switched off and on in its row, and shown alone", async (lab) => {
  const opened = await lab.until(settled);
  assert.deepEqual(opened.scene.light.map(({ name }) => name), ["key", "fill", "rim", "ambient"]);
  await lab.park();
  const whole = await lab.still("pane-0");
  const off = await lab.click("light-0-on");
  assert.deepEqual(off.scene.light.map(({ enabled }) => enabled ?? true), [false, true, true, true]);
  assert.equal(off.widgets.find(({ id }) => id === "light-0").value, "off");
  await lab.park();
  const without = await lab.picture("pane-0");
  assert.ok(differing(whole, without) > 0.1, "without the key light the picture is as it was");
  const on = await lab.click("light-0-on");
  assert.deepEqual(on.scene, opened.scene);
  const alone = await lab.click("light-2-alone");
  assert.deepEqual(alone.scene.light.map(({ enabled }) => enabled ?? true), [false, false, true, false]);
  await lab.park();
  assert.ok(differing(without, await lab.picture("pane-0")) > 0.1, "one light is as many");
  const all = await lab.click("light-2-alone");
  assert.deepEqual(all.scene, opened.scene);
  await lab.park();
  assertSame(whole, await lab.still("pane-0"), "another picture than at first");
}, options);

test("a light is dragged in the picture", async (lab) => {
  await lab.until(settled);
  const opened = await lab.park();
  const whole = await lab.saved();
  // The rim light goes with its direction, about the middle of the objects.
  const [x, y] = await lab.middle("light-2-handle");
  const turned = await lab.drag([x, y], [x - 60, y + 10], [x - 120, y + 20]);
  assert.deepEqual(turned.selection, { light: 2 });
  assert.deepEqual(turned.scene.camera, opened.scene.camera, "the camera moved as well");
  const direction = turned.scene.light[2].direction;
  assert.notDeepEqual(direction, opened.scene.light[2].direction);
  assert.ok(Math.abs(Math.hypot(...direction) - 1) < 1e-3, `${direction}`);
  // The handle is where it was dragged to, within a rounded direction.
  const [nowX, nowY] = await lab.middle("light-2-handle");
  assert.ok(Math.hypot(nowX - (x - 120), nowY - (y + 20)) < 3, `${[nowX, nowY]} from ${[x, y]}`);
  assert.ok(differing(whole, await lab.saved()) > 0.05, "the light moved, and the picture is as it was");
  const undone = await lab.key("Control+z");
  assert.deepEqual(undone.scene, opened.scene);
  assertSame(whole, await lab.saved());
}, options);

test("a lamp keeps under the pointer and its arms move it along one axis", async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "lamp.toml", text: `
[camera]
position = [0, 0.5, 6]
target = [0, 0, 0]
[[object]]
model = "builtin:sphere-2048"
[[light]]
kind = "point"
name = "lamp"
position = [1, 0.8, 1]
` });
  await lab.until((state) => settled(state) && state.title === "lamp.toml");
  await lab.rest();
  const [x, y] = await lab.middle("light-0-handle");
  const moved = await lab.drag([x, y], [x + 30, y - 30], [x - 80, y - 40]);
  const handle = await lab.middle("light-0-handle");
  // Coordinates are rounded to what a point of the window is.
  assert.ok(Math.hypot(handle[0] - (x - 80), handle[1] - (y - 40)) < 3, `${handle} from ${[x, y]}`);
  // The arms are those of the light that is chosen, which it is by now.
  const along = await lab.drag(await lab.middle("light-0-x"), [handle[0] + 120, handle[1]]);
  const [before, after] = [moved, along].map(({ scene }) => scene.light[0].position);
  assert.ok(after[0] > before[0] + 0.1, `${before} became ${after}`);
  assert.deepEqual(after.slice(1), before.slice(1));
}, options);

test("a light outside of the picture has a mark at its edge, and is dragged in", async (lab) => {
  await lab.until(settled);
  const opened = await lab.park();
  const pane = opened.widgets.find(({ id }) => id === "pane-0").rect;
  // The key light stands high above: its mark is at the upper edge, below the strip of views.
  const strip = opened.widgets.find(({ id }) => id === "overlay-wireframe").rect;
  const [x, y] = await lab.middle("light-0-handle");
  assert.ok(y > strip[1] + strip[3] + 8 && y < pane[1] + 0.25 * pane[3], `${y} below ${strip}`);
  const [toX, toY] = [pane[0] + 0.3 * pane[2], pane[1] + 0.4 * pane[3]];
  const moved = await lab.drag([x, y], [x, y + 30], [toX, toY]);
  assert.deepEqual(moved.scene.camera, opened.scene.camera);
  assert.notDeepEqual(moved.scene.light[0].position, opened.scene.light[0].position);
  const [nowX, nowY] = await lab.middle("light-0-handle");
  assert.ok(Math.hypot(nowX - toX, nowY - toY) < 3, `${[nowX, nowY]} is not ${[toX, toY]}`);
}, options);
