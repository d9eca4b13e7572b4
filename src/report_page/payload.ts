/**
 * What the program writes into the page: the contract between both.
 *
 * The built page holds three placeholders, each exactly once, which the program replaces:
 *
 *   @IBMFAIR_REPORT@ in <script id="report" type="application/json">: a Report
 *   @IBMFAIR_SCENE@  in <script id="scene" type="application/json">: a Scene, or null
 *   @IBMFAIR_BYTES@  in <script id="bytes" type="text/plain">: base64 of the gzip of all arrays, one
 *                    after the other, each aligned to 4 bytes
 *
 * In JSON, the program writes `<` as \u003c. Any field may be absent, and null stands for a number
 * that is not finite: the page shows what there is.
 */

export type Maybe<T> = T | null | undefined;

/** The JSON of `--report FILE.json`; its schema describes every field. */
export interface Report {
  version?: number;
  program?: string; // "ibmfair 0.1.0"
  command?: string; // "smooth", "fill", "view", "batch"
  input?: string;
  output?: string;
  status?: string; // of the flow: "completed", "interrupted", "stalled", "diverged"
  arguments?: Record<string, unknown>; // all options in force, by name
  options?: Record<string, unknown>; // as the flow has used them
  components?: Component[];
  warnings?: Warning[];
  mesh?: Record<string, unknown>;
  before?: Record<string, unknown>;
  after?: Record<string, unknown>;
  largest_move?: Maybe<number>;
  rms_move?: Maybe<number>;
  flow?: Record<string, unknown>;
  steps?: Step[];
  seconds?: Record<string, Maybe<number>> | number; // by stage; of a batch, of all
  new_vertices?: number;
  new_triangles?: number;
  holes?: HoleReport[];
  fairing?: Record<string, unknown>;
  defects?: Record<string, unknown[]>;
  counts?: Record<string, number>; // of a batch: items by status
  items?: BatchItem[];
  [further: string]: unknown;
}

export interface Component {
  name?: string;
  version?: string;
}

export interface Warning {
  text?: string;
  place?: Maybe<number>; // index into Scene.places
}

export interface Step {
  step?: number;
  time?: Maybe<number>;
  time_step?: Maybe<number>;
  energy?: Maybe<number>;
  gradient_norm?: Maybe<number>;
  largest_move?: Maybe<number>;
  [further: string]: unknown;
}

export interface HoleReport {
  id?: number;
  edges?: number;
  perimeter?: Maybe<number>;
  diameter?: Maybe<number>;
  status?: string; // "filled", "skipped", ...
  reason?: string;
  new_vertices?: number;
  new_triangles?: number;
  seam_degrees?: { median?: Maybe<number>; largest?: Maybe<number> };
  surroundings_degrees?: { median?: Maybe<number>; largest?: Maybe<number> };
  folded_hinges?: number;
  intersections?: number;
  fairing?: {
    converged?: boolean;
    energy_before?: Maybe<number>;
    energy_after?: Maybe<number>;
    normal_gradient_ratio?: Maybe<number>;
    steps?: number;
    [further: string]: unknown;
  };
  [further: string]: unknown;
}

export interface BatchItem {
  command?: string;
  input?: string;
  output?: string;
  status?: string; // "ok", "failed", "skipped", "interrupted", "not run"
  exit_code?: number;
  seconds?: Maybe<number>;
  peak_megabytes?: Maybe<number>;
  message?: string;
  page?: Maybe<string>; // the item's own page: a path relative to this one's folder, as on disk
  figures?: Record<string, unknown>; // flat: "after.energy"
}

/** An array within the bytes, which are unpacked first; `offset` is a multiple of 4. */
export interface ArrayRef {
  type: "float32" | "uint32" | "uint8";
  offset: number; // bytes
  length: number; // elements
}

export interface Scene {
  version: number;
  name?: string;
  bytes_length: number; // of all arrays, unpacked
  centre: [number, number, number]; // what all positions here are relative to
  states: string[]; // ["before", "after"] or ["mesh"]
  vertices: number;
  state_vertices?: number[]; // of state s: the first so many
  triangles: number[]; // of state s: the first so many of the list
  shown?: Maybe<{ triangles: number; of: number }>; // where the mesh was decimated for viewing
  arrays: {
    positions: ArrayRef[]; // per state, float32, 3 per vertex
    triangles: ArrayRef; // uint32, 3 per triangle
    patch?: Maybe<ArrayRef>; // uint8 per triangle: 0 of the input, k > 0 patch of holes[k - 1]
    edges?: Maybe<ArrayRef>; // uint32 pairs: the polygons' edges; absent: all of the triangles'
  };
  fields?: Field[];
  lines?: Line[];
  places?: Place[];
  length_unit?: string;
  mean_edge_length?: Maybe<number>;
}

/** A number per vertex or triangle, shown as colour. */
export interface Field {
  name: string;
  title: string;
  unit?: string;
  diverging?: boolean; // signed: the middle of the colour map is the middle of the range
  on: "vertex" | "triangle";
  values: Maybe<ArrayRef>[]; // per state, float32; null where a state has none
  /** What the colour map spans, the same for all states; evenly by logarithm from 1 : 1000 on. */
  range: [Maybe<number>, Maybe<number>];
}

export type LineKind = "seam" | "hole" | "boundary" | "held" | "defect";

export interface Line {
  kind: LineKind;
  title?: string;
  points: number[]; // x, y, z, ...
  closed?: boolean;
  hole?: Maybe<number>; // its `id` in Report.holes
}

/** What a warning is about, or something else worth looking at. */
export interface Place {
  title?: string;
  at: [number, number, number];
  radius?: Maybe<number>;
}
