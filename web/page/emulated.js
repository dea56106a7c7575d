// A browser that plays another device, as its tools for developers do, gives elements' sizes in the pixels of the one that
// it runs on: the canvas would have too few, and all on it be drawn too large.

/** From here on, sizes in pixels are those of the device that is played. */
export function trustDevicePixelRatio() {
  const told = Object.getOwnPropertyDescriptor(ResizeObserverEntry.prototype, "devicePixelContentBoxSize");
  // Not every browser has it; then the application multiplies by itself.
  if (told === undefined) return;
  Object.defineProperty(ResizeObserverEntry.prototype, "devicePixelContentBoxSize", {
    ...told,
    get() {
      const [pixels, content] = [told.get.call(this)[0], this.contentBoxSize[0]];
      const sides = ["inlineSize", "blockSize"].map((side) => [side, pixels[side], content[side] * devicePixelRatio]);
      // What is told is exact, to the pixel: where an element lies decides how its edges are rounded.
      const isExact = sides.every(([, exact, about]) => Math.abs(exact - about) < 2);
      const value = ([side, exact, about]) => [side, { value: isExact ? exact : Math.round(about), enumerable: true }];
      return [Object.create(ResizeObserverSize.prototype, Object.fromEntries(sides.map(value)))];
    },
  });
}
