import { element } from "./dom";
import type { Line, Report, Scene } from "./payload";
import { count_text, printable } from "./text";
import { line_styles } from "./lines";

/** A place of the mesh to which the camera can move. */
export interface Sight {
  title: string;
  kind: string; // the key of its symbol
  at: readonly number[];
  radius: number;
  line: Line | null;
}

/** One entry of the list: its text, and its place in the mesh if that is known. */
interface Entry {
  text: string;
  kind: string;
  sight: Sight | null;
}

const at_first = 12;

/** The sight of a line: the centroid of its points and their largest distance from the centroid. */
export function sight_of_line(line: Line): Sight {
  const at = [0, 0, 0];
  const count = Math.floor(line.points.length / 3);
  for (let i = 0; i < 3 * count; ++i) at[i % 3]! += line.points[i]! / count;
  let radius = 0;
  for (let i = 0; i < 3 * count; i += 3) {
    radius = Math.max(radius, Math.hypot(...at.map((x, k) => line.points[i + k]! - x)));
  }
  const style = line_styles.find((s) => s.kind === line.kind);
  return { title: line.title ?? style?.title ?? line.kind, kind: line.kind, at, radius, line };
}

function entries_of(report: Report, scene: Scene | null): Entry[] {
  const places = scene?.places ?? [];
  const told = new Set<number>();
  const sight = (index: number): Sight | null => {
    const place = places[index];
    if (!place) return null;
    told.add(index);
    const title = place.title ?? "";
    return { title, kind: "place", at: place.at, radius: place.radius ?? 0, line: null };
  };
  const warnings = (report.warnings ?? []).map((warning) => ({
    text: warning.text ?? "",
    kind: "warning",
    sight: typeof warning.place === "number" ? sight(warning.place) : null,
  }));
  const others = places.flatMap((place, i) =>
    told.has(i) ? [] : [{ text: place.title ?? "", kind: "place", sight: sight(i) }],
  );
  // A filled hole has two lines at the same place; only the seam is listed, not the rim.
  const lines = (scene?.lines ?? []).filter((line) => line.points.length >= 3);
  const filled = new Set(lines.filter((l) => l.kind === "seam").map((l) => l.hole));
  const rims = lines
    .filter((l) => l.kind !== "hole" || l.hole == null || !filled.has(l.hole))
    .map((line) => ({ ...sight_of_line(line), status: status_of(line, report) }))
    .map((s) => ({ text: s.title + s.status, kind: s.kind, sight: s }));
  return [...warnings, ...others, ...rims];
}

/** The status of the hole that a line bounds, as a suffix; empty if there is none. */
function status_of(line: Line, report: Report): string {
  const hole = report.holes?.find(({ id }) => id !== undefined && id === line.hole);
  return hole?.status ? `: ${hole.status}` : "";
}

const symbols: Record<string, string> = {
  warning: "\u26a0",
  place: "\u25ce",
  hole: "\u25cb",
  seam: "\u25cd",
  boundary: "\u25a1",
  held: "\u25a3",
  defect: "\u2716",
};

/** The list of warnings, places and lines to inspect; `list` is null if there are none. */
export class Places {
  readonly sights: Sight[];
  readonly list: HTMLElement | null;
  private readonly buttons = new Map<Sight, HTMLButtonElement>();
  private current = -1;

  constructor(
    report: Report,
    scene: Scene | null,
    private readonly go_to: ((sight: Sight) => void) | null,
  ) {
    const entries = entries_of(report, scene);
    const items = entries.map((entry) => this.item(entry));
    this.sights = entries.flatMap((entry) => (entry.sight ? [entry.sight] : []));
    this.list = items.length === 0 ? null : element("div", {}, ...folded(items));
  }

  /** Moves on by `step` places, cyclically. */
  go_on(step: number) {
    if (this.sights.length === 0) return;
    const from = this.current < 0 && step < 0 ? 0 : this.current;
    this.current = (from + step + this.sights.length) % this.sights.length;
    this.go(this.sights[this.current]!);
  }

  private go(sight: Sight) {
    this.current = this.sights.indexOf(sight);
    for (const [other, button] of this.buttons) {
      if (other === sight) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
    this.go_to?.(sight);
  }

  private item({ text, kind, sight }: Entry): HTMLLIElement {
    const symbol = element("span", { class: `symbol ${kind}`, "aria-hidden": "true" });
    symbol.textContent = symbols[kind] ?? "\u25ce";
    const words = element("span", {}, printable(text));
    if (!sight || !this.go_to) {
      return element("li", {}, element("span", { class: "entry" }, symbol, words));
    }
    const button = element(
      "button",
      { type: "button", class: "entry", title: "Show in the picture" },
      symbol,
      words,
    );
    button.addEventListener("click", () => this.go(sight));
    this.buttons.set(sight, button);
    return element("li", {}, button);
  }
}

/** Shows the first entries of a long list; the rest can be unfolded. */
function folded(items: HTMLLIElement[]): HTMLElement[] {
  const first = element("ul", { class: "places" }, ...items.slice(0, at_first));
  const rest = items.slice(at_first);
  if (rest.length === 0) return [first];
  return [
    first,
    element(
      "details",
      {},
      element("summary", {}, `${count_text(rest.length)} more`),
      element("ul", { class: "places" }, ...rest),
    ),
  ];
}
