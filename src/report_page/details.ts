import { element, section } from "./dom";
import type { Report } from "./payload";
import { printable, seconds_text, title_of, value_text } from "./text";

/** A list of names and values; nested objects are flattened. */
function properties(values: Record<string, unknown>): HTMLElement {
  const list = element("dl", { class: "properties" });
  for (const [key, value] of flat(values)) {
    list.append(element("dt", {}, title_of(key)), element("dd", {}, value_text(value)));
  }
  return list;
}

function flat(values: Record<string, unknown>, prefix = ""): [string, unknown][] {
  return Object.entries(values).flatMap(([key, value]) =>
    typeof value === "object" && value !== null && !Array.isArray(value)
      ? flat(value as Record<string, unknown>, `${prefix}${key} `)
      : [[prefix + key, value] as [string, unknown]],
  );
}

function options_list(options: Record<string, unknown>): HTMLElement {
  const list = element("dl", { class: "properties options" });
  for (const [name, value] of Object.entries(options)) {
    const option = /^-|^[A-Z]/.test(name) ? name : `--${name}`;
    list.append(
      element("dt", {}, element("code", {}, printable(option))),
      element("dd", {}, value_text(value)),
    );
  }
  return list;
}

/** Seconds of each stage, as bars, and their total. */
export function seconds_section(seconds: Report["seconds"]): HTMLElement | null {
  if (typeof seconds !== "object" || seconds === null) return null;
  const stages = Object.entries(seconds).map(([name, s]) => [name, s ?? 0] as const);
  const total = stages.reduce((sum, [, s]) => sum + s, 0);
  if (stages.length === 0) return null;
  const most = Math.max(...stages.map(([, s]) => s)) || 1;
  const rows = stages.map(([name, s]) => {
    const bar = element("div", { class: "bar" });
    bar.style.width = `${(100 * s) / most}%`;
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, title_of(name)),
      element("td", { class: "bars", "aria-hidden": "true" }, bar),
      element("td", { class: "number" }, seconds_text(s)),
      element(
        "td",
        { class: "number share" },
        total > 0 ? `${((100 * s) / total).toFixed(0)} %` : "",
      ),
    );
  });
  const sum = element(
    "tr",
    { class: "sum" },
    element("th", { scope: "row" }, "Total"),
    element("td", {}),
    element("td", { class: "number" }, seconds_text(total)),
    element("td", {}),
  );
  const table = element("table", { class: "seconds" }, element("tbody", {}, ...rows, sum));
  return section("Time by stage", table);
}

export function options_section(report: Report): HTMLElement | null {
  const parts: HTMLElement[] = [];
  if (has_any(report.arguments)) parts.push(options_list(report.arguments));
  if (has_any(report.options)) {
    parts.push(element("h3", {}, "Resolved options"), properties(report.options));
  }
  return parts.length > 0 ? section("Options", ...parts) : null;
}

export function components_section(report: Report): HTMLElement | null {
  const components = report.components ?? [];
  if (!report.program && components.length === 0) return null;
  const list = element("dl", { class: "properties" });
  const [name = "ibmfair", version = ""] = (report.program ?? "").split(" ");
  for (const part of [{ name, version }, ...components.filter((c) => c.name !== name)]) {
    list.append(
      element("dt", {}, printable(part.name ?? "")),
      element("dd", {}, printable(part.version ?? "")),
    );
  }
  return section("Software versions", list);
}

/** Keys of the report that other parts of the page show already. */
const shown_elsewhere = new Set([
  ...["version", "program", "command", "input", "output", "status", "arguments", "options"],
  ...["components", "warnings", "before", "after", "steps", "seconds", "holes", "items", "counts"],
]);

/** All remaining values of the report, so that the page shows the whole report. */
export function further_section(report: Report): HTMLElement | null {
  const rest = Object.fromEntries(
    Object.entries(report).filter(([key]) => !shown_elsewhere.has(key)),
  );
  return has_any(rest) ? section("Further figures", properties(rest)) : null;
}

function has_any(values: Record<string, unknown> | undefined): values is Record<string, unknown> {
  return values !== undefined && values !== null && Object.keys(values).length > 0;
}
