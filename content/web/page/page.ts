import {
    ACESFilmicToneMapping, Color, DirectionalLight, Group, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
    type Intersection, type Material, type Mesh, type Object3D, type Texture,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Rowland, type Panorama } from "@rowland/three";
import { builtInLight, keyLightsOf, LIGHT_NAMES, lightOf } from "./lights.js";
import { addressOf, SCENE_NAMES, settingsOf, type Settings } from "./address.js";
import { Frames } from "./frames.js";
import { PixelComparer } from "./pixel.js";
import { Programs } from "./programs.js";
import { ReferenceView } from "./reference_view.js";
import { Reflections } from "./reflections.js";
import { StudioPanel } from "./studio_panel.js";
import { numberAt, slidersOf, withNumber } from "./samples.js";
import { cabinet, films, foil, hasReference, materialsOf, Rest, samples, type Piece, type Stage } from "./stage.js";

const element = <Kind extends HTMLElement>(id: string) => document.getElementById(id) as Kind;
const message = element("message");
const report = (error: unknown): void => {
    message.textContent = (error as Error).message ?? String(error);
};
addEventListener("error", (event) => report(event.error ?? event.message));
addEventListener("unhandledrejection", (event) => report(event.reason));

// Workers start, and files come, while the graphics context is made.
const rowland = new Rowland();
rowland.onError = report;
const reflections = new Reflections();
let wanted: Settings = { scene: 0, light: 0 };
try {
    wanted = settingsOf(location.hash);
} catch (error) {
    report(error);
}
const loading = [cabinet, samples, foil, films][wanted.scene](rowland, wanted);

/** Without WebGL 2 a picture is shown, and what to do. */
function rendererOf(canvas: HTMLCanvasElement): WebGLRenderer {
    try {
        return new WebGLRenderer({ canvas, antialias: true });
    } catch (cause) {
        rowland.dispose();
        element("panel").inert = true;
        const alt = "A record, a CD, a DVD, a foil card, a grating rule and a beetle on an oak table, with the colours of their gratings";
        canvas.replaceWith(Object.assign(new Image(), { id: "view", src: "cabinet.webp", alt }));
        throw new Error("This browser has no WebGL 2, so this is a still picture: update the browser, or turn its hardware acceleration on.", { cause });
    }
}

const canvas = element<HTMLCanvasElement>("view");
const scene = new Scene();
const camera = new PerspectiveCamera(35, 1, 0.01, 40);
const renderer = rendererOf(canvas);
renderer.debug.checkShaderErrors = false; // asks the GPU's process, and waits
renderer.toneMapping = ACESFilmicToneMapping;
const controls = new OrbitControls(camera, canvas);
controls.maxPolarAngle = 0.49 * Math.PI;

/** Until it is loaded, nothing. */
let stage: Stage = { objects: new Group(), pieces: [], eye: new Vector3(0, 0.3, 0.5), target: new Vector3(), nearest: 0.1, farthest: 3 };
let loaded = false;
let environment: Texture | undefined;
const turns = new Map<Piece, number>();

const data = document.documentElement.dataset;
let frameCount = 0;
const litMaterials = () => stage.pieces.flatMap(materialsOf).filter(({ lit }) => lit).length;
const programs = new Programs(renderer, scene, camera);
const frames = new Frames(renderer, {
    prepare: () => programs.compile().catch(report),
    render() {
        renderer.render(scene, camera);
        if (referenceShown.checked) reference.draw();
        data.frames = String(++frameCount);
        data.lit = String(litMaterials());
        stage.studio?.updated();
        data.pose = JSON.stringify({ distance: controls.getDistance(), azimuth: controls.getAzimuthalAngle(), turns: stage.pieces.map((piece) => turns.get(piece) ?? 0) });
    },
    drawn() {
        mark("picture");
        if (Number(data.lit) > 0) mark("diffraction");
        rest();
    },
    changing: () => lightPending || stage.studio?.moving || down.size > 0 || (rowland.busy && !referenceShown.checked),
});
const redraw = () => loaded && environment && frames.ask();
/** When neither the GPU nor a worker has anything left: what the picture still lacks. */
function rest(): void {
    if (!loaded || !frames.idle) return;
    if (!rowland.busy) takeKeyLights();
    data.busy = String(rowland.busy || lightPending);
    frames.sharpen();
}
rowland.onIdle = rest;

/** Milliseconds since the navigation began: performance.getEntriesByType("mark"). */
const marked = new Set<string>();
function mark(name: string): void {
    if (!marked.has(name)) performance.mark(name);
    marked.add(name);
}

