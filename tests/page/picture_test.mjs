import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import {
  difference,
  keep_screenshot,
  launch,
  open,
  pixels_of,
  settle,
  share_of,
} from "./support/browser.mjs";
import { fill_payload, smooth_payload, view_payload } from "./support/payloads.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const stage = ".stage";
const picture = (page) => pixels_of(browser, page, stage);
const is_drawn = (r, g, b) => Math.abs(r - 251) + Math.abs(g - 251) + Math.abs(b - 250) > 40;

async function opened(name, payload, options) {
  const tab = await open(browser, `picture-${name}`, payload, options);
  await settle(tab.page);
  return tab;
}

test("the mesh is drawn on both sides, without errors and requests", async () => {
  const { page, troubles, close } = await opened("smooth", smooth_payload());
  const seen = await picture(page);
  for (const side of [0, 1]) {
    const share = share_of(
      seen,
      (r, g, b, x) => x > seen.width / 2 === !!side && is_drawn(r, g, b),
    );
    assert.ok(share > 0.08, `drawn on side ${side}: ${share}`);
  }
  await keep_screenshot(page, "smooth", { fullPage: true });
  assert.deepEqual(troubles, []);
  await close();
});

test("x swaps the states, and the split view shows half of each", async () => {
  const { page, close } = await opened("states", smooth_payload());
  await page.locator(".overlay").evaluate((overlay) => (overlay.style.visibility = "hidden"));
  const split = await picture(page);
  await page.keyboard.press("x");
  const first = await picture(page);
  await page.keyboard.press("x");
  const second = await picture(page);
  await page.keyboard.press("x");
  assert.ok(difference(first, second) > 0.01);
  assert.equal(difference(first, await picture(page)), 0);
  const middle = split.width / 2;
  const apart = (whole, right) =>
    difference(split, whole) -
    share_of(split, (r, g, b, x, y) => {
      const i = 4 * (y * whole.width + x);
      const far =
        Math.abs(r - whole.data[i]) +
        Math.abs(g - whole.data[i + 1]) +
        Math.abs(b - whole.data[i + 2]);
      return far > 30 && (right ? x > middle + 2 : x < middle - 2) === false;
    });
  const shown = await page.locator('[data-switch="state-0"]').getAttribute("aria-pressed");
  const [before_state, after_state] = shown === "true" ? [first, second] : [second, first];
  assert.equal(apart(before_state, false), 0, "the left half is the mesh before");
  assert.equal(apart(after_state, true), 0, "the right half is the mesh after");
  await close();
});

test("the slider follows the pointer and the arrow keys", async () => {
  const { page, close } = await opened("slider", smooth_payload());
  const slider = page.getByRole("slider");
  const box = await slider.boundingBox();
  const frame = await page.locator(stage).boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(frame.x + 0.25 * frame.width, box.y + 40, { steps: 4 });
  await page.mouse.up();
  assert.equal(await slider.getAttribute("aria-valuenow"), "25");
  const left = await picture(page);
  await slider.focus();
  for (let i = 0; i < 20; ++i) await page.keyboard.press("ArrowRight");
  assert.equal(await slider.getAttribute("aria-valuenow"), "65");
  assert.ok(difference(left, await picture(page)) > 0.005);
  await close();
});

for (const [key, name] of [
  ["w", "wireframe"],
  ["f", "flat"],
  ["i", "contours"],
  ["h", "patches"],
  ["l", "lines"],
]) {
  test(`${key} switches ${name}, and back`, async () => {
    const payload = name === "flat" ? smooth_payload({ triangles: 600 }) : fill_payload();
    const { page, close } = await opened(`switch-${name}`, payload);
    await page.keyboard.press("x");
    await page.keyboard.press("x");
    const button = page.locator(`[data-switch="${name}"]`);
    const pressed = await button.getAttribute("aria-pressed");
    const at_first = await picture(page);
    await page.keyboard.press(key);
    assert.notEqual(await button.getAttribute("aria-pressed"), pressed);
    const switched = await picture(page);
    assert.ok(difference(at_first, switched) > 0.0005, "the picture changes");
    await keep_screenshot(page, `switch-${name}`);
    await button.click();
    await page.mouse.move(0, 0);
    assert.equal(await button.getAttribute("aria-pressed"), pressed);
    assert.equal(difference(at_first, await picture(page)), 0);
    await close();
  });
}

