import {
    ACESFilmicToneMapping, Color, DirectionalLight, HalfFloatType, Mesh, MeshStandardMaterial, PerspectiveCamera, PlaneGeometry,
    PMREMGenerator, Raycaster, Scene, Vector2, WebGLRenderer, type DataTexture, type Texture,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { DataUtils } from "three";
import { GratingMaterial, Rowland } from "@rowland/three";
import { builtInLight, LIGHT_NAMES, lightOf } from "./lights.js";
import { numberAt, SAMPLES, slidersOf, withNumber } from "./samples.js";

const element = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;
const message = element("message");
const report = (error: unknown) => (message.textContent = (error as Error).message ?? String(error));
addEventListener("error", (event) => report(event.error ?? event.message));
addEventListener("unhandledrejection", (event) => report(event.reason));

const canvas = element<HTMLCanvasElement>("view");
const scene = new Scene();
const camera = new PerspectiveCamera(35, 1, 0.01, 10);
camera.position.set(0.08, 0.24, 0.33);
const renderer = new WebGLRenderer({ canvas, antialias: true });
renderer.toneMapping = ACESFilmicToneMapping;
const controls = new OrbitControls(camera, canvas);
controls.target.set(0.04, 0.0, 0.045);
controls.maxPolarAngle = 0.49 * Math.PI;
controls.minDistance = 0.12;
controls.maxDistance = 1.5;

const rowland = new Rowland();
rowland.onError = report;

// Frames are drawn when something has changed.
let asked = false;
let frames = 0;
function draw(): void {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
        asked = false;
        renderer.render(scene, camera);
        document.documentElement.dataset.frames = String(++frames);
    });
}
rowland.onUpdate = draw;
controls.addEventListener("change", draw);

const table = new Mesh(new PlaneGeometry(0.6, 0.6).rotateX(-Math.PI / 2), new MeshStandardMaterial({ color: 0x222326, roughness: 0.9 }));
table.position.y = -0.004;
table.receiveShadow = true;
scene.add(table);

const lamp = new DirectionalLight(0xffffff, 0);
lamp.position.set(-0.4, 1, 0.5);
scene.add(lamp);

const meshes = SAMPLES.map(({ material, geometry, position, name }) => {
    const mesh = new Mesh(geometry(), new GratingMaterial({ rowland, grating: material, grooves: undefined }));
    mesh.position.set(...position);
    mesh.name = name;
    scene.add(mesh);
    return mesh;
});
const materials = SAMPLES.map(({ material }) => material);

// The panel.
const sample = element<HTMLSelectElement>("sample");
const sliders = element("sliders");
let chosen = 0;

function slider(label: string, from: number, to: number, step: number, value: number, change: (value: number) => void) {
    const row = document.createElement("label");
    const input = Object.assign(document.createElement("input"), { type: "range", min: from, max: to, step, value });
    const output = document.createElement("output");
    const show = () => (output.value = String(Number(input.value)));
    input.addEventListener("input", () => {
        show();
        change(Number(input.value));
    });
    row.append(label, input, output);
    show();
    return row;
}

let waiting = 0;
function rebake(index: number): void {
    clearTimeout(waiting);
    // The worker bakes in turn; only the last of a drag's values is worth it.
    waiting = window.setTimeout(() => {
        message.textContent = "";
        meshes[index].material.bake(rowland, materials[index]);
    }, 80);
}

function showSample(index: number): void {
    chosen = index;
    sample.selectedIndex = index;
    sliders.replaceChildren(...slidersOf(materials[index]).map(({ label, path, from, to, step }) =>
        slider(label, from, to, step, numberAt(materials[index], path)!, (value) => {
            materials[index] = withNumber(materials[index], path, value);
            rebake(index);
        })));
    const price = meshes[index].material.price;
    element("price").textContent = `Price: ${price.map} look-up${price.map === 1 ? "" : "s"} a pixel for the environment, nine for each bright light in reach.`;
}
sample.append(...SAMPLES.map(({ name }) => new Option(name)));
sample.addEventListener("change", () => showSample(sample.selectedIndex));
showSample(0);

