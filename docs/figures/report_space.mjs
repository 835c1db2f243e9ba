// The picture of a report in docs/report.md, docs/figures/report_space.png:
//
//   scabo run examples/47_bolted_flange_in_space/model.yaml -o model.results && scabo report model.results --units mm,N
//   node docs/figures/report_space.mjs model.report.html docs/figures/report_space.png
//
// It needs Chromium, and playwright-core from build/report/node_modules, where `make report` has put it.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const [file, picture, chromiumPath = "/usr/bin/chromium"] = process.argv.slice(2);
const modules = fileURLToPath(new URL("../../build/report/node_modules", import.meta.url));
const { chromium } = await import(pathToFileURL(join(modules, "playwright-core", "index.mjs")).href);
const profile = mkdtempSync(join(tmpdir(), "scabo_report_"));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: chromiumPath, headless: true, viewport: { width: 1400, height: 1020 }, colorScheme: "light",
  args: ["--no-sandbox", "--no-first-run", "--disable-background-networking", "--enable-unsafe-swiftshader"],
});
const page = await context.newPage();
await page.goto(pathToFileURL(resolve(file)).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
await page.selectOption("#contact", "1");
await page.selectOption("#cut", "y");
await page.fill("#cut-at", "500");
await page.check("#cut-side");
await page.fill("#magnification-number", "10");
await page.locator("#magnification-number").press("Enter");
await page.click("#show-all");
await page.evaluate(() => { window.scrollTo(0, 190); document.activeElement?.blur(); });
await page.mouse.move(2, 2);
await page.waitForTimeout(800); // until the picture is drawn
await page.screenshot({ path: picture });
await context.close();
rmSync(profile, { recursive: true, force: true });
