// Text in scripts that gonio's fonts lack: the browser draws it.

import assert from "node:assert/strict";
import { differing } from "./support/png.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

/** In no font: an unassigned code point. */
const NOWHERE = "\u0378";

test("a comment is drawn with the browser's fonts, and a character that it lacks is reported", async (lab) => {
  await lab.until(settled);
  await lab.click("exercises");
  await lab.click("exercise-ex04");
  await lab.until(({ exercise }) => exercise.id === "ex04" && exercise.drawn);
  /** The editor with this comment. All texts have the same length. */
  const editor = async (comment) => {
    await lab.drop({ name: `Нормаль ${comment}.frag`, text: `#version 330 core\n// ${comment}\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n` });
    await lab.until(({ exercise }) => exercise.drawn && !exercise.older && exercise.file.includes(comment));
    await lab.park();
    return lab.picture("editor");
  };
  // DejaVu has Cyrillic and Armenian letters; every Debian system with a browser has a font like it.
  const comments = ["ЖЖЖЖЖЖ", "ШШШШШШ", "ՖՖՖՖՖՖ"];
  const pictures = [];
  for (const comment of comments) pictures.push(await editor(comment));
  assert.deepEqual((await lab.state()).messages, []);
  await editor(NOWHERE.repeat(6));
  const { messages } = await lab.until((state) => state.messages.length > 0);
  assert.equal(messages.length, 1);
  assert.match(messages[0].text, /^No font has the character \u0378 \(U\+0378\), displayed as a box: install a font/);
  await lab.click(`dismiss-${messages[0].id}`);
  await lab.park();
  pictures.push(await lab.picture("editor"));
  for (const [index, picture] of pictures.entries()) {
    for (const other of pictures.slice(0, index)) assert.ok(differing(picture, other) > 0, `${index} is drawn like another`);
  }
  // Known boxes are not reported again.
  await editor(`${NOWHERE.repeat(5)}Ж`);
  assert.deepEqual((await lab.state()).messages, []);
});
