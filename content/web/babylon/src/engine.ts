/** What the state of a grating takes from its engine: three's names for numbers and textures, and Babylon's meshes. */
import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Matrix, Vector3 as Vector } from "@babylonjs/core/Maths/math.vector.js";
import type { BaseTexture } from "@babylonjs/core/Materials/Textures/baseTexture.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { RawTexture2DArray } from "@babylonjs/core/Materials/Textures/rawTexture2DArray.js";
import { RawTexture3D } from "@babylonjs/core/Materials/Textures/rawTexture3D.js";
import type { AbstractMesh } from "@babylonjs/core/Meshes/abstractMesh.js";
import type { Scene as BabylonScene } from "@babylonjs/core/scene.js";
import type { Table } from "./shared/tasks.js";

/** The numbers of a uniform. */
export class Numbers {
    static readonly size: number;
    readonly numbers: number[];
    constructor(...given: number[]) {
        this.numbers = Array.from({ length: new.target.size }, (_, i) => given[i] ?? 0);
    }
    fromArray(from: ArrayLike<number>, at = 0): this {
        this.numbers.forEach((_, i) => (this.numbers[i] = from[at + i]));
        return this;
    }
    copy({ numbers }: Numbers): this {
        return this.fromArray(numbers);
    }
    toArray = (): number[] => this.numbers;
    distanceTo = ({ numbers }: Numbers): number => Math.hypot(...this.numbers.map((x, i) => x - numbers[i]));
}
export class Vector2 extends Numbers { static override readonly size = 2; }
export class Vector3 extends Numbers { static override readonly size = 3; }
export class Vector4 extends Numbers {
    static override readonly size = 4;
    get w(): number { return this.numbers[3]; }
    set w(value: number) { this.numbers[3] = value; }
}
/** By columns. */
export class Matrix3 extends Numbers {
    static override readonly size = 9;
    clone = (): Matrix3 => new Matrix3(...this.numbers);
    equals = (other: Matrix3): boolean => this.distanceTo(other) === 0;
}

/** Texels, and Babylon's texture of them once a scene draws it. */
export class Texture {
    private drawn?: RawTexture | RawTexture2DArray | RawTexture3D;
    /** `repeats`: which of the axes s and r do; the others are clamped. */
    constructor(private readonly kind: "plane" | "array" | "volume" | "vectors", private data: ArrayBufferView,
        private readonly size: [width: number, height: number, depth: number], private readonly repeats: string) {}

    of(scene: BabylonScene): RawTexture | RawTexture2DArray | RawTexture3D {
        if (this.drawn) return this.drawn;
        const { kind, data, size: [width, height, depth] } = this;
        const format = [Constants.TEXTUREFORMAT_RGBA, scene, false, false] as const;
        const half = [Constants.TEXTURE_BILINEAR_SAMPLINGMODE, Constants.TEXTURETYPE_HALF_FLOAT] as const;
        const drawn = kind === "array" ? new RawTexture2DArray(data, width, height, depth, ...format, ...half)
            : kind === "volume" ? new RawTexture3D(data, width, height, depth, ...format, ...half)
            : kind === "plane" ? new RawTexture(data, width, height, ...format, ...half)
            : new RawTexture(data, width, height, ...format, Constants.TEXTURE_NEAREST_SAMPLINGMODE, Constants.TEXTURETYPE_FLOAT);
        const wrap = (axis: string) => (this.repeats.includes(axis) ? Constants.TEXTURE_WRAP_ADDRESSMODE : Constants.TEXTURE_CLAMP_ADDRESSMODE);
        return (this.drawn = Object.assign(drawn, { wrapU: wrap("s"), wrapV: Constants.TEXTURE_CLAMP_ADDRESSMODE, wrapR: wrap("r") }));
    }

    /** Takes the texels of a texture of the same kind and size; false if it differs in that. */
    take({ kind, data, size, repeats }: Texture): boolean {
        if (kind !== this.kind || repeats !== this.repeats || size.some((x, i) => x !== this.size[i])) return false;
        this.data = data;
        this.drawn?.update(data);
        return true;
    }

    dispose(): void {
        this.drawn?.dispose();
    }
}
const filtered = (kind: "plane" | "array" | "volume", { texels, width, height, depth }: Table, repeats: string) =>
    new Texture(kind, texels, [width, height, depth], repeats);
export const planeTexture = (table: Table) => filtered("plane", table, "s");
export const arrayTexture = (table: Table, repeated = false) => filtered("array", table, repeated ? "s" : "");
export const volumeTexture = (table: Table, { s, r }: { s?: boolean; r?: boolean }) => filtered("volume", table, (s ? "s" : "") + (r ? "r" : ""));
export const MOST_STORED = 1024 * 2048;
export function storageTexture(vectors: Float32Array): Texture {
    const rows = Math.max(1, Math.ceil(vectors.length / 4096));
    const padded = new Float32Array(4096 * rows);
    padded.set(vectors);
    return new Texture("vectors", padded, [1024, rows, 1], "");
}
export const takeContent = (to: Texture, from: Texture): boolean => to.take(from);

export interface GrooveMap {
    moments: Texture; rest: Texture; smallest: number; largest: number; gaps: boolean; uv: string; uvLinear: Vector4; uvOffset: Vector2;
}
export function grooveMap(..._: unknown[]): GrooveMap {
    throw new Error("grooveTexture: not drawn by @rowland/babylon; expected a grating without it");
}
export const rotationsOf = (..._: unknown[]): number[] => [];

