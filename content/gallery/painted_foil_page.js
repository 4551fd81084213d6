// Cards under six shaders: five that paint rainbows, and the foil of @rowland/three. All have the same lights, artwork,
// mask (the metalness of the card's texture) and tone mapping.
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import { GratingExtension, Rowland } from "/dist/index.js";

const RAINBOW = `
vec3 rainbow(float turns) {
    return 0.5 + 0.5 * cos(6.2832 * (turns + vec3(0.0, 0.33, 0.67)));
}`;
const FACETS = RAINBOW + `
vec3 random(vec2 cell) {
    return fract(sin(vec3(dot(cell, vec2(127.1, 311.7)), dot(cell, vec2(269.5, 183.3)), dot(cell, vec2(419.2, 371.9)))) * 43758.5453);
}
vec3 nearest_cell(vec2 at) {
    vec3 found = vec3(0.0);
    float least = 9.0;
    for (int i = 0; i < 9; ++i) {
        vec2 cell = floor(at) + vec2(i % 3 - 1, i / 3 - 1);
        vec3 value = random(cell);
        float far = distance(at, cell + value.xy);
        if (far < least) { least = far; found = value; }
    }
    return found;
}`;

/** How each paints: functions, and code after chunks of three's fragment shader. */
const PAINTED = {
    "rainbow by view angle": { functions: RAINBOW, after: { normal_fragment_maps: `
float facing = dot(normal, normalize(vViewPosition));
diffuseColor.rgb *= mix(vec3(1.0), 1.3 * rainbow(8.0 * facing), metalnessFactor);` } },
    "gradient by place and tilt": { functions: RAINBOW, after: { aomap_fragment: `
float band = 3.0 * vMapUv.y + 0.8 * vMapUv.x - 2.0 * normal.y - 2.0 * normal.x;
vec3 dodge = 0.8 * rainbow(band) * (0.75 + 0.25 * cos(40.0 * (vMapUv.x + vMapUv.y)));
vec3 lit_in_total = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
reflectedLight.indirectSpecular += metalnessFactor * lit_in_total * dodge / (1.0 - dodge);` } },
    "matcap of rainbows": { functions: RAINBOW, after: { aomap_fragment: `
vec3 mirrored = reflect(-normalize(vViewPosition), normal);
vec2 matcap = 0.5 + mirrored.xy / (2.0 * length(mirrored + vec3(0.0, 0.0, 1.0)));
vec3 sphere = rainbow(3.0 * matcap.y + matcap.x) * smoothstep(0.9, 0.1, distance(matcap, vec2(0.45, 0.6)));
reflectedLight.directSpecular *= 1.0 - 0.7 * metalnessFactor;
reflectedLight.indirectSpecular *= 1.0 - 0.7 * metalnessFactor;
totalEmissiveRadiance += 0.7 * metalnessFactor * diffuseColor.rgb * sphere;` } },
    "three's iridescence": { physical: { iridescence: 1, iridescenceIOR: 1.6 }, functions: "", after: { lights_physical_fragment: `
material.iridescence = metalnessFactor;
material.iridescenceThickness = 250.0 + 500.0 * vMapUv.y;` } },
    "random facets": { functions: FACETS, after: { normal_fragment_maps: `
vec3 facet = nearest_cell(vec2(14.0, 20.0) * vMapUv);
normal = normalize(normal + metalnessFactor * vec3(0.5 * (facet.xy - 0.5), 0.0));
roughnessFactor = mix(roughnessFactor, 0.3, metalnessFactor);
diffuseColor.rgb *= mix(vec3(1.0), 1.3 * rainbow(facet.z), metalnessFactor);` } },
};
const MASK = { functions: "", after: { opaque_fragment: "gl_FragColor = vec4(vec3(metalnessFactor), 1.0);" } };
const OURS = "@rowland/three";

const [CELL_WIDTH, CELL_HEIGHT, LABELS, HEAD, GAP] = [176, 240, 112, 52, 10]; // pixels of the sheet
const TILTS = [-15, 0, 15]; // degrees about the horizontal axis; of negative ones the top leans back

const radians = THREE.MathUtils.degToRad;
const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(CELL_WIDTH, CELL_HEIGHT, false);
renderer.toneMapping = THREE.ACESFilmicToneMapping;
const target = new THREE.WebGLRenderTarget(CELL_WIDTH, CELL_HEIGHT, { type: THREE.FloatType });
const rowland = new Rowland();
const failures = [];
rowland.onError = (error) => failures.push(error.message);

