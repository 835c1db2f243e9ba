// Opens a page in headless Chromium: what the scripts of this folder share. Their words are MODULES CHROMIUM PAGE FOLDER, their tasks JSON on
// standard input.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

/** Words of the command line, tasks, and the page; its errors are collected in `errors`. */
export async function openPage() {
  const [modules, chromiumPath, file, folder, ...words] = process.argv.slice(2);
  const { chromium } = await import(pathToFileURL(join(modules, "playwright-core", "index.mjs")).href);
  const tasks = JSON.parse(readFileSync(0, "utf-8"));
  const context = await chromium.launchPersistentContext(join(folder, "profile"), {
    executablePath: chromiumPath, headless: true, viewport: { width: 1300, height: 900 }, colorScheme: "light", timeout: 300000,
    args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
      "--enable-unsafe-swiftshader"],
  });
  const page = await context.newPage();
  const errors = [];
  page.setDefaultTimeout(300000); // a busy machine is slow
  page.on("console", (message) => { if (message.type() === "error") errors.push(message.text()); });
  page.on("pageerror", (error) => errors.push(String(error)));
  return { file, folder, words, tasks, context, page, errors };
}
