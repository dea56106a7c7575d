// The terms of the equation: on, off, alone.

import assert from "node:assert/strict";
import { assertSame, differing, fromSum } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

/** Every term there is: light of all kinds, a lamp that fades and a spot, a surface that glows, an environment that is
 * not seen. The picture's numbers are the light's (`direct`), so pictures can be added. */
const SCENE = `
[picture]
color = "direct"
[camera]
position = [0, 0.8, 4.6]
target = [0, 0, 0]
[background]
top = [0, 0, 0]
bottom = [0, 0, 0]
[environment]
image = "sky"
light = true
visible = false
intensity = 0.3
[[object]]
model = "builtin:sphere-2048"
material = { ambient = [0.08, 0.08, 0.12], diffuse = [0.3, 0.22, 0.15], specular = [0.25, 0.25, 0.25], shininess = 12, emitted = [0, 0.05, 0.08] }
[[light]]
kind = "ambient"
[[light]]
kind = "point"
position = [2, 2, 2]
linear = 0.15
quadratic = 0.05
[[light]]
kind = "spot"
position = [-2, 1.5, 2.5]
direction = [2, -1.5, -2.5]
inner_angle = 6
outer_angle = 12
intensity = 0.5
`;

/** What is added up, and what is multiplied. */
const SUMMANDS = ["ambient", "emitted", "environment", "diffuse", "specular"];
const FACTORS = ["attenuation", "spot"];

const values = (state) => Object.fromEntries(
  state.widgets.filter(({ role }) => role === "term").map(({ id, value }) => [id.replace("term-", ""), value]),
);

/** What the scene says of a term. */
const inScene = ({ scene }, term) => {
  if (term === "environment") return scene.environment.light;
  return scene.equation[term === "specular" ? "specular_term" : term] ?? true;
};

const open = async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "terms.toml", text: SCENE });
  await lab.until((state) => settled(state) && state.title === "terms.toml");
  // No light in the row of lights is chosen, and nothing under the pointer: what is seen is the picture and its lights.
  return lab.park();
};

const options = { viewport: { width: 900, height: 640 } };

test("every term is switched off and on, and the picture follows", async (lab) => {
  const opened = await open(lab);
  const all = { ...Object.fromEntries([...SUMMANDS, ...FACTORS].map((term) => [term, "on"])), light: "shown", cosine: "shown" };
  assert.deepEqual(values(opened), all);
  const whole = await lab.still("pane-0");
  for (const term of [...SUMMANDS, ...FACTORS]) {
    const off = await lab.click(`term-${term}`);
    assert.deepEqual(values(off), { ...all, [term]: "off" }, term);
    assert.equal(inScene(off, term), false, term);
    assert.equal(off.announcement, `${term} is off`);
    await lab.park();
    const without = await lab.picture("pane-0");
    // The least of them is the spot's edge: some hundred pixels of 250 000.
    assert.ok(differing(whole, without) > 0.002, `${term} is off, and the picture is as it was`);
    const undone = await lab.key("Control+z");
    assert.deepEqual(undone.scene, opened.scene, term);
    assertSame(whole, await lab.still("pane-0"), `${term}: undone, and the picture is another one`);
  }
  // And on again by a click, as it was switched off.
  await lab.click("term-diffuse");
  const on = await lab.click("term-diffuse");
  assert.deepEqual(on.scene, opened.scene);
  await lab.park();
  assertSame(whole, await lab.still("pane-0"));
}, options);

test("terms alone add up to the picture, and none at all are black", async (lab) => {
  const opened = await open(lab);
  const whole = await lab.saved();
  const parts = [];
  for (const term of SUMMANDS) {
    const alone = await lab.click(`term-${term}`, { hold: "Shift" });
    const on = Object.entries(values(alone)).filter(([name, value]) => SUMMANDS.includes(name) && value === "on");
    // The environment's light is reflected by these two: there are no lights then.
    const wanted = term === "environment" ? ["environment", "diffuse", "specular"] : [term];
    assert.deepEqual(on.map(([name]) => name).sort(), wanted.sort());
    assert.equal(alone.scene.light.every(({ enabled }) => enabled === false), term === "environment");
    const part = await lab.saved();
    assert.ok(fromSum(part, []).largest > 8, `${term} alone is black`);
    assert.ok(differing(part, whole) > 0.05, `${term} alone is everything`);
    parts.push(part);
    // Once more: as before.
    const back = await lab.click(`term-${term}`, { hold: "Shift" });
    assert.deepEqual(back.scene, opened.scene, term);
  }
  // What is brighter than a picture can be says nothing.
  const sum = fromSum(whole, parts, 250);
  // Six numbers are rounded to whole steps, each by a half at most.
  assert.ok(sum.largest <= 3 && sum.mean < 0.5 && sum.share > 0.9, JSON.stringify(sum));
  for (const term of SUMMANDS) await lab.click(`term-${term}`);
  assert.equal(fromSum(await lab.saved(), []).largest, 0, "no term, and still there is light");
  // The environment is a part of the scene; what is switched on by this button are the equation's terms.
  await lab.click("terms-all");
  const again = await lab.click("term-environment");
  assert.deepEqual(again.scene, opened.scene);
  assertSame(whole, await lab.saved());
}, options);

test("a term alone is its debug view", async (lab) => {
  await open(lab);
  for (const [term, key] of [["diffuse", "6"], ["specular", "7"]]) {
    await lab.click(`term-${term}`, { hold: "Shift" });
    const alone = await lab.saved();
    await lab.click(`term-${term}`, { hold: "Shift" });
    await lab.park();
    const state = await lab.key(key);
    assert.equal(state.pane_settings[0].view, term);
    const view = await lab.saved();
    await lab.key("0");
    // The same sum, once of one summand and once picked out of all: rounding.
    assert.ok(fromSum(view, [alone]).largest <= 1, term);
  }
}, options);

test("the light's own factor opens the rows of the sum, and definitions can be read", async (lab) => {
  await open(lab);
  await lab.click("tab-camera");
  assert.equal((await lab.click("term-light")).tab, "Lights");
  const before = (await lab.park()).widgets.find(({ id }) => id === "pane-0").rect;
  const shown = await lab.click("definitions");
  const terms = shown.widgets.map(({ id }) => id).filter((id) => id.startsWith("definition-"));
  assert.deepEqual(terms.map((id) => id.replace("definition-", "")).sort(), [...SUMMANDS, ...FACTORS, "cosine"].sort());
  const hidden = await lab.click("definitions");
  assert.deepEqual(hidden.widgets.find(({ id }) => id === "pane-0").rect, before);
}, options);
