import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { element, section } from "./dom";
import type { Report, Step } from "./payload";
import { SortableTable, type Column } from "./sortable_table";
import { number_text, tick_text } from "./text";
import { on_theme, theme_colour } from "./theme";

/** One curve over the steps of the flow; each row of `curves` is a plot on the page. */
interface Curve {
  title: string;
  unit: string;
  value: (step: Step) => number | null | undefined;
}

const curves: Curve[] = [
  { title: "Bending energy", unit: "", value: (step) => step.energy },
  { title: "Norm of the gradient", unit: "1/length", value: (step) => step.gradient_norm },
  { title: "Time step", unit: "length\u2074", value: (step) => step.time_step },
  { title: "Largest move", unit: "length", value: (step) => step.largest_move },
];

const decades_for_log = 1.5;
const height = 190;

/** Curves over the steps of the flow, and the same numbers as a table. */
export function plots_section(report: Report): HTMLElement | null {
  const steps = with_start(report);
  if (steps.length < 2) return null;
  const frames = element("div", { class: "plots" });
  const together = uPlot.sync("steps");
  for (const curve of curves) {
    const numbers = steps.map((step) => number_or_null(curve.value(step)));
    if (numbers.every((x) => x === null)) continue;
    const frame = element("figure", { class: "plot" });
    const is_log = spans_decades(numbers);
    const unit = curve.unit === "" ? "" : `, ${curve.unit}`;
    const caption = element("figcaption", {}, curve.title);
    caption.append(element("span", { class: "unit" }, `${unit}${is_log ? ", logarithmic" : ""}`));
    const body = element("div", { role: "img", "aria-label": describe(curve.title, numbers) });
    frame.append(caption, body);
    frames.append(frame);
    draw_when_seen(body, steps, numbers, curve.title, is_log, together);
  }
  const table = new SortableTable("Steps", columns(), steps).element;
  const details = element("details", {}, element("summary", {}, "Steps as a table"), table);
  return section("Steps", frames, details);
}

/** Adds step 0, the input mesh, of which only the energy is known. */
function with_start(report: Report): Step[] {
  const steps = report.steps ?? [];
  const energy = report.flow?.energy_before;
  return typeof energy === "number" && steps.length > 0 ? [{ step: 0, energy }, ...steps] : steps;
}

function number_or_null(x: number | null | undefined): number | null {
  return typeof x === "number" && Number.isFinite(x) ? x : null;
}

function spans_decades(numbers: (number | null)[]): boolean {
  const known = numbers.filter((x) => x !== null);
  const least = Math.min(...known);
  return least > 0 && Math.log10(Math.max(...known) / least) >= decades_for_log;
}

function describe(title: string, numbers: (number | null)[]): string {
  const known = numbers.filter((x) => x !== null);
  return (
    `${title} over ${known.length} steps, from ${number_text(known[0])} ` +
    `to ${number_text(known.at(-1))}; the numbers are in the table below`
  );
}

function columns(): Column<Step>[] {
  const column = (title: string, unit: string, value: Curve["value"]): Column<Step> => ({
    title,
    unit,
    numeric: true,
    value: (step) => value(step) ?? null,
    show: (step) => number_text(value(step), 5),
  });
  return [
    column("Step", "", (step) => step.step),
    column("Time", "length\u2074", (step) => step.time),
    ...curves.map((curve) => column(curve.title, curve.unit, curve.value)),
  ];
}

/** Draws the plot once `body` has a width, and again when the width or the colours change. */
function draw_when_seen(
  body: HTMLElement,
  steps: Step[],
  numbers: (number | null)[],
  title: string,
  is_log: boolean,
  together: uPlot.SyncPubSub,
) {
  let plot: uPlot | null = null;
  const draw = () => {
    plot?.destroy();
    const options = plot_options(title, is_log, together.key, body.clientWidth);
    plot = new uPlot(options, [steps.map((step, i) => step.step ?? i), numbers], body);
  };
  new ResizeObserver(() => {
    if (body.clientWidth === 0) return;
    if (plot) plot.setSize({ width: body.clientWidth, height });
    else draw();
  }).observe(body);
  on_theme(() => plot && draw());
}

function plot_options(title: string, is_log: boolean, group: string, width: number): uPlot.Options {
  const axis = {
    stroke: theme_colour("--muted"),
    font: "12px system-ui, sans-serif",
    grid: { stroke: theme_colour("--grid"), width: 1 },
    ticks: { stroke: theme_colour("--grid"), width: 1, size: 4 },
  };
  const colour = theme_colour("--accent");
  return {
    width,
    height,
    cursor: { sync: { key: group }, y: false, drag: { x: false, y: false } },
    legend: { live: true },
    scales: { x: { time: false }, y: { distr: is_log ? 3 : 1 } },
    axes: [
      { ...axis, size: 28, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000] },
      {
        ...axis,
        size: 62,
        values: (_, splits) => splits.map((x) => (x === null ? "" : tick_text(x))),
      },
    ],
    series: [
      { label: "Step" },
      {
        label: title,
        stroke: colour,
        width: 1.75,
        points: { show: true, size: 5, fill: colour },
        value: (_, x) => number_text(x, 5),
      },
    ],
  };
}
