// Writes the static site: node build.mjs FOLDER PACKAGE, the package built.
import { cpSync, mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const [out, from] = process.argv.slice(2);
if (!from) throw new Error("expected: node build.mjs FOLDER PACKAGE");
const { buildSync } = createRequire(from + "/package.json")("esbuild");

mkdirSync(out, { recursive: true });
const options = {
    bundle: true, minify: true, format: "esm", target: "es2022", logLevel: "warning",
    nodePaths: [from + "/node_modules"], alias: { "@rowland/three": from + "/dist/index.js" },
};

/** So that nothing is fitted when the page opens. */
async function builtInKeyLights() {
    const { outputFiles } = buildSync({ ...options, entryPoints: [here + "lights.ts"], define: { BUILT_IN_KEY_LIGHTS: "{}" }, write: false });
    const { builtInLight, LIGHT_NAMES } = await import("data:text/javascript;base64," + Buffer.from(outputFiles[0].contents).toString("base64"));
    const { Tasks } = await import(pathToFileURL(from + "/dist/tasks.js"));
    const { texelsOf } = await import(pathToFileURL(from + "/dist/rowland.js"));
    const tasks = new Tasks(async (name) => readFileSync(`${from}/dist/${name}.wasm`));
    const lights = {};
    for (const name of LIGHT_NAMES) {
        const { texels, width, height } = texelsOf(builtInLight(name));
        const probe = new Float32Array(2 + texels.length);
        probe.set([width, height]);
        probe.set(texels, 2);
        const numbers = await tasks.fitKeyLights(probe, 16);
        lights[name] = Array.from(numbers, (x) => Number(x.toPrecision(8)));
    }
    return JSON.stringify(lights);
}
buildSync({ ...options, entryPoints: [here + "page.ts"], define: { BUILT_IN_KEY_LIGHTS: await builtInKeyLights() }, outfile: out + "/page.js" });
buildSync({ ...options, entryPoints: [from + "/dist/worker.js"], outfile: out + "/worker.js" });
for (const file of ["index.html", "page.css", "cabinet.glb"]) cpSync(here + file, `${out}/${file}`);
for (const file of ["bake.wasm", "arc.wasm", "reference.wasm", "solve.wasm"]) cpSync(`${from}/dist/${file}`, `${out}/${file}`);
for (const file of ["draco_decoder.wasm", "draco_wasm_wrapper.js"])
    cpSync(`${from}/node_modules/three/examples/jsm/libs/draco/gltf/${file}`, `${out}/draco/${file}`);
