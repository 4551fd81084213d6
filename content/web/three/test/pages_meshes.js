// Kinds of meshes, and materials on several of them.
import * as THREE from "three";
import { CD, ball, compare, eye, grating, lamp, mapped, picture, plate, rowland, sceneOf } from "./pages_stage.js";

const pose = (x, y, z, ...euler) => new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(...euler)).setPosition(x, y, z);

const FACING = [pose(-0.5, -0.4, 0, 0, 0, 0), pose(0.5, -0.3, 0.2, 0, 0, 0.6), pose(0, 0.5, -0.1, 0, 0, 2.1)];
const TILTED = [pose(-0.5, -0.4, 0, 0.4, 0.1, 0), pose(0.5, -0.3, 0.2, -0.3, 0.5, 0.6), pose(0, 0.5, -0.1, 0.2, -0.6, 2.1)];

/** A mesh for each matrix, with a material of its own, or with this one. */
function single(geometry, matrices, parameters, material) {
    return matrices.map((matrix) => {
        const mesh = new THREE.Mesh(geometry, material ?? grating(parameters));
        mesh.applyMatrix4(matrix);
        return mesh;
    });
}

function instanced(geometry, matrices, parameters) {
    const mesh = new THREE.InstancedMesh(geometry, grating(parameters), matrices.length);
    matrices.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
    return mesh;
}

async function alike(objects, expected, camera) {
    const [a, b] = [await picture(sceneOf(lamp(), ...objects), camera), await picture(sceneOf(lamp(), ...expected), camera)];
    return { ...compare(a, b), found: a, expected: b };
}

/** A strip along x, bent about y by `turn` radians a unit of length: positions, normals and tangents. */
function strip(turn) {
    const geometry = new THREE.PlaneGeometry(1.4, 0.9, 12, 1);
    const { position, normal } = geometry.attributes;
    const tangent = [];
    for (let i = 0; i < position.count; ++i) {
        const [x, y] = [position.getX(i), position.getY(i)];
        const angle = turn * x;
        if (turn !== 0) position.setXYZ(i, Math.sin(angle) / turn, y, (1 - Math.cos(angle)) / turn);
        normal.setXYZ(i, -Math.sin(angle), 0, Math.cos(angle));
        // Grooves askew of the bend: half along the strip, half along its axis.
        tangent.push(Math.SQRT1_2 * Math.cos(angle), Math.SQRT1_2, Math.SQRT1_2 * Math.sin(angle), 1);
    }
    geometry.setAttribute("tangent", new THREE.Float32BufferAttribute(tangent, 4));
    return geometry;
}

/** A strip that its morph target bends; `relative`: by what it adds. */
function morphing(relative = false) {
    const [flat, bent] = [strip(0), strip(0.8)];
    for (const name of ["position", "normal"]) {
        const target = bent.attributes[name];
        if (relative) target.array.forEach((x, i) => (target.array[i] = x - flat.attributes[name].array[i]));
        flat.morphAttributes[name] = [target];
    }
    flat.morphTargetsRelative = relative;
    return flat;
}

/** Of each vertex its position, its normal, and what sets its tangent. */
function* vertices({ attributes: { position, normal, tangent } }) {
    for (let i = 0; i < position.count; ++i)
        yield [...[position, normal].map((of) => new THREE.Vector3().fromBufferAttribute(of, i)), ({ x, y, z }) => tangent.setXYZ(i, x, y, z)];
}

/** A strip of two bones, the second turned about y. */
function skinned(parameters) {
    const geometry = strip(0);
    const { position } = geometry.attributes;
    const [index, weight] = [[], []];
    for (let i = 0; i < position.count; ++i) {
        const second = THREE.MathUtils.smoothstep(position.getX(i), -0.4, 0.4);
        index.push(0, 1, 0, 0);
        weight.push(1 - second, second, 0, 0);
    }
    geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(index, 4));
    geometry.setAttribute("skinWeight", new THREE.Float32BufferAttribute(weight, 4));
    const bones = [new THREE.Bone(), new THREE.Bone()];
    bones[0].add(bones[1]);
    const mesh = new THREE.SkinnedMesh(geometry, grating(parameters));
    mesh.add(bones[0]);
    mesh.bind(new THREE.Skeleton(bones));
    return { mesh, bend: (angle) => (bones[1].rotation.y = angle) };
}

