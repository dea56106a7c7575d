// The page in a browser, as a test sees it: everything that goes wrong is collected, and fails the test.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { launch } from "./chromium.mjs";
import { assertSame, decode, differing } from "./png.mjs";
import { serve } from "./server.mjs";

/** Milliseconds that a machine without a graphics card may need. No test is judged by it: it ends those that hang. */
export const PATIENCE = 90_000;

/** One browser and one server for all tests of a file. */
export function suite() {
  const shared = {};
  before(async () => {
    shared.server = await serve();
    shared.browser = await launch();
  });
  after(async () => {
    await shared.browser?.close();
    await shared.server?.stop();
  });
  /** A test with a page of its own. `options` are Playwright's of a context, and `path` below the server's top. */
  shared.test = (name, run, options = {}) => test(name, { timeout: 3 * PATIENCE }, async () => {
    const lab = await Lab.open(shared, options);
    try {
      await run(lab);
      lab.assertNothingWrong();
    } finally {
      await lab.close();
    }
  });
  return shared;
}

/** Options of a context that may look at the clipboard. */
export const CLIPBOARD = { permissions: ["clipboard-read", "clipboard-write"] };

/** Nothing is being read, and the picture is of what is open. */
export const settled = (state) => state?.loaded && state.busy === null && state.frame.complete;

/** Hints of the browser about speed, that are no fault: screenshots read pixels, and so does egui when a font lacks a
 * character and the browser draws it instead. */
const HINTS = ["GPU stall due to ReadPixels", "willReadFrequently"];

export class Lab {
  /** What went wrong in the page: errors and warnings on its console, errors nobody caught, broken requests. */
  wrong = [];
  #expected = [];
  /** Where and when was clicked last. */
  #clicked = { x: NaN, y: NaN, at: 0 };

  static async open({ browser, server }, { path = "", wait = true, prepare, ...options } = {}) {
    const lab = new Lab();
    lab.url = new URL(path, server.url).href;
    lab.context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    lab.page = await lab.context.newPage();
    lab.watch(lab.page);
    await prepare?.(lab);
    await lab.page.goto(lab.url);
    if (wait) await lab.running();
    return lab;
  }

  watch(page) {
    page.on("console", (message) => {
      const hint = HINTS.some((text) => message.text().includes(text));
      if (["error", "warning"].includes(message.type()) && !hint) this.wrong.push(`console: ${message.text()}`);
    });
    page.on("pageerror", (error) => this.wrong.push(`error: ${error.message}`));
    page.on("requestfailed", (request) => this.wrong.push(`request: ${request.url()}: ${request.failure()?.errorText}`));
    page.on("crash", () => this.wrong.push("the page crashed"));
  }

  /** What has to go wrong in this test, by a piece of its text. */
  expect(...pieces) {
    this.#expected.push(...pieces);
  }

