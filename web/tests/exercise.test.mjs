// Exercises in the page: a student's files dropped and chosen, and original files downloaded.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, readdir, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { crc32 } from "node:zlib";
import { differing } from "./support/png.mjs";
import { png, zip } from "./support/made.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const EXERCISES = join(dirname(fileURLToPath(import.meta.url)), "../../exercises");
const text = (name) => readFile(join(EXERCISES, name), "utf8");

const GREEN = "#version 330 core\nout vec4 FragColor;\nvoid main() { FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n";

/** With room for the whole list of exercises. */
const tall = { viewport: { width: 1280, height: 1200 } };

/** Begins an exercise, and waits for its picture where it has one. */
async function begin(lab, id) {
  await lab.until(settled);
  if (!(await lab.state()).widgets.some(({ id }) => id === "exercises")) await lab.click("menu");
  await lab.click("exercises");
  await lab.click(`exercise-${id}`);
  return lab.until(({ exercise }) => exercise.id === id && (exercise.drawn || exercise.tried || id === "ex02" || id === "s1"));
}

/** The panorama's six faces, as the program makes them. */
async function rightFaces() {
  const folder = await mkdtemp(join(tmpdir(), "gonio-faces-"));
  try {
    const panorama = join(EXERCISES, "s1-panorama-to-cubemap/panorama.png");
    await promisify(execFile)(process.env.GONIO_PROGRAM, ["environment", "convert", panorama, folder, "--quiet"]);
    const names = await readdir(folder);
    return await Promise.all(names.map(async (name) => ({ name, bytes: await readFile(join(folder, name)) })));
  } finally {
    await rm(folder, { recursive: true });
  }
}

const shown = ({ exercise }) => exercise.files.filter((file) => file.shown).map((file) => file.name);

test("files that are dropped take the place of their kind, and what was written is put back", async (lab) => {
  await begin(lab, "ex04");
  await lab.click("editor");
  await lab.page.keyboard.type("// mine ");
  await lab.until(({ exercise }) => exercise.files.some(({ name, changed }) => changed && name === "start.frag"));
  await lab.drop({ name: "My light.txt", text: GREEN });
  const state = await lab.until(({ exercise }) => exercise.file === "My light.txt" && exercise.drawn);
  assert.deepEqual([shown(state), state.exercise.before, state.messages], [["start.vert", "My light.txt"], 1, []]);
  assert.match(state.announcement, /opened My light.txt in place of start.frag/);
  await lab.rest();
  const green = await lab.picture("picture-yours");
  await lab.click("put-back");
  const back = await lab.until(({ exercise }) => exercise.file === "start.frag");
  assert.ok(back.exercise.files.some(({ name, changed }) => changed && name === "start.frag"));
  // A pair in a zip, with the exercise's own text beside: right, and said to be.
  const files = await Promise.all(["reference.vert", "reference.frag", "text.md"].map(async (name) => ({ name: `mine/${name}`, text: await text(`ex04-phong-diffuse/${name}`) })));
  await lab.drop({ name: "mine.zip", bytes: zip(files) });
  const pair = await lab.until(({ exercise }) => exercise.file === "mine/reference.frag" && exercise.drawn && !exercise.older);
  assert.deepEqual([shown(pair), pair.exercise.before, pair.messages], [["mine/reference.frag", "mine/reference.vert"], 2, []]);
  await lab.rest();
  assert.ok(differing(green, await lab.picture("picture-yours")) > 0.05, "it is drawn anew");
  await lab.click("check");
  const judged = await lab.until(({ exercise }) => exercise.verdict !== null);
  assert.equal(judged.exercise.verdict.word, "correct", judged.exercise.verdict.summary);
});

