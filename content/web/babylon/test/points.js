// Draws the points of a test with Babylon, a quad of pixels each: their radiance.
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Constants } from "@babylonjs/core/Engines/constants.js";
import { MaterialPluginBase } from "@babylonjs/core/Materials/materialPluginBase.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { HDRCubeTexture } from "@babylonjs/core/Materials/Textures/hdrCubeTexture.js";
import { RenderTargetTexture } from "@babylonjs/core/Materials/Textures/renderTargetTexture.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import { Scene } from "@babylonjs/core/scene.js";
import { FilmPlugin, GratingPlugin } from "../dist/index.js";

/** With each vertex at the pixel that `place` names, and the colour as it is before tone curves and the screen's gamut. */
const pointed = (Plugin) => class extends Plugin {
    getAttributes(attributes) {
        super.getAttributes(attributes);
        attributes.push("place");
    }
    getCustomCode(shader) {
        const code = super.getCustomCode(shader) ?? {};
        if (shader === "vertex")
            return { ...code, CUSTOM_VERTEX_BEGIN: "attribute vec2 place;", CUSTOM_VERTEX_MAIN_END: "gl_Position = vec4(place, 0.0, 1.0);" };
        return { ...code, CUSTOM_FRAGMENT_BEFORE_FOG: "vec4 point = vec4(0.0);\n" + this.pointCode(code.CUSTOM_FRAGMENT_BEFORE_FOG ?? ""),
            CUSTOM_FRAGMENT_MAIN_END: "gl_FragColor = point;" };
    }
    pointCode(code) {
        return code.replace(/# ifndef ROWLAND_DIFFRACTION_ONLY[^]*?# endif/, "") + "\npoint = finalColor;";
    }
};
const PointPlugin = pointed(GratingPlugin);
const PointFilmPlugin = pointed(FilmPlugin);
/** A mirror, which films are shown relative to. */
class PlainPlugin extends pointed(MaterialPluginBase) {
    constructor(material) {
        super(material, "plain", 300, {}, true, true);
    }
}

/** What Babylon mirrors less the colour of that direction of panoramaOfDirections(), as the plug-in has the panorama. */
class MirrorPlugin extends PointPlugin {
    pointCode() {
        return `# if defined(ROWLAND) && defined(REFLECTION)
point.rgb = sampleReflectionLod(reflectionSampler, reflectionOut.reflectionCoords, 0.0).rgb - 0.5 -
    0.5 * in_probe(reflect(-viewDirectionW, normalW));
# else
point.rgb = vec3(9.0);
# endif`;
    }
}

/** A Radiance file: bytes of mantissas and of the exponent at unit directions, as @rowland/three takes panoramas. */
export function panoramaOf(width, height, texel) {
    const texels = Array.from({ length: height }, (_, row) => Array.from({ length: width }, (_, column) => {
        const [elevation, azimuth] = [(0.5 - (row + 0.5) / height) * Math.PI, ((column + 0.5) / width - 0.5) * 2 * Math.PI];
        return texel([Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)]);
    }));
    return new Blob([`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`, Uint8Array.from(texels.flat(2))]);
}

/** Colours are .5 + .5 times the direction that they are seen in. */
export const panoramaOfDirections = (width, height) =>
    panoramaOf(width, height, (direction) => [...direction.map((x) => Math.round(127.5 + 127.5 * x)), 128]); // over 256: the exponent 0

/** From the panorama's space to a mesh: Babylon turns glTFs of a left-handed scene by half a turn, and mirrors them. */
const TO_MESH = { left: ([x, y, z]) => [-z, y, x], right: ([x, y, z]) => [z, y, -x] };

