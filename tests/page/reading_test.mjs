import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { difference, keep_screenshot, launch, open, pixels_of } from "./support/browser.mjs";
import { batch_payload, fill_payload, smooth_payload } from "./support/payloads.mjs";

/** Whoever reads the page: in the dark, on a phone, with keys only, by ear. */

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const theme = (page) => page.evaluate(() => document.documentElement.dataset.theme);
const background = (page) =>
  page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);

test("light and dark follow the system, and the toggle and its key", async () => {
  const { page, close } = await open(browser, "theme", smooth_payload(), { colorScheme: "dark" });
  assert.equal(await theme(page), "dark");
  assert.equal(await background(page), "rgb(19, 22, 24)");
  const dark = await pixels_of(browser, page, ".stage");
  await keep_screenshot(page, "dark", { fullPage: true });
  await page.getByRole("button", { name: "Switch to light colours" }).click();
  assert.equal(await theme(page), "light");
  assert.equal(await background(page), "rgb(246, 246, 244)");
  assert.ok(difference(dark, await pixels_of(browser, page, ".stage")) > 0.3, "the picture, too");
  await page.keyboard.press("t");
  assert.equal(await theme(page), "dark");
  await page.keyboard.press("t");
  await page.reload();
  await page.waitForSelector("h1");
  assert.equal(await theme(page), "light", "what was chosen is remembered");
  await close();
});

for (const scheme of ["light", "dark"]) {
  test(`every text has contrast enough: ${scheme}`, async () => {
    for (const [name, payload] of Object.entries({
      fill: fill_payload(),
      batch: batch_payload(),
    })) {
      const { page, close } = await open(browser, `contrast-${name}`, payload, {
        colorScheme: scheme,
      });
      const low = await page.evaluate(contrasts_below, 4.5);
      assert.deepEqual(low, []);
      await close();
    }
  });
}

/** Runs in the page: texts whose contrast with what is behind them is below `least` (WCAG 2). */
function contrasts_below(least) {
  const parts = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (colour) => {
    const [r, g, b] = parts(colour).map((c) =>
      c / 255 <= 0.03928 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4,
    );
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (node) => {
    for (let at = node; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (parts(colour)[3] !== 0) return colour;
    }
    return "rgb(255, 255, 255)";
  };
  const low = new Set();
  for (const node of document.querySelectorAll("#page *")) {
    const own = [...node.childNodes].some((c) => c.nodeType === 3 && c.textContent.trim() !== "");
    if (!own || !node.checkVisibility() || node.closest(".u-legend")) continue;
    const [a, b] = [luminance(getComputedStyle(node).color), luminance(behind(node))];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < least) low.add(`${node.className || node.tagName}: ${contrast.toFixed(2)}`);
  }
  return [...low];
}

const phone = {
  viewport: { width: 390, height: 844 },
  isMobile: true,
  hasTouch: true,
  deviceScaleFactor: 2,
};

test("on a phone nothing is wider than the screen, and fingers turn and pinch", async () => {
  for (const [name, payload] of Object.entries({
    smooth: smooth_payload(),
    batch: batch_payload(),
    fill: fill_payload(),
  })) {
    const { page, troubles, close } = await open(browser, `phone-${name}`, payload, phone);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, name);
    await keep_screenshot(page, `phone-${name}`, { fullPage: true });
    if (name === "fill") await pinch_and_turn(page);
    assert.deepEqual(troubles, []);
    await close();
  }
});

async function pinch_and_turn(page) {
  const fingers = await page.context().newCDPSession(page);
  const box = await page.locator(".stage canvas").boundingBox();
  const [x, y] = [box.x + box.width / 4, box.y + box.height / 2];
  const touch = (type, ...points) =>
    fingers.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([dx, dy], id) => ({ x: x + dx, y: y + dy, id })),
    });
  const at_first = await pixels_of(browser, page, ".stage");
  await touch("touchStart", [0, 0]);
  for (let i = 1; i <= 4; ++i) await touch("touchMove", [12 * i, 6 * i]);
  await touch("touchEnd");
  const turned = await pixels_of(browser, page, ".stage");
  assert.ok(difference(at_first, turned) > 0.01, "one finger turns");
  await touch("touchStart", [0, 0], [30, 0]);
  for (let i = 1; i <= 4; ++i) await touch("touchMove", [-10 * i, 0], [30 + 10 * i, 0]);
  await touch("touchEnd");
  assert.ok(difference(turned, await pixels_of(browser, page, ".stage")) > 0.01, "two zoom");
}

test("every control is reached by Tab, is seen to be, and has a name", async () => {
  const { page, close } = await open(browser, "tab", fill_payload());
  const controls = await page.locator("#page").evaluate((root) => {
    const all = root.querySelectorAll(
      "button, select, input, a, summary, canvas[tabindex], [role=slider]",
    );
    return [...all].filter((node) => node.checkVisibility() && !node.closest("dialog")).length;
  });
  const reached = [];
  for (let i = 0; i < 100; ++i) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const node = document.activeElement;
      if (node === document.body) return null;
      const style = getComputedStyle(node);
      const mark = getComputedStyle(node, "::after").boxShadow;
      return {
        name:
          node.getAttribute("aria-label") || node.innerText || node.labels?.[0]?.innerText || "",
        is_seen: style.outlineStyle !== "none" || mark !== "none",
        is_control: !node.classList.contains("scroll"),
      };
    });
    if (at === null) break;
    reached.push(at);
  }
  assert.equal(reached.filter((at) => at.is_control).length, controls);
  assert.deepEqual(
    reached.filter((at) => at.name.trim() === "" || !at.is_seen),
    [],
  );
  await close();
});

test("? tells the keys, and every key told of is one", async () => {
  const { page, close } = await open(browser, "help", fill_payload());
  await page.keyboard.press("?");
  const dialogue = page.getByRole("dialog", { name: "Keys" });
  await dialogue.waitFor();
  await keep_screenshot(page, "keys");
  const shown = await dialogue.locator("kbd").allInnerTexts();
  for (const key of ["x", "s", "c", "w", "f", "i", "h", "l", "r", "n", "p", "t", "?"]) {
    assert.ok(shown.includes(key), key);
  }
  await page.keyboard.press("w");
  assert.equal(
    await page.locator('[data-switch="wireframe"]').getAttribute("aria-pressed"),
    "false",
  );
  await page.keyboard.press("Escape");
  assert.equal(await dialogue.isVisible(), false);
  await page.keyboard.press("Control+w");
  assert.equal(
    await page.locator('[data-switch="wireframe"]').getAttribute("aria-pressed"),
    "false",
  );
  await close();
});

test("letters typed into the filter are no keys", async () => {
  const { page, close } = await open(browser, "typing", batch_payload());
  const at_first = await theme(page);
  await page.getByRole("searchbox").pressSequentially("t");
  assert.equal(await theme(page), at_first);
  assert.equal(await page.getByRole("searchbox").inputValue(), "t");
  await close();
});
