/**
 * Elements with attributes and children. Strings become text nodes, so that what a hostile file is
 * called or holds is never read as markup.
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

/** A titled part of the page, which a screen reader can jump to. */
export function section(title: string, ...children: (Node | string)[]): HTMLElement {
  const id = `section-${++sections}`;
  return element(
    "section",
    { class: "panel", "aria-labelledby": id },
    element("h2", { id }, title),
    ...children,
  );
}

/** What moves on the page moves at once where that is asked for. */
export function prefers_stillness(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
