import { Packer } from "./pack.mjs";
import { distances, qualities, torus, torus_curvature } from "./shapes.mjs";

/** Payloads such as the program writes, one for each kind of page. */

const flat = (rows) => rows.flat();

function base_report(command, input, output) {
  return {
    version: 1,
    program: "ibmfair 0.1.0",
    command,
    input,
    output,
    arguments: { cutoff: "4", steps: 16, laplacian: "crouzeix-raviart", weld: false },
    components: [
      { name: "AMD", version: "2.4.6" },
      { name: "assimp", version: "5.2.5" },
    ],
    warnings: [],
  };
}

function steps_of(count) {
  return Array.from({ length: count }, (_, i) => ({
    step: i + 1,
    time: 1e-10 * 2 ** i,
    time_step: 1e-10 * 2 ** i,
    energy: 120 + 9000 / (i + 1) ** 2,
    gradient_norm: 6e8 / 10 ** (i / 3),
    largest_move: 0.005 / (i + 1),
    decrease_ratio: 0.9,
    refactored: true,
    held_back: 0,
  }));
}

/** Before and after smoothing a torus of about `triangles` triangles. */
export function smooth_payload({
  triangles = 4000,
  input = "scans/torus.off",
  centre = [0, 0, 0],
} = {}) {
  const across = Math.max(3, Math.round(Math.sqrt(triangles / 5)));
  const around = Math.max(3, Math.round(triangles / (2 * across)));
  const before = torus(around, across, 0.12);
  const after = torus(around, across, 0.01);
  const packer = new Packer();
  const moves = packer.add("float32", distances(before.points, after.points));
  const curvature = packer.add("float32", torus_curvature(around, across));
  const scene = {
    version: 1,
    name: input,
    centre,
    states: ["before", "after"],
    vertices: before.points.length,
    state_vertices: [before.points.length, after.points.length],
    triangles: [before.triangles.length, after.triangles.length],
    shown: null,
    arrays: {
      positions: [before, after].map((mesh) => packer.add("float32", flat(mesh.points))),
      triangles: packer.add("uint32", flat(before.triangles)),
      patch: null,
    },
    fields: [
      {
        name: "mean_curvature",
        title: "Mean curvature",
        unit: "1/length",
        diverging: true,
        on: "vertex",
        values: [curvature, curvature],
        range: [-3.5, 3.5],
      },
      {
        name: "displacement",
        title: "Displacement",
        unit: "length",
        diverging: false,
        on: "vertex",
        values: [null, moves],
        range: [0, 0.045],
      },
      {
        name: "quality",
        title: "Triangle quality",
        unit: "",
        diverging: false,
        on: "triangle",
        values: [before, after].map((mesh) => packer.add("float32", qualities(mesh))),
        range: [0.4, 1],
      },
    ],
    lines: [],
    places: [{ title: "edge 12-40 has three triangles", at: before.points[12], radius: 0.05 }],
    length_unit: "mesh units",
    mean_edge_length: 2.6 / across,
  };
  const figures = { energy: 9503.45, area: 15.91, volume: 3.158, smallest_angle_degrees: 21.4 };
  const report = {
    ...base_report("smooth", input, "fair/torus.off"),
    status: "completed",
    options: { laplacian: "crouzeix-raviart", steps: 16, cutoff: 0.0509, guarded: true },
    mesh: {
      vertices: before.points.length,
      triangles: before.triangles.length,
      mean_edge_length: scene.mean_edge_length,
    },
    before: { ...figures, folded_hinges: 3 },
    after: {
      energy: 125.9,
      area: 15.79,
      volume: 3.1581,
      smallest_angle_degrees: 27,
      folded_hinges: 0,
    },
    largest_move: 0.0204,
    rms_move: 0.0061,
    flow: { energy_before: 9503.45, energy_after: 125.9, solver: "multifrontal", solves: 27 },
    steps: steps_of(16),
    seconds: { read: 0.0011, topology: 0.0029, factor: 0.1306, solve: 0.0349, write: 0.0063 },
    warnings: [{ text: "1 edges of three or more triangles (12-40): left out", place: 0 }],
    defects: { non_manifold_edges: [[12, 40]], bow_tie_vertices: [] },
  };
  return finished(report, scene, packer);
}

function finished(report, scene, packer) {
  scene.bytes_length = packer.length;
  return { report, scene, bytes: packer.base64() };
}

