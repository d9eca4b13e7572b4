import { element } from "./dom";
import type { Report, Scene } from "./payload";
import { change_text, number_text, title_of } from "./text";

/** Title, unit and tooltip of a known figure; other figures are shown under their key. */
interface Known {
  key: string;
  title: string;
  unit: string;
  hint: string;
}

const known: Known[] = [
  { key: "vertices", title: "Vertices", unit: "", hint: "" },
  { key: "triangles", title: "Triangles", unit: "", hint: "" },
  {
    key: "energy",
    title: "Bending energy",
    unit: "",
    hint: "8\u03c0 \u2248 25.1 for a round sphere",
  },
  { key: "area", title: "Area", unit: "length\u00b2", hint: "" },
  {
    key: "volume",
    title: "Volume",
    unit: "length\u00b3",
    hint: "for an open mesh, the volume of the cone over the mesh",
  },
  { key: "smallest_angle_degrees", title: "Smallest angle", unit: "\u00b0", hint: "" },
  {
    key: "folded_hinges",
    title: "Folded edges",
    unit: "",
    hint: "edges at which the two triangles are folded over",
  },
];

export interface FigureRow {
  title: string;
  unit: string;
  hint: string;
  before: unknown;
  after: unknown;
}

/** Figures of the mesh before and after: those of `known` first, in that order. */
export function figure_rows(report: Report, scene: Scene | null): FigureRow[] {
  const before = { ...counts_of(report, scene, 0), ...report.before };
  const is_single = report.after === undefined && scene?.states.length === 1;
  const after = is_single ? {} : { ...counts_of(report, scene, 1), ...report.after };
  const keys = [...new Set([...Object.keys(before), ...Object.keys(after)])];
  const place = (key: string) => {
    const found = known.findIndex((k) => k.key === key);
    return found < 0 ? known.length : found;
  };
  return keys
    .sort((a, b) => place(a) - place(b))
    .map((key) => {
      const about = known.find((k) => k.key === key) ?? {
        title: title_of(key),
        unit: "",
        hint: "",
      };
      return { ...about, before: before[key], after: after[key] };
    });
}

export function has_two_states(rows: FigureRow[]): boolean {
  return rows.some((row) => row.after !== undefined);
}

function counts_of(report: Report, scene: Scene | null, state: number): Record<string, unknown> {
  const added = state === 1;
  if (report.mesh) {
    const { vertices, triangles } = report.mesh as { vertices?: number; triangles?: number };
    return {
      ...(vertices !== undefined && {
        vertices: vertices + (added ? (report.new_vertices ?? 0) : 0),
      }),
      ...(triangles !== undefined && {
        triangles: triangles + (added ? (report.new_triangles ?? 0) : 0),
      }),
    };
  }
  // The counts of a decimated scene differ from those of the mesh.
  if (!scene || scene.shown || scene.states.length < 2) return {};
  return {
    vertices: scene.state_vertices?.[state] ?? scene.vertices,
    triangles: scene.triangles[state],
  };
}

/** A table with columns for before, after and change; for a single mesh, one column of values. */
export function figures_table(rows: FigureRow[], title: string): HTMLElement {
  const two = has_two_states(rows);
  const head = (two ? ["", "Before", "After", "Change"] : ["", "Value"]).map((name, i) =>
    element("th", { scope: "col", class: i > 0 ? "number" : "" }, name),
  );
  const number = (text: string, further = "") =>
    element("td", { class: `number ${further}` }, text);
  const body = rows.map((row) => {
    const name = element("th", { scope: "row" }, row.title);
    if (row.unit) name.append(" ", element("span", { class: "unit" }, row.unit));
    if (row.hint) name.title = row.hint;
    const after = [
      number(number_text(row.after, 5)),
      number(change_text(row.before, row.after), "change"),
    ];
    return element("tr", {}, name, number(number_text(row.before, 5)), ...(two ? after : []));
  });
  return element(
    "div",
    { class: "scroll" },
    element(
      "table",
      { class: "figures" },
      element("caption", { class: "visually-hidden" }, title),
      element("thead", {}, element("tr", {}, ...head)),
      element("tbody", {}, ...body),
    ),
  );
}
