// A glTF with a tilted disc, a curved strip, a foil with a groove texture, a ball of film and a lamp, drawn by Babylon and by three. Kinds of pictures: "diffracted", which is
// the light that the grooves diffract alone, and "whole".
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { ImportMeshAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { HDRCubeTexture } from "@babylonjs/core/Materials/Textures/hdrCubeTexture.js";
import { Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/loaders/glTF/2.0/glTFLoader.js";
import "@babylonjs/loaders/glTF/2.0/Extensions/KHR_lights_punctual.js";
import * as THREE from "../../three/node_modules/three/build/three.module.js";
import { GLTFLoader } from "../../three/node_modules/three/examples/jsm/loaders/GLTFLoader.js";
import { FilmExtension, GratingExtension } from "../../three/dist/index.js";
import { registerFilms, registerGratings } from "../dist/index.js";

const [WIDTH, HEIGHT] = [160, 90];
const EYE = [0.06, 0.16, 0.3];
const FIELD = 28; // degrees
const NAME = "ROWLAND_materials_diffraction";

export const CD = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 90 } }, metal: "Al", cover: { ior: 1.58 } };
export const STRIP = { grating: { pitch_nm: 1100, profile: { type: "sinusoidal", depth_nm: 180 }, orders: [-1, 1] }, grooveRotation: 0.4 };

const FOIL = { grating: { pitch_nm: 1100, profile: { type: "sinusoidal", depth_nm: 180 }, orders: [-1, 1] }, cover: { ior: 1.5 }, grooveTexture: { index: 0 } };
/** Steps of the rotation, of which some have no grooves. */
function foilImage() {
    const canvas = Object.assign(document.createElement("canvas"), { width: 16, height: 8 });
    const context = canvas.getContext("2d");
    for (let i = 0; i < 128; ++i) {
        context.fillStyle = `rgb(${(53 * i) % 255}, ${i % 9 === 0 ? 0 : 128}, 0)`;
        context.fillRect(i % 16, Math.floor(i / 16), 1, 1);
    }
    return canvas.toDataURL("image/png");
}
/** Of a glTF's material, and what its film is. */
const FILM = { iridescenceFactor: 1, iridescenceIor: 1.4, iridescenceThicknessMinimum: 200, iridescenceThicknessMaximum: 600,
    iridescenceThicknessTexture: { index: 0 }, extras: { base: { ior: 1 } } };

/** A grid of points, `at(s, t)`: position, normal and, if there are any, tangent. */
export function grid(columns, rows, at) {
    const data = { POSITION: [], NORMAL: [], TANGENT: [], TEXCOORD_0: [], indices: [] };
    for (let j = 0; j <= rows; ++j)
        for (let i = 0; i <= columns; ++i) {
            const [position, normal, tangent = []] = at(i / columns, j / rows);
            data.POSITION.push(...position);
            data.NORMAL.push(...normal);
            data.TANGENT.push(...tangent);
            data.TEXCOORD_0.push(i / columns, j / rows);
            const a = j * (columns + 1) + i;
            if (i < columns && j < rows) data.indices.push(a, a + 1, a + columns + 2, a, a + columns + 2, a + columns + 1);
        }
    return data;
}

const angle = (s) => 2 * Math.PI * s;
export const disc = grid(64, 1, (s, t) => {
    const r = 0.02 + 0.04 * (1 - t);
    return [[r * Math.cos(angle(s)), r * Math.sin(angle(s)), 0], [0, 0, 1]];
});
export const strip = grid(8, 24, (s, t) => {
    const a = 2.4 * (t - 0.5);
    return [[0.06 * (s - 0.5), 0.05 * Math.cos(a) - 0.05, -0.05 * Math.sin(a)], [0, Math.cos(a), -Math.sin(a)], [1, 0, 0, 1]];
});

function gltf() {
    const foil = grid(1, 1, (s, t) => [[0.08 * (s - 0.5), 0.05 * (t - 0.5), 0], [0, 0, 1], [1, 0, 0, 1]]);
    const ball = grid(32, 16, (s, t) => {
        const normal = [Math.sin(Math.PI * t) * Math.cos(angle(s)), Math.cos(Math.PI * t), Math.sin(Math.PI * t) * Math.sin(angle(s))];
        return [normal.map((x) => 0.02 * x), normal];
    });
    const [accessors, views, bytes] = [[], [], []];
    const put = (values, type, componentType, array) => {
        const size = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 }[type];
        views.push({ buffer: 0, byteOffset: bytes.length, byteLength: array.byteLength });
        bytes.push(...new Uint8Array(array.buffer));
        while (bytes.length % 4) bytes.push(0);
        const column = (i) => values.filter((_, at) => at % size === i);
        const bounds = size === 3 ? { min: [0, 1, 2].map((i) => Math.min(...column(i))), max: [0, 1, 2].map((i) => Math.max(...column(i))) } : {};
        return accessors.push({ bufferView: views.length - 1, componentType, count: values.length / size, type, ...bounds }) - 1;
    };
    const meshOf = ({ indices, TANGENT, ...both }, material) => ({ primitives: [{
        attributes: Object.fromEntries(Object.entries(TANGENT.length ? { ...both, TANGENT } : both).map(([name, values]) =>
            [name, put(values, { TANGENT: "VEC4", TEXCOORD_0: "VEC2" }[name] ?? "VEC3", 5126, Float32Array.from(values))])),
        indices: put(indices, "SCALAR", 5123, Uint16Array.from(indices)), material,
    }] });
    const meshes = [disc, strip, foil, ball].map(meshOf);
    const materials = [CD, STRIP, FOIL].map((grating) => ({ doubleSided: true, extensions: { [NAME]: grating },
        pbrMetallicRoughness: { baseColorFactor: [0.02, 0.02, 0.02, 1], metallicFactor: 0, roughnessFactor: 0.3 } }));
    materials.push({ extensions: { KHR_materials_iridescence: FILM }, pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1], roughnessFactor: 0 } });
    const lights = [{ type: "point", color: [1, 0.9, 0.7], intensity: 0.4 }];
    return JSON.stringify({
        asset: { version: "2.0" }, extensionsUsed: [NAME, "KHR_lights_punctual", "KHR_materials_iridescence"], extensions: { KHR_lights_punctual: { lights } },
        scene: 0, scenes: [{ nodes: [0, 1, 2, 3, 4] }], textures: [{ source: 0 }], images: [{ uri: foilImage() }],
        nodes: [{ mesh: 0, translation: [-0.045, 0, 0], rotation: [-0.5, 0.1, 0.05, 0.8587782] }, { mesh: 1, translation: [0.06, 0.01, 0] },
            { mesh: 2, translation: [0.03, -0.045, 0.06], rotation: [-0.3, 0, 0, 0.9539392] }, { mesh: 3, translation: [0.01, 0.04, -0.02] },
            { translation: [0.3, 0.5, 0.2], extensions: { KHR_lights_punctual: { light: 0 } } }],
        meshes, materials, accessors, bufferViews: views,
        buffers: [{ byteLength: bytes.length, uri: "data:application/octet-stream;base64," + btoa(String.fromCharCode(...bytes)) }],
    });
}

