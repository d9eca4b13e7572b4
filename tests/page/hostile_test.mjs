import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { keep_screenshot, launch, open } from "./support/browser.mjs";
import { hostile_payload } from "./support/payloads.mjs";

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

test("texts from files stay texts", async () => {
  const { page, troubles, close } = await open(browser, "hostile", hostile_payload());
  await keep_screenshot(page, "hostile", { fullPage: true });
  await page.keyboard.press("n");
  for (const summary of await page.locator("summary").all()) await summary.click();
  assert.equal(await page.evaluate(() => "harmed" in window), false);
  const [scripts, images] = [page.locator("#page script"), page.locator("#page img")];
  assert.equal((await scripts.count()) + (await images.count()), 0);
  const text = await page.locator("body").innerText();
  assert.match(text, /<\/script><script>window\.harmed = 1/, "it is shown as it is");
  assert.match(text, /\\u202egpj\.exe\\x07\\x1b\[31m&lt;b&gt;/, "what deceives is spelt out");
  assert.doesNotMatch(text, /[\u202e\u0007\u001b]/);
  assert.doesNotMatch(await page.title(), /[\u202e\u0007\u001b]/);
  assert.deepEqual(troubles, []);
  await close();
});

test("no link leads away from the page's own folder by scheme, drive or host", async () => {
  const { page, close } = await open(browser, "hostile-links", hostile_payload());
  const links = await page.locator("#page a").evaluateAll((all) => all.map((a) => a.href));
  const folder = page.url().replace(/[^/]*$/, "");
  assert.ok(links.length > 0);
  for (const link of links) assert.ok(link.startsWith(folder), link);
  await close();
});

test("the page may fetch nothing", async () => {
  const { page, close } = await open(browser, "hostile-fetch", hostile_payload());
  const tried = await page.evaluate(async () => {
    const violations = [];
    addEventListener("securitypolicyviolation", (event) =>
      violations.push(event.effectiveDirective),
    );
    const fetched = await fetch("https://example.org/").then(
      () => true,
      () => false,
    );
    const image = new Image();
    const seen = new Promise((done) => {
      image.onload = () => done(true);
      image.onerror = () => done(false);
    });
    image.src = "https://example.org/a.png";
    return { fetched, seen: await seen, violations };
  });
  assert.deepEqual(tried, { fetched: false, seen: false, violations: ["connect-src", "img-src"] });
  await close();
});
