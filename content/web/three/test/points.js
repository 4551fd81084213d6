// Renders the points of a test, a quad of pixels each: their radiance.
import * as THREE from "three";
import { GratingMaterial } from "../dist/index.js";

/** The material with each vertex at the pixel that `place` names. */
export class PointMaterial extends GratingMaterial {
    onBeforeCompile(shader, renderer) {
        super.onBeforeCompile(shader, renderer);
        shader.vertexShader = "attribute vec2 place;\n" +
            shader.vertexShader.replace(/}\s*$/, "gl_Position = vec4(place, 0.0, 1.0);\n}");
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

export async function reference(rowland, { grating, frames }) {
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

/** Red, green and blue of each pixel, from the left below, of a picture that may be upside down. */
export async function pixelsOf(renderer, target, flipped = false) {
    const { width, height } = target;
    let pixels = new Float32Array(4 * width * height);
    if (renderer.isWebGLRenderer) renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    else pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
    target.dispose();
    const topFirst = flipped || renderer.backend?.isWebGPUBackend === true;
    return Array.from({ length: width * height }, (_, i) => {
        const row = Math.floor(i / width);
        const at = 4 * ((topFirst ? height - 1 - row : row) * width + (i % width));
        return [...pixels.subarray(at, at + 3)];
    });
}

/**
 * A tilted plane under a lamp, whose grooves vary within its pixels and from one to the next. `flipped`: drawn from the top row on, as
 * WebGPU draws.
 */
export async function picture({ renderer, Plain }, rowland, { grating, picture: [width, height] }, flipped = false) {
    const texels = Array.from({ length: 64 }, (_, i) => [(29 * i) % 255, i % 7 === 0 ? 0 : 128, 0, 255]);
    const grooves = new THREE.DataTexture(Uint8Array.from(texels.flat()), 8, 8);
    grooves.magFilter = THREE.LinearFilter;
    const material = new Plain({ rowland, grating, grooveTexture: grooves, side: THREE.DoubleSide, specularIntensity: 0 });
    const plane = new THREE.PlaneGeometry(2, 2);
    plane.computeTangents();
    const scene = new THREE.Scene();
    const lamp = new THREE.PointLight(0xffffff, 400);
    lamp.position.set(2, 5, 7);
    const camera = new THREE.PerspectiveCamera(5, width / height).translateZ(15);
    if (flipped) camera.projectionMatrix.elements[5] *= -1;
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
    return pixelsOf(renderer, target, flipped);
}

export async function radiance({ renderer, Material }, rowland, { grating: given, representation, frames, lamp, texels, mirrored, sparkle }) {
    const grating = sparkle ? { ...given, grooveTexture: { index: 0, sparkle } } : given;
    const scene = new THREE.Scene();
    const camera = new THREE.PerspectiveCamera();
    const material = new Material({ rowland, grating, representation, grooveTexture: texels && grooveTexture(texels),
        side: THREE.DoubleSide, specularIntensity: 0 }); // of lamps on the layer beneath
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
