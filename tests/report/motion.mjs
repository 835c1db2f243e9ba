// node motion.mjs MODULES CHROMIUM PAGE FOLDER PICTURE < tasks.json: plays the report of a run in time and prints what it saw as JSON.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, chromiumPath, file, folder, picture] = process.argv.slice(2);
const { chromium } = await import(pathToFileURL(join(modules, "playwright-core", "index.mjs")).href);
const tasks = JSON.parse(readFileSync(0, "utf-8"));
const seen = { errors: [], values: [], played: [] };

const context = await chromium.launchPersistentContext(join(folder, "profile"), {
  executablePath: chromiumPath, headless: true, viewport: { width: 1300, height: 900 }, colorScheme: "light", timeout: 300000,
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--enable-unsafe-swiftshader"],
});
const page = await context.newPage();
page.setDefaultTimeout(300000); // a busy machine is slow
page.on("console", (message) => { if (message.type() === "error") seen.errors.push(message.text()); });
page.on("pageerror", (error) => seen.errors.push(String(error)));
await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");

const [x, y] = tasks.at;
for (const number of tasks.increments) {
  await page.fill("#increment", String(number));
  await page.waitForFunction((wanted) => document.getElementById("field").dataset.increment === wanted, String(number));
  await page.fill("#pick-x", String(x));
  await page.fill("#pick-y", String(y));
  await page.locator("#pick-y").press("Enter");
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 60)))));
  seen.values.push({
    name: await page.textContent("#increment-name"),
    ...await page.evaluate(() => Object.fromEntries([...document.querySelectorAll("#values .value[data-value]")].map((value) => [value.dataset.key, Number(value.dataset.value)]))),
  });
}
await page.screenshot({ path: picture });
await page.fill("#increment", "1");
await page.click("#play");
await page.waitForFunction((last) => Number(document.getElementById("increment").value) >= last, tasks.until);
seen.pressed = await page.getAttribute("#play", "aria-pressed");
await page.click("#play");
seen.stopped = await page.getAttribute("#play", "aria-pressed");
await context.close();
process.stdout.write(JSON.stringify(seen));
