// Screen readers: the tree that the browser gives them, and what is done through it.

import assert from "node:assert/strict";
import { poll, settled, suite } from "./support/lab.mjs";

const { test } = suite();

const on = { path: "?access" };

/** The browser's accessibility tree: role, name and properties of each node that is not ignored. */
async function tree(lab) {
  const cdp = await lab.context.newCDPSession(lab.page);
  const { nodes } = await cdp.send("Accessibility.getFullAXTree");
  await cdp.detach();
  return nodes.filter(({ ignored }) => !ignored).map(({ role, name, properties = [] }) => ({
    role: role.value,
    name: name?.value ?? "",
    ...Object.fromEntries(properties.map(({ name, value }) => [name, value.value])),
  }));
}

/** A node by role and name, as soon as it is there. */
async function find(lab, role, name) {
  const nodes = await poll(() => tree(lab), (nodes) => nodes.some((node) => node.role === role && node.name === name));
  return nodes.find((node) => node.role === role && node.name === name);
}

/** Gives an element of the mirror the focus, as a screen reader does. */
const focus = (lab, name) => poll(() => lab.page.evaluate((name) => {
  const found = [...document.querySelectorAll("#mirror [aria-label]")].find((element) => element.ariaLabel === name);
  found?.focus();
  return found !== undefined && document.activeElement === found;
}, name), Boolean);

/** The name of the element with the focus, or its id. */
const focused = (lab) => lab.page.evaluate(() => document.activeElement.ariaLabel || document.activeElement.id);

test("the first Tab reaches the switch, which turns support on, off and on at the next visit", async (lab) => {
  await lab.until(settled);
  assert.equal(await lab.page.evaluate(() => document.getElementById("mirror")), null);
  await lab.key("Tab");
  assert.equal(await focused(lab), "access-switch");
  assert.ok(await lab.page.evaluate(() => {
    const { left, top, width, height } = document.activeElement.getBoundingClientRect();
    return document.elementFromPoint(left + width / 2, top + height / 2) === document.activeElement;
  }), "it is not seen");
  await lab.key("Enter");
  await find(lab, "tab", "Lights");
  await lab.key("Enter");
  await poll(() => lab.page.evaluate(() => document.getElementById("mirror")), (mirror) => mirror === null);
  await lab.key("Enter");
  await find(lab, "tab", "Lights");
  const again = await lab.context.newPage();
  lab.watch(again);
  await again.goto(lab.url);
  await poll(() => again.evaluate(() => document.querySelectorAll("#mirror [role=tab]").length), (tabs) => tabs > 3);
});

test("controls have roles, names and states, and are pressed through the mirror", async (lab) => {
  await lab.until(settled);
  for (const [role, name] of [
    ["button", "Open a model or a scene (Ctrl + O)"], ["button", "Undo (Ctrl + Z)"], ["tab", "Lights"], ["tab", "Camera"],
    ["switch", "diffuse term"], ["switch", "specular term"],
  ]) await find(lab, role, name);
  assert.equal((await find(lab, "switch", "diffuse term")).checked, "true");
  const before = await lab.picture("pane-0");
  await focus(lab, "diffuse term");
  assert.equal((await lab.key("Space")).scene.equation.diffuse, false);
  assert.equal((await find(lab, "switch", "diffuse term")).checked, "false");
  assert.notDeepEqual(await lab.picture("pane-0"), before);
  // A shortcut works wherever the focus is.
  assert.equal((await lab.key("Control+z")).scene.equation.diffuse, true);
  await focus(lab, "Lights");
  assert.equal((await lab.key("Enter")).tab, "Lights");
  assert.equal((await find(lab, "tab", "Lights")).selected, true);
  // Elements lie where their widgets are.
  const { rect } = await lab.widget("tab-lights");
  const place = await lab.page.evaluate(() => {
    const { left, top, width, height } = document.activeElement.getBoundingClientRect();
    return [left, top, width, height];
  });
  for (const [index, side] of place.entries()) assert.ok(Math.abs(side - rect[index]) <= 1, `${place} and ${rect}`);
}, on);

