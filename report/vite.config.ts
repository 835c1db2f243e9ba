// One file without any other: scripts and styles stand in the page itself.
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: { target: "es2020", outDir: process.env.SCABO_REPORT_OUT ?? "dist", emptyOutDir: true, reportCompressedSize: false },
});
