import { Vector3 } from "three";
import { element } from "./dom";
import type { Key } from "./keys";
import { Legend } from "./legend";
import { Overlay } from "./overlay";
import type { Line, Scene } from "./payload";
import type { Sight } from "./places";
import { Store } from "./state";
import { count_text, file_name, number_text, printable, unit_text } from "./text";
import { switches_of, toolbar } from "./toolbar";
import { View, type Probe } from "./view";

/** The picture of the mesh with its controls, legend and keys. */
export class Viewer {
  readonly element: HTMLElement;
  readonly view: View;
  private readonly store: Store;
  private readonly overlay: Overlay;
  private readonly legend = new Legend();
  private readonly reading = element("output", { class: "reading" });

  constructor(
    private readonly scene: Scene,
    buffer: ArrayBuffer,
  ) {
    const two = scene.states.length > 1;
    this.store = new Store({
      shown: two ? scene.states.length - 1 : 0,
      split: two,
      split_at: 0.5,
      field: (scene.fields ?? []).length > 0 ? 0 : -1,
      wireframe: false,
      flat: false,
      contours: false,
      patches: true,
      lines: true,
    });
    this.view = new View(scene, buffer, this.store);
    this.overlay = new Overlay(this.view, this.store);
    this.store.on_change(() => this.legend.show(this.view.current_field()));
    this.describe_canvas();
    this.follow_pointer();
    const stage = element("div", { class: "stage" }, this.view.canvas, this.overlay.element);
    this.element = element(
      "section",
      { class: "viewer", "aria-label": "Picture of the mesh" },
      toolbar(scene, this.store),
      stage,
      element("div", { class: "below-stage" }, this.legend.element, this.captions()),
    );
  }

  go_to(sight: Sight) {
    this.view.lines.select(sight.line);
    this.overlay.mark(sight.at, sight.title);
    this.view.fly_to(sight.at, sight.radius);
    this.element.scrollIntoView({ block: "nearest" });
  }

  /** The line of a hole: its seam if it has been filled, its rim otherwise. */
  line_of_hole(hole: number): Line | undefined {
    const lines = (this.scene.lines ?? []).filter((l) => l.hole === hole && l.points.length >= 3);
    return lines.find((l) => l.kind === "seam") ?? lines[0];
  }

  keys(): Key[] {
    const { store, view } = this;
    const two = this.scene.states.length > 1;
    const fields = this.scene.fields?.length ?? 0;
    const next_field = () => store.set({ field: ((store.now.field + 2) % (fields + 1)) - 1 });
    return [
      ...(two ? [key("x", "swap the meshes before and after", () => this.swap())] : []),
      ...(two
        ? [key("s", "show both meshes side by side", () => store.set({ split: !store.now.split }))]
        : []),
      ...(fields > 0 ? [key("c", "colour by the next field or by no field", next_field)] : []),
      ...switches_of(this.scene).map(({ key: letter, meaning, name }) =>
        key(letter, meaning, () => store.set({ [name]: !store.now[name] })),
      ),
      key("r", "show the whole mesh again", () => this.reset()),
      key("1", "look along x", () => view.camera.look_along(new Vector3(1, 0, 0))),
      key("2", "look along y", () => view.camera.look_along(new Vector3(0, 1, 0))),
      key("3", "look along z", () => view.camera.look_along(new Vector3(0, 0, 1))),
      { keys: ["+", "="], shown: "+", meaning: "zoom in", run: () => view.camera.zoom(0.85) },
      {
        keys: ["-", "_"],
        shown: "\u2212",
        meaning: "zoom out",
        run: () => view.camera.zoom(1 / 0.85),
      },
      {
        keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"],
        shown: "\u2190 \u2192 \u2191 \u2193",
        meaning: "turn the mesh; with Shift, move the mesh",
        where: "view",
        run: (event) => this.arrow(event),
      },
    ];
  }

  private reset() {
    this.view.lines.select(null);
    this.overlay.mark(null, "");
    this.view.camera.go_home();
  }

  private swap() {
    const last = this.scene.states.length - 1;
    this.store.set({ split: false, shown: this.store.now.shown === 0 ? last : 0 });
  }

  private arrow(event: KeyboardEvent) {
    const across = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    const up = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    if (event.shiftKey) this.view.camera.pan(-0.05 * across, -0.05 * up);
    else this.view.camera.turn(0.12 * across, -0.12 * up);
  }

  private describe_canvas() {
    const name = this.scene.name ? file_name(this.scene.name) : "the mesh";
    this.store.on_change(() => {
      const states = this.view.visible_states().map((s) => printable(this.scene.states[s]!));
      const field = this.view.current_field();
      this.view.canvas.setAttribute(
        "aria-label",
        `${name}, ${states.join(" and ")}, ` +
          (field ? `coloured by ${printable(field.title)}` : "plain") +
          "; arrow keys turn the mesh",
      );
    });
  }

  private captions(): HTMLElement {
    const { shown } = this.scene;
    const parts: (Node | string)[] = [this.reading];
    const kinds = this.view.lines.kinds();
    if (kinds.length > 0) {
      const list = element("ul", { class: "line-kinds", "aria-label": "Lines" });
      for (const { kind, title } of kinds) {
        list.append(
          element(
            "li",
            {},
            element("span", { class: `sample ${kind}`, "aria-hidden": "true" }),
            title,
          ),
        );
      }
      parts.push(list);
    }
    if (shown) {
      parts.push(
        element(
          "p",
          { class: "note" },
          `The mesh was decimated for viewing: ${count_text(shown.triangles)} of ` +
            `${count_text(shown.of)} triangles are shown. All figures refer to the full mesh.`,
        ),
      );
    }
    return element("div", { class: "captions" }, ...parts);
  }

  /** Shows the value under the pointer, updated at most once per frame. */
  private follow_pointer() {
    const { canvas } = this.view;
    let due = 0;
    const tell = (x: number, y: number) => {
      due = 0;
      this.tell(this.view.probe(x, y));
    };
    canvas.addEventListener("pointermove", (event) => {
      cancelAnimationFrame(due);
      if (event.buttons === 0)
        due = requestAnimationFrame(() => tell(event.offsetX, event.offsetY));
    });
    canvas.addEventListener("pointerleave", () => {
      cancelAnimationFrame(due);
      this.tell(null);
    });
    canvas.addEventListener("dblclick", (event) => {
      this.view.centre_on(event.offsetX, event.offsetY);
    });
  }

  private tell(probe: Probe | null) {
    const value = probe && this.view.value_at(probe);
    this.legend.point_at(value);
    if (!probe) {
      this.reading.textContent = "";
      return;
    }
    const at = probe.at.toArray().map((x, k) => number_text(x + this.scene.centre[k]!, 5));
    const field = this.view.current_field();
    const words = field
      ? `${printable(field.title)} ${number_text(value)} ${value === null ? "" : unit_text(field.unit ?? "")} at `
      : "";
    this.reading.textContent = `${words}(${at.join(", ")})`;
  }
}

function key(letter: string, meaning: string, run: () => void): Key {
  return { keys: [letter], shown: letter, meaning, run };
}
