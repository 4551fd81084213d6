// A small scene of gratings, its pictures as floats, and how far two pictures are apart.
import * as THREE from "three";
import { WebGPURenderer } from "three/webgpu";
import { GratingMaterial } from "../dist/index.js";
import { GratingNodeMaterial } from "../dist/webgpu.js";
import { SharedRowland } from "./shared_rowland.js";

export const SIZE = 32; // of a picture, in pixels
export const CD = {
    grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 130 }, orders: [-2, -1, 1, 2], theory: "scalar" },
    metal: "Al",
};

export const rowland = new SharedRowland();
/** What a page would be told, since it was last read. */
export const told = [];
rowland.onError = (error) => told.push(error.message);
export const errors = [];
console.error = (...words) => errors.push(words.join(" "));
console.warn = (...words) => errors.push(words.join(" "));

/** A sky that is brighter above, with a warm lamp and a cold one. */
export function sky() {
    const [width, height] = [64, 32];
    const texels = new Float32Array(4 * width * height);
    for (let i = 0; i < width * height; ++i) {
        const [column, row] = [i % width, Math.floor(i / width)];
        const lamp = row > 20 && row < 24 ? (column > 40 && column < 44 ? [60, 40, 20] : column > 10 && column < 14 ? [15, 30, 60] : null) : null;
        texels.set([...(lamp ?? [0.2, 0.25, 0.3].map((x) => x * (0.5 + row / height))), 1], 4 * i);
    }
    return new THREE.DataTexture(texels, width, height, THREE.RGBAFormat, THREE.FloatType);
}

let Material;
export const grating = (parameters) => new Material({ rowland, grating: CD, side: THREE.DoubleSide, ...parameters });

export function plate(width = 1, height = 1) {
    const geometry = new THREE.PlaneGeometry(width, height);
    geometry.computeTangents();
    return geometry;
}

export function ball(radius = 0.5) {
    const geometry = new THREE.SphereGeometry(radius, 16, 10);
    geometry.computeTangents();
    return geometry;
}

export function sceneOf(...objects) {
    const scene = new THREE.Scene();
    if (objects.length > 0) scene.add(...objects);
    return scene;
}

/** A lamp for every scene that is to have one. */
export function lamp(strength = 2) {
    const light = new THREE.DirectionalLight(0xffffff, strength);
    light.position.set(0.4, 0.3, 1);
    return light;
}

export function eye(z = 2.2) {
    const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
    camera.position.set(0.3, 0.4, z);
    camera.lookAt(0, 0, 0);
    return camera;
}

/** The renderer that draws now, and what it draws into. */
export let renderer;
let target;

/** Draws by one of three's renderers from now on, and by none that drew before. */
export async function drawBy(name) {
    const nodes = name !== "WebGLRenderer";
    Material = nodes ? GratingNodeMaterial : GratingMaterial;
    renderer?.domElement.remove();
    renderer?.dispose();
    renderer = nodes ? new WebGPURenderer({ forceWebGL: name.endsWith("WebGL 2") }) : new THREE.WebGLRenderer({ antialias: false });
    await renderer.init?.();
    renderer.setSize(SIZE, SIZE, false);
    document.body.append(renderer.domElement);
    target = new THREE.WebGLRenderTarget(SIZE, SIZE, { type: THREE.FloatType });
    if (name.endsWith("on WebGPU") && !renderer.backend.isWebGPUBackend) throw new Error("this Chromium offers no WebGPU adapter");
}

function materialsOf(scene) {
    const found = new Set();
    scene.traverse(({ material }) => [material].flat().forEach((one) => one?.isGratingMaterial && found.add(one)));
    return [...found];
}

/** Draws until no map and no table is missing. */
export async function settle(scene, draw) {
    const materials = materialsOf(scene);
    await Promise.all(materials.map(({ solved }) => solved));
    for (;;) {
        draw();
        const promises = materials.map(({ settled }) => settled);
        await Promise.all(promises);
        draw();
        if (materials.every(({ settled }, i) => settled === promises[i])) return;
    }
}

/** Linear radiance: red, green, blue and alpha of each pixel. */
export async function picture(scene, camera = eye(), { by = renderer, to = target } = {}) {
    const draw = () => {
        by.setRenderTarget(to);
        by.render(scene, camera);
        by.setRenderTarget(null);
    };
    await settle(scene, draw);
    const { width, height } = to;
    const pixels = new Float32Array(4 * width * height);
    if (by.isWebGLRenderer) by.readRenderTargetPixels(to, 0, 0, width, height, pixels);
    else pixels.set(await by.readRenderTargetPixelsAsync(to, 0, 0, width, height));
    if (!by.backend?.isWebGPUBackend) return pixels;
    return pixels.map((_, i) => pixels[4 * width * (height - 1 - Math.floor(i / 4 / width)) + (i % (4 * width))]); // top first
}

/** What the canvas shows, bytes. */
export async function shown(scene, camera = eye(), by = renderer, render = () => by.render(scene, camera)) {
    await settle(scene, render);
    render();
    const gl = by.getContext();
    const pixels = new Uint8Array(4 * SIZE * SIZE);
    gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
}

export const mapped = (pixels, change) => pixels.map((x, i) => (i % 4 === 3 ? x : change(x, i % 4, (i >> 2) % SIZE, Math.floor((i >> 2) / SIZE))));

/**
 * The largest difference of two pictures over the largest component of the second, and how much of the second shows
 * diffraction: the mean difference of a pixel's largest and smallest component over the mean of all.
 */
export function compare(found, expected, skip = () => false) {
    let [worst, largest, spread, sum] = [0, 0, 0, 0];
    for (let i = 0; i < expected.length; i += 4) {
        const rgb = [expected[i], expected[i + 1], expected[i + 2]];
        largest = Math.max(largest, ...rgb);
        spread += Math.max(...rgb) - Math.min(...rgb);
        sum += (rgb[0] + rgb[1] + rgb[2]) / 3;
        if (skip((i >> 2) % SIZE, Math.floor((i >> 2) / SIZE))) continue;
        for (let c = 0; c < 3; ++c) worst = Math.max(worst, Math.abs(found[i + c] - rgb[c]));
    }
    return { difference: worst / largest, colour: spread / sum };
}

/** As a data: address, for a person. */
export function url(pixels, exposure = 1) {
    const canvas = Object.assign(document.createElement("canvas"), { width: SIZE, height: SIZE });
    const image = canvas.getContext("2d").createImageData(SIZE, SIZE);
    for (let i = 0; i < pixels.length; ++i) {
        const row = SIZE - 1 - Math.floor(i / 4 / SIZE);
        const to = 4 * (row * SIZE + ((i >> 2) % SIZE)) + (i % 4);
        const value = pixels instanceof Uint8Array ? pixels[i] : 255 * Math.min(Math.max(exposure * pixels[i], 0), 1) ** (1 / 2.2);
        image.data[to] = i % 4 === 3 ? 255 : value;
    }
    canvas.getContext("2d").putImageData(image, 0, 0);
    return canvas.toDataURL("image/png");
}
