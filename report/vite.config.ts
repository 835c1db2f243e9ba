// One file without any other: scripts and styles stand in the page itself.
import { readFileSync } from "node:fs";
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

/** The licences of what the page contains ask for their text to go with it. */
const notices = {
  name: "notices",
  transformIndexHtml: (html: string) => html.replace("</head>", `<!--\n${["three", "uplot"].map((name) =>
    `This page contains ${name}:\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf-8").trim()}\n`).join("\n")}-->\n</head>`),
};

export default defineConfig({
  plugins: [notices, viteSingleFile({ removeViteModuleLoader: true })],
  build: { target: "es2020", outDir: process.env.SCABO_REPORT_OUT ?? "dist", emptyOutDir: true, reportCompressedSize: false },
});
