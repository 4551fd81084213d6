// Writes the static site: node build.mjs FOLDER PACKAGE, the latter built.
import { cpSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const [out, from] = process.argv.slice(2);
if (!from) throw new Error("expected: node build.mjs FOLDER PACKAGE");
const { buildSync } = createRequire(from + "/package.json")("esbuild");

mkdirSync(out, { recursive: true });
const options = {
    bundle: true, minify: true, format: "esm", target: "es2022", logLevel: "warning",
    nodePaths: [from + "/node_modules"], alias: { "@rowland/three": from + "/dist/index.js" },
};
buildSync({ ...options, entryPoints: [here + "page.ts"], outfile: out + "/page.js" });
buildSync({ ...options, entryPoints: [from + "/dist/worker.js"], outfile: out + "/worker.js" });
for (const file of ["index.html", "page.css"]) cpSync(here + file, `${out}/${file}`);
for (const file of ["bake.wasm", "arc.wasm", "reference.wasm"]) cpSync(`${from}/dist/${file}`, `${out}/${file}`);
