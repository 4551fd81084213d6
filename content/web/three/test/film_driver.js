// Posts what films show, by each of the renderers.
import * as THREE from "three";
import { WebGPURenderer } from "three/webgpu";
import { FilmMaterial } from "../dist/index.js";
import { FilmNodeMaterial } from "../dist/webgpu.js";
import { shown } from "./film_points.js";
import { SharedRowland } from "./shared_rowland.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

/** Renderers by name, each with its material; that on WebGPU only where the browser has it. */
async function renderersOf() {
    const all = { WebGLRenderer: [new THREE.WebGLRenderer(), FilmMaterial] };
    for (const [name, forceWebGL] of [["WebGPURenderer on WebGL 2", true], ["WebGPURenderer on WebGPU", false]]) {
        if (!forceWebGL && !(await navigator.gpu?.requestAdapter())) continue;
        const renderer = new WebGPURenderer({ forceWebGL });
        await renderer.init();
        all[name] = [renderer, FilmNodeMaterial];
    }
    return all;
}

try {
    const { cases } = await (await fetch("/task")).json();
    const rowland = new SharedRowland();
    rowland.onError = (error) => post({ error: error.message });
    const results = {};
    for (const [name, by] of Object.entries(await renderersOf())) {
        results[name] = [];
        for (const one of cases) results[name].push(await shown(by, rowland, one));
    }
    await post({ results });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack });
}
