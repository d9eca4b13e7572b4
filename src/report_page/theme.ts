import { element } from "./dom";

/** Light or dark: the system's setting until the user chooses. */
type Theme = "light" | "dark";

const key = "ibmfair-theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const listeners: (() => void)[] = [];

function chosen(): Theme | null {
  try {
    const stored = localStorage.getItem(key);
    return stored === "light" || stored === "dark" ? stored : null;
  } catch {
    return null; // some browsers deny storage to local files
  }
}

function apply(theme: Theme) {
  document.documentElement.dataset.theme = theme;
  for (const listener of listeners) listener();
}

export function start_theme() {
  const follow = () => apply(chosen() ?? (system.matches ? "dark" : "light"));
  system.addEventListener("change", follow);
  follow();
}

export function toggle_theme() {
  const next: Theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  try {
    localStorage.setItem(key, next);
  } catch {
    // without storage, the choice lasts until the page is closed
  }
  apply(next);
}

export function on_theme(listener: () => void) {
  listeners.push(listener);
}

/** A colour of the style sheet by its name, such as "--ink". */
export function theme_colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** That colour, written as #rrggbb in the style sheet, as red, green and blue in [0, 1]. */
export function theme_rgb(name: string): [number, number, number] {
  const hex = theme_colour(name);
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255) as [number, number, number];
}

export function theme_button(): HTMLButtonElement {
  const button = element("button", { type: "button", class: "quiet" });
  const label = () => {
    const dark = document.documentElement.dataset.theme === "dark";
    button.textContent = dark ? "\u2600 Light" : "\u263e Dark";
    button.setAttribute("aria-label", dark ? "Switch to light colours" : "Switch to dark colours");
  };
  button.addEventListener("click", toggle_theme);
  on_theme(label);
  label();
  return button;
}
