// A vertex under morphs, bones and instances: where src/glsl/surface.vert.glsl reads groove_position, groove_normal and groove_linear.
import type { BatchedMesh, InstancedMesh, Mesh, Object3D, SkinnedMesh, Texture } from "three";
import {
    attribute, cross, dot, drawIndex, float, instanceIndex, int, ivec2, mat3, morphReference, normalGeometry, normalLocal, OnObjectUpdate,
    positionGeometry, positionLocal, reference, texture, textureSize, vec3,
} from "three/tsl";
import type { Node, NodeBuilder, TextureNode } from "three/webgpu";
import { storageTexture } from "../textures.js";
import type { Float, Int, Mat3, Vec3, Vec4 } from "./program.js";

/** BatchedMesh beyond three's types. */
interface Batch {
    readonly _matricesTexture: Texture;
    readonly _indirectTexture: Texture;
}

type Kinds = Partial<Pick<SkinnedMesh, "isSkinnedMesh"> & Pick<BatchedMesh, "isBatchedMesh"> & Pick<InstancedMesh, "isInstancedMesh">>;

export interface PosedVertex {
    /** After morphs, before bones and instances, in the object's space. */
    readonly position: Vec3;
    readonly normal: Vec3;
    /** Takes a direction from before bones and instances to after. */
    readonly moved: (direction: Vec3) => Vec3;
    /** Of the matrix that does. */
    readonly determinant: Float;
    /** Of vertex_products; of a batch, of products_first. */
    readonly instance: Int;
    readonly isBatched: boolean;
}

const copies = new WeakMap<object, { version: number; texture: Texture }>();

/** The matrices of an InstancedMesh, which three keeps in vertex buffers: a second set of these would exceed WebGPU's eight. */
function instanceMatrices(mesh: InstancedMesh): Texture {
    const { instanceMatrix } = mesh;
    let copy = copies.get(instanceMatrix);
    if (!copy) {
        const made = (copy = { version: instanceMatrix.version, texture: storageTexture(instanceMatrix.array as Float32Array) });
        mesh.addEventListener("dispose", () => made.texture.dispose());
        copies.set(instanceMatrix, made);
    } else if (copy.version !== instanceMatrix.version) {
        copy.version = instanceMatrix.version;
        (copy.texture.image as { data: Float32Array }).data.set(instanceMatrix.array);
        copy.texture.needsUpdate = true;
    }
    return copy.texture;
}

function boneMatrices({ skeleton }: SkinnedMesh): Texture {
    if (skeleton.boneTexture === null) skeleton.computeBoneTexture();
    return skeleton.boneTexture!;
}

/** A node of a texture that is each object's own. */
function objectTexture<Of>(object: Object3D, of: (object: Of) => Texture): TextureNode {
    const node = texture(of(object as Of));
    OnObjectUpdate((({ object }: { object: Of }) => (node.value = of(object))) as never);
    return node;
}

/** Texel `i` of a texture's rows. */
function texel(from: TextureNode, i: Int): Vec4 {
    const width = int((textureSize(from as never) as unknown as { x: Int }).x);
    return from.load(ivec2(i.mod(width), i.div(width)));
}

type Linear = Pick<PosedVertex, "moved" | "determinant">;
const along = ([x, y, z]: Mat3, s: Vec3): Vec3 => x.mul(s.x).add(y.mul(s.y)).add(z.mul(s.z));
const determinantOf = ([x, y, z]: Mat3): Float => dot(cross(x, y), z);

/** The linear part of a matrix of four texels. */
const columns = (matrices: TextureNode, matrix: Int) => [0, 1, 2].map((i) => texel(matrices, matrix.mul(4).add(i)).xyz) as unknown as Mat3;

function instanceLinear(matrices: TextureNode, instance: Int): Linear {
    const linear = columns(matrices, instance).map((column) => column.toVar()) as unknown as Mat3;
    return { moved: (direction) => along(linear, direction), determinant: determinantOf(linear) };
}

function boneLinear(matrices: TextureNode): Linear {
    const [bones, weights] = [attribute("skinIndex", "uvec4"), attribute("skinWeight", "vec4")] as unknown as Vec4[];
    const sum = [0, 1, 2].map(() => vec3(0).toVar()) as unknown as Mat3;
    for (const i of ["x", "y", "z", "w"] as const)
        columns(matrices, int(bones[i])).forEach((column, c) => sum[c].addAssign(column.mul(weights[i])));
    const [bind, inverse] = ["bindMatrix", "bindMatrixInverse"].map((name) => mat3(reference(name, "mat4", null) as unknown as Node<"mat4">));
    // The determinants of bind and inverse cancel out.
    return { moved: (direction) => inverse.mul(along(sum, bind.mul(direction) as Vec3)) as Vec3, determinant: determinantOf(sum) };
}

/** The position and the normal that three's morphs make, of a mesh whose following steps overwrite them: it is taken twice. */
function morphed(mesh: Mesh): Pick<PosedVertex, "position" | "normal"> {
    const { position, normal } = mesh.geometry.morphAttributes;
    if (!position && !normal) return { position: positionGeometry, normal: normalGeometry };
    morphReference(mesh);
    const made = { position: positionLocal.toVar() as Vec3, normal: normalLocal.toVar() as Vec3 };
    positionLocal.assign(positionGeometry);
    normalLocal.assign(normalGeometry);
    return made;
}

/** To be called where three begins the vertex's position. */
export function posed_vertex(builder: NodeBuilder): PosedVertex {
    const { object, getDrawIndex } = builder as unknown as { object: Mesh & Kinds; getDrawIndex(): string | null };
    const still = { position: positionLocal as Vec3, normal: normalLocal as Vec3, moved: (direction: Vec3) => direction, determinant: float(1),
        instance: int(0) as Int, isBatched: false };
    if (object.isSkinnedMesh) return { ...still, ...morphed(object), ...boneLinear(objectTexture(object, boneMatrices)) };
    if (object.isInstancedMesh) {
        const instance = int(instanceIndex);
        return { ...still, ...morphed(object), instance, ...instanceLinear(objectTexture(object, instanceMatrices), instance) };
    }
    if (!object.isBatchedMesh) return still;
    const drawn = int(getDrawIndex.call(builder) === null ? instanceIndex : drawIndex);
    const instance = int(texel(objectTexture(object, (mesh: Batch) => mesh._indirectTexture), drawn).x).toVar() as Int;
    const linear = instanceLinear(objectTexture(object, (mesh: Batch) => mesh._matricesTexture), instance);
    return { ...still, ...morphed(object), instance, isBatched: true, ...linear };
}