/** A mesh of a quad for each point, drawn into two of `target`'s pixels from the left to the right. */
function pointsOf(engine, { frames, lamp, hand }) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = hand === "right";
    const camera = new FreeCamera("eye", Vector3.Zero(), scene);
    const root = new TransformNode("root", scene);
    if (hand === "left") Object.assign(root, { rotation: new Vector3(0, Math.PI, 0), scaling: new Vector3(1, 1, -1) }); // as its glTF loader
    const mesh = new Mesh("points", scene);
    mesh.parent = root;
    mesh.alwaysSelectAsActiveMesh = true;
    const data = { position: [], normal: [], tangent: [], place: [], uv: [] };
    const count = frames.length;
    frames.forEach(({ view, normal, grating: g }, i) => {
        for (const [right, up] of [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]]) {
            data.position.push(...TO_MESH[hand](view.map((x) => -x)));
            data.normal.push(...TO_MESH[hand](normal));
            data.tangent.push(...TO_MESH[hand](g), 1);
            data.place.push((2 * (i + right)) / count - 1, up);
            data.uv.push((i + 0.5) / count, 0.5);
        }
    });
    const sizes = { position: 3, normal: 3, tangent: 4, place: 2, uv: 2 };
    for (const [kind, size] of Object.entries(sizes)) mesh.setVerticesData(kind, data[kind], false, size);
    mesh.setIndices(Array.from({ length: 6 * count }, (_, i) => i));
    if (lamp) {
        const [x, y, z] = lamp.direction; // of the panorama's space, toward the lamp
        const light = new DirectionalLight("lamp", (hand === "left" ? new Vector3(z, y, x) : new Vector3(z, y, -x)).negate(), scene);
        light.diffuse = new Color3(...lamp.flux);
    }
    const target = new RenderTargetTexture("target", { width: 2 * count, height: 2 }, scene, false, true, Constants.TEXTURETYPE_FLOAT);
    target.renderList = [mesh];
    target.activeCamera = camera;
    scene.customRenderTargets.push(target);
    const draw = async () => {
        scene.incrementRenderId();
        while (!mesh.isReady(true)) await new Promise((resume) => setTimeout(resume));
        scene.render();
        const pixels = await target.readPixels();
        return frames.map((_, i) => [...pixels.subarray(8 * i, 8 * i + 3)]);
    };
    return { scene, mesh, draw };
}

/** A texel of red and green for each point. */
const textureOf = (texels, scene) => RawTexture.CreateRGBATexture(Uint8Array.from(texels.flatMap(([red, green]) => [red, green, 0, 255])), texels.length, 1,
    scene, false, false, Constants.TEXTURE_BILINEAR_SAMPLINGMODE);

export async function radiance(engine, rowland, one) {
    const { representation, texels, mirrors, rotation } = one;
    const grating = one.sparkle ? { ...one.grating, grooveTexture: { index: 0, sparkle: true } } : one.grating;
    const { scene, mesh, draw } = pointsOf(engine, one);
    if (mirrors) {
        scene.environmentTexture = new HDRCubeTexture(mirrors, scene, 64);
        scene.environmentTexture.rotationY = rotation;
    }
    const material = Object.assign(new PBRMaterial("points", scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0.3, backFaceCulling: false,
        specularIntensity: 0 }); // of lamps on the layer beneath, where engines differ
    const grooveTexture = texels && textureOf(texels, scene);
    const plugin = new (mirrors ? MirrorPlugin : PointPlugin)(material, { rowland, grating, representation, grooveTexture });
    mesh.material = material;
    await plugin.state.solved;
    await draw();
    await plugin.state.settled;
    const shown = await draw();
    scene.dispose();
    return shown;
}

/** What a film shows under equal light from everywhere or under a lamp, relative to a mirror as rough. `sky`: a Radiance file of 1. */
export async function filmReflectance(engine, rowland, sky, { film, views, thicknesses, lamp }) {
    const frames = views.map(({ view: [x, , z] }) => ({ view: [2 * x * z, 0, 2 * z * z - 1], normal: [x, 0, z], grating: [0, 1, 0] })); // [0, 0, 1] is mirrored
    const { scene, mesh, draw } = pointsOf(engine, { frames, hand: "left", lamp: lamp && { direction: [0, 0, 1], flux: [1, 1, 1] } });
    if (!lamp) scene.environmentTexture = new HDRCubeTexture(sky, scene, 16);
    const materialOf = (members) => (mesh.material = Object.assign(new PBRMaterial("points", scene), { backFaceCulling: false, ...members }));
    new PlainPlugin(materialOf({ albedoColor: Color3.White(), metallic: 1, roughness: film.roughness ?? 0 }));
    const whole = await draw();
    const plugin = new PointFilmPlugin(materialOf({ albedoColor: Color3.Black(), metallic: 0 }), {});
    if (thicknesses)
        Object.assign(plugin.material.iridescence, { minimumThickness: thicknesses[0], thicknessTexture: textureOf(views.map(({ texel }) => [0, texel]), scene) });
    plugin.bake(rowland, film);
    await plugin.ready;
    const own = await draw();
    scene.dispose();
    return own.map((rgb, i) => rgb.map((x, c) => x / whole[i][c]));
}
