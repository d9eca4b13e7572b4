import type { Vector3 } from "three";
import { triangle_normal, type SurfaceState } from "./surface";

export interface Hit {
  corner: number; // index of the triangle's first corner
  distance: number;
  weights: [number, number, number]; // barycentric coordinates
}

/** The nearest triangle that a ray hits, or null (Moeller and Trumbore 1997). */
export function pick(surface: SurfaceState, origin: Vector3, direction: Vector3): Hit | null {
  const { points: X, indices } = surface;
  const { x: ox, y: oy, z: oz } = origin;
  const { x: dx, y: dy, z: dz } = direction;
  let best: Hit | null = null;
  for (let c = 0; c < 3 * surface.triangles; c += 3) {
    const i = 3 * indices[c]!;
    const j = 3 * indices[c + 1]!;
    const k = 3 * indices[c + 2]!;
    const ax = X[j]! - X[i]!;
    const ay = X[j + 1]! - X[i + 1]!;
    const az = X[j + 2]! - X[i + 2]!;
    const bx = X[k]! - X[i]!;
    const by = X[k + 1]! - X[i + 1]!;
    const bz = X[k + 2]! - X[i + 2]!;
    const px = dy * bz - dz * by;
    const py = dz * bx - dx * bz;
    const pz = dx * by - dy * bx;
    const inverse = 1 / (ax * px + ay * py + az * pz);
    const tx = ox - X[i]!;
    const ty = oy - X[i + 1]!;
    const tz = oz - X[i + 2]!;
    const u = (tx * px + ty * py + tz * pz) * inverse;
    if (!(u >= 0 && u <= 1)) continue;
    const qx = ty * az - tz * ay;
    const qy = tz * ax - tx * az;
    const qz = tx * ay - ty * ax;
    const v = (dx * qx + dy * qy + dz * qz) * inverse;
    if (!(v >= 0 && u + v <= 1)) continue;
    const distance = (bx * qx + by * qy + bz * qz) * inverse;
    if (distance > 0 && (!best || distance < best.distance)) {
      best = { corner: c, distance, weights: [1 - u - v, u, v] };
    }
  }
  return best;
}

/** The mean normal of the triangles near a point, or null if there are none. */
export function normal_near(surface: SurfaceState, at: Vector3, radius: number): Vector3 | null {
  const { points: X, indices } = surface;
  const sum = at.clone().set(0, 0, 0);
  for (let c = 0; c < 3 * surface.triangles; c += 3) {
    const i = 3 * indices[c]!;
    if (Math.hypot(X[i]! - at.x, X[i + 1]! - at.y, X[i + 2]! - at.z) <= radius) {
      const [x, y, z] = triangle_normal(X, indices, c);
      sum.x += x;
      sum.y += y;
      sum.z += z;
    }
  }
  return sum.lengthSq() > 0 ? sum.normalize() : null;
}
