// The stations beyond the rendering equation: computed by a worker, opened by a link, on a phone too.

import assert from "node:assert/strict";
import { differing } from "./support/png.mjs";
import { Lab, settled, suite } from "./support/lab.mjs";

const shared = suite();
const { test } = shared;

const shown = ({ stations }) => stations.open && stations.picture.newest && stations.plot.serial > 0;

test("a station is computed in a worker, and a slider computes it again", async (lab) => {
  await lab.until(settled);
  await lab.click("stations");
  const { stations: first } = await lab.until(shown);
  assert.deepEqual([first.stations.length, first.plot.error], [10, null]);
  await lab.click("station-polarisation");
  const { stations: before } = await lab.until((state) => shown(state) && state.stations.checks !== null);
  assert.ok(before.checks.every(({ holds }) => holds), JSON.stringify(before.checks));
  await lab.until(({ stations }) => stations.picture.samples > 0);
  await lab.click("pause");
  await lab.rest();
  const filtered = await lab.picture("station-picture");
  // The filter is turned by about 90 degrees: the reflection is back.
  const { rect: [left, top, width, height] } = await lab.widget("parameter-angle-slider");
  const at = (share) => [left + share * width, top + height / 2];
  await lab.drag(at(0.5), at(0.2), at(0.02));
  const { stations: turned } = await lab.until(({ stations }) => stations.picture.newest && stations.picture.samples > 0);
  assert.ok(turned.values.angle < 20 && !turned.paused, JSON.stringify(turned));
  await lab.click("pause");
  await lab.rest();
  assert.ok(differing(filtered, await lab.picture("station-picture")) > 0.05, "the picture is as it was");
});

test("a film runs, and leaving ends it and the work", async (lab) => {
  await lab.until(settled);
  await lab.click("stations");
  await lab.until(shown);
  await lab.click("station-interference");
  const { stations: before } = await lab.until(({ stations }) => stations.chosen === "interference");
  await lab.click("film");
  const { stations: after } = await lab.until(({ stations }) => stations.values.time > before.values.time + 1);
  assert.ok(after.playing && after.picture.size[0] > 100, JSON.stringify(after.picture));
  // A film never rests, so the click does not wait for that.
  await lab.page.mouse.move(...await lab.middle("leave"));
  await lab.page.evaluate(async () => {
    for (let i = 0; i < 5; i++) await new Promise(requestAnimationFrame);
  });
  await lab.page.mouse.down();
  await lab.page.mouse.up();
  const { stations: left } = await lab.until(({ stations }) => !stations.open);
  assert.ok(!left.running && !left.playing);
});

test("a link opens a station with its values, and the scene waits", async (lab) => {
  await lab.until(settled);
  const other = await Lab.open(shared, { path: "#station=fog:density=0.05" });
  try {
    const { stations, frame } = await other.until(shown);
    assert.deepEqual([stations.chosen, stations.values.density], ["fog", 0.05]);
    assert.equal(frame.pictures, 0, "the scene is not drawn");
    other.assertNothingWrong();
  } finally {
    await other.close();
  }
});

test("on a phone the picture stays above the pages", async (lab) => {
  await lab.until(settled);
  await lab.click("menu");
  await lab.click("stations");
  await lab.until(shown);
  for (const [page, id] of [["sliders", "parameter-index"], ["law", "station-plot"], ["stations", "station-fog"]]) {
    await lab.click(`page-${page}`);
    const { rect: [left, top, width, height] } = await lab.widget("station-picture");
    assert.ok(left >= 0 && left + width <= 390 && height > 200, `${left} ${width} ${height}`);
    const { rect: [, below] } = await lab.widget(id);
    assert.ok(below > top + height, page);
  }
}, { viewport: { width: 390, height: 844 }, hasTouch: true });