test("a number is set, and a step is one of its keys", async (lab) => {
  await lab.until(settled);
  await focus(lab, "Camera");
  await lab.key("Enter");
  const name = await poll(
    () => lab.page.evaluate(() => document.querySelector("#mirror [role=spinbutton]")?.ariaLabel),
    (name) => typeof name === "string",
  );
  await focus(lab, name);
  const first = (await lab.state()).scene.camera;
  const stepped = (await lab.key("ArrowUp")).scene.camera;
  assert.notDeepEqual(stepped, first);
  await lab.page.evaluate(() => document.activeElement.select());
  await lab.page.keyboard.type("7");
  await lab.key("Enter");
  const set = (await lab.rest()).scene.camera;
  assert.notDeepEqual(set, stepped);
  assert.ok(JSON.stringify(set).includes("7"), JSON.stringify(set));
}, on);

test("Tab goes through the mirror once, and nowhere else", async (lab) => {
  await lab.until(settled);
  await focus(lab, "Open a model or a scene (Ctrl + O)");
  const seen = [];
  for (let turns = 0; turns < 25; turns++) {
    await lab.key("Tab");
    assert.ok(await lab.page.evaluate(() => document.activeElement.closest("#mirror") !== null), `after ${seen.at(-1)}`);
    seen.push(await lab.page.evaluate(() => document.activeElement.dataset.node));
  }
  assert.equal(new Set(seen).size, seen.length, "an element came twice");
  await lab.key("Shift+Tab");
  assert.equal(await lab.page.evaluate(() => document.activeElement.dataset.node), seen.at(-2));
}, on);

test("nothing is written while nothing changes", async (lab) => {
  await lab.until(settled);
  await find(lab, "tab", "Lights");
  await lab.rest();
  const writes = await lab.page.evaluate(async () => {
    let count = 0;
    const observer = new MutationObserver((records) => (count += records.length));
    observer.observe(document.getElementById("mirror"), { subtree: true, childList: true, attributes: true, characterData: true });
    for (let frame = 0; frame < 20; frame++) await new Promise(requestAnimationFrame);
    return count;
  });
  assert.equal(writes, 0);
  // One switch is a few writes, not the whole tree.
  const few = await lab.page.evaluate(async () => {
    const changed = new Set();
    const observer = new MutationObserver((records) => records.forEach(({ target }) => changed.add(target)));
    observer.observe(document.getElementById("mirror"), { subtree: true, childList: true, attributes: true, characterData: true });
    [...document.querySelectorAll("#mirror [role=tab]")].find((tab) => tab.ariaLabel === "Camera").click();
    for (let frame = 0; frame < 20; frame++) await new Promise(requestAnimationFrame);
    return [changed.size, document.querySelectorAll("#mirror *").length];
  });
  assert.ok(few[0] > 0 && few[0] < few[1], `${few}`);
}, on);

test("an exercise is checked by keys, and its verdict is announced", async (lab) => {
  await lab.until(settled);
  const exercises = await poll(
    () => lab.page.evaluate(() => [...document.querySelectorAll("#mirror button")].map((b) => b.ariaLabel)),
    (names) => names.some((name) => name?.startsWith("Exercises")),
  );
  await focus(lab, exercises.find((name) => name?.startsWith("Exercises")));
  await lab.key("Enter");
  const names = await poll(
    () => lab.page.evaluate(() => [...document.querySelectorAll("#mirror button")].map((b) => b.ariaLabel)),
    (names) => names.some((name) => name?.startsWith("ex04 ")),
  );
  await focus(lab, names.find((name) => name?.startsWith("ex04 ")));
  await lab.key("Enter");
  await lab.until(({ exercise }) => exercise.id === "ex04" && exercise.drawn);
  await focus(lab, "Check");
  await lab.key("Enter");
  const state = await lab.until(({ exercise }) => exercise.verdict !== null);
  const said = await lab.page.evaluate(() => document.getElementById("announcement").textContent);
  assert.ok(said.toLowerCase().includes(state.exercise.verdict.word), `${said}: ${state.exercise.verdict.word}`);
  assert.ok((await tree(lab)).some(({ role, name }) => role === "StaticText" && name === said || name === said), said);
}, on);
