// The stations beyond the rendering equation: computed by a worker, opened by a link, on a phone too.

import assert from "node:assert/strict";
import { CLIPBOARD, Lab, settled, suite } from "./support/lab.mjs";

const shared = suite();
const { test } = shared;

const shown = ({ stations }) => stations.open && stations.picture.newest && stations.plot.serial > 0;

test("a station is computed in a worker, and a slider computes it again", async (lab) => {
  await lab.until(settled);
  await lab.click("stations");
  const { stations: first } = await lab.until(shown);
  assert.deepEqual([first.stations.length, first.plot.error], [10, null]);
  await lab.click("station-interference");
  const { stations: before } = await lab.until((state) => shown(state) && state.stations.checks !== null);
  assert.ok(before.checks.every(({ holds }) => holds), JSON.stringify(before.checks));
  await lab.click("film");
  const { stations: after } = await lab.until(({ stations }) => stations.values.time !== before.values.time);
  assert.ok(after.playing && after.picture.size[0] > 100, JSON.stringify(after.picture));
  await lab.click("leave");
  const { stations: left } = await lab.until(({ stations }) => !stations.open);
  assert.ok(!left.running && !left.playing);
});

test("a link opens a station with its values", async (lab) => {
  await lab.until(settled);
  const other = await Lab.open(shared, { path: `${lab.url}#station=fog:density=0.05` });
  try {
    const { stations } = await other.until(shown);
    assert.deepEqual([stations.chosen, stations.values.density], ["fog", 0.05]);
    other.assertNothingWrong();
  } finally {
    await other.close();
  }
}, CLIPBOARD);

test("on a phone the picture stays above the pages", async (lab) => {
  await lab.until(settled);
  await lab.click("menu");
  await lab.click("stations");
  await lab.until(shown);
  for (const page of ["sliders", "text", "law"]) {
    const { widgets } = await lab.click(`page-${page}`);
    assert.ok(widgets.some(({ id }) => id === "station-picture"), page);
  }
}, { viewport: { width: 390, height: 844 }, hasTouch: true });
