// Writes the static site: node build.mjs FOLDER PACKAGE CABINET, the package built and the cabinet cooked.
import { cpSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const [out, from, cabinet] = process.argv.slice(2);
if (!cabinet) throw new Error("expected: node build.mjs FOLDER PACKAGE CABINET");
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
cpSync(cabinet, `${out}/cabinet.glb`);
for (const file of ["draco_decoder.wasm", "draco_wasm_wrapper.js"])
    cpSync(`${from}/node_modules/three/examples/jsm/libs/draco/gltf/${file}`, `${out}/draco/${file}`);
