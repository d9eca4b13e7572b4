/** What the browser draws with; throws where it cannot draw in space. */
export function open_context(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { antialias: false });
  if (!context) {
    throw new Error(
      "This browser offers no WebGL 2, which drawing the mesh needs. Everything else on this page " +
        "works without it.",
    );
  }
  return context;
}

/**
 * How many pixels are drawn along one of the page's. Two and more make edges smooth, contours and
 * hatching as well as outlines. Where the processor draws by itself, one has to do: it is four times
 * as quick.
 */
export function fineness_for(context: WebGL2RenderingContext): number {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const renderer = String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
  const is_software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(renderer);
  return is_software ? 1 : Math.max(2, Math.min(devicePixelRatio, 3));
}
