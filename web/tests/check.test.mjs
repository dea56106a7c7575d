// The checker in the page: the verdicts of `gonio lab check`, and checks that end whatever a shader does.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { existsSync } from "node:fs";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { readFiles } from "./support/fixtures.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
const CORPUS = "crates/gonio-check/corpus";
const BUFFERS = "crates/gonio-exercises/tests/buffers";
const HOST = "exercises/ex11-texture-unit/host";

/** What students hand in, by exercise: right and wrong, one mistake and two, what does not compile; GLSL of every age, shaders
 * in C++, buffers and host programs. */
const SUBMISSIONS = {
  ex02: [`${BUFFERS}/house.reference.csv`, `${BUFFERS}/house.start.csv`],
  ex03: [`${CORPUS}/ex03/correct/cpp`, `${CORPUS}/ex03/wrong/normal-raw-fr`, `${CORPUS}/ex03/wrong/broken-vec`],
  ex04: [`${CORPUS}/ex04/correct/webgl1`, `${CORPUS}/ex04/wrong/normal-mv`],
  ex05: [`${CORPUS}/ex05/correct/struct-and-block`, `${CORPUS}/ex05/wrong/pair-sign-and-clamp`],
  ex06: [`${CORPUS}/ex06/correct/ternary-exp2`, `${CORPUS}/ex06/wrong/power-of-negative`, `${CORPUS}/ex06/wrong/broken-float-is-vec3`],
  ex07: [
    `${CORPUS}/ex07/correct/lights-loop-two`,
    `${CORPUS}/ex07/wrong/attenuation-inverse-square`,
    `${CORPUS}/ex07/wrong/pair-m-and-attenuation`,
  ],
  ex08: [`${CORPUS}/ex08/wrong/keeps-translation`],
  ex09: [`${CORPUS}/ex09/correct/unnormalised-view`, `${CORPUS}/ex09/wrong/normal-m`],
  ex10: [`${CORPUS}/ex10/wrong/ratio-inverted`],
  ex12: [`${CORPUS}/ex12/correct/eye-space`, `${CORPUS}/ex12/wrong/no-root`],
  ex13: ["assets/models/still_life.obj"],
  ex11: [`${HOST}/reference.txt`, `${HOST}/texture-name-as-unit.txt`, `${HOST}/stride-wrong.txt`],
};

/** Reads the files of a submission, without `expected.toml`: [{ name, bytes }]. What is not a file is part of a table. */
async function readSubmission(path) {
  const at = join(ROOT, path);
  if (existsSync(at)) return [{ name: basename(at), bytes: await readFile(at) }];
  const files = await readFiles(`${dirname(at)}.txt`, basename(at));
  return files.filter(({ name }) => name !== "expected.toml");
}

/** By the program, which ends with 1 where something is not right. */
async function native(exercise, files) {
  const cwd = await mkdtemp(join(tmpdir(), "gonio-check-"));
  try {
    for (const { name, bytes } of files) await writeFile(join(cwd, name), bytes);
    const names = files.map(({ name }) => name);
    const run = promisify(execFile)(process.env.GONIO_PROGRAM, ["lab", "check", exercise, ...names, "--json"], { cwd });
    const { stdout, code, stderr } = await run.catch((ended) => ended);
    assert.ok(code === undefined || code === 1, stderr);
    return JSON.parse(stdout);
  } finally {
    await rm(cwd, { recursive: true });
  }
}

/** By the page, in its worker. */
async function inPage(lab, exercise, submission) {
  const files = submission.map(({ name, bytes }) => ({ name, base64: bytes.toString("base64") }));
  return lab.page.evaluate(({ exercise, files }) => window.gonio.check(exercise, files.map(({ name, base64 }) => ({
    name,
    bytes: Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)),
  }))), { exercise, files });
}

/** What has to be the same. What a compiler says after its first message, and in which words, is its own affair; and so is a
 * power of a negative base, with which other mistakes may look the same (`or`). */
const said = (verdict) => ({
  verdict: verdict.verdict,
  mistakes: verdict.mistakes.map(({ id, file, line }) => ({ id, file, line })),
  peculiarities: verdict.peculiarities.map(({ id }) => id),
  terms: verdict.terms,
  scenes: verdict.scenes.map(({ scene, right }) => ({ scene, right })),
  message: verdict.messages.slice(0, 1).map(({ file, line }) => ({ file, line })),
  score: verdict.score,
});

/** The exercises that light a model. The others have sky, buffers and host programs. */
const LIT = ["ex03", "ex04", "ex05", "ex06", "ex07"];

for (const [name, isMeant] of [
  ["light", (exercise) => LIT.includes(exercise)],
  ["sky, buffers and host programs", (exercise) => !LIT.includes(exercise)],
]) {
  test(`the page and the program give the same verdicts: ${name}`, async (lab) => {
    await lab.until(settled);
    for (const exercise of Object.keys(SUBMISSIONS).filter(isMeant)) {
      for (const path of SUBMISSIONS[exercise]) {
        const submission = await readSubmission(path);
        const [page, program] = await Promise.all([inPage(lab, exercise, submission), native(exercise, submission)]);
        assert.deepEqual(said(page), said(program), path);
      }
    }
  });
}

/** Right answers, with what `body` does at the start of the fragment shader's `main`. */
async function withBody(body) {
  const files = await readSubmission(`${CORPUS}/ex04/correct/lab-plain`);
  const text = (name) => files.find((file) => file.name === name).bytes.toString();
  const fragment = text("ex04.frag").replace(/(main\s*\(\s*\)\s*\{)/, `$1 ${body}`);
  return [{ name: "ex04.vert", text: text("ex04.vert") }, { name: "ex04.frag", text: fragment }];
}

test("a loop without end ends, and the page lives on", async (lab) => {
  await lab.until(settled);
  const verdict = await lab.page.evaluate((files) => window.gonio.check("ex04", files), await withBody("for (;;) { }"));
  assert.equal(verdict.verdict, "unsure");
  assert.match(verdict.summary, /never ends/);
  // The same worker goes on with the next one, and the page draws.
  const next = await lab.page.evaluate((files) => window.gonio.check("ex04", files), await withBody(""));
  assert.equal(next.verdict, "correct", next.summary);
  const before = (await lab.state()).frame.pictures;
  const [x, y] = await lab.middle("pane-0");
  await lab.drag([x, y], [x + 80, y + 20]);
  await lab.until((state) => state.frame.pictures > before);
});

test("checks may run side by side, and what is no exercise is said", async (lab) => {
  await lab.until(settled);
  const files = await withBody("");
  const [first, second, failed] = await lab.page.evaluate(async (files) => {
    const failed = window.gonio.check("ex99", files).catch((error) => error.message);
    return Promise.all([window.gonio.check("ex04", files), window.gonio.check("ex04", files.slice(1)), failed]);
  }, files);
  assert.equal(first.verdict, "correct", first.summary);
  assert.equal(second.verdict, "unsure", second.summary);
  assert.match(failed, /unknown exercise `ex99`/);
});
