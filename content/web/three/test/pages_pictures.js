// Cameras, targets, passes and lights of one grating on a plate.
import * as THREE from "three";
import { EffectComposer } from "three/examples/jsm/postprocessing/EffectComposer.js";
import { OutputPass } from "three/examples/jsm/postprocessing/OutputPass.js";
import { RenderPass } from "three/examples/jsm/postprocessing/RenderPass.js";
import { SIZE, compare, eye, grating, lamp, mapped, picture, plate, renderer, sceneOf, shown, told } from "./pages_stage.js";

const direct = (parameters) => grating({ ...parameters, representation: "direct" }); // without maps, which take their time
let material;
const mesh = (own = material) => new THREE.Mesh(plate(1.6, 1.6), own);
const facing = () => {
    const camera = eye();
    camera.position.set(0, 0, 2);
    camera.lookAt(0, 0, 0);
    return camera;
};

let first; // the picture that most others differ from in one thing

/** To be called when another renderer draws. */
export function beginPictures() {
    material = direct();
    first = undefined;
}
const plain = async () => (first ??= await picture(sceneOf(lamp(), mesh()), facing()));
const row = (found, expected, skip) => ({ ...compare(found, expected, skip), found, expected });

/** Pictures of the same scene by a renderer with these settings, beside which the first goes on drawing. */
async function byAnother(settings) {
    const expected = await plain();
    const other = new THREE.WebGLRenderer(settings);
    try {
        const found = await picture(sceneOf(lamp(), mesh()), facing(), { by: other });
        const again = await picture(sceneOf(lamp(), mesh()), facing());
        return { ...row(found, expected), again: compare(again, expected).difference };
    } finally {
        other.dispose();
    }
}

/** What three's own tone mapping makes of a linear picture. */
async function mappedByThree(pixels, toneMapping) {
    const map = new THREE.DataTexture(pixels, SIZE, SIZE, THREE.RGBAFormat, THREE.FloatType);
    map.needsUpdate = true;
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.MeshBasicMaterial({ map }));
    renderer.toneMapping = toneMapping;
    const bytes = await shown(sceneOf(quad), new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1));
    map.dispose();
    return bytes;
}

