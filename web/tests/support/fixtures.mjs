// Tables of test cases: many small files in one text. The crate gonio-fixtures defines the format.

import { readFile } from "node:fs/promises";

/** Reads the files of one case (a folder at the top of the table): [{ name, bytes }]. Headers with flags are not supported. */
export async function readCase(table, wanted) {
  const files = [];
  let lines;
  for (const line of (await readFile(table, "utf8")).split("\n").slice(0, -1)) {
    if (!line.startsWith("-- ")) {
      lines?.push(`${line}\n`);
      continue;
    }
    const [, folder, name, flags] = /^-- ([^/]+)\/(.+?)( \[.*\])? --$/.exec(line) ?? [];
    lines = [];
    if (folder !== wanted) continue;
    if (flags !== undefined) throw new Error(`${table}: cannot read a file with flags: ${line}`);
    files.push({ name, lines });
  }
  if (files.length === 0) throw new Error(`${table} has no case ${wanted}`);
  return files.map(({ name, lines }) => ({ name, bytes: Buffer.from(lines.join("")) }));
}
