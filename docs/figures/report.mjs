// The picture of a report in docs/report.md, docs/figures/report.png:
//
//   scabo run examples/11_gravity_dam/model.yaml -o model.results && scabo report model.results --units m,N
//   node docs/figures/report.mjs model.report.html docs/figures/report.png
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
  executablePath: chromiumPath, headless: true, viewport: { width: 1400, height: 1210 }, colorScheme: "light",
  args: ["--no-sandbox", "--no-first-run", "--disable-background-networking", "--enable-unsafe-swiftshader"],
});
const page = await context.newPage();
await page.goto(pathToFileURL(resolve(file)).href);
await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
await page.selectOption("#quantity", "principal_2");
await page.fill("#pair", "31");
await page.fill("#pick-x", "12");
await page.fill("#pick-y", "2");
await page.locator("#pick-y").press("Enter");
await page.evaluate(() => { window.scrollTo(0, 0); document.activeElement?.blur(); });
await page.mouse.move(2, 2);
await page.waitForTimeout(800); // until the picture is drawn
await page.screenshot({ path: picture });
await context.close();
rmSync(profile, { recursive: true, force: true });