export type Grooves = "tangent" | "radial";
/** Babylon's mesh; the others are what three's objects can be beside it. */
export type Object3D = AbstractMesh & { readonly type?: string; isBatchedMesh?: boolean; maxInstanceCount?: number; morphTexture?: object };
export type BufferGeometry = AbstractMesh;
export type Scene = { readonly environmentIntensity: number; readonly probe: Matrix3 };
export type InstancedMesh = Object3D;
export type BatchedMesh = Object3D & { maxInstanceCount: number };

/** By columns, as GLSL's and three's. */
const linear = (matrix: Matrix): number[] => [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => matrix.m[i]);
const apply = ({ numbers: m }: Matrix3, { x, y, z }: Vector): Vector =>
    new Vector(m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z);

/**
 * From Babylon's world to the space of the panorama, which is right-handed with the middle of the picture at +x: where
 * Babylon's reflections show what HDRCubeTexture has loaded.
 */
export function toProbe(scene: BabylonScene, environment: BaseTexture | null): Matrix3 {
    const rotation = environment?.getReflectionTextureMatrix() ?? Matrix.IdentityReadOnly;
    const invertZ = (environment as { invertZ?: boolean } | null)?.invertZ ?? false;
    const r = linear(rotation as Matrix);
    const z = scene.useRightHandedSystem === invertZ ? 1 : -1;
    return new Matrix3(...[0, 3, 6].flatMap((i) => [z * r[i + 2], r[i + 1], r[i]]));
}
export const probeFromWorld = ({ probe }: Scene): Matrix3 => probe;

export function groovesOf(mesh: AbstractMesh): Grooves {
    return mesh.isVerticesDataPresent("tangent") ? "tangent" : "radial";
}

/** Babylon's meshes are one part: frames.ts of @rowland/three has those of instances. */
export function partsOf(mesh: AbstractMesh, _: AbstractMesh): { instance: number; first: number; count: number }[] {
    return [{ instance: 0, first: 0, count: mesh.getTotalVertices() }];
}

export function poseOf(mesh: AbstractMesh, _: AbstractMesh, { numbers }: Matrix3): Float32Array {
    return Float32Array.from([...numbers, ...linear(mesh.getWorldMatrix())]);
}

/** Numbers that change whenever poseOf() or planeNormal() does under the same probe. */
export const poseKey = (mesh: AbstractMesh, _: AbstractMesh): number[] => linear(mesh.getWorldMatrix());

const flat = new WeakMap<AbstractMesh, Vector | null>();
/** The normal that all vertices have, to 1e-3; null for curved meshes. Looked for once for a mesh. */
function flatNormal(mesh: AbstractMesh): Vector | null {
    if (!flat.has(mesh)) {
        const normals = mesh.getVerticesData("normal") ?? [];
        const first = Vector.FromArray(normals).normalize();
        let alike = normals.length > 0;
        for (let i = 3; alike && i < normals.length; i += 3) alike = Vector.Distance(Vector.FromArray(normals, i).normalize(), first) < 1e-3;
        flat.set(mesh, alike ? first : null);
    }
    return flat.get(mesh)!;
}

const normalMatrix = (mesh: AbstractMesh): Matrix => Matrix.Transpose(Matrix.Invert(mesh.getWorldMatrix()));

/** The normal in the probe that all of a mesh has. */
export function planeNormal(mesh: AbstractMesh, _: AbstractMesh, probe: Matrix3, __: number): Vector3 | null {
    const normal = flatNormal(mesh);
    return normal && new Vector3(...apply(probe, Vector.TransformNormal(normal, normalMatrix(mesh)).normalize()).asArray());
}

/** Unit normals and grating vectors of all vertices in the probe, as surface.vert.glsl of @rowland/three computes them. */
export function frames(mesh: AbstractMesh, _: AbstractMesh, probe: Matrix3, grooves: Grooves, turnOf: (vertex: number) => number) {
    const [positions, ownNormals, tangents] = ["position", "normal", "tangent"].map((kind) => mesh.getVerticesData(kind)!);
    const [toWorld, normalToWorld] = [mesh.getWorldMatrix(), normalMatrix(mesh)];
    const mirroring = toWorld.determinant() < 0 ? -1 : 1; // inverts the cross product
    const [normals, gratings] = [new Float32Array(ownNormals.length), new Float32Array(ownNormals.length)];
    for (let i = 0; i < ownNormals.length; i += 3) {
        const [p, own] = [Vector.FromArray(positions, i), Vector.FromArray(ownNormals, i)];
        const n = Vector.TransformNormal(own, normalToWorld).normalize();
        const across = grooves === "radial" ? p.subtract(own.scale(Vector.Dot(p, own))) : Vector.FromArray(tangents, (4 * i) / 3);
        const g = Vector.TransformNormal(across, toWorld);
        const turn = turnOf(i / 3);
        const h = Vector.Cross(n, g).scale(mirroring * Math.sin(turn) * (tangents ? tangents[(4 * i) / 3 + 3] : 1));
        const turned = g.scale(Math.cos(turn)).add(h);
        apply(probe, n).toArray(normals, i);
        apply(probe, turned.subtract(n.scale(Vector.Dot(n, turned))).normalize()).toArray(gratings, i);
    }
    return { normals, gratings };
}
