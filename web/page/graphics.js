// The graphics of a canvas.

/** The extensions that gonio uses. */
const USED = new Set([
  "EXT_color_buffer_float", "EXT_color_buffer_half_float", "EXT_float_blend", "EXT_texture_filter_anisotropic",
  "OES_texture_float_linear", "OES_texture_half_float_linear", "WEBGL_debug_renderer_info",
]);

/** The WebGL 2 context of a canvas, or null. It has no other extensions than those that gonio uses: glow asks for each that it knows,
 * and each question waits for the browser's graphics process. */
export function graphicsOf(canvas, attributes) {
  const context = canvas.getContext("webgl2", attributes);
  if (context !== null && !Object.hasOwn(context, "getExtension")) {
    const ask = context.getExtension.bind(context);
    context.getExtension = (name) => (USED.has(name) ? ask(name) : null);
  }
  return context;
}