/** The same geometry where the bones have put it. */
function frozen(mesh) {
    mesh.updateMatrixWorld(true);
    const geometry = mesh.geometry.clone();
    for (const [name, w] of [["position", 1], ["normal", 0], ["tangent", 0]]) {
        const attribute = geometry.attributes[name];
        for (let i = 0; i < attribute.count; ++i) {
            const vector = new THREE.Vector4(attribute.getX(i), attribute.getY(i), attribute.getZ(i), w);
            mesh.applyBoneTransform(i, vector);
            attribute.setXYZ(i, vector.x, vector.y, vector.z);
        }
    }
    return geometry;
}

export const meshes = {
    "flat instances, moved and turned in their plane": async () => {
        const mesh = instanced(plate(0.7, 0.7), FACING);
        return { ...(await alike([mesh], single(plate(0.7, 0.7), FACING, {}, grating()))) };
    },
    "curved instances": () => alike([instanced(ball(0.4), TILTED)], single(ball(0.4), TILTED)),
    "tilted flat instances": () => alike([instanced(plate(0.7, 0.7), TILTED)], single(plate(0.7, 0.7), TILTED, { representation: "arc" })),
    "an instance that is tilted later": async () => {
        const mesh = instanced(plate(0.7, 0.7), FACING);
        const scene = sceneOf(lamp(), mesh);
        await picture(scene);
        TILTED.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
        mesh.instanceMatrix.needsUpdate = true;
        const found = await picture(scene);
        const expected = await picture(sceneOf(lamp(), ...single(plate(0.7, 0.7), TILTED, { representation: "arc" })));
        return { ...compare(found, expected), found, expected };
    },
    "a batch of two geometries": async () => {
        const geometries = [ball(0.4), plate(0.7, 0.7)];
        const counts = geometries.map((geometry) => [geometry.attributes.position.count, geometry.index.count]);
        const mesh = new THREE.BatchedMesh(4, counts[0][0] + counts[1][0], counts[0][1] + counts[1][1], grating());
        const ids = geometries.map((geometry) => mesh.addGeometry(geometry));
        const which = [1, 0, 1];
        mesh.addInstance(ids[0]); // deleted: identifiers then have a gap
        which.forEach((geometry, i) => mesh.setMatrixAt(mesh.addInstance(ids[geometry]), TILTED[i]));
        mesh.deleteInstance(0);
        return alike([mesh], TILTED.flatMap((matrix, i) => single(geometries[which[i]], [matrix], { representation: "arc" })));
    },
    "more vertices of instances than a table holds": async () => {
        // The last are seen; the others are drawn far beside the picture, where they have no pixels.
        const beside = Array.from({ length: 1297 }, () => pose(1000, 0, 0, 0, 0, 0));
        const many = instanced(ball(0.4), [...beside, ...TILTED]);
        return alike([many], single(ball(0.4), TILTED, { representation: "direct" }));
    },
    "mirrored instances of turned grooves": () => {
        const mirrored = TILTED.map((matrix) => matrix.clone().scale(new THREE.Vector3(-0.8, 1, 1)));
        const turned = { grating: { ...CD, grooveRotation: 0.7 } };
        const [objects, expected] = [[instanced(ball(0.4), mirrored, turned)], single(ball(0.4), mirrored, turned)];
        // three takes the back of a mirrored instance for its front, which the layer beneath shows.
        for (const { material } of [...objects, ...expected]) material.diffractionOnly = true;
        return alike(objects, expected);
    },
    "instances with morphs of their own": () => {
        const geometry = morphing(true); // as WebGPURenderer of three 0.187 requires for instances
        const mesh = instanced(geometry, TILTED, { representation: "direct" });
        const apart = single(geometry, TILTED, { representation: "direct" });
        apart.forEach((one, i) => {
            one.morphTargetInfluences[0] = 0.5 * i;
            mesh.setMorphAt(i, one);
        });
        mesh.morphTexture.needsUpdate = true;
        return alike([mesh], apart);
    },
    "one material on meshes that face several ways": async () => {
        const two = TILTED.slice(1); // a map for each takes its time
        return alike(single(plate(0.7, 0.7), two, {}, grating()), single(plate(0.7, 0.7), two));
    },
    "one material on a flat mesh and a curved one": async () => {
        const material = grating();
        const objects = [single(plate(0.7, 0.7), [TILTED[0]], {}, material), single(ball(0.4), [TILTED[1]], {}, material)].flat();
        const expected = [single(plate(0.7, 0.7), [TILTED[0]], { representation: "arc" }), single(ball(0.4), [TILTED[1]])].flat();
        return alike(objects, expected);
    },
    "bones": async () => {
        const { mesh, bend } = skinned();
        const scene = sceneOf(lamp(), mesh);
        const straight = await picture(scene);
        bend(0.9);
        const found = await picture(scene);
        const expected = await picture(sceneOf(lamp(), new THREE.Mesh(frozen(mesh), grating())));
        return { ...compare(found, expected), found, expected, moved: compare(straight, expected).difference };
    },
    "radial grooves under morphs and bones": async () => {
        const { mesh, bend } = skinned({ grooves: "radial", representation: "direct" });
        const bent = strip(0.8);
        Object.assign(mesh.geometry.morphAttributes, { position: [bent.attributes.position], normal: [bent.attributes.normal] });
        mesh.updateMorphTargets();
        const scene = sceneOf(lamp(), mesh);
        const straight = await picture(scene);
        mesh.morphTargetInfluences[0] = 1;
        bend(0.9);
        const found = await picture(scene);
        // The bent strip, whose tangents point away from its origin, where the bones have put it.
        for (const [p, n, tangent] of vertices(bent)) tangent(p.addScaledVector(n, -p.dot(n)));
        for (const name of ["position", "normal", "tangent"]) mesh.geometry.setAttribute(name, bent.attributes[name]);
        const expected = await picture(sceneOf(lamp(), new THREE.Mesh(frozen(mesh), grating({ grooves: "tangent", representation: "direct" }))));
        return { ...compare(found, expected), found, expected, moved: compare(straight, expected).difference };
    },
    "morphs": async () => {
        const bent = strip(0.8);
        const mesh = new THREE.Mesh(morphing(), grating());
        const scene = sceneOf(lamp(), mesh);
        const straight = await picture(scene);
        mesh.morphTargetInfluences[0] = 1;
        const found = await picture(scene);
        const expected = await picture(sceneOf(lamp(), new THREE.Mesh(bent, grating())));
        return { ...compare(found, expected), found, expected, moved: compare(straight, expected).difference };
    },
    "an environment that is turned": async () => {
        const turn = new THREE.Euler(0.4, 0.9, -0.3);
        const objects = () => [lamp(), ...single(plate(0.7, 0.7), [TILTED[0]]), ...single(ball(0.4), [TILTED[1]])];
        const scene = sceneOf(...objects());
        scene.environmentRotation.copy(turn);
        scene.environmentIntensity = 1.5;
        const found = await picture(scene);
        // The same as all the rest turned the other way.
        const rest = new THREE.Group().add(...objects());
        const camera = eye();
        rest.add(camera);
        rest.quaternion.setFromEuler(turn).invert();
        const other = sceneOf(rest);
        other.environmentIntensity = 1.5;
        const expected = await picture(other, camera);
        other.environmentIntensity = 1;
        const weaker = await picture(other, camera);
        return { ...compare(found, expected), found, expected, moved: compare(weaker, expected).difference };
    },
    "clones, copies and JSON": async () => {
        const given = () => grating({ roughness: 0.4, representation: "direct" });
        const on = (material) => {
            const [mesh] = single(plate(), [TILTED[0]]);
            mesh.material = material;
            return sceneOf(lamp(), mesh);
        };
        const expected = await picture(on(given()));
        const used = new (given().constructor)({ rowland, grating: { ...CD, grating: { ...CD.grating, pitch_nm: 740 } }, side: THREE.DoubleSide,
            representation: "direct" });
        const before = await picture(on(used));
        used.copy(given());
        const json = JSON.parse(JSON.stringify(given().toJSON()));
        THREE.MaterialLoader.registerMaterial("GratingMaterial", given().constructor);
        const read = new THREE.MaterialLoader().parse(json);
        read.bake(rowland, read.grating);
        const differences = [];
        for (const material of [given().clone(), used, read]) differences.push(compare(await picture(on(material)), expected).difference);
        return { ...compare(expected, expected), difference: Math.max(...differences), differences, moved: compare(before, expected).difference };
    },
    "a page's own onBeforeCompile": async () => {
        const dim = { value: 0.5 };
        const hook = (shader) => {
            shader.uniforms.dim = dim;
            shader.fragmentShader = shader.fragmentShader.replace("#include <common>", "#include <common>\nuniform float dim;")
                .replace("#include <opaque_fragment>", "outgoingLight *= dim;\n#include <opaque_fragment>");
        };
        const [before, after, plain] = [{ onBeforeCompile: hook }, {}, {}].map((given) => grating({ ...given, representation: "direct" }));
        const on = (material) => sceneOf(lamp(), new THREE.Mesh(plate(), material));
        await picture(on(after));
        after.onBeforeCompile = hook;
        after.needsUpdate = true;
        const expected = mapped(await picture(on(plain)), (x) => 0.5 * x);
        const differences = [];
        for (const material of [before, after]) differences.push(compare(await picture(on(material)), expected).difference);
        return { ...compare(expected, expected), difference: Math.max(...differences), differences };
    },
};