const camera = new THREE.PerspectiveCamera(15.9, CELL_WIDTH / CELL_HEIGHT, 0.1, 1); // the height of a card and 1 cm at 35 cm
camera.position.z = 0.35;
const scene = new THREE.Scene();
scene.background = new THREE.Color(0.012, 0.012, 0.014);
const lamp = new THREE.DirectionalLight(0xffffff);
const tilted = new THREE.Group();
scene.add(lamp, tilted);

/** Equirectangular, from the radiance of a direction. */
function panorama(radiance, width = 512) {
    const texels = new Float32Array(2 * width * width).fill(1);
    for (let i = 0; i < texels.length / 4; ++i) {
        const [around, up] = [2 * Math.PI * ((i % width) + 0.5) / width, Math.PI * ((Math.floor(i / width) + 0.5) / (width / 2) - 0.5)];
        texels.set(radiance(Math.cos(up) * Math.cos(around), Math.sin(up), Math.cos(up) * Math.sin(around)), 4 * i);
    }
    const texture = new THREE.DataTexture(texels, width, width / 2, THREE.RGBAFormat, THREE.FloatType);
    return Object.assign(texture, { mapping: THREE.EquirectangularReflectionMapping, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, needsUpdate: true });
}

/** An angular map's, about −z, each texel the mean of 5 × 5. */
async function captured(url) {
    const { image: { data, width, height } } = await new HDRLoader().setDataType(THREE.FloatType).loadAsync(url);
    if (width !== height) throw new Error(`${url}: ${width} × ${height} pixels; expected an angular map, which is square`);
    return panorama((x, y, z) => {
        const scale = Math.acos(-z) / Math.PI / Math.max(Math.hypot(x, y), 1e-9);
        const [column, row] = [x, -y].map((along) => Math.round((0.5 + 0.5 * along * scale) * width - 0.5));
        const mean = [0, 0, 0];
        for (let i = 0; i < 25; ++i) {
            const [at, line] = [column + (i % 5) - 2, row + Math.floor(i / 5) - 2].map((k) => Math.min(Math.max(k, 0), width - 1));
            for (let c = 0; c < 3; ++c) mean[c] += data[4 * (line * width + at) + c] / 25;
        }
        return mean;
    });
}

async function light(environment, strength, exposure, elevation = 40) {
    scene.environment = environment;
    lamp.intensity = strength;
    lamp.position.set(0, Math.sin(radians(elevation)), Math.cos(radians(elevation)));
    renderer.toneMappingExposure = exposure;
    await rowland.setProbe(environment);
}

function painted(card, { physical, functions, after }) {
    const { map, metalnessMap, roughnessMap, color, metalness, roughness } = card;
    const Material = physical ? THREE.MeshPhysicalMaterial : THREE.MeshStandardMaterial;
    const material = new Material({ map, metalnessMap, roughnessMap, color, metalness, roughness, ...physical });
    material.onBeforeCompile = (shader) => {
        shader.fragmentShader = shader.fragmentShader.replace("void main() {", `${functions}\n$&`);
        for (const [chunk, code] of Object.entries(after)) shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, `$&\n${code}`);
    };
    material.customProgramCacheKey = () => JSON.stringify(after);
    return material;
}

/** A card's front, and its material of each row. */
async function opened(name) {
    const { scene: object } = await new GLTFLoader().register((parser) => new GratingExtension(parser, rowland)).loadAsync(`/${name}.glb`);
    let front;
    object.traverse((mesh) => (front = mesh.material?.isGratingMaterial ? mesh : front));
    await front.material.ready;
    const materials = Object.entries(PAINTED).map(([title, paint]) => [title, painted(front.material, paint)]);
    return { object, front, mask: painted(front.material, MASK), materials: new Map([...materials, [OURS, front.material]]) };
}

/** Draws until the foil's map is that of the light and the tilt. */
async function draw({ object, front }, material, tilt = 0) {
    tilted.clear().add(object);
    tilted.rotation.x = radians(tilt);
    front.material = material;
    renderer.setScissor(0, 0, 1, 1); // what waits for its map
    for (let before = null; material.isGratingMaterial; await before) {
        renderer.setScissorTest(true);
        renderer.render(scene, camera);
        renderer.setScissorTest(false);
        if (material.settled === before) break;
        before = material.settled;
    }
    renderer.render(scene, camera);
}

/** Linear radiance, RGB, of each pixel. */
async function pixels(card, material) {
    await draw(card, material);
    const found = new Float32Array(4 * CELL_WIDTH * CELL_HEIGHT);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, CELL_WIDTH, CELL_HEIGHT, found);
    renderer.setRenderTarget(null);
    return Array.from({ length: found.length / 4 }, (_, i) => [...found.subarray(4 * i, 4 * i + 3)]);
}

