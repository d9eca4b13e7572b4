import { element } from "./dom";
import { batch_headline } from "./batch_table";
import { figure_rows, has_two_states } from "./figures_table";
import { holes_summary } from "./holes_table";
import type { Report, Scene } from "./payload";
import { change_text, count_text, file_name, number_text, printable, seconds_text } from "./text";
import { status_chip } from "./status";
import { theme_button } from "./theme";

const figures_of_one = [
  "Vertices",
  "Triangles",
  "Bending energy",
  "Smallest angle",
  "Folded edges",
];

/** The few numbers by which most readers will judge the run. */
function key_figures(report: Report, scene: Scene | null): [string, string][] {
  if (report.items) return batch_headline(report);
  const figures: [string, string][] = [];
  const rows = figure_rows(report, scene);
  if (!has_two_states(rows)) {
    for (const { title, before } of rows) {
      if (figures_of_one.includes(title)) figures.push([title, number_text(before)]);
    }
    return figures;
  }
  for (const { title, before, after } of rows) {
    const change = change_text(before, after);
    if (["Bending energy", "Volume"].includes(title) && change !== "")
      figures.push([title, change]);
    if (title === "Folded edges") {
      figures.push([title, `${number_text(before)} \u2192 ${number_text(after)}`]);
    }
  }
  const edge = report.mesh?.mean_edge_length;
  if (typeof report.largest_move === "number" && typeof edge === "number" && edge > 0) {
    figures.push([
      "Largest move",
      `${number_text(report.largest_move / edge, 3)} mean edge lengths`,
    ]);
  }
  if (report.holes?.length) figures.push(["Holes filled", holes_summary(report.holes)]);
  if (typeof report.new_triangles === "number") {
    figures.push(["New triangles", number_text(report.new_triangles)]);
  }
  if (typeof report.seconds === "object") {
    const total = Object.values(report.seconds).reduce((sum: number, s) => sum + (s ?? 0), 0);
    figures.push(["Time", seconds_text(total)]);
  }
  return figures;
}

/** The names of the input and the output, as in "a.off -> b.off". */
function files_of(report: Report): (Node | string)[] {
  const input = report.input ?? (typeof report["file"] === "string" ? report["file"] : "");
  const names = [input, report.output ?? ""].filter((name) => name !== "");
  return names.flatMap((name, i) => {
    const shown = element("bdi", { title: printable(name) }, file_name(name));
    return i === 0 ? [shown] : [element("span", { class: "arrow" }, " \u2192 "), shown];
  });
}

export function page_title(report: Report): string {
  const input = report.input ?? (typeof report["file"] === "string" ? report["file"] : "");
  const command = `ibmfair ${printable(report.command ?? "")}`.trim();
  return input === "" ? command : `${file_name(input)} \u2013 ${command}`;
}

export function header(report: Report, scene: Scene | null, open_help: () => void): HTMLElement {
  const files = files_of(report);
  const title = report.items ? [`${count_text(report.items.length)} files`] : ["Report"];
  const help = element("button", { type: "button", class: "quiet" }, "? Keys");
  help.addEventListener("click", open_help);
  const kind = element("p", { class: "kind" }, `ibmfair ${printable(report.command ?? "")}`);
  if (report.status) kind.append(" ", status_chip(report.status));
  const top = element(
    "div",
    { class: "top" },
    element("div", {}, kind, element("h1", {}, ...(files.length > 0 ? files : title))),
    element("div", { class: "buttons" }, help, theme_button()),
  );
  const figures = element("dl", { class: "key-figures" });
  for (const [title, value] of key_figures(report, scene)) {
    figures.append(element("div", {}, element("dt", {}, title), element("dd", {}, value)));
  }
  return element("header", {}, top, figures);
}
