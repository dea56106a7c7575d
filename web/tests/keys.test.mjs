// Keys: views, overlays, help, undo.

import assert from "node:assert/strict";
import { assertSame, differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 740, height: 560 } };

test("number keys show quantities of the equation in place of the picture", async (lab) => {
  await lab.until(settled);
  await lab.park();
  const picture = await lab.still("pane-0");
  const views = ["normal", "light", "view", "reflection", "half", "diffuse", "specular", "depth", "uv"];
  const seen = [picture];
  for (const [index, name] of views.entries()) {
    const state = await lab.key(`${index + 1}`);
    assert.equal(state.pane_settings[0].view, name);
    assert.equal(state.widgets.find(({ id }) => id === "view-chooser").value, name);
    const shown = await lab.picture("pane-0");
    for (const [number, other] of seen.entries()) {
      assert.ok(differing(other, shown) > 0.02, `${name} looks like ${["the picture", ...views][number]}`);
    }
    seen.push(shown);
  }
  const back = await lab.key("0");
  assert.equal(back.pane_settings[0].view, null);
  assertSame(picture, await lab.still("pane-0"), "the picture is another one");
}, options);

test("overlays and special views come and go by keys and by their buttons", async (lab) => {
  await lab.until(settled);
  await lab.park();
  const picture = await lab.still("pane-0");
  for (const [key, name] of [["Shift+W", "wireframe"], ["Shift+N", "normals"], ["Shift+B", "boxes"]]) {
    const state = await lab.key(key);
    assert.equal(state.pane_settings[0].overlays[name], true);
    assert.equal(state.widgets.find(({ id }) => id === `overlay-${name}`).value, "true");
    const share = differing(picture, await lab.picture("pane-0"));
    // Lines over the picture: more than none, less than all.
    assert.ok(share > 0.003 && share < 0.7, `${name}: ${share} of the picture`);
    await lab.key(key);
    assertSame(picture, await lab.still("pane-0"), `${name} did not go`);
  }
  for (const [key, name] of [["Shift+U", "uv-checker"], ["Shift+V", "overdraw"]]) {
    assert.equal((await lab.key(key)).pane_settings[0].special, name);
    assert.ok(differing(picture, await lab.picture("pane-0")) > 0.1, name);
    assert.equal((await lab.key(key)).pane_settings[0].special, null);
  }
  assert.equal((await lab.click("overlay-boxes")).pane_settings[0].overlays.boxes, true);
  assert.equal((await lab.key("Control+z")).pane_settings[0].overlays.boxes, false);
}, options);

test("the list of keys opens and closes by its key", async (lab) => {
  await lab.until(settled);
  await lab.park();
  const before = await lab.still();
  assert.equal((await lab.key("?")).help, true);
  assert.ok(differing(before, await lab.picture()) > 0.2, "no list is seen");
  assert.equal((await lab.key("Escape")).help, false);
  assert.equal((await lab.click("help")).help, true);
  assert.equal((await lab.key("?")).help, false);
  await lab.park();
  assertSame(before, await lab.still(), "the window is another one");
}, options);

test("everything is undone and done again by keys, in its order", async (lab) => {
  await lab.until(settled);
  const steps = [await lab.park()];
  const [x, y] = await lab.middle("pane-0");
  await lab.drag([x, y + 120], [x + 60, y + 140]);
  steps.push(await lab.park());
  await lab.click("term-emitted");
  steps.push(await lab.park());
  steps.push(await lab.key("4"));
  steps.push(await lab.key("f"));
  const facts = ({ scene, pane_settings }) => ({ scene, pane_settings });
  assert.deepEqual(steps.map(({ undo }) => undo), [false, true, true, true, true]);
  for (const step of steps.slice(0, -1).reverse()) assert.deepEqual(facts(await lab.key("Control+z")), facts(step));
  assert.equal((await lab.state()).undo, false);
  for (const step of steps.slice(1, 3)) assert.deepEqual(facts(await lab.key("Control+y")), facts(step));
  for (const step of steps.slice(3)) assert.deepEqual(facts(await lab.key("Control+Shift+Z")), facts(step));
  assert.equal((await lab.state()).redo, false);
}, options);

test("keys that are typed into a field are not commands", async (lab) => {
  await lab.until(settled);
  const before = await lab.park();
  // A double click would set the default: what is typed in begins with a click.
  await lab.click("light-0-intensity");
  await lab.page.keyboard.press("Control+a");
  await lab.page.keyboard.type("1.5");
  const typed = await lab.key("Enter");
  assert.equal(typed.scene.light[0].intensity, 1.5);
  assert.deepEqual(typed.pane_settings, before.pane_settings, "a digit chose a view");
  assert.deepEqual((await lab.key("Control+z")).scene, before.scene);
}, options);
