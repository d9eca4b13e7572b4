import { element } from "./dom";
import type { HoleReport } from "./payload";
import { SortableTable, type Column } from "./sortable_table";
import { mood_of, status_chip } from "./status";
import { number_text, printable } from "./text";

function numbers(
  title: string,
  value: (hole: HoleReport) => number | null | undefined,
  unit = "",
): Column<HoleReport> {
  return {
    title,
    unit,
    numeric: true,
    value: (hole) => value(hole) ?? null,
    show: (hole) => number_text(value(hole), 3),
  };
}

const columns: Column<HoleReport>[] = [
  {
    title: "Status",
    value: (hole) => hole.status ?? "",
    show: (hole) => {
      const cell = element("div", { class: "status" }, status_chip(hole.status ?? "unknown"));
      if (hole.reason) cell.append(element("div", { class: "reason" }, printable(hole.reason)));
      for (const { method, reason } of hole.rejected ?? []) {
        const text = `not by ${printable(method ?? "")}: ${printable(reason ?? "")}`;
        cell.append(element("div", { class: "reason" }, text));
      }
      return cell;
    },
  },
  numbers("Edges", (hole) => hole.edges),
  numbers("Diameter", (hole) => hole.diameter),
  numbers("New vertices", (hole) => hole.new_vertices),
  numbers("New triangles", (hole) => hole.new_triangles),
  {
    title: "Method",
    value: (hole) => hole.method ?? "",
    show: (hole) => printable(hole.method ?? ""),
  },
  numbers("Patch diameter", (hole) => hole.diameter_ratio, "\u00d7 hole"),
  numbers("Patch area", (hole) => hole.area_ratio, "\u00d7 hole"),
  numbers("Energy before", (hole) => hole.fairing?.energy_before),
  numbers("Energy after", (hole) => hole.fairing?.energy_after),
  numbers("Gradient ratio", (hole) => hole.fairing?.normal_gradient_ratio),
  numbers("Steps", (hole) => hole.fairing?.steps),
  numbers("Seam angle", (hole) => hole.seam_degrees?.median, "\u00b0 median"),
  numbers("Largest seam angle", (hole) => hole.seam_degrees?.largest, "\u00b0"),
  numbers("Angle around hole", (hole) => hole.surroundings_degrees?.median, "\u00b0 median"),
  numbers("Folds", (hole) => hole.folded_hinges),
  numbers("Intersections", (hole) => hole.intersections),
];

/** One row per hole. `show` moves the picture to a hole for which `is_shown` is true. */
export function holes_table(
  holes: HoleReport[],
  is_shown: (id: number) => boolean,
  show: (id: number) => void,
): HTMLElement {
  const name: Column<HoleReport> = {
    title: "Hole",
    value: (hole) => hole.id ?? null,
    show: (hole) => {
      if (hole.id === undefined || !is_shown(hole.id)) return `hole ${hole.id ?? ""}`;
      const button = element("button", { type: "button", class: "link" }, `hole ${hole.id}`);
      button.title = "Show in the picture";
      button.addEventListener("click", () => show(hole.id!));
      return button;
    },
  };
  return new SortableTable("Holes", [name, ...columns], holes).element;
}

/** The number of filled holes, as in "4 of 5". */
export function holes_summary(holes: HoleReport[]): string {
  const filled = holes.filter((hole) => mood_of(hole.status ?? "") === "good").length;
  return `${filled} of ${holes.length}`;
}
