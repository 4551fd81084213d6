import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";
import { gzipSync } from "node:zlib";
import { packageFolder } from "./browser.mjs";

const { buildSync } = createRequire(import.meta.url)("esbuild");
const zipped = (bytes) => gzipSync(bytes, { level: 9 }).length;
const bundled = (entry) => buildSync({ entryPoints: [packageFolder + entry], bundle: true, minify: true, format: "esm",
    external: ["three", "three/*"], write: false }).outputFiles[0].contents;

const built = existsSync(packageFolder + "dist/bake.wasm");

test("the package stays as small as it is", { skip: built ? false : "needs dist: npm run build" }, (t) => {
    const sizes = { script: zipped(bundled("dist/index.js")), worker: zipped(bundled("dist/worker.js")),
        bake: zipped(readFileSync(packageFolder + "dist/bake.wasm")), arc: zipped(readFileSync(packageFolder + "dist/arc.wasm")),
        solve: zipped(readFileSync(packageFolder + "dist/solve.wasm")) };
    t.diagnostic(JSON.stringify(sizes));
    // 13 kB are tables of colours. arc.wasm is loaded with the first curved mesh, solve.wasm for rigorous theory.
    assert.ok(sizes.script + sizes.worker + sizes.bake < 116000 + 13000 && sizes.arc < 131000 && sizes.solve < 91000, JSON.stringify(sizes));
});