test("every field colours the mesh in its own way, and has a legend", async () => {
  const { page, close } = await opened("fields", smooth_payload());
  const seen = [await picture(page)];
  const titles = [await page.locator(".legend-title").innerText()];
  for (const field of ["1", "2", "-1"]) {
    await page.getByLabel("Colour by").selectOption(field);
    seen.push(await picture(page));
    if (field === "-1") assert.equal(await page.locator(".legend").isVisible(), false);
    else titles.push(await page.locator(".legend-title").innerText());
  }
  assert.match(titles.join(), /Mean curvature\s*1\/length,Displacement\s*length,Triangle quality/);
  for (let i = 0; i < seen.length; ++i) {
    for (let j = 0; j < i; ++j) assert.ok(difference(seen[i], seen[j]) > 0.05, `${i} and ${j}`);
  }
  await close();
});

test("signed values are blue below and red above, the same before and after", async () => {
  const payload = smooth_payload();
  payload.scene.fields[0].range = [1.6, 3.4]; // the middle of the torus' own
  const { page, close } = await opened("signed", payload);
  const seen = await picture(page);
  for (const right of [false, true]) {
    const side = (r, g, b, x) => x > seen.width / 2 === right && is_drawn(r, g, b);
    const red = share_of(seen, (r, g, b, x) => side(r, g, b, x) && r > b + 40);
    const blue = share_of(seen, (r, g, b, x) => side(r, g, b, x) && b > r + 40);
    assert.ok(red > 0.01 && blue > 0.01, `red ${red}, blue ${blue}`);
  }
  await close();
});

test("a field that spans decades is coloured by its logarithm", async () => {
  const payload = smooth_payload();
  payload.scene.fields[0] = { ...payload.scene.fields[0], diverging: false, range: [1e-2, 1e4] };
  const { page, close } = await opened("decades", payload);
  assert.match(await page.locator(".legend-title").innerText(), /1\/length, logarithmic/);
  const ticks = page.locator(".legend-ticks span");
  assert.deepEqual(await ticks.allInnerTexts(), ["0.01", "1", "100", "10\u202f000"]);
  const places = await ticks.evaluateAll((all) => all.map((tick) => tick.style.left));
  assert.deepEqual(places.map(parseFloat).map(Math.round), [0, 33, 67, 100]);
  await close();
});

test("the value and the place under the pointer are told", async () => {
  const payload = smooth_payload({ triangles: 20000, centre: [100, 200, 300] });
  const { page, close } = await opened("probe", payload);
  await page.keyboard.press("x");
  await page.keyboard.press("x");
  await page.keyboard.press("r");
  const frame = await page.locator(stage).boundingBox();
  let text = "";
  for (let x = 0.3; x < 0.7 && text === ""; x += 0.02) {
    await page.mouse.move(frame.x + x * frame.width, frame.y + 0.5 * frame.height);
    await settle(page);
    text = await page.locator(".reading").innerText();
  }
  const number = "(\u2212?[\\d.]+)";
  const found = text.match(
    new RegExp(`^Mean curvature ${number} 1/length at \\(${number}, ${number}, ${number}\\)$`),
  );
  assert.ok(found, text);
  const [H, x, y, z] = found.slice(1).map((digits) => Number(digits.replace("\u2212", "-")));
  const distance = Math.hypot(x - 100, z - 300);
  assert.ok(Math.abs(Math.hypot(distance - 1, y - 200) - 0.4) < 0.02, "on the torus");
  const c = (distance - 1) / 0.4;
  assert.ok(Math.abs(H - (2.5 + c / (1 + 0.4 * c))) < 0.1, `${H} at ${distance}`);
  await close();
});

test("nothing is drawn while nothing changes", async () => {
  const { page, close } = await opened("idle", smooth_payload());
  const frames = () => page.locator("canvas").first().getAttribute("data-frames");
  const at_first = await frames();
  await page.waitForTimeout(400);
  assert.equal(await frames(), at_first);
  await page.keyboard.press("w");
  await settle(page);
  assert.equal(Number(await frames()), Number(at_first) + 1);
  await close();
});

test("a decimated mesh is called so", async () => {
  const { page, troubles, close } = await opened("view", view_payload());
  const text = await page.locator(".captions").innerText();
  assert.match(text, /of 5\u202f200\u202f000 triangles are shown/);
  assert.equal(await page.getByRole("slider").count(), 0);
  await keep_screenshot(page, "view", { fullPage: true });
  assert.deepEqual(troubles, []);
  await close();
});