function sheet(title, cards) {
    const width = LABELS + cards.length * (TILTS.length * CELL_WIDTH + GAP);
    const canvas = Object.assign(document.createElement("canvas"), { width, height: HEAD + (Object.keys(PAINTED).length + 1) * CELL_HEIGHT });
    const context = canvas.getContext("2d");
    context.fillStyle = "#15151a";
    context.fillRect(0, 0, width, canvas.height);
    const label = (text, x, y, size, align) => {
        context.fillStyle = "#e8e8ea";
        context.font = `${size}px sans-serif`;
        context.textAlign = align;
        context.fillText(text, x, y);
    };
    label(title, 8, 20, 15, "left");
    return { canvas, context, label };
}

const left = (card, tilt) => LABELS + card * (TILTS.length * CELL_WIDTH + GAP) + tilt * CELL_WIDTH;

async function takeSheet(title, cards, names) {
    const { canvas, context, label } = sheet(title, cards);
    for (const [c, card] of cards.entries()) {
        for (const [t, tilt] of TILTS.entries()) label(`${names[c]}, ${tilt > 0 ? "+" : ""}${String(tilt).replace("-", "−")}°`, left(c, t) + CELL_WIDTH / 2, 44, 14, "center");
        for (const [row, [name, material]] of [...card.materials].entries()) {
            const words = name.split(" ");
            if (c === 0) words.forEach((word, i) => label(word, 8, HEAD + (row + 0.5) * CELL_HEIGHT + 18 * (i - words.length / 2 + 0.8), name === OURS ? 13 : 15, "left"));
            for (const [t, tilt] of TILTS.entries()) {
                await draw(card, material, tilt);
                context.imageSmoothingQuality = "high";
                context.drawImage(renderer.domElement, left(c, t), HEAD + row * CELL_HEIGHT, CELL_WIDTH, CELL_HEIGHT);
            }
        }
    }
    return canvas;
}

/** A data: address of a JPEG of at most this many bytes. */
function jpeg(canvas, most = 350_000) {
    for (let quality = 0.92; ; quality -= 0.03) {
        const url = canvas.toDataURL("image/jpeg", quality);
        if (0.75 * url.length < most) return url;
    }
}

const part = (list, test) => `${Math.round((100 * list.filter(test).length) / list.length)} %`;
const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
const luminance = ([red, green, blue]) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;
const hue = (rgb) => rgb.map((x) => x / Math.max(rgb[0] + rgb[1] + rgb[2], 1e-9));
const apart = (a, b) => Math.max(...a.map((x, c) => Math.abs(x - b[c])));

/** Of the foil's pixels, under a shader: what moves with the lamp, and what a white room shows. */
function facts(foil, title, { high, low, white }) {
    const pairs = foil.map((i) => [high[i], low[i]]);
    const room = foil.map((i) => white[i]);
    return [title, part(pairs, ([a, b]) => apart(a, b) > 0.1 * Math.max(...a, ...b)), part(pairs, ([a, b]) => apart(hue(a), hue(b)) > 0.1),
        mean(room.map(luminance)).toFixed(2), mean(room.map((rgb) => (Math.max(...rgb) - Math.min(...rgb)) / Math.max(...rgb, 1e-9))).toFixed(2)];
}

async function measured(cards, dim) {
    const found = new Map([...cards[0].materials.keys()].map((title) => [title, { high: [], low: [], white: [] }]));
    const foil = [];
    const each = async (key) => {
        for (const card of cards) for (const [title, material] of card.materials) found.get(title)[key].push(...(await pixels(card, material)));
    };
    for (const card of cards) for (const [red] of await pixels(card, card.mask)) foil.push(red);
    await light(dim, 3, 1, 40);
    await each("high");
    await light(dim, 3, 1, 20);
    await each("low");
    await light(panorama(() => [1, 1, 1], 64), 0, 1);
    await each("white");
    const where = foil.flatMap((mask, i) => (mask > 0.9 ? [i] : []));
    return [...found].map(([title, pictures]) => facts(where, title, pictures));
}

async function run({ cards: names }) {
    const cards = [];
    for (const name of names) cards.push(await opened(name));
    const dim = panorama((x, y) => Array(3).fill(0.06 + 0.04 * y));
    await light(await captured("/probe.hdr"), 0, 1);
    const grace = await takeSheet("Grace Cathedral", cards, names);
    await light(dim, 3, 1);
    const lampSheet = await takeSheet("A lamp 40° above the eye", cards, names);
    const rows = await measured(cards, dim);
    return { sheets: { grace: jpeg(grace), lamp: jpeg(lampSheet) }, rows, error: failures[0] };
}

const task = await (await fetch("/task")).json();
const result = await run(task).catch((error) => ({ error: error.stack }));
await fetch("/result", { method: "POST", body: JSON.stringify(result) });
