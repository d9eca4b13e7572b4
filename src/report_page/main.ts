import "./style.css";
import { BatchTable } from "./batch_table";
import { DamagedPage, read_bytes, read_report, read_scene } from "./decode";
import { components_section, further_section, options_section, seconds_section } from "./details";
import { element, section } from "./dom";
import { figure_rows, figures_table, has_two_states } from "./figures_table";
import { header, page_title } from "./headline";
import { holes_table } from "./holes_table";
import { help_dialogue, listen, type Key } from "./keys";
import type { Report, Scene } from "./payload";
import { Places, sight_of_line } from "./places";
import { plots_section } from "./plots";
import { start_theme, toggle_theme } from "./theme";
import { Viewer } from "./viewer";

const page = document.getElementById("page")!;

/** An error message, shown in place of the picture or of the report. */
function notice(title: string, text: string): HTMLElement {
  return element(
    "div",
    { class: "notice", role: "alert" },
    element("strong", {}, title),
    " ",
    text,
  );
}

/** The scene and its viewer, null if there is none; `picture` is the viewer or an error message. */
interface Opened {
  scene: Scene | null;
  viewer: Viewer | null;
  picture: HTMLElement | null;
}

/** An error here only replaces the picture by a message: tables and plots are shown anyway. */
async function open_scene(): Promise<Opened> {
  let scene: Scene | null = null;
  try {
    scene = read_scene();
    if (!scene) return { scene, viewer: null, picture: null };
    const viewer = await open_viewer(scene);
    return { scene, viewer, picture: viewer.element };
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    const damaged = error instanceof DamagedPage;
    const text = damaged ? `This page is damaged: ${reason}.` : reason;
    return { scene, viewer: null, picture: notice("No picture.", text) };
  }
}

async function open_viewer(scene: Scene): Promise<Viewer> {
  if (Math.max(0, ...scene.triangles) === 0) throw new Error("The mesh has no triangles.");
  return new Viewer(scene, await read_bytes(scene));
}

/** All sections of the page below and beside the picture. */
function sections(report: Report, scene: Scene | null, places: Places, viewer: Viewer | null) {
  const rows = figure_rows(report, scene);
  const title = has_two_states(rows) ? "Before and after" : "Figures";
  const beside: (HTMLElement | null)[] = [
    rows.length > 0 ? section(title, figures_table(rows, title)) : null,
    places.list ? section("Places to inspect", places.list) : null,
    seconds_section(report.seconds),
  ];
  const holes = report.holes ?? [];
  const show_hole = (id: number) => {
    const line = viewer?.line_of_hole(id);
    if (line) viewer?.go_to(sight_of_line(line));
  };
  const wide: (HTMLElement | null)[] = [
    report.items ? section("Files", new BatchTable(report.items).element) : null,
    holes.length > 0
      ? section(
          "Holes",
          holes_table(holes, (id) => !!viewer?.line_of_hole(id), show_hole),
        )
      : null,
    plots_section(report),
  ];
  const below = [options_section(report), further_section(report), components_section(report)];
  const there = (parts: (HTMLElement | null)[]) => parts.filter((part) => part !== null);
  return { beside: there(beside), wide: there(wide), below: there(below) };
}

function page_keys(places: Places, open_help: () => void): Key[] {
  const has_places = places.sights.length > 0;
  const move = (shown: string, meaning: string, step: number): Key => ({
    keys: [shown],
    shown,
    meaning,
    run: () => places.go_on(step),
  });
  return [
    ...(has_places ? [move("n", "go to the next place in the list", 1)] : []),
    ...(has_places ? [move("p", "go to the previous place in the list", -1)] : []),
    { keys: ["t"], shown: "t", meaning: "switch light or dark colours", run: toggle_theme },
    { keys: ["?"], shown: "?", meaning: "show this list of keys", run: open_help },
  ];
}

async function start() {
  start_theme();
  const report = read_report();
  document.title = page_title(report);
  const { scene, viewer, picture } = await open_scene();
  const places = new Places(report, scene, viewer && ((sight) => viewer.go_to(sight)));

  let open_help = () => {};
  const keys = [...(viewer?.keys() ?? []), ...page_keys(places, () => open_help())];
  const help = help_dialogue(keys);
  open_help = help.open;
  listen(keys, viewer?.view.canvas ?? null);

  const { beside, wide, below } = sections(report, scene, places, viewer);
  const main = element("main", {});
  if (picture && beside.length > 0) {
    main.append(
      element("div", { class: "first" }, picture, element("div", { class: "beside" }, ...beside)),
    );
  } else {
    main.append(...(picture ? [picture] : []), ...beside);
  }
  main.append(...wide, element("div", { class: "below" }, ...below));
  page.replaceChildren(header(report, scene, open_help), main, help.dialogue);
}

start().catch((error: unknown) => {
  const reason = error instanceof Error ? error.message : String(error);
  page.replaceChildren(notice("This page cannot be shown:", `${reason}.`));
});
