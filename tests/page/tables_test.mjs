import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep_screenshot, launch, open, share_of, pixels_of } from "./support/browser.mjs";
import { batch_payload, fill_payload, smooth_payload, view_payload } from "./support/payloads.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const section = (page, title) => page.getByRole("region", { name: title });
const column = (table, n) => table.locator(`tbody tr td:nth-child(${n})`).allInnerTexts();

test("figures stand before, after and with their change", async () => {
  const { page, close } = await open(browser, "tables-figures", smooth_payload());
  const rows = await section(page, "Before and after").locator("tbody tr").allInnerTexts();
  const row = (title) => rows.find((text) => text.startsWith(title))?.split(/\t/);
  assert.deepEqual(row("Bending energy").slice(1), ["9\u202f503.5", "125.9", "\u221298.7 %"]);
  assert.deepEqual(row("Volume").slice(1), ["3.158", "3.1581", "+0.003 %"]);
  assert.deepEqual(row("Folded edges").slice(1), ["3", "0", "\u2212100 %"]);
  assert.match(await page.title(), /^torus\.off \u2013 ibmfair smooth$/);
  await close();
});

test("a single mesh has its figures in one column", async () => {
  const { report, scene, bytes } = view_payload();
  const figures = { energy: 80.1, area: 15.9, folded_hinges: 2 };
  const payload = { report: { ...report, before: figures }, scene, bytes };
  const { page, close } = await open(browser, "tables-one", payload);
  const rows = await section(page, "Figures").locator("tr").allInnerTexts();
  assert.deepEqual(
    rows.map((text) => text.trim().split(/\t/).at(-1)),
    ["Value", "80.1", "15.9", "2"],
  );
  assert.match(await page.locator(".key-figures").innerText(), /Folded edges\s*2$/);
  await close();
});

test("the time of each stage is a bar of its length", async () => {
  const { page, close } = await open(browser, "tables-seconds", smooth_payload());
  const rows = section(page, "Time by stage").locator("tbody tr");
  assert.match(await rows.nth(2).innerText(), /Factor\s+0\.13 s\s+74 %/);
  const widths = await rows.locator(".bar").evaluateAll((bars) => bars.map((b) => b.clientWidth));
  assert.ok(Math.abs(widths[3] / widths[2] - 0.0349 / 0.1306) < 0.02, String(widths));
  await close();
});

test("steps are drawn as curves, with values under the pointer, and as a table", async () => {
  const { page, close } = await open(browser, "tables-steps", smooth_payload());
  const plots = section(page, "Steps").locator("figure");
  assert.equal(await plots.count(), 4);
  assert.match(await plots.nth(0).innerText(), /Bending energy, logarithmic/);
  assert.doesNotMatch(await plots.nth(3).locator("figcaption").innerText(), /logarithmic/);
  await plots.nth(0).scrollIntoViewIfNeeded();
  const seen = await pixels_of(browser, page, ".u-wrap >> nth=0");
  const ink = share_of(seen, (r, g, b) => b > r + 60);
  assert.ok(ink > 0.003, `the curve is drawn: ${ink}`);
  await plots.nth(0).locator(".u-over").hover();
  assert.match(
    await plots.nth(0).locator(".u-legend").innerText(),
    /Step\s*8\s*Bending energy\s*260\.63/,
  );
  assert.match(
    await plots.nth(1).locator(".u-legend").innerText(),
    /Step\s*8\s*Norm of the gradient\s*\d/,
    "together",
  );
  await page.getByText("Steps as a table").click();
  const steps = section(page, "Steps").getByRole("table", { name: "Steps" });
  assert.equal((await column(steps, 1)).length, 17);
  await close();
});

test("holes are told of one by one, and sorted", async () => {
  const { page, close } = await open(browser, "tables-holes", fill_payload());
  const table = page.getByRole("table", { name: "Holes" });
  assert.match((await column(table, 2))[0], /filled\s*not by lagrange: it ran away from the hole/);
  assert.match((await column(table, 2))[1], /skipped\s*has more than 16 edges/);
  await table.getByRole("button", { name: "Edges" }).click();
  assert.deepEqual(await column(table, 3), ["17", "16"]);
  await table.getByRole("button", { name: "Edges" }).click();
  assert.deepEqual(await column(table, 3), ["16", "17"]);
  await close();
});

test("the files of a batch are sorted by any column, those without a value last", async () => {
  const { report } = batch_payload();
  const { page, troubles, close } = await open(browser, "batch", { report });
  const table = page.getByRole("table", { name: "Files" });
  await keep_screenshot(page, "batch", { fullPage: true });
  const head = (name) => table.getByRole("columnheader", { name });
  const click = (name) => head(name).getByRole("button").click();

  await click("Memory");
  const numbers = (await column(table, 5)).map(Number);
  assert.deepEqual(
    numbers,
    [...numbers].sort((a, b) => b - a),
  );
  assert.equal(await head("Memory").getAttribute("aria-sort"), "descending");
  await click("Memory");
  assert.deepEqual((await column(table, 5)).map(Number), [...numbers].reverse());
  await click("File");
  const names = (await column(table, 1)).map((text) => text.split("\n")[0]);
  assert.deepEqual(
    names,
    report.items.map((_, i) => `part ${i}.off`),
    "2 before 10",
  );
  for (let i = 0; i < 2; ++i) {
    await click("Energy after");
    const energies = await column(table, 7);
    const known = energies.filter((text) => text !== "\u2013").length;
    assert.ok(energies.slice(known).every((text) => text === "\u2013"));
  }
  assert.deepEqual(troubles, []);
  await close();
});

test("the files of a batch are filtered by words and by status", async () => {
  const { report } = batch_payload();
  const { page, close } = await open(browser, "batch-filter", { report });
  const rows = page.getByRole("table", { name: "Files" }).locator("tbody tr");
  const wanted = (holds) => report.items.filter(holds).length;
  await page.getByRole("searchbox").fill("PART 17 smooth");
  assert.equal(await rows.count(), 1);
  await page.getByRole("searchbox").fill("not an off");
  assert.equal(
    await rows.count(),
    wanted((item) => item.status === "failed"),
  );
  assert.match(await rows.first().innerText(), /failed\s+exit code 3[^]*1:1: not an OFF file/);
  await page.getByRole("searchbox").fill("");
  await page.getByRole("button", { name: /^skipped/ }).click();
  assert.equal(
    await rows.count(),
    wanted((item) => item.status === "skipped"),
  );
  await page.getByRole("searchbox").fill("no such file");
  assert.equal(await rows.innerText(), "none");
  await close();
});

test("items link to their own pages, whatever these are called", async () => {
  const { report } = batch_payload(2);
  report.items[0].page = "fair/50% #1?.html";
  const { page, close } = await open(browser, "batch-links", { report });
  const link = page.getByRole("link");
  const targets = await link.evaluateAll((links) => links.map((a) => a.href));
  assert.equal(targets.length, 2);
  const here = new URL(page.url());
  assert.ok(targets[0].endsWith("/fair/50%25%20%231%3F.html"), targets[0]);
  assert.equal(new URL(targets[0]).pathname.startsWith(here.pathname.replace(/[^/]*$/, "")), true);
  await close();
});

test("a long batch is shown in parts", async () => {
  const { page, close } = await open(browser, "batch-long", batch_payload(1500));
  const rows = page.getByRole("table", { name: "Files" }).locator("tbody tr");
  assert.equal(await rows.count(), 200);
  await page.getByRole("button", { name: /Show more \(1\s300 left\)/ }).click();
  assert.equal(await rows.count(), 1200);
  await close();
});
