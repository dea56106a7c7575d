// Chromium without a screen: the system's, driven by playwright-core.

import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

const PLACES = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** Software WebGL (SwiftShader), and none of the browser's own talk to the network. */
const FLAGS = [
  "--no-sandbox",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** Where it is, if it is anywhere. */
export const found = () => PLACES.find(existsSync);

/** Starts it. `flags`: more of them. */
export async function launch(flags = []) {
  const executablePath = found();
  if (executablePath === undefined) {
    throw new Error(`no Chromium (${PLACES.join(", ")}); install the package \`chromium\``);
  }
  return chromium.launch({ executablePath, headless: true, args: [...FLAGS, ...flags] });
}
