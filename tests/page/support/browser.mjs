import { createRequire } from "node:module";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { fill_template } from "./pack.mjs";

/** Drives the built page in a browser without a screen, whose graphics are computed in software. */

function setting(name) {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set; ctest sets it`);
  return value;
}

const { chromium } = createRequire(join(setting("IBMFAIR_PAGE_MODULES"), "package.json"))(
  "playwright-core",
);
const template = readFileSync(setting("IBMFAIR_PAGE_FILE"), "utf8");
const results = setting("IBMFAIR_PAGE_RESULTS");
mkdirSync(results, { recursive: true });

/** Milliseconds until what does not come is given up: not so soon that a busy machine is too slow. */
const patience = 300000;

export function launch(further = []) {
  return chromium.launch({
    timeout: patience,
    executablePath: setting("IBMFAIR_CHROMIUM"),
    args: [
      ...["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader"],
      ...["--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", ...further],
    ],
  });
}

/** A payload in a page in a tab of its own; `troubles` fills with errors and requests. */
export async function open(browser, name, payload, options = {}) {
  const file = join(results, `${name}.html`);
  writeFileSync(file, fill_template(template, payload));
  const context = await browser.newContext({
    viewport: { width: 1200, height: 720 },
    reducedMotion: "reduce",
    ...options,
  });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const troubles = [];
  page.on("pageerror", (error) => troubles.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) troubles.push(message.text());
  });
  page.on("request", (request) => {
    if (request.url() !== pathToFileURL(file).href) troubles.push(`request: ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("header h1, .notice");
  return { page, troubles, close: () => context.close() };
}

export function keep_screenshot(page, name, options = {}) {
  return page.screenshot({ path: join(results, `${name}.png`), ...options });
}

/** Waits until what was asked for last has been drawn. */
export function settle(page) {
  return page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
}

const decoders = new Map();

/** The pixels of an element as it is on the screen: width, height, and RGBA bytes. */
export async function pixels_of(browser, page, selector) {
  await settle(page);
  const picture = await page.locator(selector).screenshot();
  // Decoded in a page that is allowed to.
  if (!decoders.has(browser)) decoders.set(browser, await browser.newPage());
  const decoder = decoders.get(browser);
  const { width, height, data } = await decoder.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) {
      text += String.fromCharCode(...data.subarray(i, i + 8192));
    }
    return { width: image.width, height: image.height, data: btoa(text) };
  }, picture.toString("base64"));
  return { width, height, data: Buffer.from(data, "base64") };
}

/** Share of the pixels for which `is_counted(r, g, b, x, y)` holds. */
export function share_of({ width, height, data }, is_counted) {
  let count = 0;
  for (let i = 0; i < width * height; ++i) {
    const [r, g, b] = data.subarray(4 * i, 4 * i + 3);
    if (is_counted(r, g, b, i % width, Math.floor(i / width))) ++count;
  }
  return count / (width * height);
}

/** Share of the pixels by which two pictures differ visibly. */
export function difference(a, b) {
  return share_of(a, (r, g, bl, x, y) => {
    const i = 4 * (y * b.width + x);
    const far =
      Math.abs(r - b.data[i]) + Math.abs(g - b.data[i + 1]) + Math.abs(bl - b.data[i + 2]);
    return far > 30;
  });
}
