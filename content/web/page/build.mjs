// Writes the static site: node build.mjs FOLDER. The package must be built.
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const three = fileURLToPath(new URL("../three/", import.meta.url));
const { buildSync } = createRequire(three + "package.json")("esbuild");
const out = process.argv[2];
if (!out) throw new Error("build.mjs: no folder; expected: node build.mjs FOLDER");

mkdirSync(out, { recursive: true });
const options = { bundle: true, minify: true, format: "esm", target: "es2022", nodePaths: [three + "node_modules"], logLevel: "warning" };
buildSync({ ...options, entryPoints: [here + "page.ts"], outfile: out + "/page.js" });
buildSync({ ...options, entryPoints: [three + "src/worker.ts"], outfile: out + "/worker.js" });
for (const file of ["index.html", "page.css"]) cpSync(here + file, `${out}/${file}`);
for (const file of ["bake.wasm", "arc.wasm"]) cpSync(`${three}dist/${file}`, `${out}/${file}`);
