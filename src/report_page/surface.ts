import { array_of, DamagedPage } from "./decode";
import type { ArrayRef, Field, Scene } from "./payload";

/**
 * The mesh as a graphics card wants it: three corners of its own for each triangle, so that a
 * number can belong to a triangle, and scaled to a ball of radius 1, so that no size of mesh leaves
 * the range of 32-bit numbers.
 */
export interface Surface {
  states: SurfaceState[];
  flags: Uint8Array; // per corner: bit i: the edge opposite corner i is drawn; bit 3: of a patch
  scale: number; // of the scene's lengths to those here
}

export interface SurfaceState {
  triangles: number;
  positions: Float32Array; // 3 per corner
  normals: Int16Array; // 4 per corner, the last unused
}

export const patch_bit = 8;

export function build_surface(scene: Scene, buffer: ArrayBuffer): Surface {
  const most = Math.max(0, ...scene.triangles);
  const indices = array_of(buffer, scene.arrays.triangles, "uint32", 3 * most);
  for (let i = 0; i < indices.length; ++i) {
    if (indices[i]! >= scene.vertices)
      throw new DamagedPage("a triangle of its mesh has no corner");
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

/** Vertices of the state; those that it has not yet are left at the centre and not drawn. */
function points_of(scene: Scene, buffer: ArrayBuffer, s: number): Float32Array {
  const ref = scene.arrays.positions[s];
  const count = scene.state_vertices?.[s] ?? scene.vertices;
  if (!ref || count > scene.vertices) throw new DamagedPage("its mesh has no positions");
  const all = new Float32Array(3 * scene.vertices);
  all.set(array_of(buffer, ref, "float32", ref.length).subarray(0, all.length));
  return all;
}

/** Math.hypot takes ten times as long, and nothing here overflows when squared. */
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
  const positions = new Float32Array(3 * indices.length);
  for (let c = 0; c < indices.length; ++c) {
    const v = 3 * indices[c]!;
    positions[3 * c] = P[v]! * scale;
    positions[3 * c + 1] = P[v + 1]! * scale;
    positions[3 * c + 2] = P[v + 2]! * scale;
  }
  const normals = vertex_normals(positions, indices, P.length / 3);
  return { triangles: indices.length / 3, positions, normals };
}

/** The mean of the normals around each vertex, weighted by area. */
function vertex_normals(X: Float32Array, indices: Uint32Array, vertices: number): Int16Array {
  const sums = new Float64Array(3 * vertices);
  for (let c = 0; c < indices.length; c += 3) {
    const [x, y, z] = triangle_normal(X, c);
    for (let k = c; k < c + 3; ++k) {
      const v = 3 * indices[k]!;
      sums[v]! += x;
      sums[v + 1]! += y;
      sums[v + 2]! += z;
    }
  }
  const normals = new Int16Array(4 * indices.length);
  for (let c = 0; c < indices.length; ++c) {
    const v = 3 * indices[c]!;
    const length = length_of(sums[v]!, sums[v + 1]!, sums[v + 2]!) || 1;
    for (let k = 0; k < 3; ++k) normals[4 * c + k] = Math.round((32767 * sums[v + k]!) / length);
  }
  return normals;
}

/** Normal of the triangle whose first corner is `c`, twice its area long. */
export function triangle_normal(X: Float32Array, c: number): [number, number, number] {
  const i = 3 * c;
  const [ax, ay, az] = [X[i + 3]! - X[i]!, X[i + 4]! - X[i + 1]!, X[i + 5]! - X[i + 2]!];
  const [bx, by, bz] = [X[i + 6]! - X[i]!, X[i + 7]! - X[i + 1]!, X[i + 8]! - X[i + 2]!];
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

/** Leaves only the edges of polygons, not those that triangulating them has added. */
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

/** What the colour map is told of a corner without a value; see surface_material.ts. */
export const no_value = -100;

/**
 * The values of a field per corner, 0 and 1 being the ends of its range; null where the state has
 * none.
 */
export function field_values(
  scene: Scene,
  buffer: ArrayBuffer,
  field: Field,
  state: number,
): Float32Array | null {
  const ref: ArrayRef | null | undefined = field.values[state];
  if (!ref) return null;
  const corners = 3 * scene.triangles[state]!;
  const indices = array_of(
    buffer,
    scene.arrays.triangles,
    "uint32",
    3 * Math.max(...scene.triangles),
  );
  const values = array_of(buffer, ref, "float32", ref.length);
  const [low, high] = range_of(field);
  const shares = new Float32Array(corners);
  for (let c = 0; c < corners; ++c) {
    const value = values[field.on === "vertex" ? indices[c]! : Math.floor(c / 3)];
    shares[c] =
      value === undefined || !Number.isFinite(value)
        ? no_value
        : Math.min(3, Math.max(-2, high > low ? (value - low) / (high - low) : 0.5));
  }
  return shares;
}

export function range_of(field: Field): [number, number] {
  const [low, high] = field.range;
  return [low ?? 0, high ?? 0];
}
