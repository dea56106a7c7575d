// Reads and writes the chunks of PNG files (W3C, PNG 3, 2023), for the page's build and its tests.

import { deflateSync, inflateSync } from "node:zlib";

const SIGNATURE = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);

/** The check sum of PNG and zip (ISO 3309). */
export function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** A PNG of chunks, each a `kind` of four letters and its `data`. */
export function written(chunks) {
  const number = (value) => {
    const buffer = Buffer.alloc(4);
    buffer.writeUInt32BE(value);
    return buffer;
  };
  return Buffer.concat([SIGNATURE, ...chunks.flatMap(({ kind, data }) => {
    const body = Buffer.concat([Buffer.from(kind, "latin1"), data]);
    return [number(data.length), body, number(crc32(body))];
  })]);
}

/** The chunks of a PNG, in order. */
export function chunksOf(png) {
  const chunks = [];
  for (let at = SIGNATURE.length; at < png.length;) {
    const length = png.readUInt32BE(at);
    chunks.push({ kind: png.toString("latin1", at + 4, at + 8), data: png.subarray(at + 8, at + 8 + length) });
    at += 12 + length;
  }
  return chunks;
}

/**
 * The same picture with its pixels stored instead of deflated, for a server that sends files compressed by brotli: brotli finds
 * more in pixels than in what deflate has made of them.
 */
export function stored(png) {
  const chunks = chunksOf(png);
  const isPixels = ({ kind }) => kind === "IDAT";
  const deflated = Buffer.concat(chunks.filter(isPixels).map(({ data }) => data));
  const pixels = { kind: "IDAT", data: deflateSync(inflateSync(deflated), { level: 0 }) };
  const first = chunks.findIndex(isPixels);
  return written([...chunks.slice(0, first), pixels, ...chunks.slice(first).filter((chunk) => !isPixels(chunk))]);
}
