import { css_gradient, diverging, sequential } from "./colour_maps";
import { element } from "./dom";
import { scale_of } from "./field_scale";
import type { Field } from "./payload";
import { number_text, printable, tick_text, unit_text } from "./text";

/** The colour bar of the picture, with a mark at the value under the mouse pointer. */
export class Legend {
  readonly element = element("div", { class: "legend" });
  private readonly pointer = element("div", { class: "legend-pointer", hidden: "" });
  private field: Field | undefined;

  show(field: Field | undefined) {
    this.field = field;
    this.element.hidden = field === undefined;
    if (!field) return;
    const [low, high] = field.range;
    const scale = scale_of(field);
    const map = field.diverging ? diverging : sequential;
    const unit = [unit_text(field.unit ?? ""), scale.is_log ? "logarithmic" : ""]
      .filter((part) => part !== "")
      .join(", ");
    const bar = element("div", { class: "legend-bar" }, this.pointer);
    bar.style.backgroundImage = css_gradient(map);
    const ticks = element("div", { class: "legend-ticks" });
    for (const value of scale.ticks(5)) {
      const tick = element("span", {}, tick_text(value));
      tick.style.left = `${100 * this.share_of(value)}%`;
      ticks.append(tick);
    }
    const title = printable(field.title);
    this.element.replaceChildren(
      element("div", { class: "legend-title" }, title, element("span", { class: "unit" }, unit)),
      bar,
      ticks,
    );
    this.element.setAttribute("role", "img");
    this.element.setAttribute(
      "aria-label",
      `${title} from ${number_text(low)} to ${number_text(high)} ${unit}, coloured ${map.name}; ` +
        "values outside this range have the colour of the nearer end",
    );
    this.point_at(null);
  }

  point_at(value: number | null) {
    this.pointer.hidden = value === null;
    if (value !== null) this.pointer.style.left = `${100 * this.share_of(value)}%`;
  }

  private share_of(value: number): number {
    const share = this.field ? scale_of(this.field).share(value) : 0.5;
    return Math.min(1, Math.max(0, share));
  }
}
