/** The WebGL 2 context of a canvas; throws if the browser has none. */
export function open_context(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { antialias: false });
  if (!context) {
    throw new Error(
      "This browser has no WebGL 2, which is needed to draw the mesh. Everything else on this " +
        "page works without WebGL.",
    );
  }
  return context;
}

/**
 * The number of drawn pixels along the side of one CSS pixel. Two or more smooth the edges,
 * contours and hatching as well as the outlines. In software rendering the number is one, which is
 * four times as fast.
 */
export function fineness_for(context: WebGL2RenderingContext): number {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
  const is_software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
  return is_software ? 1 : Math.max(2, Math.min(devicePixelRatio, 3));
}
