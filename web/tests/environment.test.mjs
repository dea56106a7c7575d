// The environment's panel and the gallery: studied and converted step by step, because the page has one thread.

import assert from "node:assert/strict";
import { hdr } from "./support/made.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const studied = ({ environment }) => environment?.facts && !environment.running;

test("a panorama that is dropped is studied, and saved as faces and as a cubemap", async (lab) => {
  await lab.until(settled);
  await lab.click("tab-picture");
  await lab.click("environment-panel");
  // Bright above, dark below: it closes at its sides and poles.
  await lab.drop({ name: "evening.hdr", bytes: hdr(64, 32, (_, y) => [200 - 4 * y, 220 - 4 * y, 240 - 4 * y, 129]) });
  const { environment } = await lab.until((state) => studied(state) && state.environment.facts.files === 1);
  assert.deepEqual([environment.facts.arrangement, environment.error], ["equirectangular", null]);
  assert.ok(environment.facts.fits, environment.facts.sentences.join("; "));
  const cubemap = await lab.download(() => lab.click("save-environment-ktx2"));
  assert.equal(cubemap.name, "evening.ktx2");
  assert.deepEqual([...cubemap.bytes.subarray(1, 7)], [..."KTX 20"].map((letter) => letter.charCodeAt(0)));
  const faces = await lab.download(() => lab.click("save-environment-faces-zip"));
  assert.equal(faces.name, "evening_faces.zip");
  for (const face of ["posx", "negx", "posy", "negy", "posz", "negz"]) {
    assert.ok(faces.bytes.includes(`${face}.hdr`), face);
  }
});

test("the gallery draws small pictures, and a click opens the scene", async (lab) => {
  await lab.until(settled);
  await lab.click("samples");
  await lab.click("gallery");
  const { gallery } = await lab.until((state) => state.gallery.open && state.gallery.drawn > 2);
  assert.equal(gallery.sections.length, 12);
  await lab.click("exhibit-phong");
  const state = await lab.until((state) => settled(state) && state.title === "phong.toml");
  assert.deepEqual([state.gallery.open, state.error], [false, null]);
});
