// Files that are dropped on the page.

import assert from "node:assert/strict";
import { assertSame, differing } from "./support/png.mjs";
import { hdr, png, zip } from "./support/made.mjs";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const options = { viewport: { width: 740, height: 560 } };

/** A square that faces the viewer, its left half green and its right half magenta. */
const OBJ = `mtllib square.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl painted
f 1/1/1 2/2/1 3/3/1
f 1/1/1 3/3/1 4/4/1
`;
const MODEL = { name: "square.obj", text: OBJ };
const MATERIALS = { name: "square.mtl", text: "newmtl painted\nKa 1 1 1\nKd 1 1 1\nmap_Kd paint.png\n" };
const TEXTURE = { name: "paint.png", bytes: png(16, 16, (x) => (x < 8 ? [0, 255, 0] : [255, 0, 255])) };

const opened = (lab, title) => lab.until((state) => settled(state) && state.title === title);

/** How many pixels are rather green, and rather magenta. */
const painted = (picture) => {
  let [green, magenta] = [0, 0];
  for (let i = 0; i < picture.rgb.length; i += 3) {
    const [r, g, b] = picture.rgb.subarray(i, i + 3);
    if (g > r + 60 && g > b + 60) green++;
    if (r > g + 60 && b > g + 60) magenta++;
  }
  return [green, magenta].map((count) => count / (picture.width * picture.height));
};

test("a model, its materials and its texture are dropped together, in any order, or as a zip", async (lab) => {
  const first = await lab.until(settled);
  const seen = [];
  const folder = [MODEL, MATERIALS, TEXTURE].map((file) => ({ ...file, name: `square/${file.name}` }));
  for (const [title, ...files] of [
    ["square.obj", MODEL, MATERIALS, TEXTURE],
    ["square.obj", TEXTURE, MATERIALS, MODEL],
    ["square.obj", { name: "square.zip", bytes: zip([MATERIALS, TEXTURE, MODEL]) }],
    ["square.obj", { name: "archive.zip", bytes: zip(folder) }],
  ]) {
    const before = (await lab.state()).generation;
    await lab.drop(...files);
    await lab.until((state) => settled(state) && state.generation > before);
    const state = await lab.rest();
    const names = files.map(({ name }) => name).join(", ");
    assert.deepEqual([state.title, state.triangles, state.error, state.messages], [title, 2, null, []], names);
    const picture = await lab.saved();
    const [green, magenta] = painted(picture);
    assert.ok(green > 0.05 && magenta > 0.05, `${names}: ${green} green, ${magenta} magenta`);
    seen.push(picture);
  }
  assert.notDeepEqual((await lab.state()).scene, first.scene);
  for (const other of seen.slice(1)) assertSame(seen[0], other);
}, options);

test("a model without its materials is shown, and the file that lacks is named until that is read", async (lab) => {
  await lab.until(settled);
  await lab.drop(MODEL);
  const state = await opened(lab, "square.obj");
  assert.deepEqual([state.triangles, state.error], [2, null]);
  const warnings = state.messages.filter(({ severity }) => severity === "warning");
  assert.ok(warnings.some(({ text }) => text.includes("square.mtl")), JSON.stringify(state.messages));
  const [green, magenta] = painted(await lab.saved());
  assert.deepEqual([green, magenta], [0, 0]);
  for (const { id } of state.messages) await lab.click(`dismiss-${id}`);
  assert.deepEqual((await lab.state()).messages, []);
  // The texture alone is missing.
  await lab.drop(MODEL, MATERIALS);
  const told = await lab.until((state) => settled(state) && state.messages.length > 0);
  assert.ok(told.messages.some(({ severity, text }) => severity === "warning" && text.includes("paint.png")), JSON.stringify(told.messages));
  // It is adopted when it is dropped later, not taken for an environment.
  await lab.drop(TEXTURE);
  const adopted = await lab.until((state) => settled(state) && state.messages.length === 0);
  assert.deepEqual([adopted.title, adopted.scene.environment ?? null], ["square.obj", told.scene.environment ?? null]);
  await lab.rest();
  const [greenLater, magentaLater] = painted(await lab.saved());
  assert.ok(greenLater > 0.05 && magentaLater > 0.05, `${greenLater} green, ${magentaLater} magenta`);
}, options);

