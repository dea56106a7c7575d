// The probe: the equation at one pixel, by both renderers.

import assert from "node:assert/strict";
import { crop, differing } from "./support/png.mjs";
import { CLIPBOARD, settled, suite } from "./support/lab.mjs";

const { test } = suite();

/** Every number in plain data, with where it stands. */
function* numbers(value, path = "") {
  if (typeof value === "number" || value === null) yield [path, value];
  else if (typeof value === "object") for (const [key, inner] of Object.entries(value)) yield* numbers(inner, `${path}.${key}`);
}

test("a pixel is probed, pinned and let go, and both renderers agree", async (lab) => {
  await lab.until(settled);
  const opened = await lab.park();
  assert.equal(opened.probe, null);
  const picture = await lab.saved();
  const [left, top, width, height] = opened.widgets.find(({ id }) => id === "pane-0").rect;
  assert.deepEqual([picture.width, picture.height], [width, height].map(Math.round));
  const seen = async (x, y) => {
    await lab.page.mouse.move(left + x + 0.5, top + y + 0.5);
    await lab.rest();
    const { probe } = await lab.until((state) => state.probe?.pixel[0] === x && state.probe?.pixel[1] === y);
    // As `gonio probe` and the pictures: the project's first issue set it.
    assert.ok(probe.gpu.difference < 1e-3, JSON.stringify(probe));
    return probe;
  };
  assert.equal((await lab.key("p")).tab, "Probe");
  // On the background, the torus, a dark square of the floor: the pixel's own numbers, and those of the picture (four
  // samples in place of one: the floor's texture is smooth enough there).
  const places = [[0.5, 0.97], [0.54, 0.43], [0.72, 0.605]].map(([x, y]) => [Math.floor(x * width), Math.floor(y * height)]);
  const objects = new Set();
  for (const [x, y] of places) {
    const probe = await seen(x, y);
    objects.add(probe.object);
    const shown = picture.at(x, y);
    assert.ok(probe.displayed.every((value, channel) => Math.abs(value - shown[channel]) <= 4), `${probe.displayed} and ${shown} at ${x}, ${y}`);
    assert.equal(probe.pinned, false);
  }
  assert.ok(objects.size > 1, [...objects].join());
  // A click pins what is under the pointer: it stays while the pointer goes on.
  const [x, y] = places[2];
  await lab.page.mouse.move(left + x + 0.5, top + y + 0.5);
  await lab.page.mouse.down();
  await lab.page.mouse.up();
  await lab.page.mouse.move(left + 20, top + height - 60);
  const pinned = await lab.rest();
  assert.equal(pinned.probe.pinned, true);
  assert.deepEqual(pinned.probe.pixel, [x, y]);
  assert.equal(pinned.scene.camera.position.join(), opened.scene.camera.position.join());
  // All its numbers, as the button hands them out.
  await lab.click("probe-copy-json");
  const reading = JSON.parse(await lab.clipboard());
  assert.deepEqual([reading.x, reading.y, reading.width, reading.height], [x, y, Math.round(width), Math.round(height)]);
  const all = [...numbers(reading)];
  assert.ok(all.length > 100, `${all.length} numbers`);
  // A light without a place has no distance, light is interpolated by Gouraud's shading alone, and nothing is traced here.
  const absent = ([path]) => path.endsWith(".distance") || [".probe.interpolated", ".traced"].includes(path);
  assert.deepEqual(all.filter((entry) => !Number.isFinite(entry[1]) && !absent(entry)), []);
  const { terms } = reading.probe;
  for (const vector of [terms.point.normal, terms.point.view, ...terms.lights.flatMap(({ l, r, h }) => [l, r, h])]) {
    assert.ok(Math.abs(Math.hypot(...vector) - 1) < 1e-6, `${vector}`);
  }
  // The lobe and its inset, which says the value towards the eye, can be hidden.
  assert.ok(await lab.widget("lobe-0"));
  const hidden = await lab.click("probe-lobe");
  assert.ok(!hidden.widgets.some(({ id }) => id === "lobe-0"));
  // N, L, V, R, H and the ring stand in the picture, near to the pixel.
  await lab.park();
  const arrows = await lab.picture("pane-0");
  const released = await lab.key("Escape");
  assert.equal(released.probe, null);
  const bare = await lab.picture("pane-0");
  const share = differing(bare, arrows);
  assert.ok(share > 0.002 && share < 0.2, `${share} of the picture is arrows`);
  const near = (picture) => crop(picture, x - 20, y - 20, 40, 40);
  assert.ok(differing(near(bare), near(arrows)) > 0.15, "no arrow begins at the pixel");
}, { ...CLIPBOARD, viewport: { width: 740, height: 560 } });

test("a pinned pixel follows a term that is switched off", async (lab) => {
  await lab.until(settled);
  const { rect: [left, top, width, height] } = await lab.widget("pane-0");
  await lab.clickAt([left + 0.66 * width, top + 0.42 * height]);
  const lit = (await lab.until((state) => state.probe?.pinned && state.probe.gpu !== null)).probe;
  await lab.click("term-diffuse");
  const { probe } = await lab.until((state) => state.probe?.reference[0] < lit.reference[0]);
  assert.deepEqual(probe.pixel, lit.pixel);
  assert.ok(probe.gpu.difference < 1e-3, JSON.stringify(probe));
  await lab.key("Control+z");
  const back = (await lab.until((state) => state.probe?.reference[0] === lit.reference[0])).probe;
  assert.deepEqual(back, lit);
}, { viewport: { width: 740, height: 560 } });
