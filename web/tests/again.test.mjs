// The second visit, and other places to stand.

import assert from "node:assert/strict";
import { cp, mkdtemp, rm } from "node:fs/promises";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { test as plain } from "node:test";
import { kept, Lab, PATIENCE, settled, suite } from "./support/lab.mjs";
import { launch } from "./support/chromium.mjs";

const { test } = suite();

test("the second visit needs no connection", async (lab) => {
  await kept(lab);
  await lab.context.setOffline(true);
  await lab.page.reload();
  await lab.running();
});

test("the second visit takes nothing but the page itself from the server", async (lab) => {
  await kept(lab);
  const fetched = [];
  lab.page.on("response", (response) => {
    if (!response.fromServiceWorker()) fetched.push(new URL(response.url()).pathname);
  });
  await lab.page.reload();
  await lab.running();
  assert.deepEqual(fetched.filter((path) => !path.endsWith("/worker.js")), []);
});

test("edits of the scene that were not saved are offered again, and restored", async (lab) => {
  const opened = await lab.until(settled);
  const edited = await lab.click("light-0-on");
  assert.notDeepEqual(edited.scene, opened.scene);
  await lab.page.waitForFunction(() => Object.keys(localStorage).some((key) => key.startsWith("gonio draft ")));
  await lab.page.reload();
  await lab.running();
  const again = await lab.until((state) => settled(state) && state.messages.length > 0);
  assert.match(again.messages[0].text, /^Unsaved changes to still-life from less than a minute ago were kept$/);
  assert.deepEqual(again.scene.light, opened.scene.light, "nothing is restored unasked");
  await lab.click("restore-draft");
  const restored = await lab.until((state) => settled(state) && state.messages.length === 0);
  assert.deepEqual([restored.scene.light, restored.undo], [edited.scene.light, true]);
});

plain("a static host may put it into any folder, and send no headers of its own", { timeout: 3 * PATIENCE }, async () => {
  const folder = await mkdtemp(join(tmpdir(), "gonio-page-"));
  await cp(fileURLToPath(new URL("../../dist", import.meta.url)), join(folder, "some/where"), { recursive: true });
  const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml" };
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, "http://localhost").pathname.replace(/\/$/, "/index.html");
    try {
      const bytes = await readFile(join(folder, path));
      response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const browser = await launch();
  try {
    const lab = await Lab.open({ browser, server: { url: `http://127.0.0.1:${server.address().port}/` } }, { path: "some/where/" });
    lab.assertNothingWrong();
    await lab.close();
  } finally {
    await browser.close();
    server.closeAllConnections();
    await new Promise((resolve) => server.close(resolve));
    await rm(folder, { recursive: true });
  }
});
