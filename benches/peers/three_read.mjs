// Reads an OBJ file with three.js and tells what it took: node three_read.mjs OBJLoader.js FILE
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [loaderPath, file] = process.argv.slice(2);
const { OBJLoader } = await import(pathToFileURL(loaderPath));
const wall = performance.now();
const cpu = process.cpuUsage();
try {
  const group = new OBJLoader().parse(readFileSync(file, 'utf8'));
  const used = process.cpuUsage(cpu);
  let vertices = 0;
  group.traverse((node) => { vertices += node.isMesh ? node.geometry.getAttribute('position').count : 0; });
  console.log(JSON.stringify({
    wall_s: (performance.now() - wall) / 1e3,
    cpu_s: (used.user + used.system) / 1e6,
    vertices,
    triangles: Math.round(vertices / 3),
  }));
} catch (error) {
  console.log(error.message);
  process.exit(1);
}
