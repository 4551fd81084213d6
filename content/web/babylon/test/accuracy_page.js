import { Engine } from "@babylonjs/core/Engines/engine.js";
import { readPanorama, Rowland } from "../dist/index.js";
import { radiance } from "./points.js";

const errors = [];
console.error = (...words) => errors.push(words.join(" ").slice(0, 2000)); // of programs that do not compile
const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });
try {
    const { probe, keyLights, cases } = await (await fetch("/task")).json();
    const engine = new Engine(document.querySelector("canvas"), false);
    const rowland = new Rowland();
    rowland.onError = (error) => post({ error: error.message });
    await rowland.setProbe(await readPanorama(probe), { keyLights });
    const results = [];
    for (const one of cases) results.push(await radiance(engine, rowland, one));
    await post({ results, error: errors[0] });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack });
}