  assertNothingWrong() {
    const unexpected = this.wrong.filter((text) => !this.#expected.some((piece) => text.includes(piece)));
    assert.deepEqual(unexpected, []);
    for (const piece of this.#expected) {
      assert.ok(this.wrong.some((text) => text.includes(piece)), `expected, and it did not happen: ${piece}`);
    }
  }

  /** Waits until the application's first frame is there. */
  async running() {
    const ended = () => document.body.classList.contains("running") || !document.getElementById("trouble").hidden;
    await poll(() => this.page.evaluate(ended), (done) => done);
    const trouble = await this.trouble();
    assert.equal(trouble, null, `the page says: ${trouble}`);
  }

  /** What the page says in place of the application, or null. */
  trouble() {
    return this.page.evaluate(() => {
      const trouble = document.getElementById("trouble");
      return trouble.hidden ? null : trouble.innerText;
    });
  }

  /** The application's state: see `gonio_app::exported`. */
  state() {
    return this.page.evaluate(() => window.gonio.state());
  }

  /** Waits until `holds` is true of the state, and gives that state. */
  until(holds) {
    return poll(() => this.state(), holds);
  }

  /** A widget by its id. */
  async widget(id) {
    const { widgets } = await this.state();
    const found = widgets.find((widget) => widget.id === id);
    assert.ok(found, `there is no widget ${id}; there are: ${widgets.map((widget) => widget.id).join(" ")}`);
    return found;
  }

  /** A widget's middle, in CSS pixels. */
  async middle(id) {
    const { rect: [left, top, width, height] } = await this.widget(id);
    return [left + width / 2, top + height / 2];
  }

  /** Waits until the application paints no more, and gives its state: what was done has come to its end. It paints with
   * the browser's frames: where three of those pass without one of its own, it has nothing left to do. */
  rest() {
    return poll(() => this.page.evaluate(async () => {
      // Asked for here as long as that takes no longer than a picture or two: each question from outside takes time too.
      let before = window.gonio.state();
      for (let turns = 0; turns < 20 && before !== null; turns++) {
        for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
        const state = window.gonio.state();
        if (state === null || (state.busy === null && state.frame.frames === before.frame.frames)) return state;
        before = state;
      }
      return null;
    }), (state) => state !== null);
  }

  /** Clicks a widget once it is there and all is still, and gives the state that comes of it. `hold`: a key that is held
   * down meanwhile. */
  async click(id, { hold, ...options } = {}) {
    await this.until((state) => state.widgets.some((widget) => widget.id === id));
    await this.rest();
    await this.reveal(id);
    await this.clickAt(await this.middle(id), { hold, ...options });
    return this.rest();
  }

  /** Scrolls the panel to a widget that lies below or above what is seen of it. */
  async reveal(id) {
    // The tray of messages lies at the bottom and is never scrolled away.
    if (/^(dismiss|copy)-|^(restore-scene|messages-all)$/.test(id)) return;
    const { width, height } = this.page.viewportSize() ?? { width: Infinity, height: Infinity };
    for (let turns = 0; turns < 8; turns++) {
      const { clip: [, clipTop, , clipHeight] } = await this.widget(id);
      const [x, y] = await this.middle(id);
      // The status line stands below the panel.
      const bottom = Math.min(clipTop + clipHeight, height - 50);
      const below = y - bottom;
      const above = clipTop - y;
      if (below <= 0 && above <= 0) return;
      await this.page.mouse.move(Math.min(x, width - 30), bottom - 50);
      await this.page.mouse.wheel(0, below > 0 ? below + 60 : -(above + 60));
      await this.rest();
    }
    assert.fail(`${id} cannot be scrolled to`);
  }

  /** Clicks a place. What is under the pointer is known to the application a frame after it came there. */
  async clickAt([x, y], { hold, ...options } = {}) {
    await this.page.mouse.move(x, y);
    await this.rest();
    // Nobody here means a double click, and what is one is a matter of seconds: egui's default is 0.3.
    const since = Date.now() - this.#clicked.at;
    if (Math.hypot(x - this.#clicked.x, y - this.#clicked.y) < 8 && since < 350) {
      await new Promise((resolve) => setTimeout(resolve, 350 - since));
    }
    if (hold) await this.page.keyboard.down(hold);
    await this.page.mouse.down(options);
    await this.page.mouse.up(options);
    this.#clicked = { x, y, at: Date.now() };
    await this.rest();
    if (hold) await this.page.keyboard.up(hold);
  }

  /** Takes hold at a place and goes to others, in steps, as a hand does. */
  async drag(from, ...to) {
    await this.page.mouse.move(...from);
    await this.rest();
    await this.page.mouse.down();
    for (const [x, y] of to) await this.page.mouse.move(x, y, { steps: 3 });
    await this.page.mouse.up();
    return this.rest();
  }

  /** Presses a key or a combination such as `Control+z`. */
  async key(key) {
    await this.page.keyboard.press(key);
    return this.rest();
  }

  /** The pointer where it points at nothing: no tooltip hides what is looked at. */
  async park() {
    await this.page.mouse.move(2, 2);
    return this.rest();
  }

  /** Drops files on the picture, or in the middle of an exercise or the bench, all at once and in this order: each a `name`, and `text` or `bytes`. */
  async drop(...files) {
    const { size, exercise, bench } = await this.state();
    const [x, y] = exercise.open || bench.open ? size.map((side) => side / 2) : await this.middle("pane-0");
    const packed = files.map(({ name, text, bytes }) => ({ name, base64: Buffer.from(bytes ?? text).toString("base64") }));
    await this.page.evaluate(({ packed, x, y }) => {
      const dataTransfer = new DataTransfer();
      for (const { name, base64 } of packed) {
        dataTransfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
      }
      for (const kind of ["dragenter", "dragover", "drop"]) {
        const event = new DragEvent(kind, { dataTransfer, clientX: x, clientY: y, bubbles: true, cancelable: true });
        document.getElementById("lab").dispatchEvent(event);
      }
    }, { packed, x, y });
  }

  /** What the page hands out when `act` is done: name and bytes. */
  async download(act) {
    const [download] = await Promise.all([this.page.waitForEvent("download", { timeout: PATIENCE }), act()]);
    return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
  }

  /** The current pane's picture as the page saves it: without handles, captions and arrows. */
  async saved() {
    const { name, bytes } = await this.download(() => this.key("Control+s"));
    assert.match(name, /\.png$/);
    return Object.assign(decode(bytes), { bytes });
  }

  /** What is on the clipboard; the context needs the permission: `CLIPBOARD`. */
  clipboard() {
    return this.page.evaluate(() => navigator.clipboard.readText());
  }

  /** A screenshot, of the whole page or of one widget's rectangle. */
  async picture(id) {
    const clip = id === undefined ? undefined : await this.clip(id);
    return decode(await this.page.screenshot({ clip, timeout: PATIENCE }));
  }

  /** A screenshot that the next one is the same as: the browser shows what was painted a while later. */
  async still(id) {
    let before = await this.picture(id);
    for (let turns = 0; turns < 20; turns++) {
      const next = await this.picture(id);
      if (before.width === next.width && before.height === next.height && differing(before, next, 0) === 0) return next;
      before = next;
    }
    assertSame(before, await this.picture(id), "it never stands still");
    return before;
  }

  async clip(id) {
    const { rect: [x, y, width, height] } = await this.widget(id);
    return { x: Math.ceil(x), y: Math.ceil(y), width: Math.floor(width) - 1, height: Math.floor(height) - 1 };
  }

  close() {
    return this.context.close();
  }
}

/** Asks until the answer is as wanted, and gives it. Not Playwright's own way of waiting: that evaluates text in the
 * page, which the page's policy forbids. */
export async function poll(ask, wanted) {
  const end = Date.now() + PATIENCE;
  for (;;) {
    const answer = await ask();
    if (wanted(answer)) return answer;
    if (Date.now() > end) {
      throw new Error(`it did not come to pass: ${wanted}; last answer: ${JSON.stringify(answer)?.slice(0, 2000)}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

/** Waits until the files of all samples have come: then the page begins to keep itself. */
export const fetched = (lab) => poll(
  () => lab.page.evaluate(() => navigator.serviceWorker.getRegistration().then((found) => found !== undefined)),
  Boolean,
);

/** Waits until the page is kept for the next visit: its worker is active and in charge. By then it has asked for all
 * its files; whoever loads it again before, breaks off those requests, and that counts as something wrong. */
export const kept = (lab) => poll(
  () => lab.page.evaluate(() => navigator.serviceWorker.ready.then(() => navigator.serviceWorker.controller !== null)),
  (controlled) => controlled,
);
