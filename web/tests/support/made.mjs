// Files that tests make: pictures and archives, byte by byte.

import { deflateRawSync, deflateSync } from "node:zlib";
import { crc32, written } from "../../build/chunks.mjs";

const number = (value, bytes, bigEndian = false) => {
  const buffer = Buffer.alloc(bytes);
  if (bigEndian) buffer.writeUIntBE(value, 0, bytes);
  else buffer.writeUIntLE(value, 0, bytes);
  return buffer;
};

/** A PNG of 8 bits a channel (W3C, PNG 3, 2023). `color(x, y)`: red, green and blue, 0 to 255. */
export function png(width, height, color) {
  const rows = Array.from({ length: height }, (_, y) => [0, ...Array.from({ length: width }, (_, x) => color(x, y)).flat()]);
  const header = Buffer.concat([number(width, 4, true), number(height, 4, true), Buffer.from([8, 2, 0, 0, 0])]);
  const pixels = deflateSync(Buffer.from(rows.flat()));
  return written([{ kind: "IHDR", data: header }, { kind: "IDAT", data: pixels }, { kind: "IEND", data: Buffer.alloc(0) }]);
}

/** A Radiance picture (.hdr), not compressed. `color(x, y)`: mantissas of red, green and blue, and the exponent: 128 + e
 * makes 255 nearly 2 to the power of e (Ward, Real Pixels, 1991). */
export function hdr(width, height, color) {
  const pixels = [];
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) pixels.push(...color(x, y));
  return Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), Buffer.from(pixels)]);
}

/** An archive of files, each a `name` and `text` or `bytes`, deflated (PKWARE, APPNOTE 6.3). */
export function zip(files) {
  const [entries, directory] = [[], []];
  let offset = 0;
  for (const { name, text, bytes } of files) {
    const plain = Buffer.from(bytes ?? text);
    const packed = deflateRawSync(plain);
    const called = Buffer.from(name);
    // Version 2.0, deflate, no date.
    const common = Buffer.concat([
      number(20, 2), number(0, 2), number(8, 2), number(0, 2), number(0x21, 2),
      number(crc32(plain), 4), number(packed.length, 4), number(plain.length, 4), number(called.length, 2), number(0, 2),
    ]);
    const entry = Buffer.concat([Buffer.from("PK\x03\x04", "latin1"), common, called, packed]);
    directory.push(Buffer.from("PK\x01\x02", "latin1"), number(20, 2), common, Buffer.alloc(10), number(offset, 4), called);
    entries.push(entry);
    offset += entry.length;
  }
  const list = Buffer.concat(directory);
  const end = [Buffer.from("PK\x05\x06", "latin1"), Buffer.alloc(4), number(files.length, 2), number(files.length, 2)];
  return Buffer.concat([...entries, list, ...end, number(list.length, 4), number(offset, 4), number(0, 2)]);
}
