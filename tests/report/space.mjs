// node space.mjs MODULES CHROMIUM PAGE FOLDER PICTURE < tasks.json: opens the report of a model in space and prints what it saw as JSON.
import { pathToFileURL } from "node:url";
import { openPage } from "./open_page.mjs";

const { file, words, tasks, context, page, errors } = await openPage();
const [picture] = words;
const seen = { errors, requests: [], picks: [] };
page.on("request", (request) => { if (![file, ...tasks.mechanisms].some((own) => request.url() === pathToFileURL(own).href) && !request.url().startsWith("data:")) seen.requests.push(request.url().slice(0, 200)); });
await page.goto(pathToFileURL(file).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
seen.text = await page.evaluate(() => document.getElementById("page").innerText);

const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 80)))));
const values = (list) => page.evaluate((id) => Object.fromEntries([...document.querySelectorAll(`#${id} .value[data-value]`)].map((value) => [value.dataset.key, Number(value.dataset.value)])), list);
const increment = async (number) => {
  await page.fill("#increment", String(number));
  await page.waitForFunction((wanted) => document.getElementById("field").dataset.increment === wanted && document.getElementById("contacts").dataset.increment === wanted, String(number));
};
/** Clicks where a point of the undeformed model, relative to its centre, is seen. */
const click = async (at) => {
  await page.locator("#space-view").scrollIntoViewIfNeeded();
  const [px, py] = await page.evaluate((point) => window.scaboReport.space.camera.toPixel(...point), at), box = await page.locator("#space-view").boundingBox();
  await page.mouse.click(box.x + px, box.y + py);
  await settled();
  return page.evaluate(() => ({ where: document.querySelector("#field .where").textContent, at: document.getElementById("values").dataset.at?.split(" ").map(Number) }));
};
const read = async (at) => ({ ...(await click(at)), values: await values("values") });
const camera = () => page.evaluate(() => { const { azimuth, elevation, scale, middle } = window.scaboReport.space.camera; return { azimuth, elevation, scale, middle: [...middle] }; });

await page.fill("#magnification-number", "0");
await page.locator("#magnification-number").press("Enter");
for (const number of tasks.increments) {
  await increment(number);
  seen.picks.push(await read(tasks.top));
}
await page.fill("#magnification-number", String(tasks.magnification)); // what is picked has moved
await page.locator("#magnification-number").press("Enter");
seen.moved = await read(tasks.moved);
await page.fill("#magnification-number", "0");
await page.locator("#magnification-number").press("Enter");

// A section: its face is seen, and values on it are read.
await page.selectOption("#cut", "x");
await page.fill("#cut-at", String(tasks.cut));
await page.click("#view-x");
await settled();
seen.cut = await read(tasks.on_cut);
seen.cut_text = await page.textContent("#cut-text");
await page.click("#show-all");
await settled();
await page.screenshot({ path: picture });
await page.check("#cut-side");
await page.click("#view-x");
await settled();
seen.other_side = await read(tasks.on_cut);
await page.uncheck("#cut-side");
await page.selectOption("#cut", "");

// A hidden body is neither seen nor picked.
await page.click("#show-all");
await page.click("#field .bodies summary");
await page.uncheck("#body-2");
seen.below = await read(tasks.below);
await page.check("#body-2");

// The mouse turns, with Shift it moves, the wheel enlarges; so do keys.
await page.locator("#space-view").scrollIntoViewIfNeeded();
const box = await page.locator("#space-view").boundingBox(), x = box.x + 0.5 * box.width, y = box.y + 0.5 * box.height;
const drag = async () => { await page.mouse.move(x, y); await page.mouse.down(); await page.mouse.move(x + 50, y + 20, { steps: 4 }); await page.mouse.up(); };
seen.cameras = [await camera()];
await drag();
seen.cameras.push(await camera());
await page.keyboard.down("Shift");
await drag();
await page.keyboard.up("Shift");
seen.cameras.push(await camera());
await page.mouse.move(x, y);
await page.mouse.wheel(0, -200);
await settled();
seen.cameras.push(await camera());
await page.focus("#space-view");
await page.keyboard.press("ArrowLeft");
seen.cameras.push(await camera());
await page.keyboard.press("0");
seen.cameras.push(await camera());
await page.keyboard.press("PageUp");
seen.stepped = await page.evaluate(() => window.scaboReport.state.shown.increment);

// A pair under the mouse is lit up on both sides.
await increment(tasks.increments.at(-1));
await page.locator("#face-map").scrollIntoViewIfNeeded();
const map = await page.locator("#face-map").boundingBox(), [px, py] = await page.evaluate((pair) => window.scaboReport.maps.pixelOf(pair), tasks.pair);
await page.mouse.move(map.x + px, map.y + py);
await settled();
seen.pair = { values: await values("pair-values"), ring: await page.evaluate(() => document.querySelectorAll("#field .ring").length), number: await page.evaluate(() => window.scaboReport.state.shown.pair) };
await page.fill("#increment", "1");
await page.click("#play");
await page.waitForFunction((last) => Number(document.getElementById("increment").value) >= last, tasks.increments.at(-1));
seen.unlabelled = await page.evaluate(() => [...document.querySelectorAll("input, select, button, canvas")].filter((control) => {
  if (control.closest("[role=img]")?.getAttribute("aria-label")) return false;
  const label = control.getAttribute("aria-label") || control.closest("label")?.textContent || control.textContent;
  return !label?.trim();
}).map((control) => control.id || control.outerHTML.slice(0, 60)));

// A mechanism is played in place of the fields, and leaves them as they were.
seen.mechanisms = [];
for (const file of tasks.mechanisms) {
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
  const fields = () => page.evaluate(() => [...window.scaboReport.space.moved]), boxes = await page.locator("#show-mechanism").count(), before = await fields();
  if (boxes) await page.check("#show-mechanism");
  await page.waitForFunction(() => document.getElementById("field").dataset.quantity === "mechanism");
  const mechanism = { boxes, note: await page.textContent("#field .note"), moved: await fields(), body: await page.evaluate(() => [...window.scaboReport.space.solids.body]) };
  await page.waitForFunction(() => { (window.lengths ??= []).push(window.scaboReport.space.length); return window.lengths.length > 2 && Math.max(...window.lengths) > 1.5 * window.lengths.at(-1); });
  mechanism.longest = await page.evaluate(() => Math.max(...window.lengths));
  mechanism.coloured = await page.evaluate(() => { const { space } = window.scaboReport; return [...new Set([...space.solids.body].filter((_, i) => !Number.isNaN(space.value[i])))]; });
  if (boxes) {
    await page.uncheck("#show-mechanism");
    await page.waitForFunction(() => document.getElementById("field").dataset.quantity !== "mechanism");
    mechanism.fields = [before, await fields()];
    mechanism.after = await page.getAttribute("#field", "data-quantity");
  }
  seen.mechanisms.push(mechanism);
}
await context.close();
process.stdout.write(JSON.stringify(seen));
