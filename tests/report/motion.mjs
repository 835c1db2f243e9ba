// node motion.mjs MODULES CHROMIUM PAGE FOLDER PICTURE < tasks.json: plays the report of a run in time and prints what it saw as JSON.
import { pathToFileURL } from "node:url";
import { openPage } from "./open_page.mjs";

const { file, words, tasks, context, page, errors } = await openPage();
const [picture] = words;
const seen = { errors, values: [], played: [] };
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
