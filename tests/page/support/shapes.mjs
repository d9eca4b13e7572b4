/** Meshes to show: points and triangles, and what is known of them without computing it. */

/** A torus of `2 * around * across` triangles, with a bump pattern of the given height. */
export function torus(around, across, bump = 0) {
  const points = [];
  const triangles = [];
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < across; ++j) {
      const u = (2 * Math.PI * i) / around;
      const v = (2 * Math.PI * j) / across;
      const r = 0.4 * (1 + bump * Math.sin(9 * u) * Math.sin(5 * v));
      const distance = 1 + r * Math.cos(v);
      points.push([distance * Math.cos(u), r * Math.sin(v), distance * Math.sin(u)]);
      const next_i = (i + 1) % around;
      const next_j = (j + 1) % across;
      const at = (a, b) => a * across + b;
      triangles.push([at(i, j), at(i, next_j), at(next_i, j)]);
      triangles.push([at(next_i, j), at(i, next_j), at(next_i, next_j)]);
    }
  }
  return { points, triangles };
}

/** Mean curvature (the sum of both principal ones) of the torus without bumps, per vertex. */
export function torus_curvature(around, across) {
  const values = [];
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < across; ++j) {
      const c = Math.cos((2 * Math.PI * j) / across);
      values.push(1 / 0.4 + c / (1 + 0.4 * c));
    }
  }
  return values;
}

export function distances(A, B) {
  return A.map((a, i) => Math.hypot(...a.map((x, k) => x - B[i][k])));
}

/** 4 sqrt(3) A / sum of the squared edges: 1 for an equilateral triangle. */
export function qualities({ points, triangles }) {
  return triangles.map(([a, b, c]) => {
    const [p, q] = [b, c].map((v) => points[v].map((x, k) => x - points[a][k]));
    const cross = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    const edge = points[c].map((x, k) => x - points[b][k]);
    const squares = [...p, ...q, ...edge].reduce((sum, x) => sum + x * x, 0);
    return (2 * Math.sqrt(3) * Math.hypot(...cross)) / squares;
  });
}
