/**
 * The data that the program writes into the page: the contract between program and page.
 *
 * The built page holds three placeholders, each exactly once, which the program replaces:
 *
 *   @IBMFAIR_REPORT@ in <script id="report" type="application/json">: a Report
 *   @IBMFAIR_SCENE@  in <script id="scene" type="application/json">: a Scene, or null
 *   @IBMFAIR_BYTES@  in <script id="bytes" type="text/plain">: base64 of the gzip of all arrays, one
 *                    after the other, each aligned to 4 bytes
 *
 * In JSON, the program writes `<` as \u003c. Any field may be absent; the page shows the fields
 * that are present. Null stands for a number that is not finite.
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
  arguments?: Record<string, unknown>; // all options of the command line, by name
  options?: Record<string, unknown>; // options of the flow, resolved for this mesh
  components?: Component[];
  warnings?: Warning[];
  mesh?: Record<string, unknown>;
  before?: Record<string, unknown>;
  after?: Record<string, unknown>;
  largest_move?: Maybe<number>;
  rms_move?: Maybe<number>;
  flow?: Record<string, unknown>;
  steps?: Step[];
  seconds?: Record<string, Maybe<number>> | number; // per stage; for a batch, the total
  new_vertices?: number;
  new_triangles?: number;
  holes?: HoleReport[];
  fairing?: Record<string, unknown>;
  defects?: Record<string, unknown[]>;
  counts?: Record<string, number>; // for a batch: number of items per status
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
  method?: string;
  rejected?: { method?: string; reason?: string }[];
  diameter_ratio?: Maybe<number>;
  area_ratio?: Maybe<number>;
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
  page?: Maybe<string>; // path of the item's own page, relative to the folder of this page
  figures?: Record<string, unknown>; // keys are flattened, as in "after.energy"
}

/** An array within the unpacked bytes; `offset` is a multiple of 4. */
export interface ArrayRef {
  type: "float32" | "uint32" | "uint8";
  offset: number; // bytes
  length: number; // elements
}

export interface Scene {
  version: number;
  name?: string;
  bytes_length: number; // number of unpacked bytes of all arrays
  centre: [number, number, number]; // all positions in the scene are relative to this point
  states: string[]; // ["before", "after"] or ["mesh"]
  vertices: number;
  state_vertices?: number[]; // state s has the first state_vertices[s] vertices
  triangles: number[]; // state s has the first triangles[s] triangles of the list
  shown?: Maybe<{ triangles: number; of: number }>; // present if the mesh was decimated for viewing
  arrays: {
    positions: ArrayRef[]; // per state, float32, 3 per vertex
    triangles: ArrayRef; // uint32, 3 per triangle
    patch?: Maybe<ArrayRef>; // uint8 per triangle: 0: input, k > 0: patch of holes[k - 1]
    edges?: Maybe<ArrayRef>; // uint32 pairs: edges of the polygons; absent: all edges
  };
  fields?: Field[];
  lines?: Line[];
  places?: Place[];
  length_unit?: string;
  mean_edge_length?: Maybe<number>;
}

/** One value per vertex or triangle, shown as colour. */
export interface Field {
  name: string;
  title: string;
  unit?: string;
  diverging?: boolean; // signed values: the colour map is centred on the middle of the range
  on: "vertex" | "triangle";
  values: Maybe<ArrayRef>[]; // per state, float32; null for a state without values
  /** Range of the colour map in all states; logarithmic if positive and 1 : 1000 or more. */
  range: [Maybe<number>, Maybe<number>];
}

export type LineKind = "seam" | "hole" | "boundary" | "held" | "defect";

export interface Line {
  kind: LineKind;
  title?: string;
  points: number[]; // x, y, z, ...
  closed?: boolean;
  hole?: Maybe<number>; // `id` of the hole in Report.holes
}

/** The place that a warning refers to, or another place to inspect. */
export interface Place {
  title?: string;
  at: [number, number, number];
  radius?: Maybe<number>;
}
