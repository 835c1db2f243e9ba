// node browser.mjs MODULES CHROMIUM PAGE FOLDER < tasks.json: opens a report in headless Chromium and prints what it saw as JSON.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, chromiumPath, file, folder] = process.argv.slice(2);
const { chromium } = await import(pathToFileURL(join(modules, "playwright-core", "index.mjs")).href);
const tasks = JSON.parse(readFileSync(0, "utf-8"));
const seen = { errors: [], requests: [], dialogs: 0 };

const context = await chromium.launchPersistentContext(join(folder, "profile"), {
  executablePath: chromiumPath, headless: true, viewport: { width: 1300, height: 900 }, colorScheme: "light", timeout: 300000,
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--enable-unsafe-swiftshader"],
});
const page = await context.newPage();
page.setDefaultTimeout(300000); // a busy machine is slow
page.on("console", (message) => { if (message.type() === "error") seen.errors.push(message.text()); });
page.on("pageerror", (error) => seen.errors.push(String(error)));
page.on("request", (request) => { if (request.url() !== pathToFileURL(file).href && !request.url().startsWith("data:")) seen.requests.push(request.url().slice(0, 200)); });
page.on("dialog", (dialog) => { ++seen.dialogs; void dialog.dismiss(); });

await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
seen.title = await page.title();
seen.heading = await page.textContent("h1");
seen.injected = await page.evaluate(() => document.querySelectorAll("h1 *, img").length);
seen.text = await page.evaluate(() => document.getElementById("page").innerText);

const increment = async (number) => {
  await page.fill("#increment", String(number));
  await page.waitForFunction((wanted) => document.getElementById("field").dataset.increment === wanted && document.getElementById("contacts")?.dataset.increment === wanted, String(number));
};
const values = (list) => page.evaluate((id) => Object.fromEntries([...document.querySelectorAll(`#${id} .value[data-value]`)].map((value) => [value.dataset.key, Number(value.dataset.value)])), list);
const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 60)))));
const box = async () => (await page.locator("#field-view").boundingBox());

// Values at points: by a click on the picture, and by coordinates.
seen.picks = [];
for (const [number, x, y] of tasks.picks) {
  await increment(number);
  await page.locator("#field-view").scrollIntoViewIfNeeded();
  await page.keyboard.press("Escape");
  const [px, py] = await page.evaluate(([at, up]) => window.scaboReport.field.pixelOf(at, up), [x, y]), { x: left, y: top } = await box();
  await page.mouse.click(left + px, top + py);
  await page.waitForSelector("#values .value");
  const clicked = await values("values");
  await page.fill("#pick-x", String(x));
  await page.fill("#pick-y", String(y));
  await page.locator("#pick-y").press("Enter");
  await settled();
  seen.picks.push({ clicked, typed: await values("values") });
}
await page.fill("#pick-x", "1e3");
await page.locator("#pick-x").press("Enter");
seen.outside = await page.textContent(".where");

// A pair: the mouse in the picture lights up the curves, and the other way.
const state = () => page.evaluate(() => ({ pair: window.scaboReport.state.shown.pair, values: document.getElementById("pair-values").dataset.pair,
  ring: document.querySelector(".ring").style.display !== "none" ? document.querySelector(".ring").getAttribute("transform") : null,
  cursor: document.querySelector("#contacts .u-cursor-x").getBoundingClientRect().x - document.querySelector("#contacts .u-over").getBoundingClientRect().x }));
await page.click("#show-all");
await page.locator("#field-view").scrollIntoViewIfNeeded();
seen.dark_pair = await state();
const place = await page.evaluate((pair) => window.scaboReport.field.pixelOfPair(pair), tasks.pair), frame = await box();
await page.mouse.move(frame.x + place[0], frame.y + place[1]);
await settled();
seen.from_field = { ...(await state()), expected: await page.evaluate((pair) => window.scaboReport.contacts.chart.positionOf(pair), tasks.pair), place, shown: await values("pair-values") };
await page.locator("#contacts .u-over").first().scrollIntoViewIfNeeded();
const over = await page.locator("#contacts .u-over").first().boundingBox();
const at = await page.evaluate((pair) => window.scaboReport.contacts.chart.positionOf(pair), tasks.other);
await page.mouse.move(over.x + at, over.y + 20);
await settled();
seen.from_curve = { ...(await state()), place: await page.evaluate((pair) => window.scaboReport.field.pixelOfPair(pair), tasks.other), shown: await values("pair-values") };
await page.mouse.move(2, 2);
await page.fill("#pair", String(tasks.other + 1));
await settled();
seen.from_keyboard = await state();

