// The BRDF bench on the page: plots, files, checks, and the angle under the pointer.

import assert from "node:assert/strict";
import { differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

/** The bench, opened from the scene's top bar. */
const opened = async (lab, narrow = false) => {
  await lab.until(settled);
  if (narrow) await lab.click("menu");
  await lab.click("bench");
  return (await lab.rest()).bench;
};

test("models are plotted, the light is dragged, and the plot is saved", async (lab) => {
  const first = await opened(lab);
  assert.deepEqual(first.functions.map(({ shown }) => shown), [true, true, true]);
  assert.equal(first.plot.kind, "polar");
  const before = await lab.picture("bench-plot");
  const { rect: [left, top] } = await lab.widget("bench-plot");
  const { center: [x, y], radius } = first.plot;
  const at = (degrees) => {
    const angle = (degrees * Math.PI) / 180;
    return [left + x - 0.8 * radius * Math.sin(angle), top + y - 0.8 * radius * Math.cos(angle)];
  };
  const { bench } = await lab.drag(at(45), at(60), at(75));
  assert.ok(Math.abs(bench.plot.theta - 75) < 1, `${bench.plot.theta}`);
  assert.ok(differing(before, await lab.picture("bench-plot")) > 0.01, "the plot is as it was");
  await lab.click("save");
  const { name, bytes } = await lab.download(() => lab.click("save-plot-svg"));
  assert.equal(name, "polar.svg");
  assert.match(bytes.toString(), /^<svg .*phong-normalised/s);
});

test("a function in GLSL is plotted and checked, and an error has its line", async (lab) => {
  await opened(lab);
  const head = "vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)\n{\n";
  await lab.drop({ name: "bright.glsl", text: `${head}    return vec3(0.9);\n}\n` });
  await lab.until(({ bench }) => bench.functions.length === 4);
  await lab.click("check-function");
  const { bench } = await lab.until(({ bench }) => bench.checks.of === "bright.glsl" && !bench.checks.running);
  const passed = Object.fromEntries(bench.checks.found.map(({ property, passed }) => [property, passed]));
  assert.deepEqual(passed, { reciprocity: true, energy: false, positivity: true });
  await lab.drop({ name: "wrong.glsl", text: `${head}    return vec3(0.9)\n}\n` });
  const { error } = await lab.until((state) => state.error !== null);
  assert.match(error, /^wrong\.glsl:[34]:\d+: /);
});

test("on a phone the plot is above its settings", async (lab) => {
  await opened(lab, true);
  const { rect: [left, top, width, height] } = await lab.widget("bench-plot");
  assert.ok(left >= 0 && left + width <= 390 && height > 250, `${left} ${width} ${height}`);
  const { rect: [, below] } = await lab.widget("theta");
  assert.ok(below > top + height);
}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