// The ground truth beside the picture begins again when that has changed.
const referenceShown = element<HTMLInputElement>("reference");
const reference = new ReferenceView(renderer, redraw);
let restarting = 0;
function draw(): void {
    redraw();
    reference.stop();
    clearTimeout(restarting);
    if (!referenceShown.checked || rowland.lightVersion === 0) return;
    restarting = window.setTimeout(() => reference.start(hitAt, camera), 400);
}
rowland.onUpdate = () => {
    programs.changed();
    draw();
};
controls.addEventListener("change", draw);

const lamp = new DirectionalLight(0xffffff, 0);
lamp.position.set(-0.4, 1, 0.5);
scene.add(lamp);

// The panel.
const sample = element<HTMLSelectElement>("sample");
const lights = element<HTMLSelectElement>("light");
const sliders = element("sliders");
let chosen = 0;
let panel: StudioPanel | undefined; // of the foil studio

const SAMPLES_SCENE = SCENE_NAMES.indexOf("samples");
const studioAddress = ({ settings }: StudioPanel) => addressOf({ scene: wanted.scene, light: lights.selectedIndex, ...settings });
/** Whoever opens the address sees the chosen sample. */
function writeAddress(): void {
    const piece = stage.pieces[chosen];
    if (panel) return history.replaceState(null, "", studioAddress(panel));
    const bent = wanted.scene === SAMPLES_SCENE && piece ? piece : undefined;
    const material = bent && bent.grating !== bent.given ? bent.grating : undefined;
    const representation = bent?.name === wanted.sample ? wanted.representation : undefined;
    history.replaceState(null, "", addressOf({ scene: wanted.scene, sample: bent?.name, light: lights.selectedIndex, representation, material }));
}

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
function rebake(piece: Piece): void {
    clearTimeout(waiting);
    // The worker bakes in turn; only the last of a drag's values is worth it.
    waiting = window.setTimeout(() => {
        message.textContent = "";
        for (const material of materialsOf(piece)) material.bake(rowland, piece.grating);
        writeAddress();
    }, 80);
}

function showSample(index: number): void {
    chosen = index;
    sample.selectedIndex = index;
    const piece = stage.pieces[index];
    sliders.replaceChildren(...slidersOf(piece.grating).map(({ label, path, from, to, step }) =>
        slider(label, from, to, step, numberAt(piece.grating, path)!, (value) => {
            piece.grating = withNumber(piece.grating, path, value);
            rebake(piece);
        })));
    const price = materialsOf(piece)[0].price;
    const lights = "film" in materialsOf(piece)[0] ? "3 for each of the lamp's highlights" : "39 for each bright light in reach";
    element("price").textContent = `Price: ${price.map} look-up${price.map === 1 ? "" : "s"} a pixel for the environment, ${lights}.`;
}
sample.addEventListener("change", () => {
    showSample(sample.selectedIndex);
    writeAddress();
});
const scenes = element<HTMLSelectElement>("scene");
scenes.append(...SCENE_NAMES.map((name) => new Option(name[0].toUpperCase() + name.slice(1))));
scenes.selectedIndex = wanted.scene;
scenes.addEventListener("change", () => {
    location.hash = addressOf({ scene: scenes.selectedIndex, light: lights.selectedIndex });
    location.reload();
});

function bind(id: string, change: (value: number) => void, update = draw): void {
    const input = element<HTMLInputElement>(id);
    const output = input.nextElementSibling as HTMLOutputElement;
    const show = () => {
        output.value = input.value;
        change(Number(input.value));
        update();
    };
    input.addEventListener("input", show);
    show();
}
bind("lamp", (value) => (lamp.intensity = value));
bind("exposure", (value) => (renderer.toneMappingExposure = 2 ** value));

// Both sides show the light that the grooves diffract of the panorama, and nothing else.
let others = new Rest(stage.objects);
referenceShown.addEventListener("change", () => {
    const on = referenceShown.checked;
    for (const material of stage.pieces.flatMap(materialsOf)) if ("diffractionOnly" in material) material.diffractionOnly = on;
    others.show(on);
    lamp.visible = !on;
    scene.background = on ? new Color(0) : environment ?? null;
    rowland.onUpdate();
});
bind("line", (value) => (reference.line = value), redraw);

