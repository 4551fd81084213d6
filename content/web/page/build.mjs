// Writes the static site: node build.mjs FOLDER PACKAGE, the package built.
import { cpSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
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

/** A source of the page as a module here. */
async function imported(entry, define) {
    const { outputFiles } = buildSync({ ...options, entryPoints: [here + entry], define, write: false });
    return import("data:text/javascript;base64," + Buffer.from(outputFiles[0].contents).toString("base64"));
}

const { Tasks } = await import(pathToFileURL(from + "/dist/tasks.js"));
const tasks = new Tasks(async (name) => readFileSync(`${from}/dist/${name}.wasm`));

/** So that nothing is fitted when the page opens. */
async function builtInKeyLights() {
    const { builtInLight, LIGHT_NAMES } = await imported("lights.ts", { BUILT_IN_KEY_LIGHTS: "{}" });
    const lights = {};
    for (const name of LIGHT_NAMES) {
        const { texels, width, height } = builtInLight(name);
        const probe = new Float32Array(2 + texels.length);
        probe.set([width, height]);
        probe.set(texels, 2);
        const numbers = await tasks.fitKeyLights(probe, 16);
        lights[name] = Array.from(numbers, (x) => Number(x.toPrecision(8)));
    }
    return JSON.stringify(lights);
}

/** Writes efficiencies.bin; where in it those of each sample are. */
async function builtInEfficiencies() {
    const { EFFICIENCY_UNIT, SAMPLES } = await imported("samples.ts", { BUILT_IN_EFFICIENCIES: "{}" });
    const samples = {};
    const values = [];
    for (const { name, material } of SAMPLES) {
        const { relief } = await tasks.material(0, { json: JSON.stringify(material), efficiencies: new Float32Array(), version: 0 });
        if (relief[0] === 0) continue; // scalar theory
        const numbers = [...await tasks.solve(relief)];
        const header = numbers.splice(0, 4 + numbers[3]);
        samples[name] = { header, first: values.length, count: numbers.length };
        values.push(...numbers.map((x) => Math.min(Math.round(x / EFFICIENCY_UNIT), 65535)));
    }
    writeFileSync(`${out}/efficiencies.bin`, Uint16Array.from(values));
    return JSON.stringify(samples);
}

const { top } = await import(pathToFileURL(from + "/build/places.mjs"));

/** Ranges and defaults of foil recipes, by type and key: of the schema that the foil library states. */
async function foilSchema() {
    const { BakeModule } = await import(pathToFileURL(from + "/dist/module.js"));
    const module = await BakeModule.load(readFileSync(top + "build/web/bake/schema.wasm"));
    const { properties: { foil, card } } = JSON.parse(String.fromCharCode(...module.numbers("foil_schema")));
    return JSON.stringify({ foil: Object.fromEntries(foil.oneOf.map(({ properties }) => [properties.type.const, properties])), card: card.properties });
}

const builtIn = { FOIL_SCHEMA: await foilSchema(), BUILT_IN_KEY_LIGHTS: await builtInKeyLights(), BUILT_IN_EFFICIENCIES: await builtInEfficiencies() };
buildSync({ ...options, entryPoints: [here + "page.ts"], define: builtIn, outfile: out + "/page.js" });
buildSync({ ...options, entryPoints: [from + "/dist/worker.js"], outfile: out + "/worker.js" });
for (const name of ["environment", "foil_worker"]) buildSync({ ...options, entryPoints: [`${here}${name}.ts`], outfile: `${out}/${name}.js` });
for (const file of ["index.html", "page.css", "cabinet.glb", "cabinet.webp"]) cpSync(here + file, `${out}/${file}`);
cpSync(here + "../../scenes/films.glb", `${out}/films.glb`);
for (const file of readdirSync(from + "/dist").filter((name) => name.endsWith(".wasm"))) cpSync(`${from}/dist/${file}`, `${out}/${file}`);
cpSync(top + "build/web/bake/foil.wasm", out + "/foil.wasm"); // the package has no foil studio
for (const file of ["draco_decoder.wasm", "draco_wasm_wrapper.js"])
    cpSync(`${from}/node_modules/three/examples/jsm/libs/draco/gltf/${file}`, `${out}/draco/${file}`);