const canvasOf = () => Object.assign(document.createElement("canvas"), { width: WIDTH, height: HEIGHT });

async function idle(rowland) {
    while (rowland.busy) await new Promise((resolve) => (rowland.onIdle = resolve));
}

export async function byBabylon(rowland, panorama, kinds) {
    const canvas = canvasOf();
    const engine = new Engine(canvas, false, { preserveDrawingBuffer: true, useExactSrgbConversions: true });
    engine.getCaps().parallelShaderCompile = undefined; // else Babylon draws with the program before while it compiles
    const scene = new Scene(engine);
    scene.clearColor = new Color4(0, 0, 0, 1);
    const [x, y, z] = EYE;
    const camera = new FreeCamera("eye", new Vector3(-x, y, z), scene); // the loader mirrors x for a left-handed scene
    camera.setTarget(Vector3.Zero());
    Object.assign(camera, { fov: (FIELD * Math.PI) / 180, minZ: 0.01 });
    scene.environmentTexture = new HDRCubeTexture(panorama, scene, 64);
    scene.environmentTexture.rotationY = Math.PI / 2; // toward the glTF as three has it
    registerGratings(rowland);
    registerFilms(rowland);
    await ImportMeshAsync("data:" + gltf(), scene, { pluginExtension: ".gltf" });
    const pictures = {};
    const draw = async () => {
        scene.incrementRenderId();
        await scene.whenReadyAsync();
        scene.render();
    };
    for (const kind of kinds) {
        for (const mesh of scene.meshes) {
            const grating = mesh.material?.pluginManager?.getPlugin("Rowland");
            if (grating) grating.state.diffractionOnly = kind === "diffracted";
            else if (mesh.material) mesh.isVisible = kind === "whole";
        }
        await draw();
        await idle(rowland);
        await draw();
        pictures[kind] = canvas.toDataURL("image/png");
    }
    const [film] = scene.materials.filter(({ pluginManager }) => pluginManager?.getPlugin("RowlandFilm"));
    const { minimumThickness, maximumThickness, indexOfRefraction, thicknessTexture } = film.iridescence;
    const { tableError } = film.pluginManager.getPlugin("RowlandFilm");
    return { pictures, canvas, film: { minimumThickness, maximumThickness, indexOfRefraction, tableError,
        sRgb: thicknessTexture.getInternalTexture()._useSRGBBuffer } };
}

export async function byThree(rowland, panorama, kinds) {
    const canvas = canvasOf();
    const renderer = new THREE.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    renderer.setSize(WIDTH, HEIGHT, false);
    const camera = new THREE.PerspectiveCamera(FIELD, WIDTH / HEIGHT, 0.01, 10);
    camera.position.set(...EYE);
    camera.lookAt(0, 0, 0);
    const loader = new GLTFLoader().register((parser) => new GratingExtension(parser, rowland))
        .register((parser) => new FilmExtension(parser, rowland));
    const scene = new THREE.Scene().add((await loader.parseAsync(gltf(), "")).scene);
    const { texels, width, height } = panorama;
    const image = new THREE.DataTexture(new Float32Array(4 * width * height), width, height, THREE.RGBAFormat, THREE.FloatType);
    for (let i = 0; i < width * height; ++i) image.image.data.set(texels.subarray(3 * i, 3 * i + 3), 4 * i);
    image.flipY = image.needsUpdate = true;
    scene.environment = Object.assign(image, { mapping: THREE.EquirectangularReflectionMapping, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter });
    const pictures = {};
    for (const kind of kinds) {
        scene.traverse((object) => {
            const { material } = object;
            if (material?.isGratingMaterial) material.diffractionOnly = kind === "diffracted";
            else if (material) object.visible = kind === "whole";
        });
        renderer.render(scene, camera);
        await idle(rowland);
        renderer.render(scene, camera);
        pictures[kind] = canvas.toDataURL("image/png");
    }
    return { pictures, canvas };
}
