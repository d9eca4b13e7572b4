import { Group } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Line, LineKind } from "./payload";
import { theme_rgb } from "./theme";

/** How a kind of line is drawn; kinds differ in colour, dashes and width. */
interface LineStyle {
  kind: LineKind;
  title: string;
  colour: string; // the name of a colour in the style sheet
  width: number; // pixels
  dash: number; // length, where the mesh fits the unit ball; 0 for solid lines
}

export const line_styles: LineStyle[] = [
  { kind: "hole", title: "Rims of holes", colour: "--line-hole", width: 3, dash: 0 },
  { kind: "seam", title: "Seams of patches", colour: "--line-seam", width: 2.5, dash: 0.012 },
  { kind: "boundary", title: "Boundaries", colour: "--line-boundary", width: 2.5, dash: 0 },
  { kind: "held", title: "Border of fixed vertices", colour: "--line-held", width: 2, dash: 0.006 },
  { kind: "defect", title: "Defects", colour: "--line-defect", width: 4, dash: 0 },
];

interface Bundle {
  style: LineStyle;
  object: LineSegments2;
  states: number[]; // the states of the mesh in which the lines are drawn
}

/** The lines of a scene. Lines of the same kind and states are drawn as one object. */
export class Lines {
  readonly group = new Group();
  private readonly bundles: Bundle[] = [];
  private chosen: LineSegments2 | null = null;

  constructor(
    lines: Line[],
    private readonly scale: number,
    states: number,
  ) {
    const filled = new Set(lines.filter((l) => l.kind === "seam").map((l) => l.hole));
    const alike = new Map<string, Line[]>();
    for (const line of lines) {
      const key = `${line.kind} ${states_of(line, filled, states)}`;
      alike.set(key, [...(alike.get(key) ?? []), line]);
    }
    for (const members of alike.values()) {
      const style = line_styles.find((s) => s.kind === members[0]!.kind);
      const object = style && line_object(members, style, scale);
      if (!object) continue;
      this.group.add(object);
      this.bundles.push({ style, object, states: states_of(members[0]!, filled, states) });
    }
  }

  /** Draws the selected line a second time, wider and in front of the surface. */
  select(line: Line | null) {
    if (this.chosen) this.group.remove(this.chosen);
    const style = line_styles.find((s) => s.kind === line?.kind);
    this.chosen = line && style ? line_object([line], { ...style, dash: 0 }, this.scale) : null;
    if (!this.chosen) return;
    this.chosen.material.linewidth = 5;
    this.chosen.material.depthTest = false;
    this.chosen.renderOrder = 1;
    this.group.add(this.chosen);
  }

  recolour() {
    for (const { object, style } of this.bundles) {
      object.material.color.setRGB(...theme_rgb(style.colour));
    }
  }

  show_those_of(state: number) {
    for (const { object, states } of this.bundles) object.visible = states.includes(state);
  }

  kinds(): LineStyle[] {
    return line_styles.filter((style) => this.bundles.some((b) => b.style === style));
  }
}

function line_object(lines: Line[], style: LineStyle, scale: number): LineSegments2 | null {
  const parts = lines.map((line) => segments_of(line, scale));
  const points = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  if (points.length === 0) return null;
  let offset = 0;
  for (const part of parts) {
    points.set(part, offset);
    offset += part.length;
  }
  const material = new LineMaterial({
    linewidth: style.width,
    dashed: style.dash > 0,
    dashSize: style.dash,
    gapSize: 0.7 * style.dash,
  });
  material.color.setRGB(...theme_rgb(style.colour));
  const object = new LineSegments2(new LineSegmentsGeometry().setPositions(points), material);
  return style.dash > 0 ? object.computeLineDistances() : object;
}

/** The rim of a filled hole is drawn in the first state, its seam in the last, others in all. */
function states_of(line: Line, filled: Set<unknown>, states: number): number[] {
  const all = [...Array(states).keys()];
  if (states < 2) return all;
  if (line.kind === "seam") return [states - 1];
  const closes = line.kind === "hole" && line.hole != null && filled.has(line.hole);
  return closes ? [0] : all;
}

function segments_of(line: Line, scale: number): Float32Array {
  const count = Math.floor(line.points.length / 3);
  const points = Float32Array.from(line.points, (x) => x * scale);
  const pairs: number[] = [];
  for (let i = 0; i + 1 < count; ++i) pairs.push(i, i + 1);
  if (line.closed && count > 2) pairs.push(count - 1, 0);
  const segments = new Float32Array(3 * pairs.length);
  pairs.forEach((point, k) => segments.set(points.subarray(3 * point, 3 * point + 3), 3 * k));
  return segments;
}
