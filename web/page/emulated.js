// A browser that emulates another device, as developer tools do, reports element sizes in the pixels of the real device. The
// canvas would have too few pixels, and everything would be drawn too large.

/** Makes element sizes in pixels those of the emulated device. */
export function trustDevicePixelRatio() {
  const property = Object.getOwnPropertyDescriptor(ResizeObserverEntry.prototype, "devicePixelContentBoxSize");
  // Not every browser has this property; then the application multiplies itself.
  if (property === undefined) return;
  Object.defineProperty(ResizeObserverEntry.prototype, "devicePixelContentBoxSize", {
    ...property,
    get() {
      const [pixels, content] = [property.get.call(this)[0], this.contentBoxSize[0]];
      const sides = ["inlineSize", "blockSize"].map((side) => [side, pixels[side], content[side] * devicePixelRatio]);
      // The reported size is exact to the pixel, because the element's position decides how its edges are rounded.
      const isExact = sides.every(([, exact, about]) => Math.abs(exact - about) < 2);
      const value = ([side, exact, about]) => [side, { value: isExact ? exact : Math.round(about), enumerable: true }];
      return [Object.create(ResizeObserverSize.prototype, Object.fromEntries(sides.map(value)))];
    },
  });
}
