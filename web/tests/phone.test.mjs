// A phone, held upright: fingers, and little room.

import assert from "node:assert/strict";
import { differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const [WIDTH, HEIGHT] = [390, 844];
const options = { viewport: { width: WIDTH, height: HEIGHT }, hasTouch: true, isMobile: true };

/** Fingers on the screen: each is a list of places, one for each step; all lists are as long. */
const touch = async (lab, ...fingers) => {
  const cdp = await lab.context.newCDPSession(lab.page);
  const send = (type, touchPoints) => cdp.send("Input.dispatchTouchEvent", { type, touchPoints });
  const at = (step) => fingers.map((places, id) => ({ x: places[step][0], y: places[step][1], id, radiusX: 4, radiusY: 4, force: 1 }));
  await send("touchStart", at(0));
  await lab.rest();
  for (let step = 1; step < fingers[0].length; step++) {
    await send("touchMove", at(step));
    await lab.rest();
  }
  await send("touchEnd", []);
  await cdp.detach();
  return lab.rest();
};

const along = ([fromX, fromY], [toX, toY], steps = 4) =>
  Array.from({ length: steps + 1 }, (_, i) => [fromX + ((toX - fromX) * i) / steps, fromY + ((toY - fromY) * i) / steps]);

const distance = ({ position, target }) => Math.hypot(...position.map((value, axis) => value - target[axis]));

test("fingers turn, pinch and move the picture, and press what is on the screen", async (lab) => {
  const opened = await lab.until(settled);
  assert.deepEqual(opened.size, [WIDTH, HEIGHT]);
  await lab.rest();
  const [x, y] = await lab.middle("pane-0");
  const picture = await lab.saved();
  const first = opened.scene.camera;
  // One finger turns around what is looked at.
  const turned = (await touch(lab, along([x - 40, y + 60], [x + 40, y + 75]))).scene.camera;
  assert.notDeepEqual(turned.position, first.position);
  assert.deepEqual(turned.target, first.target);
  assert.ok(Math.abs(distance(turned) - distance(first)) < 1e-6);
  assert.ok(differing(picture, await lab.saved()) > 0.1, "the camera turned, and the picture is as it was");
  // Two that part come nearer, two that go the same way move sideways.
  const near = (await touch(lab, along([x - 20, y + 60], [x - 70, y + 60]), along([x + 20, y + 60], [x + 70, y + 60]))).scene.camera;
  assert.ok(distance(near) < 0.7 * distance(turned), `${distance(near)} after ${distance(turned)}`);
  const moved = (await touch(lab, along([x - 30, y + 40], [x - 30, y + 80]), along([x + 30, y + 40], [x + 30, y + 80]))).scene.camera;
  assert.ok(Math.abs(distance(moved) - distance(near)) < 0.05 * distance(near), `${distance(moved)} after ${distance(near)}`);
  assert.notDeepEqual(moved.target, near.target);
  // Three gestures, three steps; and a finger presses a button.
  for (const camera of [near, turned, first]) {
    await lab.page.touchscreen.tap(...await lab.middle("undo"));
    assert.deepEqual((await lab.rest()).scene.camera, camera);
  }
  await lab.page.touchscreen.tap(...await lab.middle("term-diffuse"));
  assert.equal((await lab.rest()).scene.equation.diffuse, false);
}, options);

test("nothing is cut off on a small screen", async (lab) => {
  await lab.until(settled);
  await lab.rest();
  const inside = ({ rect: [left, top, width, height] }, bottom) =>
    left >= 0 && top >= 0 && left + width <= WIDTH + 0.5 && top + height <= bottom + 0.5 && width > 4 && height > 4;
  const check = (state, where) => {
    const pane = state.widgets.find(({ id }) => id === "pane-0").rect;
    for (const widget of state.widgets) {
      // What the side panel holds may be scrolled to: it lies below the tabs, and only there may anything reach below.
      const scrolls = widget.rect[1] > pane[1] + pane[3];
      assert.ok(inside(widget, scrolls ? Infinity : HEIGHT), `${where}: ${widget.id} at ${widget.rect.join(", ")}`);
    }
  };
  for (const tab of ["lights", "objects", "camera", "picture", "probe", "compare", "frame"]) {
    await lab.page.touchscreen.tap(...await lab.middle(`tab-${tab}`));
    const state = await lab.rest();
    assert.equal(state.tab.toLowerCase(), tab);
    check(state, tab);
  }
  // The list of lights is scrolled to its end by a finger.
  await lab.page.touchscreen.tap(...await lab.middle("tab-lights"));
  await lab.rest();
  await lab.page.touchscreen.tap(...await lab.middle("light-0-open"));
  const long = await lab.rest();
  const last = (state) => state.widgets.find(({ id }) => id === "add-light-ambient").rect;
  assert.ok(last(long)[1] + last(long)[3] > HEIGHT, "there is nothing to scroll to");
  for (let swipe = 0; swipe < 4; swipe++) await touch(lab, along([WIDTH / 2, HEIGHT - 60], [WIDTH / 2, HEIGHT - 260]));
  const scrolled = await lab.rest();
  assert.ok(last(scrolled)[1] + last(scrolled)[3] <= HEIGHT, `${last(scrolled)}`);
  // The menu has everything the bar has no room for.
  await lab.page.touchscreen.tap(...await lab.middle("menu"));
  const menu = await lab.rest();
  for (const id of ["open", "save-picture", "copy-link", "sample-cube"]) {
    const entry = menu.widgets.find((widget) => widget.id === id);
    assert.ok(entry && inside(entry, HEIGHT), `${id} at ${entry?.rect}`);
  }
}, options);

test("a fine screen has a picture as fine", async (lab) => {
  const state = await lab.until(settled);
  assert.deepEqual([state.pixels_per_point, state.size, state.frame.size[0]], [2, [WIDTH, HEIGHT], 2 * WIDTH]);
  const canvas = await lab.page.evaluate(() => [document.getElementById("lab").width, document.getElementById("lab").height]);
  assert.deepEqual(canvas, [2 * WIDTH, 2 * HEIGHT]);
}, { ...options, deviceScaleFactor: 2 });
