// `gonio serve`, the program itself, on a port of its own.

import { spawn } from "node:child_process";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const DIST = fileURLToPath(new URL("../../../dist", import.meta.url));

/** Serves the page in `folder`. Gives its address and how to end it. */
export async function serve(folder = DIST) {
  const program = process.env.GONIO_PROGRAM;
  if (program === undefined) throw new Error("GONIO_PROGRAM is not set; `cargo xtask test --web` runs these tests");
  const child = spawn(program, ["serve", "--port", "0", "--quiet", "--from", folder], { stdio: ["ignore", "pipe", "inherit"] });
  const url = await new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).once("line", resolve);
    child.once("error", reject);
    child.once("exit", (code) => reject(new Error(`gonio serve ended with ${code}`)));
  });
  return {
    url,
    stop: () => new Promise((resolve) => {
      child.removeAllListeners("exit");
      child.once("exit", resolve);
      child.kill();
    }),
  };
}
