// Renders the points of a test, a quad of pixels each, by each of the renderers, and posts their radiance.
import * as THREE from "three";
import { attribute, vec4 } from "three/tsl";
import { WebGPURenderer } from "three/webgpu";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingMaterial, Rowland } from "../dist/index.js";
import { GratingNodeMaterial } from "../dist/webgpu.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

/** The material with each vertex at the pixel that `place` names. */
class PointMaterial extends GratingMaterial {
    onBeforeCompile(shader) {
        super.onBeforeCompile(shader);
        shader.vertexShader = "attribute vec2 place;\n" +
            shader.vertexShader.replace(/}\s*$/, "gl_Position = vec4(place, 0.0, 1.0);\n}");
    }
}

class PointNodeMaterial extends GratingNodeMaterial {
    setupModelViewProjection() {
        return vec4(attribute("place", "vec2"), 0, 1);
    }
}

/** Bakes a case once for all renderers. */
class SharedRowland extends Rowland {
    shared = new Map();
    once(key, bake) {
        if (!this.shared.has(key)) this.shared.set(key, bake());
        return this.shared.get(key);
    }
    material(id, grating, efficiencies) {
        return this.once(`material ${efficiencies !== undefined}`, () => super.material(id, grating, efficiencies));
    }
    solve(...of) {
        return this.once("solve", () => super.solve(...of));
    }
    plane(...of) {
        return this.once(`plane ${of.at(-1)}`, () => super.plane(...of));
    }
    arc(...of) {
        return this.once("arc", () => super.arc(...of));
    }
    products(...of) {
        return this.once("products", () => super.products(...of));
    }
}

/** A quad for each frame, seen from the origin; mirrored in x. */
function geometry(frames, mirrored) {
    const x = mirrored ? -1 : 1;
    const arrays = { position: [], normal: [], tangent: [], place: [], uv: [] };
    const count = frames.length;
    frames.forEach(({ view, normal, grating }, i) => {
        const given = ([a, b, c]) => [x * a, b, c];
        for (const [right, up] of [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]]) {
            arrays.position.push(...given(view.map((c) => -c)));
            arrays.normal.push(...given(normal));
            arrays.tangent.push(...given(grating), 1);
            arrays.place.push((2 * (i + right)) / count - 1, up);
            arrays.uv.push((i + 0.5) / count, 0.5);
        }
    });
    const result = new THREE.BufferGeometry();
    const sizes = { position: 3, normal: 3, tangent: 4, place: 2, uv: 2 };
    for (const [name, size] of Object.entries(sizes))
        result.setAttribute(name, new THREE.Float32BufferAttribute(arrays[name], size));
    return result;
}

async function reference(rowland, { grating, frames }) {
    const material = new GratingMaterial({ rowland, grating });
    const points = frames.flatMap(({ view, normal, grating }) => [...view, ...normal, ...grating]);
    const radiance = await material.reference(Float32Array.from(points));
    return frames.map((_, i) => [...radiance.subarray(3 * i, 3 * i + 3)]);
}

/** A texel for each point. */
function grooveTexture(texels) {
    const texture = new THREE.DataTexture(Uint8Array.from(texels.flatMap(([red, green]) => [red, green, 0, 255])), texels.length, 1);
    texture.magFilter = THREE.LinearFilter;
    return texture;
}

/** Red, green and blue of each pixel, from the left below. */
async function pixelsOf(renderer, target) {
    const { width, height } = target;
    let pixels = new Float32Array(4 * width * height);
    if (renderer.isWebGLRenderer) renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    else pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
    target.dispose();
    const topFirst = renderer.backend?.isWebGPUBackend === true;
    return Array.from({ length: width * height }, (_, i) => {
        const row = Math.floor(i / width);
        const at = 4 * ((topFirst ? height - 1 - row : row) * width + (i % width));
        return [...pixels.subarray(at, at + 3)];
    });
}

/** A tilted plane under a lamp, whose grooves vary within its pixels and from one to the next. */
async function picture({ renderer, Plain }, rowland, { grating, picture: [width, height] }) {
    const texels = Array.from({ length: 64 }, (_, i) => [(29 * i) % 255, i % 7 === 0 ? 0 : 128, 0, 255]);
    const grooves = new THREE.DataTexture(Uint8Array.from(texels.flat()), 8, 8);
    grooves.magFilter = THREE.LinearFilter;
    const material = new Plain({ rowland, grating, grooveTexture: grooves });
    const plane = new THREE.PlaneGeometry(2, 2);
    plane.computeTangents();
    const scene = new THREE.Scene();
    const lamp = new THREE.PointLight(0xffffff, 400);
    lamp.position.set(2, 5, 7);
    const camera = new THREE.PerspectiveCamera(5, width / height).translateZ(15);
    scene.add(lamp, new THREE.Mesh(plane.rotateX(-0.6), material));
    const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
    await material.solved;
    for (let i = 0; i < 2; ++i) {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        await material.settled;
    }
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    material.dispose();
    return pixelsOf(renderer, target);
}

async function radiance({ renderer, Material }, rowland, { grating, representation, frames, lamp, texels, mirrored }) {
    const scene = new THREE.Scene();
    const camera = new THREE.PerspectiveCamera();
    const material = new Material({ rowland, grating, representation, grooveTexture: texels && grooveTexture(texels), side: THREE.DoubleSide });
    material.state.options.set("ROWLAND_UNCOMPRESSED", "1");
    if (lamp) {
        const light = new THREE.DirectionalLight(new THREE.Color(...lamp.flux), 1);
        light.position.set(...lamp.direction);
        scene.add(light);
    }
    const mesh = new THREE.Mesh(geometry(frames, mirrored), material);
    if (mirrored) mesh.scale.x = -1;
    mesh.frustumCulled = false;
    scene.add(mesh);
    const target = new THREE.WebGLRenderTarget(2 * frames.length, 2, { type: THREE.FloatType });
    await material.solved;
    const draw = () => {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
    };
    draw();
    await material.settled;
    draw();
    const pixels = await pixelsOf(renderer, target);
    material.dispose();
    return frames.map((_, i) => pixels[2 * i]);
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
    for (const one of cases) {
        rowland.shared.clear();
        const shown = {};
        if (one.representation === "reference") shown.reference = await reference(rowland, one);
        else for (const [name, by] of Object.entries(drawing)) shown[name] = await (one.picture ? picture : radiance)(by, rowland, one);
        results.push(shown);
    }
    await post({ results, errors: [...errors], refusals: await refusals() });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack, errors });
}
