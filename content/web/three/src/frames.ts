import {
    Euler, Matrix3, Matrix4, Vector3, Vector4, type BatchedMesh, type BufferAttribute, type BufferGeometry, type Camera, type InstancedMesh,
    type Intersection, type Mesh, type Object3D, type Scene, type SkinnedMesh,
} from "three";

/** Which way g, across the grooves, points on a mesh: along its tangents, or away from its origin as on a disc. */
export type Grooves = "tangent" | "radial";

/** From the world to the probe, which three's scene.environmentRotation turns. */
export function probeFromWorld({ environmentRotation }: Scene): Matrix3 {
    return new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromEuler(environmentRotation ?? new Euler())).transpose();
}

export function groovesOf(geometry: BufferGeometry): Grooves {
    return geometry.getAttribute("tangent") ? "tangent" : "radial";
}

/** Vertices of a mesh that one matrix takes to the world: all of them, or those of an instance. */
export interface Part {
    /** Of an InstancedMesh or a BatchedMesh, else 0. */
    instance: number;
    first: number;
    count: number;
    toWorld: Matrix4;
}

const kindOf = (object: Object3D) => object as Partial<InstancedMesh & BatchedMesh & SkinnedMesh & Mesh>;

/** Instances that a BatchedMesh has, also unseen ones. */
function* batched(mesh: BatchedMesh): Generator<{ instance: number; first: number; count: number }> {
    for (let instance = 0, left = mesh.instanceCount; left > 0 && instance < mesh.maxInstanceCount; ++instance) {
        let range;
        try {
            range = mesh.getGeometryRangeAt(mesh.getGeometryIdAt(instance))!;
        } catch {
            continue; // deleted; three tells by an error alone
        }
        yield { instance, first: range.vertexStart, count: range.vertexCount };
        --left;
    }
}

export function partsOf(object: Object3D, geometry: BufferGeometry): Part[] {
    const mesh = kindOf(object);
    const count = geometry.getAttribute("position").count;
    const toWorld = (read: (matrix: Matrix4) => void) => {
        const matrix = new Matrix4();
        read(matrix);
        return matrix.premultiply(object.matrixWorld);
    };
    if (mesh.isInstancedMesh)
        return Array.from({ length: mesh.count! }, (_, instance) =>
            ({ instance, first: 0, count, toWorld: toWorld((matrix) => mesh.getMatrixAt!(instance, matrix)) }));
    if (mesh.isBatchedMesh)
        return Array.from(batched(object as BatchedMesh), (part) =>
            ({ ...part, toWorld: toWorld((matrix) => mesh.getMatrixAt!(part.instance, matrix)) }));
    return [{ instance: 0, first: 0, count, toWorld: object.matrixWorld }];
}

const linear = ({ elements: e }: Matrix4) => [e[0], e[1], e[2], e[4], e[5], e[6], e[8], e[9], e[10]];

/** All numbers on which the directions of a mesh's frames depend, in any order that stays. */
export function poseOf(object: Object3D, geometry: BufferGeometry, toProbe: Matrix3): Float32Array {
    const mesh = kindOf(object);
    const numbers = [...toProbe.elements];
    for (const { instance, first, count, toWorld } of partsOf(object, geometry)) {
        if (mesh.isBatchedMesh) numbers.push(instance, first, count);
        numbers.push(...linear(toWorld));
    }
    if (mesh.isSkinnedMesh) for (const { matrixWorld } of mesh.skeleton!.bones) numbers.push(...linear(matrixWorld));
    if (bends(object, geometry)) numbers.push(...(mesh.morphTargetInfluences ?? []));
    return Float32Array.from(numbers);
}

/** Numbers that change whenever poseOf() or planeNormal() does under the same probe; null for a BatchedMesh, which tells of no change. */
export function poseKey(object: Object3D, geometry: BufferGeometry): number[] | null {
    const mesh = kindOf(object);
    if (mesh.isBatchedMesh) return null;
    const key = [...linear(object.matrixWorld), geometry.getAttribute("position").count];
    for (const of of [geometry.getAttribute("normal") as BufferAttribute | undefined, mesh.instanceMatrix]) key.push(of?.id ?? -1, of?.version ?? -1);
    if (mesh.isInstancedMesh) key.push(mesh.count!, mesh.morphTexture ? 1 : 0);
    if (mesh.isSkinnedMesh) for (const { matrixWorld } of mesh.skeleton!.bones) key.push(...linear(matrixWorld));
    if (bends(object, geometry)) key.push(...(mesh.morphTargetInfluences ?? []));
    return key;
}

