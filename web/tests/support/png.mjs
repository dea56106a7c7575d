// Reads the pictures that a browser's screenshots are: PNG, 8 bits, RGB or RGBA, not interlaced (W3C, PNG 3, 2023).

import { AssertionError } from "node:assert/strict";
import { inflateSync } from "node:zlib";
import { chunksOf } from "../../build/chunks.mjs";

/** Width, height, and `at(x, y)`: red, green and blue, 0 to 255. */
export function decode(png) {
  let width = 0, height = 0, channels = 0;
  const parts = [];
  for (const { kind, data } of chunksOf(png)) {
    if (kind === "IHDR") {
      [width, height] = [data.readUInt32BE(0), data.readUInt32BE(4)];
      channels = { 2: 3, 6: 4 }[data[9]];
      if (data[8] !== 8 || channels === undefined || data[12] !== 0) throw new Error("a kind of PNG that no browser writes");
    }
    if (kind === "IDAT") parts.push(data);
  }
  const bytes = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const pixels = Buffer.alloc(stride * height);
  for (let y = 0; y < height; y++) {
    const filter = bytes[y * (stride + 1)];
    for (let x = 0; x < stride; x++) {
      const left = x >= channels ? pixels[y * stride + x - channels] : 0;
      const up = y > 0 ? pixels[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? pixels[(y - 1) * stride + x - channels] : 0;
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      pixels[y * stride + x] = bytes[y * (stride + 1) + 1 + x] + guess;
    }
  }
  if (channels === 3) return picture(width, height, pixels);
  const rgb = Buffer.alloc(width * height * 3);
  for (let i = 0; i < width * height; i++) pixels.copy(rgb, 3 * i, 4 * i, 4 * i + 3);
  return picture(width, height, rgb);
}

/** Of red, green and blue, row by row from the top. */
function picture(width, height, rgb) {
  return { width, height, rgb, at: (x, y) => [...rgb.subarray(3 * (y * width + x), 3 * (y * width + x) + 3)] };
}

/** A part of a picture. */
export function crop({ width: whole, rgb: from }, left, top, width, height) {
  const rgb = Buffer.alloc(width * height * 3);
  for (let y = 0; y < height; y++) {
    const start = 3 * ((top + y) * whole + left);
    from.copy(rgb, 3 * y * width, start, start + 3 * width);
  }
  return picture(width, height, rgb);
}

/** Whichever of the three neighbours is nearest to left + up - corner. */
function paeth(left, up, corner) {
  const guess = left + up - corner;
  const [a, b, c] = [left, up, corner].map((value) => Math.abs(guess - value));
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** The share of pixels, 0 to 1, that differ by more than `step` in any channel. Both must be of one size. */
export function differing(a, b, step = 2) {
  if (a.width !== b.width || a.height !== b.height) throw new Error("pictures of two sizes");
  let count = 0;
  for (let i = 0; i < a.rgb.length; i += 3) {
    const far = (channel) => Math.abs(a.rgb[i + channel] - b.rgb[i + channel]) > step;
    if (far(0) || far(1) || far(2)) count++;
  }
  return count / (a.width * a.height);
}

/** Fails unless all pixels of both pictures are the same, and says where and by how much they differ. */
export function assertSame(a, b, message = "the pictures differ") {
  if (differing(a, b, 0) === 0) return;
  let [left, top, right, bottom, count, most] = [Infinity, Infinity, -1, -1, 0, 0];
  for (let y = 0; y < a.height; y++) {
    for (let x = 0; x < a.width; x++) {
      const other = b.at(x, y);
      const difference = Math.max(...a.at(x, y).map((value, channel) => Math.abs(value - other[channel])));
      if (difference === 0) continue;
      [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x), Math.max(bottom, y)];
      count++;
      most = Math.max(most, difference);
    }
  }
  const where = `columns ${left} to ${right} and rows ${top} to ${bottom} of ${a.width}x${a.height}`;
  throw new AssertionError({ message: `${message}: ${count} pixels in ${where} differ, by at most ${most}` });
}

/** How many different colours there are: an empty canvas has one. */
export function colors(picture) {
  const seen = new Set();
  for (let y = 0; y < picture.height; y += 2) {
    for (let x = 0; x < picture.width; x += 2) seen.add(picture.at(x, y).join());
  }
  return seen.size;
}

/** The largest and the mean difference of all numbers from those of the sum of `others` (none of them: from black), but
 * for those where that sum is at least `most`. */
export function fromSum(picture, others, most = Infinity) {
  let [largest, sum, count] = [0, 0, 0];
  for (let i = 0; i < picture.rgb.length; i++) {
    const wanted = others.reduce((light, other) => light + other.rgb[i], 0);
    if (wanted >= most) continue;
    const difference = Math.abs(picture.rgb[i] - wanted);
    largest = Math.max(largest, difference);
    sum += difference;
    count++;
  }
  return { largest, mean: sum / count, share: count / picture.rgb.length };
}
