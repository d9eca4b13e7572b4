import { element } from "./dom";
import type { Store } from "./state";
import { printable, title_of } from "./text";
import type { View } from "./view";

/** The layer over the picture: names of the meshes shown, the slider of a split view, a marker. */
export class Overlay {
  readonly element = element("div", { class: "overlay" });
  private readonly badges = [0, 1].map((side) =>
    element("div", { class: `badge ${side === 0 ? "left" : "right"}` }),
  );
  private readonly slider = element("div", {
    class: "slider",
    role: "slider",
    tabindex: "0",
    "aria-label": "Position of the divider of the split view",
    "aria-valuemin": "0",
    "aria-valuemax": "100",
  });
  private readonly marker = element("div", { class: "marker", hidden: "" });
  private marked: readonly number[] | null = null;

  constructor(
    private readonly view: View,
    private readonly store: Store,
  ) {
    this.element.append(...this.badges, this.slider, this.marker);
    this.listen_to_slider();
    store.on_change(() => this.update());
    view.after_drawing = () => this.place_marker();
  }

  /** Marks a point of the mesh until another point is marked; null removes the marker. */
  mark(at: readonly number[] | null, title: string) {
    this.marked = at;
    this.marker.replaceChildren(element("span", {}, printable(title)));
    this.place_marker();
  }

  private update() {
    const { split, split_at } = this.store.now;
    const states = this.view.visible_states();
    const both = states.length > 1;
    this.badges.forEach((badge, side) => {
      const state = states[side];
      badge.hidden = state === undefined || this.view.scene.states.length < 2;
      if (state !== undefined) badge.textContent = this.title_of_state(state);
    });
    this.slider.hidden = !(split && both);
    this.slider.style.left = `${100 * split_at}%`;
    this.slider.setAttribute("aria-valuenow", String(Math.round(100 * split_at)));
  }

  private title_of_state(state: number): string {
    const field = this.view.current_field();
    const bare =
      field && !field.values[state] ? `, no ${printable(field.title).toLowerCase()}` : "";
    return title_of(this.view.scene.states[state]!) + bare;
  }

  private place_marker() {
    const place = this.marked && this.view.place_of(this.marked);
    this.marker.hidden = !place;
    if (place) this.marker.style.transform = `translate(${place.x}px, ${place.y}px)`;
  }

  private listen_to_slider() {
    const move_to = (share: number) =>
      this.store.set({ split_at: Math.min(0.98, Math.max(0.02, share)) });
    this.slider.addEventListener("pointerdown", (event) => {
      this.slider.setPointerCapture(event.pointerId);
      event.preventDefault();
      this.slider.focus();
    });
    this.slider.addEventListener("pointermove", (event) => {
      if (!this.slider.hasPointerCapture(event.pointerId)) return;
      const box = this.element.getBoundingClientRect();
      move_to((event.clientX - box.left) / box.width);
    });
    this.slider.addEventListener("keydown", (event) => {
      const steps: Record<string, number> = { ArrowLeft: -0.02, ArrowRight: 0.02 };
      const step = steps[event.key];
      if (step === undefined) return;
      event.preventDefault();
      move_to(this.store.now.split_at + step);
    });
  }
}
