// What films show under equal light from everywhere, and under a lamp, relative to a perfect mirror; posted.
import * as THREE from "three";
import { FilmMaterial, Rowland } from "../dist/index.js";

const post = (value) => fetch("/result", { method: "POST", body: JSON.stringify(value) });

/** A pixel of a square that faces +z, seen from `view`. */
function pixel(renderer, scene, view, target) {
    const camera = new THREE.PerspectiveCamera(0.1, 1, 0.1, 10);
    camera.position.set(...view);
    camera.lookAt(0, 0, 0);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const rgba = new Float32Array(4);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, rgba);
    return [...rgba.subarray(0, 3)];
}

try {
    const { cases } = await (await fetch("/task")).json();
    const renderer = new THREE.WebGLRenderer();
    const rowland = new Rowland();
    rowland.onError = (error) => post({ error: error.message });
    const white = new THREE.DataTexture(new Float32Array(4 * 64 * 32).fill(1), 64, 32, THREE.RGBAFormat, THREE.FloatType);
    Object.assign(white, { mapping: THREE.EquirectangularReflectionMapping, needsUpdate: true });
    const target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.FloatType });
    const results = [];
    for (const { film, views, thicknesses, lamp } of cases) {
        const scene = new THREE.Scene();
        if (lamp) {
            const light = new THREE.DirectionalLight();
            light.position.set(...lamp);
            scene.add(light);
        } else scene.environment = white;
        const parameters = {};
        if (thicknesses) {
            const texels = new Uint8Array([0, 0, 0, 255]);
            parameters.iridescenceThicknessMap = new THREE.DataTexture(texels, 1, 1);
            parameters.iridescenceThicknessRange = thicknesses;
        }
        const material = new FilmMaterial({ rowland, film, ...parameters });
        const mirror = new THREE.MeshPhysicalMaterial({ color: 0xffffff, metalness: 1, roughness: film.roughness ?? 0 });
        await material.ready;
        const mesh = new THREE.Mesh(new THREE.PlaneGeometry(), material);
        scene.add(mesh);
        results.push(views.map(({ view, texel = 0 }) => {
            const map = material.iridescenceThicknessMap;
            if (map) {
                map.image.data[1] = texel;
                map.needsUpdate = true;
            }
            mesh.material = mirror;
            const whole = pixel(renderer, scene, view, target);
            mesh.material = material;
            return pixel(renderer, scene, view, target).map((x, c) => x / whole[c]);
        }));
    }
    await post({ results });
} catch (error) {
    await post({ error: error.message + "\n" + error.stack });
}