/** Whether vertices move beside each other. */
export function bends(object: Object3D, geometry: BufferGeometry): boolean {
    const { position, normal } = geometry.morphAttributes;
    return kindOf(object).isSkinnedMesh === true || position !== undefined || normal !== undefined;
}

const normals = new WeakMap<BufferAttribute, { version: number; flat: Vector3 | null }>();

/** The normal that all vertices have, to 1e-3; null for curved meshes. */
export function flatNormal(geometry: BufferGeometry): Vector3 | null {
    const attribute = geometry.getAttribute("normal") as BufferAttribute | undefined;
    if (!attribute || attribute.count === 0) return null;
    const known = normals.get(attribute);
    if (known && known.version === attribute.version) return known.flat;
    let flat: Vector3 | null = new Vector3().fromBufferAttribute(attribute, 0).normalize();
    const other = new Vector3();
    for (let i = 1; flat && i < attribute.count; ++i)
        if (other.fromBufferAttribute(attribute, i).normalize().distanceTo(flat) > 1e-3) flat = null;
    normals.set(attribute, { version: attribute.version, flat });
    return flat;
}

/** The normal in the probe that all of a mesh has, its instances included, to `tolerance`; else null. */
export function planeNormal(object: Object3D, geometry: BufferGeometry, toProbe: Matrix3, tolerance: number): Vector3 | null {
    const flat = bends(object, geometry) ? null : flatNormal(geometry);
    if (!flat) return null;
    let common: Vector3 | null = null;
    const normalMatrix = new Matrix3();
    for (const { toWorld } of partsOf(object, geometry)) {
        const normal = flat.clone().applyMatrix3(normalMatrix.getNormalMatrix(toWorld)).normalize().applyMatrix3(toProbe);
        if (common && common.distanceTo(normal) > tolerance) return null;
        common ??= normal;
    }
    return common;
}

/** A vertex after morphs and bones, in the object's space: the normal, and g from the given tangent or away from the origin. */
class BentVertex {
    readonly n = new Vector3();
    readonly g = new Vector3();
    private readonly p = new Vector3();
    private readonly first = new Vector3();
    private readonly sum = new Vector3();
    private readonly direction = new Vector4();
    private readonly moves: boolean;

    constructor(private readonly object: Object3D, private readonly geometry: BufferGeometry, private readonly radial: boolean) {
        this.moves = bends(object, geometry);
    }

    private morph(of: "position" | "normal", index: number, vector: Vector3): void {
        const targets = this.geometry.morphAttributes[of] as BufferAttribute[] | undefined;
        const influences = kindOf(this.object).morphTargetInfluences;
        if (!targets || !influences) return;
        const rest = this.geometry.morphTargetsRelative ? 1 : 1 - influences.reduce((sum, x) => sum + x, 0);
        vector.multiplyScalar(rest);
        targets.forEach((target, i) => vector.addScaledVector(this.sum.fromBufferAttribute(target, index), influences[i] ?? 0));
    }

    private skin(index: number, vector: Vector3): void {
        this.direction.set(vector.x, vector.y, vector.z, 0);
        (this.object as SkinnedMesh).applyBoneTransform(index, this.direction as unknown as Vector3);
        vector.set(this.direction.x, this.direction.y, this.direction.z);
    }

