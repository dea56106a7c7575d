// The same scene in one to four panes, each with its own settings.

import assert from "node:assert/strict";
import { assertSame, colors, crop, differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 1000, height: 700 } };

/** A coarse sphere: where shadings differ most. */
const open = async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "coarse.toml", text: `
[camera]
position = [0, 0.4, 5]
target = [0, 0, 0]
[[object]]
model = "builtin:sphere-128"
material = { shininess = 30 }
[[light]]
kind = "directional"
direction = [-0.6, -0.8, -1]
` });
  await lab.until((state) => settled(state) && state.title === "coarse.toml");
  return lab.click("tab-compare");
};

const panes = (state) => state.widgets.filter(({ role }) => role === "picture").map(({ id }) => id);

/** The picture of a pane by a screenshot, without its border, where captions and axes stand. */
const middle = async (lab, id) => {
  const picture = await lab.picture(id);
  const [left, top] = [picture.width, picture.height].map((side) => Math.floor(side / 4));
  return crop(picture, left, top, 2 * left, 2 * top);
};

test("three shadings side by side, four panes at most, one again", async (lab) => {
  await open(lab);
  const three = await lab.click("preset-shadings");
  assert.deepEqual(three.pane_settings.map(({ shading }) => shading), ["flat", "gouraud", "phong"]);
  assert.deepEqual(panes(three), ["pane-0", "pane-1", "pane-2"]);
  await lab.park();
  const pictures = [];
  for (const id of panes(three)) pictures.push(await middle(lab, id));
  // Pairs differ, and flat shading has the fewest colours: one for each triangle.
  for (const [a, b] of [[0, 1], [0, 2], [1, 2]]) {
    assert.ok(differing(pictures[a], pictures[b]) > 0.02, `panes ${a} and ${b} are the same`);
  }
  const [flat, gouraud, phong] = pictures.map(colors);
  assert.ok(flat < gouraud && flat < phong, `${flat}, ${gouraud}, ${phong} colours`);
  // A fourth like the current one, with a setting of its own.
  await lab.click("choose-pane-2");
  const four = await lab.click("add-pane");
  assert.deepEqual([four.panes, four.pane, panes(four).length], [4, 3, 4]);
  assert.equal(four.widgets.find(({ id }) => id === "add-pane").enabled, false, "a fifth pane");
  await lab.click("pane-specular");
  const matte = await lab.click("pane-specular-none");
  assert.deepEqual(matte.pane_settings.map(({ specular }) => specular), [null, null, null, "none"]);
  assert.deepEqual(matte.pane_settings.map(({ shading }) => shading), ["flat", "gouraud", "phong", "phong"]);
  await lab.park();
  assert.ok(differing(await middle(lab, "pane-2"), await middle(lab, "pane-3")) > 0.01, "the highlight is still there");
  // The camera is everybody's.
  const [x, y] = await lab.middle("pane-1");
  const before = await middle(lab, "pane-3");
  const turned = await lab.drag([x, y], [x + 50, y + 30]);
  assert.notDeepEqual(turned.scene.camera, four.scene.camera);
  await lab.park();
  assert.ok(differing(before, await middle(lab, "pane-3")) > 0.02, "a pane did not turn with the others");
  const one = await lab.click("preset-one");
  assert.deepEqual([one.panes, panes(one)], [1, ["pane-0"]]);
}, options);

test("two panes are wiped", async (lab) => {
  await open(lab);
  await lab.click("preset-one");
  const conventions = await lab.click("preset-conventions");
  assert.deepEqual(conventions.pane_settings.map(({ convention }) => convention), ["lab", "physical"]);
  const wiped = await lab.click("wipe-mode");
  assert.deepEqual(wiped.arrangement, { kind: "wipe", wipe: 0.5, pair: [0, 1] });
  const { rect: [left, top, width, height] } = await lab.widget("pane-1");
  await lab.park();
  // A stripe right of the divider, and one left of it, as they are before it is dragged over them.
  const stripe = async (share) => {
    const picture = await lab.picture("pane-1");
    const third = Math.floor(picture.height / 3);
    return crop(picture, Math.floor(share * picture.width) - 10, third, 20, third);
  };
  const [before, beside] = [await stripe(0.6), await stripe(0.4)];
  const hold = [left + 0.5 * width, top + 0.8 * height];
  const dragged = await lab.drag(hold, [left + 0.8 * width, hold[1]]);
  assert.ok(Math.abs(dragged.arrangement.wipe - 0.8) < 0.01, JSON.stringify(dragged.arrangement));
  assert.deepEqual(dragged.scene.camera, wiped.scene.camera);
  await lab.park();
  assert.ok(differing(before, await stripe(0.6)) > 0.5, "right of the divider stood the second pane, now the first");
  assertSame(beside, await stripe(0.4), "left of the divider it is the first as before");
}, options);

test("where two panes differ is shown and counted, and equal ones differ by nothing", async (lab) => {
  await open(lab);
  await lab.click("preset-shadings");
  const mapped = await lab.click("difference-mode");
  assert.deepEqual(mapped.arrangement, { kind: "difference", wipe: null, pair: [0, 1] });
  const { difference } = mapped;
  const pixels = difference.size[0] * difference.size[1];
  assert.deepEqual(difference.size, mapped.frame.size);
  assert.ok(difference.differing > 0.01 * pixels && difference.differing < 0.9 * pixels, JSON.stringify(difference));
  assert.ok(Math.abs(difference.percent - (100 * difference.differing) / pixels) < 1e-9);
  const { mean, rms, max } = difference.spread;
  assert.ok(0 < mean && mean < rms && rms < max && max <= 255, JSON.stringify(difference));
  assert.ok(Math.abs(difference.psnr_db - 20 * Math.log10(255 / rms)) < 1e-6);
  assert.ok(difference.worst.every((value, axis) => value >= 0 && value < difference.size[axis]));
  await lab.park();
  const map = await middle(lab, "pane-0");
  // All three as the second: nothing is left, and the map has the colour of nothing everywhere.
  await lab.click("choose-pane-1");
  const same = await lab.click("copy-pane");
  assert.deepEqual(same.pane_settings.map(({ shading }) => shading), ["gouraud", "gouraud", "gouraud"]);
  const none = (await lab.until((state) => state.difference?.differing === 0)).difference;
  assert.deepEqual(none.spread, { mean: 0, rms: 0, max: 0 });
  assert.deepEqual([none.psnr_db, none.worst, none.percent], [null, null, 0]);
  await lab.park();
  // Below and left of the middle: the sun's handle stands above it.
  const empty = await middle(lab, "pane-0");
  const [half, below] = [empty.width >> 1, empty.height >> 1];
  assert.equal(colors(crop(empty, 0, below, half, below)), 1);
  assert.ok(colors(crop(map, 0, below, half, below)) > 10, "the map has one colour");
  // Numbers follow the panes: of another pair.
  await lab.click("choose-pane-0");
  await lab.click("pane-shading");
  await lab.click("pane-shading-flat");
  await lab.click("pair-second");
  const other = await lab.click("pair-second-2");
  assert.deepEqual(other.arrangement.pair, [0, 2]);
  const again = (await lab.until((state) => state.difference?.differing > 0)).difference;
  assert.deepEqual(again, difference);
}, options);
