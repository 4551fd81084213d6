// Instances beside meshes of their own, and an orthographic camera beside a far one. Pictures of each pair as bytes.
import { Camera } from "@babylonjs/core/Cameras/camera.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Matrix, Quaternion, Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import "@babylonjs/core/Meshes/instancedMesh.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import "@babylonjs/core/Meshes/thinInstanceMesh.js";
import { Scene } from "@babylonjs/core/scene.js";
import { gratingMaterial } from "../dist/index.js";
import { CD, disc, strip, STRIP } from "./scene.js";

const placed = (position, rotation) => ({ position: new Vector3(...position), rotationQuaternion: Quaternion.FromEulerAngles(...rotation) });
/** The second is out of sight, so that those that are drawn have other numbers. */
const FLAT = [placed([-0.1, 0, 0], [0, 0, 0]), placed([9, 0, 0], [0, 0, 0]), placed([0.02, 0.03, 0], [0, 0, 1]), placed([0.1, -0.02, 0.02], [0, 0, 2])];
const TURNED = [placed([-0.1, 0, 0], [0.3, 0, 0]), placed([9, 0, 0], [1, 0, 0]), placed([0, 0, 0], [0.6, 0.7, 0]), placed([0.1, 0, 0], [-0.2, -0.5, 0.4])];
const SHAPES = {
    discs: { shape: disc, grating: CD, nodes: FLAT },
    strips: { shape: strip, grating: STRIP, nodes: TURNED },
};

function meshOf({ shape, grating }, rowland, scene) {
    const mesh = new Mesh("mesh", scene);
    mesh.setVerticesData("position", shape.POSITION, false, 3);
    mesh.setVerticesData("normal", shape.NORMAL, false, 3);
    if (shape.TANGENT.length > 0) mesh.setVerticesData("tangent", shape.TANGENT, false, 4);
    mesh.setIndices(shape.indices);
    mesh.material = gratingMaterial("grating", scene, { rowland, grating });
    mesh.material.backFaceCulling = false;
    return mesh;
}

const WAYS = {
    meshes: (one, ...of) => one.nodes.forEach((node) => Object.assign(meshOf(one, ...of), node)),
    createInstance(one, ...of) {
        const mesh = Object.assign(meshOf(one, ...of), one.nodes[0]);
        for (const node of one.nodes.slice(1)) Object.assign(mesh.createInstance("instance"), node);
    },
    thinInstances(one, ...of) {
        const matrices = one.nodes.map(({ position, rotationQuaternion }) => Matrix.Compose(Vector3.One(), rotationQuaternion, position));
        meshOf(one, ...of).thinInstanceAdd(matrices);
    },
};

/** The far camera's field is the orthographic one's, to 1e-3 of its depth. */
const CAMERAS = {
    near: (camera) => Object.assign(camera, { fov: 0.5, minZ: 0.01 }),
    orthographic: (camera) => Object.assign(camera, { mode: Camera.ORTHOGRAPHIC_CAMERA, orthoTop: 0.1, orthoBottom: -0.1, orthoLeft: -0.16, orthoRight: 0.16, minZ: 0.01 }),
    far(camera) {
        camera.position.scaleInPlace(400);
        Object.assign(camera, { fov: 2 * Math.atan(0.1 / camera.position.length()), minZ: camera.position.length() - 1, maxZ: camera.position.length() + 1 });
    },
};

async function picture(engine, rowland, { shape, way = "meshes", camera = "near", hand = "left" }) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = hand === "right";
    scene.clearColor = new Color4(0, 0, 0, 1);
    const eye = new FreeCamera("eye", new Vector3(0.05, 0.15, 0.4), scene);
    CAMERAS[camera](eye);
    eye.setTarget(Vector3.Zero());
    WAYS[way](SHAPES[shape], rowland, scene);
    const draw = async () => {
        scene.incrementRenderId();
        await scene.whenReadyAsync();
        scene.render();
    };
    for (let i = 0; i < 3; ++i) { // the table follows the first picture, and the program the table
        await draw();
        while (rowland.busy) await new Promise((resolve) => (rowland.onIdle = resolve));
    }
    await draw();
    const url = engine.getRenderingCanvas().toDataURL("image/png");
    scene.dispose();
    return url;
}

export async function comparisons(rowland, pixelsOfUrl) {
    const canvas = Object.assign(document.createElement("canvas"), { width: 96, height: 60 });
    const engine = new Engine(canvas, false, { preserveDrawingBuffer: true });
    engine.getCaps().parallelShaderCompile = undefined; // else Babylon draws with the program before while it compiles
    const pairs = [...["createInstance", "thinInstances"].flatMap((way) => Object.keys(SHAPES).map((shape) =>
        ({ name: `${way} of ${shape}`, one: { shape, way }, slow: { shape } }))),
        ...["left", "right"].map((hand) => ({ name: `an orthographic camera, ${hand}-handed`, one: { shape: "strips", camera: "orthographic", hand },
            slow: { shape: "strips", camera: "far", hand } }))];
    const results = [];
    const drawn = {}; // slow ones are drawn once
    for (const { name, ...both } of pairs) {
        const urls = {};
        for (const [of, settings] of Object.entries(both)) urls[of] = drawn[JSON.stringify(settings)] ??= await picture(engine, rowland, settings);
        results.push({ name, urls, one: await pixelsOfUrl(urls.one), slow: await pixelsOfUrl(urls.slow) });
    }
    return results;
}
