import { array_of, DamagedPage } from "./decode";
import { scale_of } from "./field_scale";
import type { Field, Scene } from "./payload";

/**
 * The mesh as it is drawn: scaled to a ball of radius 1, so that meshes of any size stay within the
 * range of 32-bit floating-point numbers.
 */
export interface Surface {
  states: SurfaceState[];
  flags: Uint8Array; // per corner: bit i: the edge opposite corner i is drawn; patch_bit: see below
  scale: number; // factor from lengths of the scene to lengths here
}

export interface SurfaceState {
  triangles: number;
  indices: Uint32Array; // 3 vertices per triangle
  points: Float32Array; // 3 per vertex
  normals: Int16Array; // 4 per vertex, the last unused
}

/** The flag of corners whose triangle belongs to a patch. */
export const patch_bit = 8;

export function build_surface(scene: Scene, buffer: ArrayBuffer): Surface {
  const most = Math.max(0, ...scene.triangles);
  const indices = array_of(buffer, scene.arrays.triangles, "uint32", 3 * most);
  for (let i = 0; i < indices.length; ++i) {
    if (indices[i]! >= scene.vertices)
      throw new DamagedPage("a triangle of its mesh refers to a missing vertex");
  }
  const points = scene.states.map((_, s) => points_of(scene, buffer, s));
  const scale = 1 / (radius_of(points) || 1);
  return {
    states: points.map((P, s) =>
      build_state(P, indices.subarray(0, 3 * scene.triangles[s]!), scale),
    ),
    flags: flags_of(scene, buffer, indices),
    scale,
  };
}

/** Vertices of state `s`. Vertices that the state does not have are at the centre and not drawn. */
function points_of(scene: Scene, buffer: ArrayBuffer, s: number): Float32Array {
  const ref = scene.arrays.positions[s];
  const count = scene.state_vertices?.[s] ?? scene.vertices;
  if (!ref || count > scene.vertices) throw new DamagedPage("its mesh has no positions");
  const all = new Float32Array(3 * scene.vertices);
  all.set(array_of(buffer, ref, "float32", ref.length).subarray(0, all.length));
  return all;
}

/** Math.hypot takes ten times as long; the squares of 32-bit numbers do not overflow here. */
function length_of(x: number, y: number, z: number): number {
  return Math.sqrt(x * x + y * y + z * z);
}

function radius_of(points: Float32Array[]): number {
  let largest = 0;
  for (const P of points) {
    for (let i = 0; i < P.length; i += 3) {
      largest = Math.max(largest, length_of(P[i]!, P[i + 1]!, P[i + 2]!));
    }
  }
  return Number.isFinite(largest) ? largest : 0;
}

function build_state(P: Float32Array, indices: Uint32Array, scale: number): SurfaceState {
  const points = P.map((x) => x * scale);
  const normals = vertex_normals(points, indices);
  return { triangles: indices.length / 3, indices, points, normals };
}

/** The area-weighted mean of the triangle normals around each vertex. */
function vertex_normals(X: Float32Array, indices: Uint32Array): Int16Array {
  const sums = new Float64Array(X.length);
  for (let c = 0; c < indices.length; c += 3) {
    const [x, y, z] = triangle_normal(X, indices, c);
    for (let k = c; k < c + 3; ++k) {
      const v = 3 * indices[k]!;
      sums[v]! += x;
      sums[v + 1]! += y;
      sums[v + 2]! += z;
    }
  }
  const normals = new Int16Array((4 * X.length) / 3);
  for (let v = 0; 3 * v < X.length; ++v) {
    const i = 3 * v;
    const length = length_of(sums[i]!, sums[i + 1]!, sums[i + 2]!) || 1;
    for (let k = 0; k < 3; ++k) normals[4 * v + k] = Math.round((32767 * sums[i + k]!) / length);
  }
  return normals;
}

/** Normal of the triangle whose first corner is `c`; its length is twice the area. */
export function triangle_normal(
  X: Float32Array,
  indices: Uint32Array,
  c: number,
): [number, number, number] {
  const [p, q, r] = [3 * indices[c]!, 3 * indices[c + 1]!, 3 * indices[c + 2]!];
  const [ax, ay, az] = [X[q]! - X[p]!, X[q + 1]! - X[p + 1]!, X[q + 2]! - X[p + 2]!];
  const [bx, by, bz] = [X[r]! - X[p]!, X[r + 1]! - X[p + 1]!, X[r + 2]! - X[p + 2]!];
  return [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
}

function flags_of(scene: Scene, buffer: ArrayBuffer, indices: Uint32Array): Uint8Array {
  const flags = new Uint8Array(indices.length).fill(7);
  const { edges, patch } = scene.arrays;
  if (edges) mark_edges(array_of(buffer, edges, "uint32", edges.length), indices, scene, flags);
  if (patch) {
    const patches = array_of(buffer, patch, "uint8", indices.length / 3);
    for (let c = 0; c < flags.length; ++c) {
      if (patches[Math.floor(c / 3)]! > 0) flags[c]! |= patch_bit;
    }
  }
  return flags;
}

/** Clears the flags of edges that were added when polygons were cut into triangles. */
function mark_edges(edges: Uint32Array, indices: Uint32Array, scene: Scene, flags: Uint8Array) {
  const key = (a: number, b: number) => Math.min(a, b) * scene.vertices + Math.max(a, b);
  const drawn = new Set<number>();
  for (let e = 0; e + 1 < edges.length; e += 2) drawn.add(key(edges[e]!, edges[e + 1]!));
  for (let c = 0; c < indices.length; c += 3) {
    let mask = 0;
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [indices[c + ((k + 1) % 3)]!, indices[c + ((k + 2) % 3)]!];
      if (drawn.has(key(a, b))) mask |= 1 << k;
    }
    flags.fill(mask, c, c + 3);
  }
}

/** The share that stands for a missing value; see surface_material.ts. */
export const no_value = -100;

/** The values of a field in a state, or null if the state has none. */
export function values_of(buffer: ArrayBuffer, field: Field, state: number): Float32Array | null {
  const ref = field.values[state];
  return ref ? array_of(buffer, ref, "float32", ref.length) : null;
}

/** Values as shares of the field's range: 0 and 1 are its ends. */
export function shares_of(field: Field, values: Float32Array): Float32Array {
  const scale = scale_of(field);
  return values.map((value) => {
    const share = Number.isFinite(value) ? scale.share(value) : NaN;
    // The logarithm of 0 is clamped to the lower end; a negative value counts as missing.
    return Number.isNaN(share) ? no_value : Math.min(3, Math.max(-2, share));
  });
}
