// Tables of test cases: many small files in one text. The crate gonio-fixtures defines the format.

import { readFile } from "node:fs/promises";

/** Reads the file at `path` in a table, or the files of that folder: [{ name, bytes }]. Headers with flags are not supported. */
export async function readFiles(table, path) {
  const files = [];
  let lines;
  for (const line of (await readFile(table, "utf8")).split("\n").slice(0, -1)) {
    if (!line.startsWith("-- ")) {
      lines?.push(`${line}\n`);
      continue;
    }
    const [, at, flags] = /^-- (.+?)( \[.*\])? --$/.exec(line) ?? [];
    lines = [];
    if (at !== path && !at?.startsWith(`${path}/`)) continue;
    if (flags !== undefined) throw new Error(`${table}: cannot read a file with flags: ${line}`);
    files.push({ name: at === path ? path : at.slice(path.length + 1), lines });
  }
  if (files.length === 0) throw new Error(`${table} does not contain ${path}`);
  return files.map(({ name, lines }) => ({ name, bytes: Buffer.from(lines.join("")) }));
}
