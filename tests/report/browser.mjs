// node browser.mjs MODULES CHROMIUM PAGE FOLDER < tasks.json: opens a report in headless Chromium and prints what it saw as JSON.
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { openPage } from "./open_page.mjs";

const { file, folder, tasks, context, page, errors } = await openPage();
const seen = { errors, requests: [], dialogs: 0 };
page.on("request", (request) => { if (![file, tasks.mechanism].some((own) => request.url() === pathToFileURL(own).href) && !request.url().startsWith("data:")) seen.requests.push(request.url().slice(0, 200)); });
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
for (let k = 0; k < 80; ++k) {
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

// Largest and smallest values, hidden bodies, and which body is above.
const shown = () => page.evaluate(() => { const { hidden, order } = window.scaboReport.state.shown; return { hidden: [...hidden], order }; });
seen.extremes = [];
for (const hide of [[], [2]]) {
  await page.evaluate((numbers) => window.scaboReport.state.set({ hidden: new Set(numbers) }), hide);
  await settled();
  seen.extremes.push(await page.locator("#extremes span").evaluateAll((spans) => Object.fromEntries(spans.map(({ dataset: { key, value, x, y } }) => [key, [value, x, y].map(Number)]))));
}
const pictured = () => page.evaluate(() => { window.scaboReport.field.drawNow(); const gl = document.getElementById("field-view").getContext("webgl2"), [x, y] = window.scaboReport.field.pixelOf(3, 0.75);
  const ratio = gl.drawingBufferWidth / document.getElementById("field-view").clientWidth, pixel = new Uint8Array(4);
  gl.readPixels(Math.round(x * ratio), gl.drawingBufferHeight - Math.round(y * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); return pixel[3]; });
seen.opacity = [await pictured()];
await page.click("#bodies summary");
await page.click("#body-1");
seen.bodies = [await shown()];
await settled();
seen.opacity.push(await pictured());
await page.fill("#body-filter", "lo");
await page.click("#bodies-show");
await page.locator(".body-row button").first().click();
await page.fill("#body-filter", "upper");
await page.click("#bodies-show");
seen.bodies.push(await shown());

// Values along a line, by its ends and with the mouse.
for (const [k, value] of tasks.line.entries()) await page.fill(`#line-${["x1", "y1", "x2", "y2"][k]}`, String(value));
await page.locator("#line-y2").press("Enter");
await settled();
const saved = async (button) => {
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  await file.saveAs(join(folder, file.suggestedFilename()));
  return file.suggestedFilename();
};
seen.saved = {};
for (const id of ["line-csv", "pairs-csv", "contacts-csv", "reactions-csv", "save-png"]) seen.saved[id] = await saved(`#${id}`);
await page.click("#line-clear");
await page.click("#line-draw");
await page.locator("#field-view").scrollIntoViewIfNeeded();
const edges = await box(), ends = await page.evaluate(() => [[1, 0.5], [2, 1]].map((at) => window.scaboReport.field.pixelOf(...at)));
await page.mouse.move(edges.x + ends[0][0], edges.y + ends[0][1]);
await page.mouse.down();
await page.mouse.move(edges.x + ends[1][0], edges.y + ends[1][1], { steps: 4 });
await page.mouse.up();
await settled();
seen.drawn_line = await page.evaluate(() => ["x1", "y1", "x2", "y2"].map((name) => Number(document.getElementById(`line-${name}`).value)));
await page.click("#line-clear");

// Totals, at the increment that is shown.
await increment(3);
seen.totals = await page.locator("#totals table[aria-label='Totals of contacts'] td").allTextContents();

// On paper: an image for the picture, and light colours.
await page.selectOption("#theme", "dark");
seen.paper = await page.evaluate(() => {
  dispatchEvent(new Event("beforeprint"));
  const image = document.querySelector(".printed"), found = { image: image?.src.slice(0, 22), theme: document.documentElement.dataset.theme };
  dispatchEvent(new Event("afterprint"));
  return { ...found, after: document.querySelector(".printed") === null && document.documentElement.dataset.theme === "dark" };
});
await page.selectOption("#theme", "light");

// On a phone the picture comes first.
await page.setViewportSize({ width: 390, height: 844 });
await page.evaluate(() => window.scrollTo(0, 0));
await settled();
seen.phone = await page.evaluate(() => { const { top, bottom, left, right } = document.querySelector(".stage").getBoundingClientRect();
  return { top, bottom, left, right, width: document.documentElement.scrollWidth, verdict: document.getElementById("outcome").getBoundingClientRect().top }; });
await page.setViewportSize({ width: 1300, height: 900 });
await increment(2);

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

// A mechanism is played in place of the fields, and leaves them as they were.
await page.emulateMedia({ colorScheme: "light" });
await page.goto(pathToFileURL(tasks.mechanism).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
const fields = () => page.evaluate(() => window.scaboReport.field.scene.fields.visible);
await page.click("#show-mechanism");
seen.mechanism = { note: await page.textContent("#field .note"), fields: [await fields()] };
await page.waitForFunction(() => { const { value } = window.scaboReport.field.scene.mechanism.magnification; (window.lengths ??= []).push(value);
  return Math.max(...window.lengths) > 3 * Math.min(...window.lengths.filter((length) => length > 0)); });
seen.mechanism.longest = await page.evaluate(() => Math.max(...window.lengths));
await page.click("#show-mechanism");
await settled();
seen.mechanism.fields.push(await fields());
process.stdout.write(JSON.stringify(seen));
await context.close();