function bind(id: string, change: (value: number) => void): void {
    const input = element<HTMLInputElement>(id);
    const output = input.nextElementSibling as HTMLOutputElement;
    const show = () => {
        output.value = input.value;
        change(Number(input.value));
        draw();
    };
    input.addEventListener("input", show);
    show();
}
bind("lamp", (value) => (lamp.intensity = value));
bind("exposure", (value) => (renderer.toneMappingExposure = 2 ** value));

// Light.
let environment: Texture | undefined;
/** Halves are filtered on every GPU; floats are not. */
function filterable(texture: Texture): Texture {
    const image = texture.image as { data: Float32Array; width: number; height: number };
    if (renderer.extensions.has("OES_texture_float_linear") || !(image.data instanceof Float32Array)) return texture;
    const halves = (texture as DataTexture).clone();
    halves.image = { ...image, data: Uint16Array.from(image.data, (x) => DataUtils.toHalfFloat(Math.min(x, 65504))) } as never;
    halves.type = HalfFloatType;
    halves.needsUpdate = true;
    return halves;
}

async function light(texture: Texture): Promise<void> {
    const pmrem = new PMREMGenerator(renderer);
    environment?.dispose();
    environment = pmrem.fromEquirectangular(filterable(texture)).texture;
    pmrem.dispose();
    scene.environment = environment;
    scene.background = environment;
    scene.backgroundBlurriness = 0.3;
    draw();
    await rowland.setProbe(texture);
}

let shownLight: Texture = builtInLight(LIGHT_NAMES[0]);
const lights = element<HTMLSelectElement>("light");
lights.append(...LIGHT_NAMES.map((name) => new Option(name)));
lights.addEventListener("change", () => {
    message.textContent = "";
    shownLight = builtInLight(LIGHT_NAMES[lights.selectedIndex]);
    light(shownLight).catch(report);
});

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    message.textContent = "";
    lightOf(file).then((texture) => light((shownLight = texture))).catch(report);
});

// Turning a sample by hand.
const ray = new Raycaster();
let held: Mesh | undefined;
function under(event: PointerEvent): Mesh | undefined {
    const box = canvas.getBoundingClientRect();
    ray.setFromCamera(new Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), camera);
    return ray.intersectObjects(meshes, false)[0]?.object as Mesh | undefined;
}
canvas.addEventListener("pointerdown", (event) => {
    held = under(event);
    if (!held) return;
    controls.enabled = false;
    showSample(meshes.indexOf(held as never));
    canvas.setPointerCapture(event.pointerId);
}, { capture: true });
canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    held.rotation.y += 0.01 * event.movementX;
    draw();
});
const release = () => {
    held = undefined;
    controls.enabled = true;
};
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);

const KEYS: Record<string, () => void> = {
    ArrowLeft: () => orbit(-0.06, 0),
    ArrowRight: () => orbit(0.06, 0),
    ArrowUp: () => orbit(0, -0.06),
    ArrowDown: () => orbit(0, 0.06),
    "+": () => zoom(0.9),
    "=": () => zoom(0.9),
    "-": () => zoom(1 / 0.9),
    q: () => (meshes[chosen].rotation.y -= 0.05),
    e: () => (meshes[chosen].rotation.y += 0.05),
};
function orbit(around: number, down: number): void {
    const offset = camera.position.clone().sub(controls.target);
    const polar = Math.min(Math.max(Math.acos(offset.y / offset.length()) + down, 0.02), controls.maxPolarAngle);
    camera.position.setFromSphericalCoords(offset.length(), polar, Math.atan2(offset.x, offset.z) + around).add(controls.target);
}
function zoom(factor: number): void {
    camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
}
canvas.addEventListener("keydown", (event) => {
    const key = KEYS[event.key];
    if (!key) return;
    event.preventDefault();
    key();
    controls.update();
    draw();
});

// A lost context comes back with three's own textures; the environment map is rendered again.
canvas.addEventListener("webglcontextlost", () => (message.textContent = "The graphics context was lost; waiting for it to come back."));
canvas.addEventListener("webglcontextrestored", () => {
    message.textContent = "";
    light(shownLight).catch(report);
});

function resize(): void {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(innerWidth, innerHeight, false);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    draw();
}
addEventListener("resize", resize);
scene.background = new Color(0x101114);
resize();
controls.update();
light(shownLight).catch(report);
