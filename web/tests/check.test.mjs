// The checker in the page: the verdicts of `gonio lab check`, and a worker that is ended where it must be.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile, readdir } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { settled, suite } from "./support/lab.mjs";

const { test } = suite();

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "../..");
const CORPUS = "crates/gonio-lab/corpus";

/** Exercise, and where the submission is. Right, wrong, two mistakes, not compiling; every dialect of GLSL; a C++ file. */
const SUBMISSIONS = [
  ["ex02", "crates/gonio-lab/tests/ex02/cube-right.csv"],
  ["ex02", "crates/gonio-lab/tests/ex02/cube-from-0.csv"],
  ["ex03", `${CORPUS}/ex03/correct/cpp`],
];

/** A submission's files: what is not for the checker's eyes is left out. */
async function filesOf(path) {
  const names = path.includes(".") ? [path] : (await readdir(join(ROOT, path))).map((name) => join(path, name));
  return names.filter((name) => !name.endsWith("expected.toml")).sort();
}

/** By the program; a submission that is not right makes it end with 1. */
async function native(exercise, files) {
  const args = ["lab", "check", exercise, ...files.map((file) => join(ROOT, file)), "--json"];
  const { stdout } = await promisify(execFile)(process.env.GONIO_PROGRAM, args).catch((ended) => ended);
  return JSON.parse(stdout);
}