// Light.
/** What the light still lacks: asked for when a picture shows the whole of it. */
let takeKeyLights = () => {};
let lightPending = true;
let lightsAsked = 0;
/** `keys`: the light's, if they are known. */
async function light(panorama: Panorama, keys?: Float32Array): Promise<void> {
    const number = ++lightsAsked;
    takeKeyLights = () => {};
    lightPending = true;
    data.busy = "true";
    const reflected = reflections.of(panorama);
    const baked = rowland.setProbe(panorama, { keyLights: "later" }); // takes the texels
    const next = await reflected;
    if (number !== lightsAsked) return;
    environment?.dispose();
    scene.environment = environment = next;
    if (!referenceShown.checked) scene.background = environment;
    scene.backgroundBlurriness = 0.3;
    rowland.onUpdate();
    await baked;
    takeKeyLights = () => {
        takeKeyLights = () => {};
        rowland.setKeyLights(keys ?? 16).catch(report).finally(() => {
            lightPending = false;
            rest();
        });
    };
    rest();
}
const showBuiltIn = (index: number) => light(builtInLight(LIGHT_NAMES[index]), keyLightsOf(LIGHT_NAMES[index]));

lights.append(...LIGHT_NAMES.map((name) => new Option(name)));
lights.selectedIndex = wanted.light;
lights.addEventListener("change", () => {
    message.textContent = "";
    showBuiltIn(lights.selectedIndex).catch(report);
    writeAddress();
});

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
    event.preventDefault();
    give(event.dataTransfer?.files[0]);
});
const panorama = element<HTMLInputElement>("panorama");
panorama.addEventListener("change", () => give(panorama.files?.[0]));
function give(file?: File): void {
    if (!file) return;
    message.textContent = "";
    if (panel && !/\.(hdr|exr)$/i.test(file.name)) return void panel.take(file).catch(report);
    lightOf(file).then((texels) => light(texels)).catch(report);
}

const ray = new Raycaster();
/** What the point (x, y) of the picture shows, in pixels from the left and from below. */
function seenAt(x: number, y: number): Intersection<Mesh> | undefined {
    ray.setFromCamera(new Vector2((2 * x) / canvas.width - 1, (2 * y) / canvas.height - 1), camera);
    const hits = ray.intersectObject(stage.objects) as Intersection<Mesh>[];
    return hits.find(({ object }) => !(object.material as Material).transparent);
}
/** The same where the ground truth can be had. */
function hitAt(x: number, y: number): Intersection<Mesh> | undefined {
    const hit = seenAt(x, y);
    return hit && hasReference(hit.object) ? hit : undefined;
}
function pieceOf(object: Object3D | null): Piece | undefined {
    if (!object) return undefined;
    return stage.pieces.find(({ handle }) => handle === object) ?? pieceOf(object.parent);
}
/** The pixel at a pointer, and what its middle shows. */
function under(event: PointerEvent) {
    const box = canvas.getBoundingClientRect();
    return pixelAt((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
}
/** From 0 to 1 from the left and from above. */
function pixelAt(right: number, down: number) {
    const [x, y] = [Math.floor(right * canvas.width), Math.floor(down * canvas.height)];
    return { x, y, hit: seenAt(x + 0.5, canvas.height - y - 0.5) };
}
/** A pixel that shows the chosen sample, if one of a few of its vertices does. */
function chosenPixel() {
    const mesh = stage.pieces[chosen].meshes[0];
    const vertices = mesh.geometry.getAttribute("position");
    let pixel = pixelAt(0.5, 0.5);
    for (let part = 0.05; part < 1; part += 0.1) {
        const at = new Vector3().fromBufferAttribute(vertices, Math.floor(part * vertices.count)).applyMatrix4(mesh.matrixWorld).project(camera);
        pixel = pixelAt((at.x + 1) / 2, (1 - at.y) / 2);
        if (pixel.hit && stage.pieces[chosen].meshes.includes(pixel.hit.object as never)) break;
    }
    return pixel;
}

// The error of the pixel that the pointer rests on.
const comparer = new PixelComparer(renderer, scene, camera, lamp);
let resting = 0;
let compared = 0;
function compareAfter(pixel: () => { x: number; y: number; hit?: Intersection<Mesh> }, milliseconds: number): void {
    clearTimeout(resting);
    resting = window.setTimeout(async () => {
        const { x, y, hit } = pixel();
        if (!hit || !("grating" in hit.object.material) || rowland.lightVersion === 0) return;
        if (!hasReference(hit.object)) {
            element("pixel").textContent = "No error of this pixel: its grooves are a texture's, and vary within it.";
            return;
        }
        const number = ++compared;
        const { shown, reference, error } = await comparer.compare(hit, x, y);
        if (number !== compared) return;
        const text = (rgb: number[]) => rgb.map((value) => value.toPrecision(3)).join(", ");
        element("pixel").textContent = `Diffracted light of this pixel: ${text(shown)} (red, green, blue). The sum over wavelengths and ` +
            `the panorama: ${text(reference)}. Difference: ${(100 * error).toPrecision(2)} %.`;
    }, milliseconds);
}

// Turning a sample by hand, or zooming with a second finger.
let held: Piece | undefined;
function turn(piece: Piece, angle: number): void {
    piece.handle.rotateY(angle);
    turns.set(piece, (turns.get(piece) ?? 0) + angle);
}
const down = new Set<number>();
const fingers = new Map<number, PointerEvent>(); // of the held sample
const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
};
canvas.addEventListener("pointerdown", (event) => {
    if (down.size === 0 && !stage.studio) held = pieceOf(under(event).hit?.object ?? null);
    down.add(event.pointerId);
    if (!held) return; // the controls' own
    if (fingers.size === 0) showSample(stage.pieces.indexOf(held));
    controls.enabled = false;
    fingers.set(event.pointerId, event);
    canvas.setPointerCapture(event.pointerId);
}, { capture: true });
canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (event.buttons === 0) compareAfter(() => under(event), 400);
    else clearTimeout(resting);
    if (!held || !before) return;
    if (fingers.size === 1) {
        turn(held, 0.01 * (event.clientX - before.clientX));
        fingers.set(event.pointerId, event);
    } else {
        const old = spread();
        fingers.set(event.pointerId, event);
        if (fingers.size === 2) zoom(old / Math.max(spread(), 1));
    }
    controls.update();
    draw();
});
const release = (event: PointerEvent) => {
    down.delete(event.pointerId);
    fingers.delete(event.pointerId);
    if (down.size > 0) return;
    referenceShown.checked ? draw() : frames.sharpen();
    if (event.pointerType === "touch" && held) compareAfter(() => under(event), 0);
    held = undefined;
    controls.enabled = true;
};
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);