// The keyboard reaches everything, and the picture obeys it.
await page.evaluate(() => { document.activeElement?.blur(); window.scrollTo(0, 0); });
seen.reached = [];
for (let k = 0; k < 45; ++k) {
  await page.keyboard.press("Tab");
  seen.reached.push(await page.evaluate(() => document.activeElement.id || document.activeElement.tagName));
}
seen.unlabelled = await page.evaluate(() => [...document.querySelectorAll("input, select, button, canvas")].filter((control) => {
  if (control.closest("[role=img]")?.getAttribute("aria-label")) return false;
  const label = control.getAttribute("aria-label") || control.closest("label")?.textContent || control.textContent;
  return !label?.trim();
}).map((control) => control.id || control.outerHTML.slice(0, 60)));
await page.focus("#field-view");
const camera = () => page.evaluate(() => { const { x, y, scale } = window.scaboReport.field.camera; return [x, y, scale]; });
seen.cameras = [await camera()];
for (const key of ["ArrowRight", "ArrowUp", "+", "0"]) {
  await page.keyboard.press(key);
  seen.cameras.push(await camera());
}
await page.keyboard.press("Enter");
await settled();
seen.middle = await page.evaluate(() => window.scaboReport.state.shown.picked !== null);
await page.keyboard.press("PageUp");
seen.stepped = await page.evaluate(() => window.scaboReport.state.shown.increment);

// Two quantities against each other; the ring follows the increment, and a click chooses it.
const ring = () => page.evaluate(() => { const { x, y } = document.querySelector("#loops .loop-now").dataset; return [Number(x), Number(y)]; });
const option = (id, name) => page.locator(`#${id} option`).evaluateAll((options, wanted) => options.find((one) => one.textContent === wanted)?.value, name);
await page.selectOption("#loop-x", await option("loop-x", tasks.loop[0]));
await page.selectOption("#loop-y", await option("loop-y", tasks.loop[1]));
seen.loop = { points: await page.locator("#loops .loop-point").evaluateAll((points) => points.map(({ dataset: { x, y } }) => [Number(x), Number(y)])), rings: [] };
for (const wanted of [3, 1]) {
  await increment(wanted);
  seen.loop.rings.push(await ring());
}
await page.locator("#loops .loop").scrollIntoViewIfNeeded();
const point = await page.locator("#loops .loop-point").nth(1).boundingBox();
await page.mouse.click(point.x + 3, point.y + 3);
seen.loop.clicked = await page.evaluate(() => window.scaboReport.state.shown.increment);
await increment(2);
await page.mouse.move(2, 2);

// Every quantity, then light and dark.
seen.quantities = await page.locator("#quantity option").evaluateAll((options) => options.map((option) => option.value));
for (const key of seen.quantities) {
  await page.selectOption("#quantity", key);
  await page.waitForFunction((wanted) => document.getElementById("field").dataset.quantity === wanted, key);
}
for (const id of ["show-mesh", "show-elements", "show-bands"]) await page.click(`#${id}`);
await page.fill("#magnification-number", "0");
await settled();
await page.selectOption("#quantity", "von_mises");
const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
seen.backgrounds = [await background()];
await settled();
await page.locator(".stage").screenshot({ path: join(folder, "light.png") });
await page.selectOption("#theme", "dark");
seen.backgrounds.push(await background());
await settled();
await page.locator(".stage").screenshot({ path: join(folder, "dark.png") });
await page.selectOption("#theme", "system");
await page.emulateMedia({ colorScheme: "dark" });
await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
seen.backgrounds.push(await background());
await page.click("#play");
await page.waitForFunction(() => window.scaboReport.state.shown.increment === 1);
await page.click("#play");
process.stdout.write(JSON.stringify(seen));
await context.close();
