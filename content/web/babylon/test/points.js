// Draws the points of a test with Babylon, a quad of pixels each: their radiance.
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Constants } from "@babylonjs/core/Engines/constants.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { HDRCubeTexture } from "@babylonjs/core/Materials/Textures/hdrCubeTexture.js";
import { RenderTargetTexture } from "@babylonjs/core/Materials/Textures/renderTargetTexture.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { TransformNode } from "@babylonjs/core/Meshes/transformNode.js";
import { Scene } from "@babylonjs/core/scene.js";
import { GratingPlugin } from "../dist/index.js";

/** With each vertex at the pixel that `place` names, and the colour as it is before tone curves and the screen's gamut. */
class PointPlugin extends GratingPlugin {
    getAttributes(attributes) {
        attributes.push("place");
    }
    getCustomCode(shader) {
        const code = super.getCustomCode(shader);
        if (shader === "vertex")
            return { ...code, CUSTOM_VERTEX_BEGIN: "attribute vec2 place;", CUSTOM_VERTEX_MAIN_END: "gl_Position = vec4(place, 0.0, 1.0);" };
        return { ...code, CUSTOM_FRAGMENT_BEFORE_FOG: "vec4 point = vec4(0.0);\n" + this.pointCode(code.CUSTOM_FRAGMENT_BEFORE_FOG),
            CUSTOM_FRAGMENT_MAIN_END: "gl_FragColor = point;" };
    }
    pointCode(code) {
        return code.replace(/# ifndef ROWLAND_DIFFRACTION_ONLY[^]*?# endif/, "point = finalColor;");
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

/** A Radiance file whose colours are .5 + .5 times the direction that they are seen in, as @rowland/three takes panoramas. */
export function panoramaOfDirections(width, height) {
    const texels = Array.from({ length: height }, (_, row) => Array.from({ length: width }, (_, column) => {
        const [elevation, azimuth] = [(0.5 - (row + 0.5) / height) * Math.PI, ((column + 0.5) / width - 0.5) * 2 * Math.PI];
        const direction = [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
        return [...direction.map((x) => Math.round(127.5 + 127.5 * x)), 128]; // over 256: the exponent 0
    }));
    return new Blob([`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`, Uint8Array.from(texels.flat(2))]);
}

/** From the panorama's space to a mesh: Babylon turns glTFs of a left-handed scene by half a turn, and mirrors them. */
const TO_MESH = { left: ([x, y, z]) => [-z, y, x], right: ([x, y, z]) => [z, y, -x] };

export async function radiance(engine, rowland, { grating, representation, frames, lamp, hand, mirrors, rotation }) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = hand === "right";
    if (mirrors) {
        scene.environmentTexture = new HDRCubeTexture(mirrors, scene, 64);
        scene.environmentTexture.rotationY = rotation;
    }
    const camera = new FreeCamera("eye", Vector3.Zero(), scene);
    const root = new TransformNode("root", scene);
    if (hand === "left") Object.assign(root, { rotation: new Vector3(0, Math.PI, 0), scaling: new Vector3(1, 1, -1) }); // as its glTF loader
    const mesh = new Mesh("points", scene);
    mesh.parent = root;
    mesh.alwaysSelectAsActiveMesh = true;
    const data = { position: [], normal: [], tangent: [], place: [] };
    const count = frames.length;
    frames.forEach(({ view, normal, grating: g }, i) => {
        for (const [right, up] of [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]]) {
            data.position.push(...TO_MESH[hand](view.map((x) => -x)));
            data.normal.push(...TO_MESH[hand](normal));
            data.tangent.push(...TO_MESH[hand](g), 1);
            data.place.push((2 * (i + right)) / count - 1, up);
        }
    });
    const sizes = { position: 3, normal: 3, tangent: 4, place: 2 };
    for (const [kind, size] of Object.entries(sizes)) mesh.setVerticesData(kind, data[kind], false, size);
    mesh.setIndices(Array.from({ length: 6 * count }, (_, i) => i));
    const material = Object.assign(new PBRMaterial("points", scene), { albedoColor: Color3.Black(), metallic: 0, roughness: 0.3, backFaceCulling: false,
        specularIntensity: 0 }); // of lamps on the layer beneath, where engines differ
    const plugin = new (mirrors ? MirrorPlugin : PointPlugin)(material, { rowland, grating, representation });
    mesh.material = material;
    if (lamp) {
        const [x, y, z] = lamp.direction; // of the panorama's space, toward the lamp
        const light = new DirectionalLight("lamp", (hand === "left" ? new Vector3(z, y, x) : new Vector3(z, y, -x)).negate(), scene);
        light.diffuse = new Color3(...lamp.flux);
    }
    const target = new RenderTargetTexture("target", { width: 2 * count, height: 2 }, scene, false, true, Constants.TEXTURETYPE_FLOAT);
    target.renderList = [mesh];
    target.activeCamera = camera;
    scene.customRenderTargets.push(target);
    await plugin.state.solved;
    const draw = async () => {
        scene.incrementRenderId();
        while (!mesh.isReady(true)) await new Promise((resume) => setTimeout(resume));
        scene.render();
    };
    await draw();
    await plugin.state.settled;
    await draw();
    const pixels = await target.readPixels();
    scene.dispose();
    return frames.map((_, i) => [...pixels.subarray(8 * i, 8 * i + 3)]);
}