test("the File panel lists what a model lacks, shows the lines of values, and saves the model", async (lab) => {
  await lab.until(settled);
  await lab.drop(MODEL, MATERIALS);
  await opened(lab, "square.obj");
  await lab.click("tab-file");
  const read = ({ file }) => !file.reading && file.models.length === 1 && file.models[0].reading === undefined;
  const { file: { chosen, models: [model] } } = await lab.until(read);
  assert.deepEqual([chosen, model.format, model.triangles, model.missing], ["square.obj", "obj", 2, ["paint.png"]]);
  await lab.drop(TEXTURE);
  await lab.until((state) => read(state) && state.file.models[0].missing.length === 0);
  await lab.click("file-material-0-diffuse-line");
  const { file: { lines } } = await lab.until(({ file }) => file.lines !== null);
  assert.deepEqual([lines.file, lines.line, lines.text, lines.error], ["square.mtl", 3, "Kd 1 1 1", null]);
  await lab.click("file-lines-close");
  const glb = await lab.download(() => lab.click("save-model-glb"));
  assert.deepEqual([glb.name, glb.bytes.subarray(0, 4).toString()], ["square.glb", "glTF"]);
  // Several files are packed.
  const { name, bytes } = await lab.download(() => lab.click("save-model-obj"));
  assert.equal(name, "square_converted.zip");
  for (const part of ["square_converted.obj", "square_converted.mtl", "square_converted_paint.png"]) assert.ok(bytes.includes(part), part);
}, options);

test("a file that cannot be read leaves everything as it was, and says where it is broken", async (lab) => {
  await lab.until(settled);
  await lab.click("term-emitted");
  const before = await lab.park();
  const picture = await lab.saved();
  const broken = [
    // The fourth number of the third line is none; the fourth line has a word that is no key of a scene.
    [{ name: "broken.obj", text: "v 0 0 0\nv 1 0 0\nv 0 1 x\nf 1 2 3\n" }, /broken\.obj.*\b3:7\b|broken\.obj.*line 3, column 7/],
    [{ name: "broken.toml", text: "[camera]\nposition = [0, 0, 5]\n[[object]]\nmodle = \"builtin:cube\"\n" }, /broken\.toml.*\b4\b.*\b1\b/],
    [{ name: "broken.glb", bytes: Buffer.from("glTF\x02\0\0\0\x40\0\0\0", "latin1") }, /broken\.glb/],
    [{ name: "broken.zip", bytes: zip([MODEL]).subarray(0, 120) }, /broken\.zip/],
    [{ name: "notes.txt", text: "nothing to see" }, /notes\.txt.*cannot be opened/],
  ];
  for (const [file, said] of broken) {
    await lab.drop(file);
    const state = await lab.until((state) => state.error !== null && state.busy === null);
    assert.match(state.error, said);
    const facts = ({ scene, title, triangles, generation, undo }) => ({ scene, title, triangles, generation, undo });
    assert.deepEqual(facts(state), facts(before), file.name);
    for (const { id } of state.messages) await lab.click(`dismiss-${id}`);
    assert.equal((await lab.rest()).error, null);
  }
  assertSame(picture, await lab.saved(), "the picture is another one");
  // And what was done before can still be undone.
  assert.equal((await lab.key("Control+z")).undo, false);
}, options);

test("a panorama that is dropped is the environment", async (lab) => {
  await lab.until(settled);
  const before = await lab.park();
  const picture = await lab.saved();
  const sky = png(64, 32, (x, y) => (y < 16 ? [40, 90, 255] : [30, 160, 40]));
  await lab.drop({ name: "sky.png", bytes: sky });
  const blue = await lab.until((state) => settled(state) && state.scene.environment?.image === "sky.png");
  assert.deepEqual([blue.error, blue.messages, blue.title], [null, [], "still-life"]);
  assert.deepEqual(blue.scene.object, before.scene.object);
  await lab.rest();
  const below = await lab.saved();
  assert.ok(differing(picture, below) > 0.2, "no environment is seen");
  // The camera looks down: what is seen behind the floor is the lower half.
  const [r, g, b] = below.at(below.width - 10, below.height - 10);
  assert.ok(g > r + 40 && g > b + 40, `${[r, g, b]} is not green`);
  // Another one takes its place: red, from a Radiance picture.
  await lab.drop({ name: "red.hdr", bytes: hdr(16, 8, () => [200, 20, 20, 128]) });
  await lab.until((state) => settled(state) && state.scene.environment?.image === "red.hdr");
  await lab.rest();
  const red = (await lab.saved()).at(below.width - 10, below.height - 10);
  assert.ok(red[0] > red[1] + 60 && red[0] > red[2] + 60, `${red} is not red`);
  await lab.key("Control+z");
  await lab.until((state) => settled(state) && state.scene.environment?.image === "sky.png");
  await lab.rest();
  assertSame(below, await lab.saved());
  await lab.key("Control+z");
  const back = await lab.until((state) => settled(state) && !state.scene.environment);
  assert.deepEqual(back.scene, before.scene);
  await lab.rest();
  assertSame(picture, await lab.saved());
}, options);

