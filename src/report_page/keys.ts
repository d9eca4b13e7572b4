import { element } from "./dom";

/** A key and its action. Keys with `where: "view"` only work while the picture has the focus. */
export interface Key {
  keys: string[]; // values of KeyboardEvent.key
  shown: string;
  meaning: string;
  run: (event: KeyboardEvent) => void;
  where?: "view";
}

function is_typing(event: KeyboardEvent): boolean {
  const at = event.target;
  return (
    at instanceof HTMLSelectElement ||
    at instanceof HTMLTextAreaElement ||
    (at instanceof HTMLInputElement && !["checkbox", "radio", "button"].includes(at.type))
  );
}

/** Listens for the keys on the page; keys are ignored while the user types into a field. */
export function listen(keys: Key[], view: HTMLElement | null) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || is_typing(event)) return;
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const key = keys.find(
      (k) => k.keys.includes(event.key) && (k.where !== "view" || event.target === view),
    );
    if (!key) return;
    event.preventDefault();
    key.run(event);
  });
}

/** The dialogue that lists the keys, and a function `open` that shows the dialogue. */
export function help_dialogue(keys: Key[]): { dialogue: HTMLDialogElement; open: () => void } {
  const close = element("button", { type: "button" }, "Close");
  const row = (key: Key) =>
    element(
      "tr",
      {},
      element("td", {}, ...key.shown.split(" ").map((k) => element("kbd", {}, k))),
      element("td", {}, key.meaning),
    );
  const group = (title: string, members: Key[]) =>
    members.length === 0
      ? []
      : [
          element("h3", {}, title),
          element("table", { class: "keys" }, element("tbody", {}, ...members.map(row))),
        ];
  const dialogue = element(
    "dialog",
    { "aria-labelledby": "help-title" },
    element("h2", { id: "help-title" }, "Keys"),
    ...group(
      "Anywhere",
      keys.filter((k) => !k.where),
    ),
    ...group(
      "While the picture has the focus",
      keys.filter((k) => k.where === "view"),
    ),
    element(
      "p",
      { class: "note" },
      "Pointer: drag to turn the mesh, drag with the right button (or two fingers) to move the " +
        "mesh, use the wheel or pinch to zoom, double-click a point to turn about that point.",
    ),
    close,
  );
  close.addEventListener("click", () => dialogue.close());
  return { dialogue, open: () => dialogue.showModal() };
}
