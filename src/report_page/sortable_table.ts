import { element } from "./dom";
import { count_text } from "./text";

export interface Column<Row> {
  title: string;
  unit?: string;
  numeric?: boolean;
  /** The sort key of the column; rows with null come last in either order. */
  value: (row: Row) => number | string | null;
  show: (row: Row) => Node | string;
}

const at_once = 200;

/** A table that is sorted by clicking a column's title, and that shows long lists in parts. */
export class SortableTable<Row> {
  readonly element: HTMLElement;
  private readonly body = element("tbody");
  private readonly more = element("button", { type: "button" });
  private readonly heads: HTMLTableCellElement[];
  private shown = at_once;
  private sorted_by = -1;
  private descending = false;

  constructor(
    caption: string,
    private readonly columns: Column<Row>[],
    private rows: Row[],
  ) {
    this.heads = columns.map((column, i) => this.head(column, i));
    const table = element(
      "table",
      { class: "sortable" },
      element("caption", { class: "visually-hidden" }, caption),
      element("thead", {}, element("tr", {}, ...this.heads)),
      this.body,
    );
    // The focus lets the keyboard scroll a table that is wider than the page.
    const frame = { class: "scroll", tabindex: "0", role: "group", "aria-label": caption };
    this.element = element("div", {}, element("div", frame, table), this.more);
    this.more.addEventListener("click", () => {
      this.shown += 5 * at_once;
      this.fill();
    });
    this.fill();
  }

  show(rows: Row[]) {
    this.rows = rows;
    this.shown = at_once;
    this.fill();
  }

  sort_by(column: number, descending: boolean) {
    this.sorted_by = column;
    this.descending = descending;
    this.heads.forEach((head, i) => {
      if (i === column) head.setAttribute("aria-sort", descending ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    this.fill();
  }

  private head(column: Column<Row>, i: number): HTMLTableCellElement {
    const button = element("button", { type: "button" }, column.title);
    if (column.unit) button.append(" ", element("span", { class: "unit" }, column.unit));
    button.addEventListener("click", () => {
      // Numbers are sorted in descending order first: readers mostly look for the largest.
      const again = this.sorted_by === i;
      this.sort_by(i, again ? !this.descending : column.numeric === true);
    });
    return element("th", { scope: "col", class: column.numeric ? "number" : "" }, button);
  }

  private in_order(): Row[] {
    const column = this.columns[this.sorted_by];
    if (!column) return this.rows;
    const sign = this.descending ? -1 : 1;
    return [...this.rows].sort((a, b) => {
      const [x, y] = [column.value(a), column.value(b)];
      if (x === null || y === null) return Number(x === null) - Number(y === null);
      if (typeof x === "number" && typeof y === "number") return sign * (x - y);
      return sign * String(x).localeCompare(String(y), "en", { numeric: true });
    });
  }

  private fill() {
    const rows = this.in_order().slice(0, this.shown);
    this.body.replaceChildren(...rows.map((row) => this.line(row)));
    if (rows.length === 0) {
      const span = String(this.columns.length);
      this.body.append(element("tr", {}, element("td", { colspan: span, class: "none" }, "none")));
    }
    const left = this.rows.length - rows.length;
    this.more.hidden = left <= 0;
    this.more.textContent = `Show more (${count_text(left)} left)`;
  }

  private line(row: Row): HTMLTableRowElement {
    return element(
      "tr",
      {},
      ...this.columns.map((column) =>
        element("td", { class: column.numeric ? "number" : "" }, column.show(row)),
      ),
    );
  }
}
