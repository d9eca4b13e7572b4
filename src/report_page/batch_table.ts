import { element } from "./dom";
import type { BatchItem, Report } from "./payload";
import { SortableTable, type Column } from "./sortable_table";
import { mood_of, status_chip } from "./status";
import {
  count_text,
  file_name,
  number_text,
  printable,
  seconds_text,
  title_of,
  value_text,
} from "./text";

/** The figures with a column of their own, in this order; "All figures" lists all of them. */
const foremost = [
  "mesh.vertices",
  "vertices",
  "before.energy",
  "after.energy",
  "after.smallest_angle_degrees",
  "after.folded_hinges",
  "largest_move",
  "new_vertices",
  "new_triangles",
];

/** The files of a batch, which can be filtered by words and status and sorted by any column. */
export class BatchTable {
  readonly element: HTMLElement;
  private readonly table: SortableTable<BatchItem>;
  private readonly search = element("input", {
    type: "search",
    placeholder: "Filter by name or message",
    "aria-label": "Filter by name or message",
  });
  private readonly count = element("output", { class: "note" });
  private status: string | null = null;

  constructor(private readonly items: BatchItem[]) {
    this.table = new SortableTable("Files", columns_of(items), items);
    this.search.addEventListener("input", () => this.filter());
    const bar = element(
      "div",
      { class: "toolbar" },
      this.search,
      this.status_buttons(),
      this.count,
    );
    this.element = element("div", {}, bar, this.table.element);
    this.filter();
  }

  private status_buttons(): HTMLElement {
    const group = element("div", { class: "segments", role: "group", "aria-label": "Status" });
    const numbers = new Map<string, number>();
    for (const { status = "unknown" } of this.items) {
      numbers.set(status, (numbers.get(status) ?? 0) + 1);
    }
    const choices: [string | null, number][] = [[null, this.items.length], ...numbers];
    for (const [status, number] of choices) {
      const text = `${printable(status ?? "all")} ${count_text(number)}`;
      const button = element("button", { type: "button" }, text);
      button.setAttribute("aria-pressed", String(status === null));
      button.addEventListener("click", () => {
        this.status = status;
        for (const other of group.children) {
          other.setAttribute("aria-pressed", String(other === button));
        }
        this.filter();
      });
      group.append(button);
    }
    return group;
  }

  private filter() {
    const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = this.items.filter((item) => {
      if (this.status !== null && (item.status ?? "unknown") !== this.status) return false;
      const text = `${item.input} ${item.output} ${item.command} ${item.message}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    this.table.show(rows);
    this.count.textContent = `${count_text(rows.length)} of ${count_text(this.items.length)} files`;
  }
}

function columns_of(items: BatchItem[]): Column<BatchItem>[] {
  const there = new Set(items.flatMap((item) => Object.keys(item.figures ?? {})));
  const figures = foremost.filter((key) => there.has(key));
  return [
    {
      title: "File",
      value: (item) => item.input ?? item.output ?? "",
      show: name_cell,
    },
    {
      title: "Status",
      value: (item) => item.status ?? "",
      show: status_cell,
    },
    {
      title: "Command",
      value: (item) => item.command ?? "",
      show: (item) => printable(item.command ?? ""),
    },
    {
      title: "Time",
      numeric: true,
      value: (item) => item.seconds ?? null,
      show: (item) => seconds_text(item.seconds),
    },
    {
      title: "Memory",
      unit: "MB",
      numeric: true,
      value: (item) => item.peak_megabytes ?? null,
      show: (item) => number_text(item.peak_megabytes, 3),
    },
    ...figures.map((key) => figure_column(key)),
    { title: "All figures", value: () => null, show: all_figures },
  ];
}

function figure_column(key: string): Column<BatchItem> {
  const value = (item: BatchItem) => item.figures?.[key];
  return {
    title: figure_titles[key] ?? title_of(key),
    numeric: true,
    value: (item) => {
      const figure = value(item);
      return typeof figure === "number" ? figure : null;
    },
    show: (item) => number_text(value(item), 4),
  };
}

const figure_titles: Record<string, string> = {
  "mesh.vertices": "Vertices",
  "before.energy": "Energy before",
  "after.energy": "Energy after",
  "after.smallest_angle_degrees": "Smallest angle \u00b0",
  "after.folded_hinges": "Folds",
};

function name_cell(item: BatchItem): Node {
  const input = item.input || item.output || "";
  const name = element("bdi", {}, file_name(input));
  const href = link_of(item.page);
  const cell = element("div", { class: "file", title: printable(input) });
  cell.append(href ? element("a", { href }, name) : name);
  if (item.output && item.output !== input) {
    cell.append(
      element("div", { class: "reason" }, "\u2192 ", element("bdi", {}, printable(item.output))),
    );
  }
  return cell;
}

/**
 * The link to the page at a path on disk, relative to this page's folder. Null if the path is not
 * relative: paths that begin with a slash, a drive letter, a scheme or a host are rejected.
 */
export function link_of(path: string | null | undefined): string | null {
  if (!path || /^([\\/]|[a-z][a-z0-9+.-]*:)/i.test(path)) return null;
  return `./${path.split("/").map(encodeURIComponent).join("/")}`;
}

function status_cell(item: BatchItem): Node {
  const status = item.status ?? "unknown";
  const cell = element("div", { class: "status" }, status_chip(status));
  if (mood_of(status) === "bad" && item.exit_code) {
    cell.append(element("span", { class: "note" }, ` exit code ${item.exit_code}`));
  }
  if (item.message) cell.append(element("div", { class: "reason" }, printable(item.message)));
  return cell;
}

function all_figures(item: BatchItem): Node | string {
  const figures = Object.entries(item.figures ?? {});
  if (figures.length === 0) return "";
  const list = element("dl", { class: "properties" });
  for (const [key, value] of figures) {
    list.append(element("dt", {}, title_of(key)), element("dd", {}, value_text(value)));
  }
  return element("details", {}, element("summary", {}, `${figures.length} figures`), list);
}

/** The key figures of the whole batch. */
export function batch_headline(report: Report): [string, string][] {
  const items = report.items ?? [];
  const done = items.filter((item) => item.status === "ok" || item.status === "skipped").length;
  const most = Math.max(0, ...items.map((item) => item.peak_megabytes ?? 0));
  const failed = items.filter((item) => item.status === "failed").length;
  return [
    ["Files done", `${count_text(done)} of ${count_text(items.length)}`],
    ["Failed", count_text(failed)],
    ["Time", typeof report.seconds === "number" ? seconds_text(report.seconds) : "\u2013"],
    ["Peak memory", `${number_text(most, 3)} MB`],
  ];
}
