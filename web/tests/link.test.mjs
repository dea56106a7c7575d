// A link that carries the scene.

import assert from "node:assert/strict";
import { assertSame } from "./support/png.mjs";
import { CLIPBOARD, fetched, Lab, settled, suite } from "./support/lab.mjs";

const shared = suite();
const { test } = shared;

const options = { ...CLIPBOARD, viewport: { width: 740, height: 560 } };

/** Opens an address of the page where nobody was before. */
const elsewhere = async (address, look) => {
  const other = await Lab.open(shared, { path: address, viewport: options.viewport });
  try {
    await look(other, await other.until(settled));
    other.assertNothingWrong();
  } finally {
    await other.close();
  }
};

test("a link brings the same scene to somebody else", async (lab) => {
  await lab.until(settled);
  await fetched(lab);
  await lab.click("samples");
  await lab.click("sample-light-kinds");
  await lab.until((state) => settled(state) && state.title === "light-kinds");
  const [x, y] = await lab.middle("pane-0");
  await lab.drag([x, y + 150], [x + 50, y + 180]);
  await lab.click("term-ambient");
  await lab.click("light-1-on");
  await lab.click("save");
  const sent = await lab.click("copy-link");
  assert.match(sent.announcement, /link/);
  const link = await lab.clipboard();
  assert.ok(link.startsWith(`${lab.url}#scene=`) && link.length < 4000, link);
  const picture = await lab.saved();
  await elsewhere(link, async (other, state) => {
    assert.deepEqual([state.messages, state.scene], [[], sent.scene]);
    assertSame(picture, await other.saved(), "the scene is the same, and its picture another one");
  });
}, options);

test("what a link cannot carry is said, and so is a damaged one", async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "mine.obj", text: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" });
  await lab.until((state) => settled(state) && state.title === "mine.obj");
  await lab.click("save");
  const refused = await lab.click("copy-link");
  assert.match(refused.error, /mine\.obj/);
  await elsewhere(`${lab.url}#scene=AAAA`, async (other, state) => {
    assert.equal(state.title, "still-life");
    assert.match(state.error, /damaged/);
  });
}, options);