test("a model and a panorama are dropped together", async (lab) => {
  await lab.until(settled);
  await lab.drop({ name: "light.hdr", bytes: hdr(16, 8, () => [128, 128, 128, 128]) }, MODEL, TEXTURE, MATERIALS);
  const state = await opened(lab, "square.obj");
  assert.deepEqual([state.messages, state.scene.environment.image], [[], "light.hdr"]);
  const [green, magenta] = painted(await lab.saved());
  assert.ok(green > 0.05 && magenta > 0.05);
}, options);

const OWN = `#version 300 es
precision highp float;
in vec3 normal;
uniform float gain;
out vec4 c;
void main() {
    vec3 n = normalize(normal);
    c = vec4(gain * abs(n.y), 0.0, 0.0, 1.0);
}
`;

test("shaders that are dropped draw the scene and are stepped through, and an error keeps the last good ones", async (lab) => {
  await lab.until(settled);
  await lab.park();
  const before = await lab.saved();
  await lab.drop({ name: "own.frag", text: OWN }, { name: "names.toml", text: "[names]\ngain = 1.0\n" });
  const drawn = await lab.until((state) => settled(state) && state.shaders?.compiled);
  assert.deepEqual([drawn.shaders.failed, drawn.error, drawn.tab, drawn.title], [false, null, "Shaders", "still-life"]);
  assert.equal(drawn.shaders.uniforms[0].origin, "names.toml");
  await lab.rest();
  const red = await lab.saved();
  assert.ok(differing(before, red) > 0.2, "the picture is gonio's");
  await lab.click("pane-0");
  const stepped = await lab.until(({ shaders }) => shaders.step?.busy === false && shaders.step.values);
  assert.deepEqual([stepped.shaders.text, stepped.shaders.step.message, stepped.shaders.step.line], ["own.frag", null, 8]);
  const beside = (line) => stepped.shaders.step.values.find((value) => value.line === line).text.replace(/[()]/g, "").split(", ").map(Number);
  assert.ok(Math.abs(Math.hypot(...beside(7)) - 1) < 1e-3, JSON.stringify(stepped.shaders.step.values));
  assert.ok(Math.abs(beside(8)[0] - Math.abs(beside(7)[1])) < 1e-3);
  await lab.key("Shift+F10");
  await lab.until(({ shaders }) => shaders.step.line === 7);
  // An error has its line, and the picture stays.
  await lab.click("step-unpin");
  await lab.drop({ name: "own.frag", text: OWN.replace("gain * abs", "gian * abs") });
  const failed = await lab.until(({ shaders }) => shaders.failed);
  assert.match(failed.error, /^own\.frag:8:.*gian/);
  assert.equal(failed.shaders.compiled, true);
  for (const { id } of failed.messages) await lab.click(`dismiss-${id}`);
  await lab.rest();
  // The number of samples at edges follows the time that a picture takes.
  assert.ok(differing(red, await lab.saved()) < 0.01, "the picture is another one");
  await lab.click("shader-texts");
  assert.equal((await lab.widget("note-0")).value, "8");
  // A loop that never ends is not drawn, and closing the shaders brings gonio's picture back.
  await lab.drop({ name: "own.frag", text: OWN.replace("    c =", "    while (n.x > -2.0) n.y += 0.1;\n    c =") });
  const endless = await lab.until(({ shaders }) => shaders.remarks.some((remark) => remark.includes("does not end")));
  assert.equal(endless.shaders.failed, true);
  for (const { id } of endless.messages) await lab.click(`dismiss-${id}`);
  await lab.click("close-texts");
  await lab.click("close-shaders");
  const closed = await lab.until((state) => settled(state) && state.shaders === null);
  assert.deepEqual(closed.messages, []);
  await lab.rest();
  assert.ok(differing(before, await lab.saved()) < 0.01, "the picture is not gonio's");
});
