// Posts the radiance of the points of a test, by each of the renderers.
import * as THREE from "three";
import { attribute, vec4 } from "three/tsl";
import { WebGPURenderer } from "three/webgpu";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingMaterial, Rowland } from "../dist/index.js";
import { GratingNodeMaterial } from "../dist/webgpu.js";
import { picture, PointMaterial, radiance, reference } from "./points.js";
import { SharedRowland } from "./shared_rowland.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

class PointNodeMaterial extends GratingNodeMaterial {
    setupModelViewProjection() {
        return vec4(attribute("place", "vec2"), 0, 1);
    }
}

/** Renderers by name; that on WebGPU only where the browser has it. */
async function renderersOf(names) {
    const all = {};
    for (const name of names) {
        if (name === "WebGLRenderer") {
            all[name] = { renderer: new THREE.WebGLRenderer(), Material: PointMaterial, Plain: GratingMaterial };
            continue;
        }
        const forceWebGL = name.endsWith("WebGL 2");
        if (!forceWebGL && !(await navigator.gpu?.requestAdapter())) continue;
        const renderer = new WebGPURenderer({ forceWebGL });
        await renderer.init();
        if (forceWebGL === (renderer.backend.isWebGPUBackend === true)) throw new Error(`${name}: the renderer took another back end`);
        all[name] = { renderer, Material: PointNodeMaterial, Plain: GratingNodeMaterial };
    }
    return all;
}

/** What each material says under the renderer that cannot draw it, in two pictures. */
async function refusals() {
    const said = [];
    const rowland = new Rowland();
    rowland.onError = ({ message }) => said.push(message);
    const grating = { grating: { pitch_nm: 1600, profile: { type: "slit", width_nm: 800 } } };
    const nodes = new WebGPURenderer({ forceWebGL: true });
    await nodes.init();
    for (const [renderer, Material] of [[nodes, GratingMaterial], [new THREE.WebGLRenderer(), GratingNodeMaterial]]) {
        renderer.setSize(1, 1);
        const scene = new THREE.Scene();
        scene.add(new THREE.Mesh(new THREE.PlaneGeometry(), new Material({ rowland, grating })));
        for (let i = 0; i < 2; ++i)
            try {
                renderer.render(scene, new THREE.PerspectiveCamera().translateZ(1));
            } catch {} // WebGLRenderer has no program for a class that it does not know
    }
    rowland.dispose();
    return said;
}

const errors = []; // of shaders, which three logs
for (const kind of ["error", "warn"]) {
    const log = console[kind];
    console[kind] = (...words) => {
        errors.push(words.join(" "));
        log(...words);
    };
}
try {
    const { probe, keyLights, renderers, cases } = await (await fetch("/task")).json();
    const rowland = new SharedRowland();
    rowland.onError = (error) => post({ error: error.message });
    const loader = probe.endsWith(".exr") ? new EXRLoader() : new HDRLoader();
    loader.setDataType(THREE.FloatType);
    const light = await loader.loadAsync(probe);
    // three takes a byte of a Radiance mantissa as n/255; the format and Rowland as n/256.
    if (probe.endsWith(".hdr")) light.image.data = light.image.data.map((x) => (x * 255) / 256);
    await rowland.setProbe(light, { keyLights });
    const drawing = await renderersOf(renderers);
    const results = [];
    const FLIPPED = "WebGLRenderer, upside down";
    for (const one of cases) {
        const shown = {};
        if (one.representation === "reference") shown.reference = await reference(rowland, one);
        else for (const [name, by] of Object.entries(drawing)) shown[name] = await (one.picture ? picture : radiance)(by, rowland, one);
        if (one.picture) shown[FLIPPED] = await picture(drawing.WebGLRenderer, rowland, one, true);
        results.push(shown);
    }
    await post({ results, keys: [...(await rowland.fitKeyLights(keyLights))], errors: [...errors], refusals: await refusals() });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack, errors });
}