test("what is nothing for the exercise is one sentence, and changes nothing", async (lab) => {
  const before = await begin(lab, "ex04");
  for (const [file, said] of [
    [{ name: "photo.png", bytes: png(2, 2, () => [0, 0, 0]) }, /^ex04 does not read photo\.png/],
    [{ name: "cow.obj", text: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" }, /^cow\.obj is a model: leave the exercises/],
    [{ name: "broken.zip", bytes: zip([{ name: "a.frag", text: GREEN }]).subarray(0, 60) }, /broken\.zip.*damaged/],
  ]) {
    await lab.drop(file);
    const state = await lab.until(({ error }) => error !== null);
    assert.match(state.error, said);
    assert.deepEqual([state.exercise.files, state.title, state.exercise.open], [before.exercise.files, "still-life", true]);
    for (const { id } of state.messages) await lab.click(`dismiss-${id}`);
  }
  // In the scene the same model is opened.
  await lab.click("leave");
  await lab.drop({ name: "cow.obj", text: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" });
  await lab.until((state) => settled(state) && state.title === "cow.obj");
});

test("files are chosen by a button, also six pictures and a buffer", async (lab) => {
  await begin(lab, "s1");
  const choose = async (...files) => {
    const asked = lab.page.waitForEvent("filechooser");
    await lab.click("open-files");
    const chooser = await asked;
    assert.ok(chooser.isMultiple());
    await chooser.setFiles(files.map(({ name, text, bytes }) => ({ name, mimeType: "", buffer: Buffer.from(bytes ?? text) })));
  };
  await choose(...await rightFaces());
  const state = await lab.until(({ exercise }) => exercise.before === 1);
  assert.equal(shown(state).length, 6);
  await lab.click("check");
  const judged = await lab.until(({ exercise }) => exercise.verdict !== null);
  assert.equal(judged.exercise.verdict.word, "correct", JSON.stringify(judged.exercise.verdict));
  await lab.click("exercises");
  await lab.click("exercise-ex02");
  await choose({ name: "cube.csv", text: "1,2,3\n4,5,6\n7,8,9\n" });
  await lab.until(({ exercise }) => exercise.id === "ex02" && exercise.file === "cube.csv");
}, tall);

test("a file is saved as it is, and all that one starts from as a zip", async (lab) => {
  await begin(lab, "s1");
  const one = await lab.download(() => lab.click("save-files"));
  assert.deepEqual([one.name, one.bytes.toString()], ["start.frag", await text("s1-panorama-to-cubemap/start.frag")]);
  await lab.click("page-text");
  const [x, y] = await lab.middle("page-text");
  await lab.page.mouse.move(x, y + 120);
  for (let turns = 0; turns < 12; turns++) await lab.page.mouse.wheel(0, 2000);
  await lab.rest();
  const { name, bytes } = await lab.download(() => lab.click("start-files"));
  assert.equal(name, "s1.zip");
  for (const inside of ["start.vert", "start.frag", "text.md", "faces.svg", "panorama.png"]) {
    const wanted = await readFile(join(EXERCISES, "s1-panorama-to-cubemap", inside));
    // Nothing is compressed, and each is told with its checksum.
    assert.ok(bytes.includes(wanted), inside);
    const sum = Buffer.alloc(4);
    sum.writeUInt32LE(crc32(wanted));
    assert.ok(bytes.includes(sum), inside);
  }
  assert.ok(!bytes.includes("reference.frag"), "the answer is not among them");
}, tall);

test("on a phone files are opened and put back, and figures are shown", async (lab) => {
  await begin(lab, "ex04");
  await lab.click("page-text");
  const state = await lab.until(({ widgets }) => widgets.some(({ id }) => id.startsWith("figure-")));
  assert.ok(state.widgets.find(({ id }) => id.startsWith("figure-")).rect[2] > 300);
  await lab.click("page-files");
  await lab.drop({ name: "a.frag", text: GREEN });
  await lab.until(({ exercise }) => exercise.file === "a.frag" && exercise.drawn);
  await lab.click("put-back");
  await lab.until(({ exercise }) => exercise.file === "start.frag");
}, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
