import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep_screenshot, launch, open, pixels_of, share_of } from "./support/browser.mjs";
import {
  batch_payload,
  empty_payload,
  one_triangle_payload,
  smooth_payload,
} from "./support/payloads.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const notice = (page) => page.locator(".notice").innerText();

test("without WebGL, all but the picture is there, and it says so", async (context) => {
  const bare = await launch(["--disable-3d-apis"]);
  context.after(() => bare.close());
  const { page, close } = await open(bare, "no-webgl", smooth_payload());
  assert.match(await notice(page), /No picture\..*no WebGL 2/);
  await page.locator(".plot canvas").nth(3).waitFor();
  assert.equal(await page.getByRole("region", { name: "Before and after" }).count(), 1);
  assert.match(await page.locator(".places").innerText(), /three or more triangles/);
  assert.equal(await page.locator(".places button").count(), 0, "nothing to fly to");
  await keep_screenshot(page, "no-webgl");
  await close();
});

test("a mesh without triangles has no picture", async () => {
  const { page, troubles, close } = await open(browser, "empty", empty_payload());
  assert.match(await notice(page), /The mesh has no triangles/);
  assert.deepEqual(troubles, []);
  await close();
});

test("one tiny triangle far away fills the picture, values that are no numbers do no harm", async () => {
  const { page, troubles, close } = await open(browser, "one-triangle", one_triangle_payload());
  const seen = await pixels_of(browser, page, ".stage");
  const share = share_of(seen, (r, g, b) => r + g + b < 700);
  assert.ok(share > 0.05, `drawn: ${share}`);
  assert.deepEqual(troubles, []);
  await close();
});

for (const [what, harm, message] of [
  ["bytes that are no base64", (p) => (p.bytes = "?!"), /mesh is missing or cut off/],
  ["bytes that are cut off", (p) => (p.bytes = p.bytes.slice(0, 400)), /cannot be unpacked/],
  ["too few bytes", (p) => (p.scene.bytes_length += 4), /has \d+ bytes, not \d+/],
  ["an array beyond the end", (p) => (p.scene.arrays.triangles.offset += 1e6), /wrong size/],
  [
    "too large a vertex",
    (p) => (p.scene.vertices = p.scene.state_vertices[0] = 5),
    /wrong size|missing vertex/,
  ],
  ["a scene that is none", (p) => (p.scene = "none"), /No picture/],
]) {
  test(`${what}: the rest of the page is there`, async () => {
    const payload = smooth_payload();
    harm(payload);
    const { page, close } = await open(browser, "damaged", payload);
    assert.match(await notice(page), message);
    assert.equal(await page.getByRole("region", { name: "Time by stage" }).count(), 1);
    await close();
  });
}

test("a report without fields, and a page without a report, are no blank page", async () => {
  const bare = await open(browser, "bare", { report: {} });
  assert.equal(await bare.page.locator("h1").innerText(), "Report");
  assert.deepEqual(bare.troubles, []);
  await bare.close();
  const none = await open(browser, "none", { report: null });
  assert.match(await notice(none.page), /This page cannot be shown: its report is missing/);
  await none.close();
});

test("a batch of no files is a table of none", async () => {
  const { page, troubles, close } = await open(browser, "batch-none", batch_payload(0));
  assert.equal(await page.getByRole("table", { name: "Files" }).locator("td").innerText(), "none");
  assert.deepEqual(troubles, []);
  await close();
});