const KEYS: Record<string, () => unknown> = {
    ArrowLeft: () => orbit(-0.06, 0),
    ArrowRight: () => orbit(0.06, 0),
    ArrowUp: () => orbit(0, -0.06),
    ArrowDown: () => orbit(0, 0.06),
    "+": () => zoom(0.9),
    "=": () => zoom(0.9),
    "-": () => zoom(1 / 0.9),
    q: () => stage.pieces[chosen] && turn(stage.pieces[chosen], -0.05),
    Enter: () => stage.pieces[chosen] && compareAfter(chosenPixel, 0),
    e: () => stage.pieces[chosen] && turn(stage.pieces[chosen], 0.05),
};
function orbit(around: number, down: number): void {
    if (stage.studio) return stage.studio.tilt(down, around);
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

// A lost context comes back empty; three uploads its textures again.
canvas.addEventListener("webglcontextlost", () => (message.textContent = "The graphics context was lost; waiting for it to come back."));
canvas.addEventListener("webglcontextrestored", () => {
    message.textContent = "";
    rowland.onUpdate();
});

function resize(): void {
    const { clientWidth, clientHeight } = canvas;
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / clientHeight;
    // On a narrow screen as much from left to right as on one of 4 : 3, or as a card is wide.
    const shape = stage.studio ? 0.75 : 4 / 3;
    camera.fov = (360 / Math.PI) * Math.atan(Math.tan((17.5 * Math.PI) / 180) * Math.max(1, shape / camera.aspect));
    camera.updateProjectionMatrix();
    draw();
}
addEventListener("resize", resize);
scene.background = new Color(0x101114);
resize();
mark("script");
showBuiltIn(wanted.light).catch(report);
stage = await loading;
loaded = true;
mark("model");
scene.add(stage.objects);
others = new Rest(stage.objects);
camera.position.copy(stage.eye);
controls.target.copy(stage.target);
controls.minDistance = stage.nearest;
controls.maxDistance = stage.farthest;
controls.update();
if (stage.studio) {
    controls.enableRotate = controls.enablePan = false;
    scene.backgroundIntensity = 0.2;
    resize();
    canvas.setAttribute("aria-label", "A foil card. Arrow keys tilt it, plus and minus zoom.");
    stage.studio.open(canvas, draw);
    panel = new StudioPanel(element("studio"), stage.studio,
        { report, clear: () => (message.textContent = ""), changed: writeAddress, address: () => studioAddress(panel!) });
    panel.open(wanted.foil, wanted.art).catch(report);
} else {
    sample.append(...stage.pieces.map(({ name }) => new Option(name)));
    const named = stage.pieces.findIndex(({ name }) => name === wanted.sample);
    if (wanted.sample !== undefined && named < 0)
        report(new Error(`the address: expected sample to be one of ${stage.pieces.map(({ name }) => name).join(", ")}, found "${wanted.sample}"`));
    showSample(Math.max(named, 0));
}
rowland.onUpdate();
