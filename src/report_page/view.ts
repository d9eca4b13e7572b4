import {
  Color,
  DataTexture,
  LinearFilter,
  LinearSRGBColorSpace,
  Scene as Stage,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { Camera, home_of } from "./camera";
import { fineness_for, open_context } from "./context";
import { diverging, entries, sequential } from "./colour_maps";
import { element } from "./dom";
import { DrawnSurface } from "./drawn_surface";
import { scale_of } from "./field_scale";
import { Lines } from "./lines";
import type { Field, Scene } from "./payload";
import { normal_near, pick, type Hit } from "./pick";
import type { Store } from "./state";
import { build_surface, values_of, type Surface } from "./surface";
import { surface_material } from "./surface_material";
import { on_theme, theme_rgb } from "./theme";

/** The point of the surface under the pointer. */
export interface Probe {
  state: number;
  hit: Hit;
  at: Vector3; // in the scene's units, relative to its centre
}

/** The picture of the mesh, drawn only when something has changed. */
export class View {
  readonly canvas = element("canvas", { tabindex: "0", role: "img" });
  readonly camera: Camera;
  readonly lines: Lines;
  /** Called after each drawing, to update the layer over the picture. */
  after_drawing: () => void = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly surface: Surface;
  private readonly stage = new Stage();
  private readonly drawn: DrawnSurface[];
  private readonly map = new DataTexture(new Uint8Array(4 * entries), entries, 1);
  private readonly material = surface_material(this.map);
  private readonly fineness: number; // drawn pixels along the side of one CSS pixel
  private field_shown = -2;
  private frame = 0;
  private frames = 0;

  /** Throws if the browser has no WebGL 2, or if the data are damaged. */
  constructor(
    readonly scene: Scene,
    private readonly buffer: ArrayBuffer,
    private readonly store: Store,
  ) {
    this.surface = build_surface(scene, buffer);
    const context = open_context(this.canvas);
    this.fineness = fineness_for(context);
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    // The shader computes the final sRGB colours, so three.js must not convert them.
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.renderer.debug.checkShaderErrors = false;
    this.map.minFilter = this.map.magFilter = LinearFilter;
    this.drawn = this.surface.states.map((state) => {
      const flags = this.surface.flags.subarray(0, 3 * state.triangles);
      return new DrawnSurface(state, flags, this.material);
    });
    this.lines = new Lines(scene.lines ?? [], this.surface.scale, scene.states.length);
    this.stage.add(...this.drawn.map((d) => d.group), this.lines.group);
    const home = home_of(this.surface.states.at(-1)!.points);
    this.camera = new Camera(this.canvas, home, () => this.request_drawing());
    store.on_change(() => this.update());
    on_theme(() => this.take_theme());
    this.take_theme();
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.canvas.addEventListener("webglcontextrestored", () => this.request_drawing());
  }

  /** The states of the mesh that can be seen at the moment, from left to right. */
  visible_states(): number[] {
    const { split, shown } = this.store.now;
    const last = this.scene.states.length - 1;
    return split && last > 0 ? [0, last] : [Math.min(shown, last)];
  }

  current_field(): Field | undefined {
    return this.scene.fields?.[this.store.now.field];
  }

  request_drawing() {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
    });
  }

  /** Flies to a place. `radius` is the radius of the region to show; both in the scene's units. */
  fly_to(at: readonly number[], radius: number) {
    const target = new Vector3().fromArray(at).multiplyScalar(this.surface.scale);
    const size = Math.min(1, Math.max(radius * this.surface.scale, this.edge_length()));
    const state = this.surface.states[this.visible_states().at(-1)!]!;
    const direction = normal_near(state, target, 1.5 * size) ?? this.camera.sight().direction;
    this.camera.fly({ target, direction, distance: 6 * size });
  }

  /** The pixel of a point given in the scene's units; null if the point is behind the eye. */
  place_of(at: readonly number[]): { x: number; y: number } | null {
    const point = new Vector3().fromArray(at).multiplyScalar(this.surface.scale);
    point.project(this.camera.lens);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!(Math.abs(point.z) <= 1)) return null;
    return { x: ((point.x + 1) / 2) * width, y: ((1 - point.y) / 2) * height };
  }

  /** The point of the surface at pixel (x, y) of the picture, or null. */
  probe(x: number, y: number): Probe | null {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const states = this.visible_states();
    const right = states.length > 1 && x > this.store.now.split_at * width;
    const state = right ? states[1]! : states[0]!;
    const origin = this.camera.lens.position;
    const aim = new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5);
    const ray = aim.unproject(this.camera.lens).sub(origin).normalize();
    const hit = pick(this.surface.states[state]!, origin, ray);
    if (!hit) return null;
    const at = origin.clone().addScaledVector(ray, hit.distance);
    return { state, hit, at: at.divideScalar(this.surface.scale) };
  }

  /** The value of the current field at a probe, or null if there is none. */
  value_at({ state, hit }: Probe): number | null {
    const field = this.current_field();
    if (!field) return null;
    const values = values_of(this.buffer, field, state);
    if (!values) return null;
    const { indices } = this.surface.states[state]!;
    const value =
      field.on === "triangle"
        ? values[hit.corner / 3]
        : hit.weights.reduce((sum, w, k) => sum + w * values[indices[hit.corner + k]!]!, 0);
    return value !== undefined && Number.isFinite(value) ? value : null;
  }

  /** Makes the point of the surface at pixel (x, y) the centre of rotation. */
  centre_on(x: number, y: number) {
    const target = this.probe(x, y)?.at.multiplyScalar(this.surface.scale);
    if (!target) return;
    const direction = this.camera.lens.position.clone().sub(target);
    this.camera.fly({ target, direction, distance: direction.length() });
  }

  private edge_length(): number {
    return (this.scene.mean_edge_length ?? 0) * this.surface.scale || 0.01;
  }

  private update() {
    const { now } = this.store;
    const { uniforms } = this.material;
    if (now.field !== this.field_shown) this.show_field();
    const field = this.current_field();
    uniforms.flat_shading.value = now.flat;
    uniforms.wireframe.value = now.wireframe;
    uniforms.patches.value = now.patches;
    uniforms.contours.value = now.contours && field?.on === "vertex";
    const with_triangles = now.wireframe || (now.patches && !!this.scene.arrays.patch);
    for (const drawn of this.drawn) drawn.show(with_triangles);
    this.request_drawing();
  }

  private show_field() {
    this.field_shown = this.store.now.field;
    const field = this.current_field();
    this.material.uniforms.coloured.value = field !== undefined;
    this.drawn.forEach((drawn, s) => {
      drawn.colour(field, field ? values_of(this.buffer, field, s) : null);
    });
    if (!field) return;
    this.map.image.data!.set((field.diverging ? diverging : sequential).colours);
    this.map.needsUpdate = true;
    const { first, step } = scale_of(field).contours;
    this.material.uniforms.ticks.value = new Vector2(first, step);
  }

  private take_theme() {
    const { uniforms } = this.material;
    uniforms.plain.value.fromArray(theme_rgb("--surface-plain"));
    uniforms.inside.value.fromArray(theme_rgb("--surface-inside"));
    uniforms.ink.value.fromArray(theme_rgb("--surface-ink"));
    uniforms.accent.value.fromArray(theme_rgb("--surface-patch"));
    this.renderer.setClearColor(new Color(...theme_rgb("--view")));
    this.lines.recolour();
    this.request_drawing();
  }

  private resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.fineness);
    this.material.uniforms.fineness.value = this.fineness;
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height);
    this.draw(); // at once: a canvas is empty after its size has changed
  }

  private draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.camera.fit_depth();
    const states = this.visible_states();
    const parting = states.length > 1 ? this.store.now.split_at * width : width;
    this.renderer.setScissorTest(true);
    states.forEach((state, side) => {
      const left = side === 0 ? 0 : parting;
      this.renderer.setScissor(left, 0, side === 0 ? parting : width - parting, height);
      this.drawn.forEach(({ group }, s) => (group.visible = s === state));
      this.lines.group.visible = this.store.now.lines;
      this.lines.show_those_of(state);
      this.renderer.render(this.stage, this.camera.lens);
    });
    this.canvas.dataset.frames = String(++this.frames);
    if (this.frames === 1) performance.mark("first-frame");
    this.after_drawing();
  }
}
