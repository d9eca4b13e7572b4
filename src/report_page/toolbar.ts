import { element } from "./dom";
import type { Scene } from "./payload";
import type { Store, ViewState } from "./state";
import { printable, title_of } from "./text";

/** A switch of the view. Each row of the table makes a button, a key and a line of the key help. */
export interface Switch {
  name: "wireframe" | "flat" | "contours" | "patches" | "lines";
  key: string;
  title: string;
  meaning: string;
}

export const switches: Switch[] = [
  { name: "wireframe", key: "w", title: "Edges", meaning: "show or hide the edges of the mesh" },
  { name: "flat", key: "f", title: "Flat", meaning: "switch flat or smooth shading" },
  { name: "contours", key: "i", title: "Contours", meaning: "show or hide lines of equal value" },
  { name: "patches", key: "h", title: "Patches", meaning: "show or hide the hatching of patches" },
  { name: "lines", key: "l", title: "Lines", meaning: "show or hide rims, seams and other lines" },
];

/** The switches that have an effect in this scene. */
export function switches_of(scene: Scene): Switch[] {
  const there: Record<Switch["name"], boolean> = {
    wireframe: true,
    flat: true,
    contours: (scene.fields ?? []).length > 0,
    patches: !!scene.arrays.patch,
    lines: (scene.lines ?? []).length > 0,
  };
  return switches.filter((s) => there[s.name]);
}

export function toolbar(scene: Scene, store: Store): HTMLElement {
  const bar = element("div", { class: "toolbar", role: "toolbar", "aria-label": "View" });
  if (scene.states.length > 1) bar.append(state_buttons(scene, store));
  if ((scene.fields ?? []).length > 0) bar.append(field_choice(scene, store));
  const group = element("div", { class: "buttons" });
  for (const { name, key, title, meaning } of switches_of(scene)) {
    group.append(
      toggle(
        store,
        title,
        `${meaning} (${key})`,
        name,
        (s) => ({ [name]: !s[name] }),
        (s) => s[name],
      ),
    );
  }
  bar.append(group);
  return bar;
}

function toggle(
  store: Store,
  title: string,
  hint: string,
  name: string,
  change: (state: ViewState) => Partial<ViewState>,
  is_on: (state: ViewState) => boolean,
): HTMLButtonElement {
  const button = element("button", { type: "button", title: hint, "data-switch": name }, title);
  button.addEventListener("click", () => store.set(change(store.now)));
  store.on_change((state) => button.setAttribute("aria-pressed", String(is_on(state))));
  return button;
}

function state_buttons(scene: Scene, store: Store): HTMLElement {
  const group = element("div", { class: "segments", role: "group", "aria-label": "Mesh shown" });
  scene.states.forEach((state, s) => {
    group.append(
      toggle(
        store,
        title_of(state),
        `show the mesh ${printable(state)} (press x to swap)`,
        `state-${s}`,
        () => ({ shown: s, split: false }),
        (now) => !now.split && now.shown === s,
      ),
    );
  });
  group.append(
    toggle(
      store,
      "Split",
      "show both meshes side by side (s)",
      "split",
      () => ({ split: true }),
      (now) => now.split,
    ),
  );
  return group;
}

function field_choice(scene: Scene, store: Store): HTMLElement {
  const choice = element("select", { id: "field-choice" });
  choice.append(element("option", { value: "-1" }, "no field (plain)"));
  scene.fields?.forEach((field, i) => {
    choice.append(element("option", { value: String(i) }, printable(field.title)));
  });
  choice.addEventListener("change", () => store.set({ field: Number(choice.value) }));
  store.on_change((state) => (choice.value = String(state.field)));
  return element("label", { class: "choice" }, "Colour by ", choice);
}
