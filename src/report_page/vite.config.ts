import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const bundled = ["three", "uplot", "d3-scale-chromatic", "d3-interpolate", "d3-color"];

/** The folder in which npm has installed a package. */
function folder_of(name: string): string {
  const paths = createRequire(import.meta.url).resolve.paths(name) ?? [];
  const found = paths
    .map((path) => join(path, name))
    .find((path) => {
      try {
        return readFileSync(join(path, "package.json")).length > 0;
      } catch {
        return false;
      }
    });
  if (!found) throw new Error(`${name} is not installed`);
  return found;
}

function licence_of(name: string): string {
  const folder = folder_of(name);
  const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const text = readFileSync(join(folder, "LICENSE"), "utf8").trim();
  return `${name} ${version}\n\n${text.replaceAll("--", "- -")}`;
}

/** Adds the licences of the libraries to the page, as they require; the minifier drops comments. */
function keep_licences(): Plugin {
  return {
    name: "keep-licences",
    enforce: "post",
    transformIndexHtml(html) {
      const texts = bundled.map(licence_of).join("\n\n" + "=".repeat(72) + "\n\n");
      const notice = `<!-- This page holds these libraries:\n\n${texts}\n-->`;
      return html.replace("</body>", () => `${notice}\n  </body>`);
    },
  };
}

export default defineConfig({
  root: dirname(new URL(import.meta.url).pathname),
  base: "./",
  plugins: [viteSingleFile({ removeViteModuleLoader: true }), keep_licences()],
  build: { target: "es2022", chunkSizeWarningLimit: 2000, reportCompressedSize: false },
});
