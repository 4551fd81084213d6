// What a film shows with three under equal light from everywhere, or under a lamp that it mirrors, relative to a perfect mirror.
import * as THREE from "three";

/** A pixel of a square that faces +z, seen from `view`. The copy from `target` is asked for before this returns. */
async function pixel(renderer, scene, view, target) {
    const camera = new THREE.PerspectiveCamera(0.1, 1, 0.1, 10);
    camera.position.set(...view);
    camera.lookAt(0, 0, 0);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    let rgba = new Float32Array(4);
    if (renderer.isWebGLRenderer) renderer.readRenderTargetPixels(target, 0, 0, 1, 1, rgba);
    else rgba = await renderer.readRenderTargetPixelsAsync(target, 0, 0, 1, 1);
    return [...rgba.subarray(0, 3)];
}

const skies = new Map();
/** A uniform sky, which each renderer filters for itself, once: in software that takes seconds. */
function white(renderer) {
    if (!skies.has(renderer)) {
        const texture = new THREE.DataTexture(new Float32Array(4 * 64 * 32).fill(1), 64, 32, THREE.RGBAFormat, THREE.FloatType);
        skies.set(renderer, Object.assign(texture, { mapping: THREE.EquirectangularReflectionMapping, needsUpdate: true }));
    }
    return skies.get(renderer);
}

export async function shown([renderer, Material], rowland, { film, views, thicknesses, lamp }) {
    const scene = new THREE.Scene();
    const light = new THREE.DirectionalLight();
    if (lamp) scene.add(light);
    else scene.environment = white(renderer);
    const target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.FloatType });
    const parameters = {};
    if (thicknesses) {
        parameters.iridescenceThicknessMap = new THREE.DataTexture(new Uint8Array([0, 0, 0, 255]), 1, 1);
        parameters.iridescenceThicknessRange = thicknesses;
    }
    const material = new Material({ rowland, film, ...parameters });
    const mirror = new THREE.MeshPhysicalMaterial({ color: 0xffffff, metalness: 1, roughness: film.roughness ?? 0 });
    await material.ready;
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(), material);
    scene.add(mesh);
    // All views are drawn before the first is read: WebGPURenderer takes a frame of the browser for each that it waits for.
    const results = [];
    for (const { view, texel = 0 } of views) {
        const map = material.iridescenceThicknessMap;
        if (map) {
            map.image.data[1] = texel;
            map.needsUpdate = true;
        }
        light.position.set(-view[0], -view[1], view[2]);
        mesh.material = mirror;
        const whole = pixel(renderer, scene, view, target);
        mesh.material = material;
        const own = pixel(renderer, scene, view, target);
        results.push(Promise.all([whole, own]));
    }
    return (await Promise.all(results)).map(([whole, own]) => own.map((x, c) => x / whole[c]));
}
