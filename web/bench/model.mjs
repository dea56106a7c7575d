// A model to measure with: a ball with waves on it, as OBJ with a normal at each vertex.

import { writeFile } from "node:fs/promises";

/** A grid of `steps` by `steps` quads, so twice as many triangles as there are quads. */
export function modelText(steps) {
  const lines = ["# a ball with waves"];
  const columns = steps + 1;
  for (let row = 0; row < columns; row++) {
    for (let column = 0; column < columns; column++) {
      const [theta, phi] = [(Math.PI * row) / steps, (2 * Math.PI * column) / steps];
      const normal = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)];
      const radius = 1 + 0.05 * Math.sin(8 * theta) * Math.cos(8 * phi);
      lines.push(`v ${normal.map((value) => (radius * value).toFixed(6)).join(" ")}`);
      lines.push(`vn ${normal.map((value) => value.toFixed(4)).join(" ")}`);
    }
  }
  const corner = (row, column) => {
    const index = row * columns + column + 1;
    return `${index}//${index}`;
  };
  for (let row = 0; row < steps; row++) {
    for (let column = 0; column < steps; column++) {
      const [a, b, c, d] = [corner(row, column), corner(row, column + 1), corner(row + 1, column + 1), corner(row + 1, column)];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  }
  return `${lines.join("\n")}\n`;
}

/** Writes that to a file. Gives the number of triangles. */
export async function writeModel(path, steps) {
  await writeFile(path, modelText(steps));
  return 2 * steps * steps;
}
