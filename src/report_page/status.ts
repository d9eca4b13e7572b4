import { element } from "./dom";
import { printable } from "./text";

/** How well a run ended; shown by a sign and a word as well as by colour. */
type Mood = "good" | "warning" | "bad" | "neutral";

const moods: Record<string, Mood> = {
  ok: "good",
  completed: "good",
  filled: "good",
  converged: "good",
  skipped: "neutral",
  "not run": "neutral",
  interrupted: "warning",
  stalled: "warning",
  "not converged": "warning",
  failed: "bad",
  diverged: "bad",
};

const signs: Record<Mood, string> = {
  good: "\u2713",
  warning: "\u26a0",
  bad: "\u2715",
  neutral: "\u2013",
};

export function mood_of(status: string): Mood {
  return moods[status] ?? (/fail|error|not /.test(status) ? "bad" : "neutral");
}

export function status_chip(status: string): HTMLElement {
  const mood = mood_of(status);
  return element(
    "span",
    { class: `chip ${mood}` },
    element("span", { "aria-hidden": "true" }, signs[mood]),
    ` ${printable(status)}`,
  );
}
