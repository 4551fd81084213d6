// Bundles a script of this folder and opens a page with it.
import { createRequire } from "node:module";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium, resultOf } from "../../three/test/browser.mjs";

export const packageFolder = fileURLToPath(new URL("..", import.meta.url));
export const missing = !chromium() ? "needs Chromium" : !existsSync(packageFolder + "dist/shared/bake.wasm") ? "needs dist: npm run build" : false;

/** What a page with the script posts to /result. */
export async function resultOfScript(script, task, files = {}) {
    const folder = mkdtempSync(join(tmpdir(), "rowland-babylon-"));
    try {
        const { buildSync } = createRequire(packageFolder)("esbuild");
        buildSync({ entryPoints: [script], absWorkingDir: packageFolder, nodePaths: [packageFolder + "node_modules"], bundle: true, format: "esm", outfile: join(folder, "page.js") });
        writeFileSync(join(folder, "page.html"), '<!doctype html><canvas width="8" height="8"></canvas><script type="module" src="dist/shared/page.js"></script>');
        // The script lies where its workers do.
        return await resultOf("page.html", task, { folder: packageFolder,
            files: { "/page.html": join(folder, "page.html"), "/dist/shared/page.js": join(folder, "page.js"), ...files } });
    } finally {
        rmSync(folder, { recursive: true });
    }
}