/** A torus with two holes, of which the first has been filled. */
export function fill_payload() {
  const [around, across] = [60, 24];
  const whole = torus(around, across);
  const cell = (i, j) => 2 * (i * across + j);
  const taken = new Map();
  for (let i = 0; i < 4; ++i) {
    for (let j = 0; j < 4; ++j) {
      for (const t of [cell(8 + i, 3 + j), cell(8 + i, 3 + j) + 1]) taken.set(t, 1);
      for (const t of [cell(30 + i, 10 + j), cell(30 + i, 10 + j) + 1]) taken.set(t, 2);
    }
  }
  const kept = whole.triangles.filter((_, t) => !taken.has(t));
  const patch = whole.triangles.filter((_, t) => taken.get(t) === 1);
  const rim = (i, j) => {
    const at = (a, b) => whole.points[(i + a) * across + j + b];
    const corners = [];
    for (let k = 0; k < 4; ++k) corners.push(at(k, 0));
    for (let k = 0; k < 4; ++k) corners.push(at(4, k));
    for (let k = 4; k > 0; --k) corners.push(at(k, 4));
    for (let k = 4; k > 0; --k) corners.push(at(0, k));
    return corners.flat();
  };
  const packer = new Packer();
  const positions = packer.add("float32", flat(whole.points));
  const curvature = packer.add("float32", torus_curvature(around, across));
  const scene = {
    version: 1,
    name: "holes.ply",
    centre: [0, 0, 0],
    states: ["before", "after"],
    vertices: whole.points.length,
    state_vertices: [whole.points.length, whole.points.length],
    triangles: [kept.length, kept.length + patch.length],
    shown: null,
    arrays: {
      positions: [positions, positions],
      triangles: packer.add("uint32", flat([...kept, ...patch])),
      patch: packer.add("uint8", [...kept.map(() => 0), ...patch.map(() => 1)]),
    },
    fields: [
      {
        name: "mean_curvature",
        title: "Mean curvature",
        unit: "1/length",
        diverging: true,
        on: "vertex",
        values: [curvature, curvature],
        range: [-3.5, 3.5],
      },
    ],
    lines: [
      { kind: "hole", title: "hole 0", points: rim(8, 3), closed: true, hole: 0 },
      { kind: "seam", title: "hole 0", points: rim(8, 3), closed: true, hole: 0 },
      { kind: "hole", title: "hole 7", points: rim(30, 10), closed: true, hole: 7 },
    ],
    places: [],
    length_unit: "mesh units",
    mean_edge_length: 0.1,
  };
  return finished(fill_report(), scene, packer);
}

function fill_report() {
  const hole = { edges: 16, perimeter: 1.62, diameter: 0.57, closed_loop: true, simple: true };
  return {
    ...base_report("fill", "holes.ply", "closed.ply"),
    new_vertices: 9,
    new_triangles: 32,
    holes: [
      {
        id: 0,
        ...hole,
        status: "filled",
        reason: "",
        method: "crouzeix-raviart",
        rejected: [{ method: "lagrange", reason: "it ran away from the hole" }],
        new_vertices: 9,
        new_triangles: 32,
        diameter_ratio: 1.02,
        area_ratio: 1.1,
        seam_degrees: { median: 1.8, largest: 3.9 },
        surroundings_degrees: { median: 1.7, largest: 4.2 },
        folded_hinges: 0,
        intersections: 0,
        fairing: {
          converged: true,
          energy_before: 3.85,
          energy_after: 3.25,
          normal_gradient_ratio: 3.4e-4,
          steps: 4,
        },
      },
      { id: 7, ...hole, edges: 17, status: "skipped", reason: "has more than 16 edges" },
    ],
    seconds: { read: 0.02, topology: 0.042, fill: 0.025, audit: 0.009, write: 0.008 },
    defects: {},
  };
}

/** One mesh by itself, most of whose triangles were left out for viewing. */
export function view_payload() {
  const { report, scene, bytes } = smooth_payload();
  const { positions } = scene.arrays;
  Object.assign(scene, {
    states: ["mesh"],
    triangles: scene.triangles.slice(0, 1),
    state_vertices: scene.state_vertices.slice(0, 1),
    shown: { triangles: scene.triangles[0], of: 5200000 },
    arrays: { ...scene.arrays, positions: positions.slice(0, 1) },
    fields: scene.fields
      .filter(({ name }) => name !== "displacement")
      .map((field) => ({ ...field, values: field.values.slice(0, 1) })),
    lines: [
      { kind: "boundary", title: "boundary 0", points: [1.4, 0, 0, 1, 0.4, 0], closed: false },
    ],
  });
  const { program, components } = report;
  return {
    report: {
      ...{ version: 1, program, components, command: "view", file: "torus.off", vertices: 2000 },
      ...{ area: 15.9, volume: null, bending_energy: { lagrange: 80.1 }, warnings: [] },
    },
    scene,
    bytes,
  };
}

