// The traced picture of the page: by a worker, finer and finer, beside OpenGL's.

import assert from "node:assert/strict";
import { crop, differing } from "./support/png.mjs";
import { poll, settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 800, height: 560 } };

/** A sphere that shades the ground. */
const open = async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "shaded.toml", text: `
[camera]
position = [0, 2, 5]
target = [0, 0, 0]
[[object]]
model = "builtin:sphere-smooth"
[[object]]
model = "builtin:cube"
translate = [0, -1.2, 0]
scale = [4, 0.1, 4]
[[light]]
kind = "directional"
direction = [-1, -1, -0.3]
` });
  await lab.until((state) => settled(state) && state.title === "shaded.toml");
};

const middle = async (lab, id) => {
  const picture = await lab.picture(id);
  const [left, top] = [picture.width, picture.height].map((side) => Math.floor(side / 4));
  return crop(picture, left, top, 2 * left, 2 * top);
};

test("the traced picture is refined, starts again with the camera, and ends with its pane", async (lab) => {
  await open(lab);
  const before = await middle(lab, "pane-0");
  await lab.click("view-chooser");
  await lab.click("view-traced");
  const coarse = await lab.until((state) => state.traced[0]?.pictures > 0);
  assert.ok(coarse.traced[0].paths > 0, JSON.stringify(coarse.traced));
  const fine = await lab.until((state) => state.traced[0]?.error !== null);
  assert.ok(fine.traced[0].pictures > coarse.traced[0].pictures && fine.traced[0].paths >= 2, JSON.stringify(fine.traced));
  assert.equal(fine.traced[0].requests, 1, "nothing has changed");
  const { first_ms, longest_ms } = fine.traced[0];
  assert.ok(first_ms > 0 && longest_ms > 0, JSON.stringify(fine.traced));
  await lab.park();
  assert.ok(differing(before, await middle(lab, "pane-0")) > 0.05, "there is no shadow");
  const [x, y] = await lab.middle("pane-0");
  const turned = await lab.drag([x, y], [x + 60, y + 10]);
  assert.ok(turned.traced[0].requests > 1, "the camera was moved");
  await lab.until((state) => state.traced[0]?.error !== null);
  const ended = await lab.key("0");
  assert.deepEqual(ended.traced, [null]);
  assert.ok(ended.pane_settings.length === 1 && settled(ended));
}, options);

/** Notes each request for the path tracer: its worker and its module. */
const watched = (lab) => {
  lab.asked = [];
  lab.page.on("request", (request) => {
    const [name] = /(tracer|gonio-trace)\.[^/]+$/.exec(request.url()) ?? [];
    if (name !== undefined) lab.asked.push(name.endsWith(".js") ? "worker" : "module");
  });
};

test("the path tracer is loaded after the first picture and before a pane asks for it, once", async (lab) => {
  await poll(() => lab.asked.join(), (asked) => asked === "worker,module");
  const [picture, asked] = await lab.page.evaluate(() => {
    const worker = performance.getEntriesByType("resource").find(({ name }) => name.includes("/tracer."));
    return [performance.getEntriesByName("gonio-first-picture")[0].startTime, worker.startTime];
  });
  assert.ok(asked > picture, `the picture came at ${picture} ms, and the tracer was asked for at ${asked} ms`);
  const state = await lab.until(settled);
  assert.deepEqual(state.traced, [null], "nobody has asked for a traced picture");
  await lab.click("view-chooser");
  await lab.click("view-traced");
  await lab.until((state) => state.traced[0]?.pictures > 0);
  assert.deepEqual(lab.asked, ["worker", "module"], "the pane takes the worker that waits for it");
}, { ...options, prepare: watched });

test("a click brings the path tracer while the page is still busy", async (lab) => {
  await lab.until(settled);
  await poll(() => lab.held, Boolean);
  assert.deepEqual(lab.asked, []);
  await lab.click("view-chooser");
  await poll(() => lab.asked.join(), (asked) => asked === "worker,module");
  assert.deepEqual((await lab.state()).traced, [null]);
  lab.release();
}, {
  ...options,
  prepare: async (lab) => {
    watched(lab);
    const gate = new Promise((resolve) => { lab.release = resolve; });
    // One of the other samples, which the page fetches when it is idle.
    await lab.page.route("**/environments-room.*", async (route) => {
      lab.held = true;
      await gate;
      await route.continue();
    });
  },
});

test("it is wiped and compared with OpenGL's picture, and each simplification is one switch", async (lab) => {
  await open(lab);
  await lab.click("tab-compare");
  await lab.click("preset-truth");
  await lab.until((state) => state.traced[0]?.error !== null && state.traced[1] === null);
  await lab.click("difference-mode");
  // Not of the picture that stands in until there is a traced one.
  const { difference } = await lab.until((state) => state.difference !== null && state.traced[0]?.error !== null);
  assert.ok(difference.percent > 1 && difference.percent < 95, JSON.stringify(difference));
  const first = await lab.click("truth-wavelengths");
  assert.deepEqual(first.traced[0].simplified, ["wavelengths"]);
  const again = await lab.click("truth-wavelengths");
  assert.deepEqual(again.traced[0].simplified, []);
  await lab.until((state) => state.traced[0]?.pictures > 0);
  // With all simplifications it is the light equation: but for edges the same as OpenGL's picture.
  await lab.reveal("truth-step");
  const { rect: [left, top, width, height] } = await lab.widget("truth-step");
  await lab.drag([left + 8, top + height / 2], [left + width - 8, top + height / 2]);
  const all = await lab.until(({ traced: [pane], ...state }) =>
    pane.simplified.length === 10 && pane.error !== null && state.difference !== null);
  assert.ok(all.difference.percent < difference.percent / 3, JSON.stringify([difference, all.difference]));
}, options);

test("a click lists the light of the pixel by the way it took, in the same picture", async (lab) => {
  await open(lab);
  await lab.click("view-chooser");
  await lab.click("view-traced");
  await lab.until((state) => state.traced[0]?.pictures > 0);
  const [x, y] = await lab.middle("pane-0");
  await lab.clickAt([x, y]);
  const ways = (state) => Object.fromEntries((state.probe?.traced ?? []).map(([name, , rgb]) => [name, rgb]));
  const state = await lab.until((state) => state.probe?.pinned && ways(state).total !== undefined);
  const { total, emitted, "first bounce": bounce, "the rest": rest, "directional 0": sun } = ways(state);
  assert.ok(sun[0] > 0, JSON.stringify(state.probe));
  assert.ok(Math.abs(total[0] - emitted[0] - bounce[0] - rest[0] - sun[0]) < 1e-4 * total[0], JSON.stringify(state.probe));
  const { requests } = state.traced[0];
  await lab.clickAt([x + 20, y]);
  const other = await lab.until((now) => now.probe?.pixel[0] !== state.probe.pixel[0] && ways(now).total !== undefined);
  assert.equal(other.traced[0].requests, requests);
}, options);

test("a scene in the room is traced: the worker fetches the room itself", async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "mirrored.toml", text: `
[environment]
image = "room"
[[object]]
model = "builtin:cube"
` });
  await lab.until((state) => settled(state) && state.title === "mirrored.toml");
  await lab.click("view-chooser");
  await lab.click("view-traced");
  const { traced: [pane] } = await lab.until((state) => state.traced[0]?.pictures > 0 || state.traced[0]?.failed);
  assert.equal(pane.failed, null);
}, options);
