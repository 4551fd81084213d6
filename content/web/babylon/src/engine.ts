/** What grating_state.ts takes from its engine: three's names for numbers and textures, and Babylon's meshes. */
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
export class Matrix3 extends Numbers { static override readonly size = 9; } // by columns

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
export type BufferGeometry = AbstractMesh;
export type Scene = { readonly environmentIntensity: number };
/** A mesh's pose in the space of the panorama. */
export type Object3D = { readonly matrixWorld: { readonly elements: ArrayLike<number> } };

/**
 * From Babylon's world to the space of the panorama, which is right-handed with the middle of the picture at +x: where
 * Babylon's reflections show what HDRCubeTexture has loaded.
 */
export function toProbe(scene: BabylonScene, environment: BaseTexture | null): Matrix {
    const rotation = environment?.getReflectionTextureMatrix() ?? Matrix.Identity();
    const invertZ = (environment as { invertZ?: boolean } | null)?.invertZ ?? false;
    const swapped = Matrix.FromValues(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1);
    return rotation.multiply(Matrix.Scaling(1, 1, scene.useRightHandedSystem === invertZ ? 1 : -1)).multiply(swapped);
}

export function groovesOf(mesh: AbstractMesh): Grooves {
    return mesh.isVerticesDataPresent("tangent") ? "tangent" : "radial";
}

const flat = new WeakMap<AbstractMesh, Vector3 | null>();
/** The normal that all vertices have, to 1e-3; null for curved meshes. Looked for once for a mesh. */
export function flatNormal(mesh: AbstractMesh): Vector3 | null {
    if (!flat.has(mesh)) {
        const normals = mesh.getVerticesData("normal") ?? [];
        const first = Vector.FromArray(normals).normalize();
        let alike = normals.length > 0;
        for (let i = 3; alike && i < normals.length; i += 3) alike = Vector.Distance(Vector.FromArray(normals, i).normalize(), first) < 1e-3;
        flat.set(mesh, alike ? new Vector3(...first.asArray()) : null);
    }
    return flat.get(mesh)!;
}

const matrices = ({ matrixWorld }: Object3D) => {
    const toWorld = Matrix.FromArray(matrixWorld.elements);
    return { toWorld, normalToWorld: Matrix.Transpose(Matrix.Invert(toWorld)) };
};

export function worldNormal({ numbers }: Vector3, object: Object3D): Vector3 {
    return new Vector3(...Vector.TransformNormal(Vector.FromArray(numbers), matrices(object).normalToWorld).normalize().asArray());
}

/** Normals and grating vectors of all vertices, as grating.vert.glsl computes them: frames.ts of @rowland/three. */
export function worldFrames(mesh: AbstractMesh, object: Object3D, grooves: Grooves, turnOf: (vertex: number) => number) {
    const [positions, ownNormals, tangents] = ["position", "normal", "tangent"].map((kind) => mesh.getVerticesData(kind)!);
    const { toWorld, normalToWorld } = matrices(object);
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
        n.toArray(normals, i);
        turned.subtract(n.scale(Vector.Dot(n, turned))).normalize().toArray(gratings, i);
    }
    return { normals, gratings };
}
