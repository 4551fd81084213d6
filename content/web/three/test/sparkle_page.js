// Posts pictures of foil that sparkles, and of foil of one direction, by each of the renderers.
import * as THREE from "three";
import { WebGPURenderer } from "three/webgpu";
import { GratingMaterial } from "../dist/index.js";
import { GratingNodeMaterial } from "../dist/webgpu.js";
import { pixelsOf } from "./points.js";
import { SharedRowland } from "./shared_rowland.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

function grooveTexture({ width, height, texels }) {
    const rgba = new Uint16Array(4 * width * height);
    for (let i = 0; i < width * height; ++i) rgba.set([texels[2 * i], texels[2 * i + 1], 0, 65535], 4 * i);
    const texture = new THREE.DataTexture(rgba, width, height, THREE.RGBAFormat, THREE.UnsignedShortType);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.magFilter = THREE.LinearFilter;
    return texture;
}

/** A ring of light above a dim horizon. */
function probe() {
    const [width, height] = [64, 32];
    const texels = new Float32Array(3 * width * height);
    for (let i = 0; i < width * height; ++i) {
        const upward = Math.cos((Math.PI * (Math.floor(i / width) + 0.5)) / height);
        const ring = Math.exp(-(((upward - 0.5) / 0.08) ** 2));
        texels.set([0.05 + 3 * ring, 0.05 + 2.5 * ring, 0.08 + 2 * ring], 3 * i);
    }
    return { texels, width, height };
}

/** The material of a case. `sparkle`: whether pixels show some of the facets that they cover. */
async function foil({ Material }, rowland, { grating, representation }, texture, sparkle) {
    const material = new Material({
        rowland, grating: { grating, cover: undefined, grooveTexture: { index: 0, sparkle } }, representation, grooveTexture: texture, specularIntensity: 0,
    });
    material.diffractionOnly = true;
    await material.ready;
    return material;
}

/** A square of foil, each of whose pixels covers `change` of the texture. */
async function drawn({ renderer }, material, { lamp }, { change, pixels }, corner) {
    const square = new THREE.PlaneGeometry(2, 2);
    const uv = square.getAttribute("uv");
    for (let i = 0; i < uv.count; ++i)
        uv.setXY(i, ...[0, 1].map((k) => corner[k] + pixels * (change[0][k] * uv.getX(i) + change[1][k] * uv.getY(i))));
    square.setAttribute("tangent", new THREE.Float32BufferAttribute([1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1], 4));
    const scene = new THREE.Scene();
    if (lamp) {
        const light = new THREE.DirectionalLight(0xffffff, lamp.flux);
        light.position.set(...lamp.direction);
        scene.add(light);
    }
    scene.add(new THREE.Mesh(square, material));
    const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 1, 3).translateZ(2);
    const target = new THREE.WebGLRenderTarget(pixels, pixels, { type: THREE.FloatType });
    for (let i = 0; i < 3; ++i) {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        await material.settled;
    }
    return pixelsOf(renderer, target);
}

async function renderersOf() {
    const all = { "WebGLRenderer": { renderer: new THREE.WebGLRenderer(), Material: GratingMaterial } };
    for (const forceWebGL of [true, false]) {
        if (!forceWebGL && !(await navigator.gpu?.requestAdapter())) continue;
        const renderer = new WebGPURenderer({ forceWebGL });
        await renderer.init();
        all[`WebGPURenderer on ${forceWebGL ? "WebGL 2" : "WebGPU"}`] = { renderer, Material: GratingNodeMaterial };
    }
    return all;
}

const errors = []; // of shaders, which three logs
for (const kind of ["error", "warn"]) console[kind] = (...words) => errors.push(words.join(" "));
try {
    const { cases, edge, corner } = await (await fetch("/task")).json();
    const rowland = new SharedRowland();
    rowland.onError = (error) => post({ error: error.message });
    await rowland.setProbe(probe(), { keyLights: 0 });
    const drawing = await renderersOf();
    const results = [];
    for (const one of cases) {
        const shown = [];
        for (const red of one.reds) {
            const texture = grooveTexture({ width: 1, height: 1, texels: [red, one.green] });
            const material = await foil(drawing.WebGLRenderer, rowland, one, texture, false);
            shown.push((await drawn(drawing.WebGLRenderer, material, one, { change: [[1, 0], [0, 1]], pixels: 1 }, corner))[0]);
        }
        const texture = grooveTexture(one.texture);
        const pictures = {};
        for (const [name, by] of Object.entries(drawing)) {
            const material = await foil(by, rowland, one, texture, true);
            pictures[name] = [];
            for (const distance of one.distances) pictures[name].push(await drawn(by, material, one, distance, corner));
        }
        results.push({ shown, pictures });
    }
    const edges = {};
    for (const [name, by] of Object.entries(drawing)) {
        const material = await foil(by, rowland, edge, grooveTexture(edge.texture), false);
        edges[name] = await drawn(by, material, edge, edge.distance, [0, 0]);
    }
    const loaded = performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname);
    await post({ results, edges, errors, loaded });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack, errors });
}