export const statuses = ["ok", "ok", "ok", "failed", "skipped", "not run"];

export function batch_payload(count = 40) {
  const items = Array.from({ length: count }, (_, i) => {
    const status = statuses[i % statuses.length];
    const failed = status === "failed";
    return {
      command: "smooth",
      input: `scans/part ${i}.off`,
      output: `fair/part ${i}.off`,
      status,
      exit_code: failed ? 3 : 0,
      seconds: ((i * 7919) % 1000) / 100,
      peak_megabytes: 20 + ((i * 31) % 17),
      message: failed ? `scans/part ${i}.off:1:1: not an OFF file` : "",
      page: status === "ok" ? `fair/part ${i}.html` : null,
      figures: failed ? {} : { "mesh.vertices": 1000 + i, "after.energy": i % 5 ? 900 / i : null },
    };
  });
  const counts = Object.fromEntries(
    [...new Set(statuses)].map((s) => [s, items.filter((item) => item.status === s).length]),
  );
  return { report: { ...base_report("batch"), seconds: 83.2, counts, items } };
}

export function one_triangle_payload() {
  const packer = new Packer();
  const scene = {
    version: 1,
    name: "one.off",
    centre: [1e9, -1e9, 0],
    states: ["mesh"],
    vertices: 3,
    triangles: [1],
    arrays: {
      positions: [packer.add("float32", [-1e-20, 0, 0, 1e-20, 0, 0, 0, 1e-20, 0])],
      triangles: packer.add("uint32", [0, 1, 2]),
    },
    fields: [
      {
        name: "mean_curvature",
        title: "Mean curvature",
        on: "vertex",
        diverging: true,
        values: [packer.add("float32", [NaN, Infinity, 0])],
        range: [null, null],
      },
    ],
  };
  return finished({ command: "view", input: "one.off" }, scene, packer);
}

export function empty_payload() {
  const scene = {
    version: 1,
    name: "empty.off",
    bytes_length: 0,
    centre: [0, 0, 0],
    states: ["mesh"],
    vertices: 0,
    triangles: [0],
    arrays: {
      positions: [{ type: "float32", offset: 0, length: 0 }],
      triangles: { type: "uint32", offset: 0, length: 0 },
    },
  };
  return { report: { command: "view", input: "empty.off", vertices: 0 }, scene, bytes: "" };
}

export const hostile_text =
  '</script><script>window.harmed = 1</script><img src=x onerror="window.harmed = 1">' +
  "\u202egpj.exe\u0007\u001b[31m&lt;b&gt;";

/** Every text of every payload is one that wants to be more than text. */
export function hostile_payload() {
  const { report, scene, bytes } = fill_payload();
  const poison = (value) => {
    if (typeof value === "string") return hostile_text;
    if (Array.isArray(value)) return value.map(poison);
    if (value === null || typeof value !== "object") return value;
    return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key, poison(inner)]));
  };
  const poisoned = poison(report);
  poisoned.arguments[hostile_text] = hostile_text;
  poisoned.before = { [hostile_text]: 1 };
  poisoned.after = { [hostile_text]: 2 };
  poisoned.seconds[hostile_text] = 1;
  poisoned.warnings = [{ text: hostile_text, place: 0 }];
  poisoned.items = [
    ...["javascript:window.harmed=1", "//example.org/", "file:///etc/passwd", "\\\\host\\share"],
    ...["java\tscript:window.harmed=1", " javascript:window.harmed=1", hostile_text],
  ].map((page) => ({ ...poison(batch_payload(1).report.items[0]), page }));
  scene.name = hostile_text;
  scene.fields[0].title = scene.fields[0].unit = hostile_text;
  scene.lines.forEach((line) => (line.title = hostile_text));
  scene.places = [{ title: hostile_text, at: [1, 0, 0], radius: 0.1 }];
  return { report: poisoned, scene, bytes };
}
