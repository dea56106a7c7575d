// A student's evening on the page in French, with the keyboard alone.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { CLIPBOARD, poll, settled, suite } from "./support/lab.mjs";

const { test } = suite();

const EXERCISE = join(dirname(fileURLToPath(import.meta.url)), "../../exercises/ex04-phong-diffuse");

/** Presses Tab until a widget has the focus. */
async function tabTo(lab, id) {
  const passed = new Set();
  for (let presses = 0; presses < 250; presses += 1) {
    const { widgets } = await lab.state();
    for (const widget of widgets) if (widget.focused) passed.add(widget.id);
    if (widgets.some((widget) => widget.id === id && widget.focused)) return;
    // The editor keeps Tab for itself until Escape leaves it; Tab then goes on behind it.
    if (widgets.some((widget) => widget.id === "editor" && widget.focused)) {
      await lab.page.keyboard.press("Escape");
      await lab.rest();
    }
    await lab.page.keyboard.press("Tab");
    await lab.rest();
  }
  assert.fail(`Tab does not reach ${id}, but ${[...passed].join(", ")}`);
}

test("exercise 04 is found, broken, judged and fixed by keys, in French, with a comment in Chinese", async (lab) => {
  await lab.until(settled);
  assert.equal(await lab.page.evaluate(() => document.documentElement.lang), "fr");
  await tabTo(lab, "exercises");
  await lab.page.keyboard.press("Enter");
  await lab.until(({ widgets }) => widgets.some(({ id }) => id === "exercise-ex04"));
  await tabTo(lab, "exercise-ex04");
  await lab.page.keyboard.press("Enter");
  const { exercise } = await lab.until(({ exercise }) => exercise.id === "ex04" && exercise.drawn);
  for (const [index, { name }] of exercise.files.entries()) {
    const ending = /\.(vert|frag)$/.exec(name)?.[1];
    if (ending === undefined) continue;
    const right = await readFile(join(EXERCISE, `reference.${ending}`), "utf8");
    await lab.page.evaluate((text) => navigator.clipboard.writeText(text), right.replace("mat3(itM)", "mat3(M)"));
    await tabTo(lab, `file-${index}`);
    await lab.page.keyboard.press("Enter");
    await lab.until(({ exercise }) => exercise.file === name);
    await tabTo(lab, "editor");
    await lab.page.keyboard.press("Control+a");
    await lab.page.keyboard.press("Control+v");
    await lab.until(({ exercise }) => exercise.files.some((file) => file.name === name && file.changed));
    await lab.page.keyboard.insertText("// 法线归一化");
    await lab.rest();
    await lab.page.keyboard.press("Escape");
  }
  await lab.until(({ exercise }) => exercise.drawn && !exercise.older);
  await lab.page.keyboard.press("Control+Enter");
  const wrong = await lab.until(({ exercise }) => exercise.verdict !== null);
  const { word, mistakes, summary } = wrong.exercise.verdict;
  assert.deepEqual([word, mistakes], ["wrong", ["normal-by-model-matrix"]], summary);
  assert.match(summary, /normale/);
  // The editor takes the focus to show the line, in the file where it is; the student corrects it.
  await lab.until(({ exercise }) => exercise.file.endsWith(".vert"));
  await lab.rest();
  await tabTo(lab, "editor");
  const fix = await readFile(join(EXERCISE, "reference.vert"), "utf8");
  await lab.page.evaluate((text) => navigator.clipboard.writeText(text), fix);
  await lab.page.keyboard.press("Control+a");
  await lab.page.keyboard.press("Control+v");
  await lab.rest();
  await lab.page.keyboard.press("Control+Enter");
  const fixed = await poll(() => lab.state(), ({ exercise }) => exercise.verdict?.word === "correct");
  assert.doesNotMatch(fixed.exercise.verdict.summary, /\b(the|is|of)\b/);
}, { path: "?language=fr", ...CLIPBOARD });