    at(index: number): this {
        const { n, g, p, first, sum, geometry } = this;
        n.fromBufferAttribute(geometry.getAttribute("normal"), index);
        if (this.moves) {
            first.copy(n);
            this.morph("normal", index, n);
            n.normalize();
        }
        if (this.radial) {
            p.fromBufferAttribute(geometry.getAttribute("position"), index);
            if (this.moves) this.morph("position", index, p);
            g.copy(p).addScaledVector(n, -p.dot(n));
        } else {
            g.fromBufferAttribute(geometry.getAttribute("tangent"), index);
            if (this.moves) {
                // The least rotation from the first normal to the morphed one.
                const ahead = g.dot(first);
                sum.addVectors(first, n);
                g.addScaledVector(sum, -g.dot(sum) / Math.max(1 + first.dot(n), 1e-6)).addScaledVector(n, 2 * ahead);
            }
        }
        if (kindOf(this.object).isSkinnedMesh) {
            this.skin(index, n);
            this.skin(index, g);
        }
        return this;
    }
}

/**
 * Calls `visit` with the normal, of length 1, and the grating vector of vertices in the probe, as
 * src/glsl/surface.vert.glsl computes them. `turnOf`: radians from the tangent toward the bitangent at a vertex.
 */
function eachFrame(object: Object3D, geometry: BufferGeometry, part: Part, vertices: Iterable<number>, toProbe: Matrix3, grooves: Grooves,
    turnOf: (vertex: number) => number, visit: (n: Vector3, g: Vector3) => void): void {
    const vertex = new BentVertex(object, geometry, grooves === "radial");
    const toWorld = new Matrix3().setFromMatrix4(part.toWorld);
    const normalToWorld = new Matrix3().getNormalMatrix(part.toWorld);
    const tangents = geometry.getAttribute("tangent");
    const mirroring = toWorld.determinant() < 0 ? -1 : 1; // inverts the cross product
    const h = new Vector3();
    for (const i of vertices) {
        const { n, g } = vertex.at(i);
        n.applyMatrix3(normalToWorld).normalize();
        g.applyMatrix3(toWorld);
        const turn = turnOf(i);
        h.crossVectors(n, g).multiplyScalar(mirroring * Math.sin(turn) * (tangents ? tangents.getW(i) : 1));
        g.multiplyScalar(Math.cos(turn)).add(h);
        visit(n.applyMatrix3(toProbe), g.applyMatrix3(toProbe));
    }
}

/** Unit normals and grating vectors of all vertices, part after part, in the probe. */
export function frames(object: Object3D, geometry: BufferGeometry, toProbe: Matrix3, grooves: Grooves, turnOf: (vertex: number) => number) {
    const parts = partsOf(object, geometry);
    const count = parts.reduce((sum, part) => sum + part.count, 0);
    const normals = new Float32Array(3 * count);
    const gratings = new Float32Array(3 * count);
    let at = 0;
    for (const part of parts) {
        const vertices = Array.from({ length: part.count }, (_, i) => part.first + i);
        eachFrame(object, geometry, part, vertices, toProbe, grooves, turnOf, (n, g) => {
            n.toArray(normals, at);
            g.addScaledVector(n, -g.dot(n)).normalize().toArray(gratings, at);
            at += 3;
        });
    }
    return { normals, gratings };
}

/** Unit vectors in the probe at a point of a mesh: toward the eye, the normal, the grating vector. */
export function pointFrame({ object, point, face, barycoord, instanceId, batchId }: Intersection<Mesh>, toProbe: Matrix3, grooves: Grooves,
    turn: number, camera: Camera): Float32Array {
    const instance = instanceId ?? batchId ?? 0;
    const part = partsOf(object, object.geometry).find((one) => one.instance === instance)!;
    const weights = [barycoord!.x, barycoord!.y, barycoord!.z];
    const [normal, grating] = [new Vector3(), new Vector3()];
    let corner = 0;
    eachFrame(object, object.geometry, part, [face!.a, face!.b, face!.c], toProbe, grooves, () => turn, (n, g) => {
        normal.addScaledVector(n, weights[corner]);
        grating.addScaledVector(g, weights[corner++]);
    });
    normal.normalize();
    grating.addScaledVector(normal, -grating.dot(normal)).normalize();
    const view = new Vector3();
    if ((camera as { isOrthographicCamera?: boolean }).isOrthographicCamera) view.setFromMatrixColumn(camera.matrixWorld, 2);
    else view.setFromMatrixPosition(camera.matrixWorld).sub(point);
    view.normalize().applyMatrix3(toProbe);
    return Float32Array.of(...view.toArray(), ...normal.toArray(), ...grating.toArray());
}
