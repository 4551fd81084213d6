import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";
import { gzipSync } from "node:zlib";
import { packageFolder } from "./browser.mjs";

const { buildSync } = createRequire(import.meta.url)("esbuild");
const zipped = (bytes) => gzipSync(bytes, { level: 9 }).length;
/** What a page loads that imports `names`. */
const bundled = (entry, names) => buildSync({ stdin: { contents: `export ${names} from "./${entry}"`, resolveDir: packageFolder }, bundle: true, minify: true, format: "esm",
    external: ["three", "three/*"], splitting: true, outdir: "/", write: false }).outputFiles.find(({ path }) => path === "/stdin.js").contents;

const built = existsSync(packageFolder + "dist/bake.wasm");

test("the package stays as small as it is", { skip: built ? false : "needs dist: npm run build" }, (t) => {
    const module = (name) => zipped(readFileSync(`${packageFolder}dist/${name}.wasm`));
    const sizes = { script: zipped(bundled("dist/index.js", "{ GratingMaterial, Rowland }")), worker: zipped(bundled("dist/worker.js", "*")), bake: module("bake"),
        keys: module("keys"), arc: module("arc"), solve: module("solve"), film: module("film"), sparkle: module("sparkle") };
    t.diagnostic(JSON.stringify(sizes));
    // keys.wasm is loaded after the first picture, arc.wasm with the first curved mesh, solve.wasm for rigorous theory,
    // film.wasm with the first film, sparkle.wasm with the first glitter.
    assert.ok(sizes.script + sizes.worker + sizes.bake < 109600 && sizes.keys < 30000 && sizes.arc < 131000 && sizes.solve < 91000 &&
        sizes.film < 44000 && sizes.sparkle < 8000, JSON.stringify(sizes));
});
