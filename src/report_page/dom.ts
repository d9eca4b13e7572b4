/**
 * An element with attributes and children. Strings become text nodes, so that names and contents of
 * hostile files are never parsed as markup.
 */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

let sections = 0;

/** A section with a title, to which a screen reader can jump. */
export function section(title: string, ...children: (Node | string)[]): HTMLElement {
  const id = `section-${++sections}`;
  return element(
    "section",
    { class: "panel", "aria-labelledby": id },
    element("h2", { id }, title),
    ...children,
  );
}

/** Whether the user asks for reduced motion; the camera then moves without animation. */
export function prefers_stillness(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
