import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import {
  difference,
  keep_screenshot,
  launch,
  open,
  pixels_of,
  settle,
} from "./support/browser.mjs";
import { fill_payload, smooth_payload } from "./support/payloads.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const canvas = ".stage canvas";
const picture = (page) => pixels_of(browser, page, canvas);

async function opened(name, payload = smooth_payload(), options = {}) {
  const tab = await open(browser, `camera-${name}`, payload, options);
  await page_settled(tab.page);
  return tab;
}

async function page_settled(page) {
  await settle(page);
  await page.mouse.move(2, 2);
}

test("keys turn, move and zoom, and r goes back", async () => {
  const { page, close } = await opened("keys");
  await page.locator(canvas).focus();
  const at_first = await picture(page);
  const ways = [
    "ArrowLeft",
    "ArrowUp",
    "Shift+ArrowRight",
    "Shift+ArrowDown",
    "+",
    "-",
    "1",
    "2",
    "3",
  ];
  for (const key of ways) {
    await page.keyboard.press(key);
    assert.ok(difference(at_first, await picture(page)) > 0.005, `${key} changes the picture`);
    await page.keyboard.press("r");
    assert.equal(difference(at_first, await picture(page)), 0, `r undoes ${key}`);
  }
  await close();
});

test("arrow keys scroll the page, not the mesh, where the picture has no focus", async () => {
  const { page, close } = await opened("scroll");
  const at_first = await picture(page);
  await page.keyboard.press("ArrowDown");
  await page.waitForFunction(() => scrollY > 0);
  await page.evaluate(() => scrollTo(0, 0));
  assert.equal(difference(at_first, await picture(page)), 0);
  await close();
});

test("the pointer turns, moves and zooms", async () => {
  const { page, close } = await opened("pointer");
  await page.locator(canvas).focus(); // its outline would come with the first key
  const box = await page.locator(canvas).boundingBox();
  const [x, y] = [box.x + 0.3 * box.width, box.y + 0.5 * box.height];
  const drag = async (button) => {
    await page.mouse.move(x, y);
    await page.mouse.down({ button });
    await page.mouse.move(x + 90, y + 30, { steps: 3 });
    await page.mouse.up({ button });
  };
  const ways = {
    turn: () => drag("left"),
    move: () => drag("right"),
    zoom: async () => {
      await page.mouse.move(x, y);
      await page.mouse.wheel(0, -400);
    },
  };
  const at_first = await picture(page);
  for (const [name, way] of Object.entries(ways)) {
    await way();
    await page.waitForTimeout(100);
    assert.ok(difference(at_first, await picture(page)) > 0.01, `${name} changes the picture`);
    await page.keyboard.press("r");
    assert.equal(difference(at_first, await picture(page)), 0, `r undoes ${name}`);
  }
  await close();
});

test("a click on a warning flies to its place and marks it", async () => {
  const { page, close } = await opened("warning");
  const at_first = await picture(page);
  await page.getByRole("button", { name: /three or more triangles/ }).click();
  assert.ok(difference(at_first, await picture(page)) > 0.1);
  const marker = page.locator(".marker");
  assert.equal(await marker.innerText(), "edge 12-40 has three triangles");
  const [at, frame] = [await marker.boundingBox(), await page.locator(canvas).boundingBox()];
  assert.ok(Math.abs(at.x - frame.x - frame.width / 2) < 3, "in the middle of the picture");
  assert.ok(Math.abs(at.y - frame.y - frame.height / 2) < 3);
  await keep_screenshot(page, "fly-to-warning");
  await page.keyboard.press("r");
  assert.equal(await marker.isVisible(), false);
  await close();
});

test("n and p go through the holes, and the table of holes goes to each", async () => {
  const { page, close } = await opened("holes", fill_payload());
  const current = () => page.locator(".entry[aria-current]").innerText();
  await page.keyboard.press("n");
  assert.match(await current(), /hole 0: filled/);
  await page.keyboard.press("n");
  assert.match(await current(), /hole 7: skipped/);
  await page.keyboard.press("n");
  assert.match(await current(), /hole 0/);
  await page.keyboard.press("p");
  assert.match(await current(), /hole 7/);
  const at_7 = await picture(page);
  await page.getByRole("button", { name: "hole 0", exact: true }).click();
  await page.locator(canvas).scrollIntoViewIfNeeded();
  assert.ok(difference(at_7, await picture(page)) > 0.05);
  await keep_screenshot(page, "fill", { fullPage: true });
  await close();
});

test("a flight takes its time, unless things shall not move", async () => {
  for (const [motion, is_long] of [
    ["no-preference", true],
    ["reduce", false],
  ]) {
    const { page, close } = await opened(`motion-${motion}`, smooth_payload(), {
      reducedMotion: motion,
    });
    const frames = async () => Number(await page.locator(canvas).getAttribute("data-frames"));
    const at_first = await frames();
    await page.keyboard.press("n");
    await page.waitForTimeout(900);
    const drawn = (await frames()) - at_first;
    assert.equal(drawn > 2, is_long, `${drawn} frames with ${motion}`);
    await close();
  }
});