export const pictures = {
    "an orthographic camera": async () => {
        const scene = sceneOf(lamp(), new THREE.Mesh(new THREE.RingGeometry(0.15, 0.9, 32, 2), material));
        const near = new THREE.OrthographicCamera(-0.7, 0.7, 0.7, -0.7, 0.1, 5000);
        const far = new THREE.PerspectiveCamera((180 / Math.PI) * 2 * Math.atan(0.7 / 2000), 1, 1, 5000);
        near.position.set(0.3, 0.4, 2).setLength(2000);
        far.position.copy(near.position);
        for (const camera of [near, far]) camera.lookAt(0, 0, 0);
        near.position.setLength(3);
        return row(await picture(scene, near), await picture(scene, far), (x, y) => Math.min(x, y, SIZE - 1 - x, SIZE - 1 - y) < 1);
    },
    "two eyes of an ArrayCamera": async () => {
        const eyes = [-0.5, 0.5].map((x, i) => {
            const camera = new THREE.PerspectiveCamera(50, 0.5, 0.1, 100);
            camera.position.set(x, 0.2, 2);
            camera.lookAt(0, 0, 0);
            camera.updateMatrixWorld();
            camera.viewport = new THREE.Vector4((i * SIZE) / 2, 0, SIZE / 2, SIZE);
            return camera;
        });
        const array = new THREE.ArrayCamera(eyes);
        array.copy(eyes[0], false);
        array.updateMatrixWorld();
        const scene = sceneOf(lamp(), mesh());
        const found = await picture(scene, array);
        const half = new THREE.WebGLRenderTarget(SIZE / 2, SIZE, { type: THREE.FloatType });
        const halves = [await picture(scene, eyes[0], { to: half }), await picture(scene, eyes[1], { to: half })];
        half.dispose();
        const expected = mapped(found, (_, c, x, y) => halves[Math.floor((2 * x) / SIZE)][4 * (y * (SIZE / 2) + (x % (SIZE / 2))) + c]);
        return row(found, expected);
    },
    "a CubeCamera": async () => {
        const scene = sceneOf(lamp(), mesh());
        const cube = new THREE.WebGLCubeRenderTarget(SIZE, { type: THREE.FloatType, generateMipmaps: false });
        const camera = new THREE.CubeCamera(0.1, 10, cube);
        camera.position.set(0.1, 0.1, 0.9);
        scene.add(camera);
        await picture(scene, facing());
        camera.update(renderer, scene);
        const found = new Float32Array(4 * SIZE * SIZE);
        const BACK = 5; // of the faces +x, −x, +y, −y, +z, −z
        renderer.readRenderTargetPixels(cube, 0, 0, SIZE, SIZE, found, BACK);
        cube.dispose();
        return row(found, await picture(scene, camera.children[BACK]));
    },
    "several samples of a pixel": async () => {
        const target = new THREE.WebGLRenderTarget(SIZE, SIZE, { type: THREE.FloatType, samples: 4 });
        const found = await picture(sceneOf(lamp(), mesh()), facing(), { to: target });
        target.dispose();
        return row(found, await plain());
    },
    "another canvas with logarithmic depth": () => byAnother({ logarithmicDepthBuffer: true }),
    "another canvas with reversed depth": () => byAnother({ reversedDepthBuffer: true }),
    "an EffectComposer": async () => {
        renderer.toneMapping = THREE.ACESFilmicToneMapping;
        const scene = sceneOf(lamp(), mesh());
        const composer = new EffectComposer(renderer);
        composer.addPass(new RenderPass(scene, facing()));
        composer.addPass(new OutputPass());
        const found = await shown(scene, facing(), renderer, () => composer.render());
        const expected = await shown(scene, facing());
        renderer.toneMapping = THREE.NoToneMapping;
        composer.dispose();
        return row(found, expected);
    },
    "every tone mapping": async () => {
        const kinds = ["Linear", "Reinhard", "Cineon", "ACESFilmic", "AgX", "Neutral"];
        const linear = await plain();
        const scene = sceneOf(lamp(), mesh());
        const differences = [];
        let last;
        for (const kind of kinds) {
            renderer.toneMapping = THREE[kind + "ToneMapping"];
            const found = await shown(scene, facing());
            last = row(found, await mappedByThree(linear, renderer.toneMapping));
            differences.push(last.difference);
        }
        renderer.toneMapping = THREE.NoToneMapping;
        return { ...last, difference: Math.max(...differences), differences };
    },
    "fog": async () => {
        const scene = sceneOf(lamp(), mesh());
        scene.fog = new THREE.Fog(new THREE.Color(0.1, 0.2, 0.3), 1, 3);
        const found = await picture(scene, facing());
        const half = [0.05, 0.1, 0.15]; // the plate is half way from 1 to 3
        return row(found, mapped(await plain(), (x, c) => 0.5 * x + half[c]));
    },
    "clipping planes": async () => {
        const own = direct({ clippingPlanes: [new THREE.Plane(new THREE.Vector3(-1, 0, 0), 0)] });
        renderer.localClippingEnabled = true;
        const found = await picture(sceneOf(lamp(), mesh(own)), facing());
        renderer.localClippingEnabled = false;
        return row(found, mapped(await plain(), (value, _, x) => (x < SIZE / 2 ? value : 0)));
    },
    "vertex colours": async () => {
        const painted = mesh(direct({ vertexColors: true }));
        const { count } = painted.geometry.attributes.position;
        painted.geometry.setAttribute("color", new THREE.Float32BufferAttribute(Array(count).fill([0.8, 0.5, 0.2]).flat(), 3));
        const own = direct();
        await own.ready;
        for (const one of [painted.material, own]) one.color.set(1, 1, 1);
        own.color.setRGB(0.8, 0.5, 0.2);
        return row(await picture(sceneOf(lamp(), painted), facing()), await picture(sceneOf(lamp(), mesh(own)), facing()));
    },
    "shadows": async () => {
        const dark = await picture(sceneOf(mesh()), facing());
        const lit = await plain();
        const light = lamp();
        light.castShadow = true;
        light.shadow.mapSize.set(64, 64);
        Object.assign(light.shadow.camera, { left: -1, right: 1, top: 1, bottom: -1, near: 0.01, far: 4 });
        const wall = new THREE.Mesh(new THREE.PlaneGeometry(4, 4).translate(2, 0, 0), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
        wall.material.colorWrite = wall.material.depthWrite = false;
        wall.castShadow = true;
        wall.position.z = 0.5; // its edge's shadow falls where x is −.2
        const plate = mesh();
        plate.receiveShadow = true;
        renderer.shadowMap.enabled = true;
        const found = await picture(sceneOf(light, wall, plate), facing());
        renderer.shadowMap.enabled = false;
        const edge = SIZE / 2 - (0.2 / (2 * Math.tan(Math.PI / 9) * 2)) * SIZE;
        const expected = mapped(lit, (value, c, x, y) => (x < edge ? value : dark[4 * (y * SIZE + x) + c]));
        return { ...row(found, expected, (x) => Math.abs(x + 0.5 - edge) < 2), moved: compare(dark, lit).difference };
    },
    "more than sixteen lights": async () => {
        const lights = Array.from({ length: 20 }, () => lamp(0.1));
        return row(await picture(sceneOf(...lights, mesh()), facing()), await plain());
    },
    "every map and shadows within the promises of WebGL 2": async () => {
        const canvas = document.createElement("canvas");
        const gl = canvas.getContext("webgl2");
        const getParameter = gl.getParameter.bind(gl);
        const promised = new Map([[gl.MAX_TEXTURE_IMAGE_UNITS, 16], [gl.MAX_VARYING_VECTORS, 15]]);
        gl.getParameter = (name) => promised.get(name) ?? getParameter(name);
        // Rows of four components between the stages: ANGLE names what a fragment shader reads, pairs end in Uv.
        const linkProgram = gl.linkProgram.bind(gl);
        const varyings = [];
        gl.linkProgram = (program) => {
            for (const shader of gl.getAttachedShaders(program)) {
                const [, inputs] = /^Inputs: (.*)/.exec(gl.getExtension("WEBGL_debug_shaders").getTranslatedShaderSource(shader));
                if (!inputs.includes("gl_FragCoord")) continue;
                const names = inputs.trim().split(/ +/).filter((name) => !name.startsWith("gl_"));
                const pairs = names.filter((name) => name.endsWith("Uv"));
                varyings.push(names.length - pairs.length + Math.ceil(pairs.length / 2) + (names.includes("arc_products") ? 8 : 0));
            }
            linkProgram(program);
        };
        const other = new THREE.WebGLRenderer({ canvas, context: gl });
        const light = lamp();
        light.castShadow = true;
        light.shadow.mapSize.set(16, 16);
        other.shadowMap.enabled = true;
        const texture = new THREE.DataTexture(Uint8Array.of(200, 150, 220, 255), 1, 1);
        texture.needsUpdate = true;
        const maps = ["map", "alphaMap", "lightMap", "aoMap", "emissiveMap", "bumpMap", "normalMap", "roughnessMap", "metalnessMap", "clearcoatMap",
            "clearcoatNormalMap", "clearcoatRoughnessMap", "sheenColorMap", "sheenRoughnessMap", "specularColorMap", "specularIntensityMap"];
        const all = (names) => ({ clearcoat: 0.5, sheen: 0.5, ...Object.fromEntries(names.map((name) => [name, texture])) });
        const scene = (parameters) => {
            const one = mesh(grating({ ...parameters, representation: "arc" }));
            one.receiveShadow = true;
            return sceneOf(light, one);
        };
        const found = await picture(scene(all(maps)), facing(), { by: other });
        const message = told.splice(0).join(" | ");
        const leftOut = /left out: (.*?)\./.exec(message)?.[1].split(", ") ?? [];
        const samplers = [gl.SAMPLER_2D, gl.SAMPLER_3D, gl.SAMPLER_2D_ARRAY, gl.SAMPLER_CUBE, gl.SAMPLER_2D_SHADOW, gl.SAMPLER_CUBE_SHADOW];
        const counts = other.info.programs.map(({ program }) =>
            Array.from({ length: gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) }, (_, i) => gl.getActiveUniform(program, i))
                .reduce((sum, { type, size }) => sum + (samplers.includes(type) ? size : 0), 0));
        other.dispose();
        renderer.shadowMap.enabled = true;
        const expected = await picture(scene(all(maps.filter((name) => !leftOut.includes(name)))), facing());
        renderer.shadowMap.enabled = false;
        return { ...row(found, expected), leftOut, limits: { samplers: Math.max(...counts), varyings: Math.max(...varyings) } };
    },
    "made and disposed fifty times": async () => {
        const scene = sceneOf(lamp());
        const counts = () => {
            const { textures, geometries } = renderer.info.memory;
            return { textures, geometries, programs: renderer.info.programs.length };
        };
        await plain();
        const once = async (parameters) => {
            const own = mesh(grating(parameters));
            scene.add(own);
            await picture(scene, facing());
            own.material.dispose();
            own.geometry.dispose();
            scene.remove(own);
        };
        const kept = [mesh(), mesh(grating())]; // so that the programs are not compiled fifty times
        await picture(sceneOf(lamp(), ...kept), facing());
        await once({});
        const before = counts();
        for (let i = 0; i < 50; ++i) await once(i % 25 === 0 ? {} : { representation: "direct" });
        const expected = await plain();
        const again = mesh(direct());
        await picture(sceneOf(lamp(), again), facing());
        again.material.dispose();
        again.material.needsUpdate = true;
        const found = await picture(sceneOf(lamp(), again), facing()); // as three's materials
        again.material.dispose();
        again.geometry.dispose();
        return { ...row(found, expected), before, after: counts() };
    },
};
