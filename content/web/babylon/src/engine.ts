/** What the state of a grating and a film's table take from their engine: three's names for numbers and textures, and Babylon's meshes. */
import { Constants } from "@babylonjs/core/Engines/constants.js";
import "@babylonjs/core/Engines/Extensions/engine.readTexture.js";
import type { ThinEngine } from "@babylonjs/core/Engines/thinEngine.js";
import { Matrix, Vector2, Vector3 as Vector, Vector4 } from "@babylonjs/core/Maths/math.vector.js";
import { BaseTexture } from "@babylonjs/core/Materials/Textures/baseTexture.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { RawTexture2DArray } from "@babylonjs/core/Materials/Textures/rawTexture2DArray.js";
import { RawTexture3D } from "@babylonjs/core/Materials/Textures/rawTexture3D.js";
import type { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import type {} from "@babylonjs/core/Meshes/thinInstanceMesh.types.js";
import type { Scene as BabylonScene } from "@babylonjs/core/scene.js";
import type { GrooveImage, Wrap } from "./shared/groove_map.js";
import type { Table } from "./shared/tasks.js";

export { Vector2, Vector4 };

export class Vector3 extends Vector {
    distanceTo(other: Vector): number {
        return Vector.Distance(this, other);
    }
}
/** By columns. */
export class Matrix3 extends Float32Array {
    constructor() {
        super(9);
    }
    fromArray(from: Float32Array, at = 0): this {
        this.set(from.subarray(at, at + 9));
        return this;
    }
    copy(other: Matrix3): this {
        this.set(other);
        return this;
    }
    clone = (): Matrix3 => new Matrix3().copy(this);
    equals = (other: Matrix3): boolean => this.every((x, i) => x === other[i]);
}

const WRAPS: Record<Wrap, number> = { clamp: Constants.TEXTURE_CLAMP_ADDRESSMODE, repeat: Constants.TEXTURE_WRAP_ADDRESSMODE,
    mirror: Constants.TEXTURE_MIRROR_ADDRESSMODE };
type Texels = Float32Array | Uint16Array;
type Drawn = RawTexture | RawTexture2DArray | RawTexture3D;

/** Texels, and Babylon's texture of them once a scene draws it. RGBA: halves, filtered, or floats, which are not. */
export class Texture {
    private drawn?: Drawn;
    private readonly wraps: readonly Wrap[]; // along s, t and r
    /** `levels`: the largest first. */
    constructor(private readonly kind: "plane" | "array" | "volume", private levels: readonly Texels[],
        private readonly size: readonly [width: number, height: number, depth: number], [s = "clamp", t = "clamp", r = "clamp"]: readonly Wrap[] = [],
        private readonly nearest = false) {
        this.wraps = [s, t, r];
    }

    of(scene: BabylonScene): Drawn {
        if (this.drawn) return this.drawn;
        const { kind, levels, size: [width, height, depth] } = this;
        const sampling = this.nearest ? levels.length > 1 ? Constants.TEXTURE_NEAREST_NEAREST_MIPNEAREST : Constants.TEXTURE_NEAREST_SAMPLINGMODE
            : levels.length > 1 ? Constants.TEXTURE_TRILINEAR_SAMPLINGMODE : Constants.TEXTURE_BILINEAR_SAMPLINGMODE;
        const type = levels[0] instanceof Float32Array ? Constants.TEXTURETYPE_FLOAT : Constants.TEXTURETYPE_HALF_FLOAT;
        const format = [Constants.TEXTUREFORMAT_RGBA, scene, levels.length > 1, false, sampling, type] as const;
        const drawn = kind === "plane" ? new RawTexture(levels[0], width, height, ...format)
            : new (kind === "array" ? RawTexture2DArray : RawTexture3D)(levels[0], width, height, depth, ...format);
        const [wrapU, wrapV, wrapR] = this.wraps.map((wrap) => WRAPS[wrap]);
        const engine = scene.getEngine() as ThinEngine;
        for (let level = 1; level < levels.length; ++level) // Babylon has made room for these
            engine.updateTextureData(drawn.getInternalTexture()!, levels[level], 0, 0, Math.max(1, width >> level), Math.max(1, height >> level), 0, level);
        return (this.drawn = Object.assign(drawn, { wrapU, wrapV, wrapR, anisotropicFilteringLevel: 1 }));
    }

    /** Takes the texels of a texture of the same kind and size; false if it differs in that. */
    take({ kind, levels, size, wraps }: Texture): boolean {
        if (levels.length > 1 || `${[kind, size, wraps]}` !== `${[this.kind, this.size, this.wraps]}`) return false;
        this.levels = levels;
        this.drawn?.update(levels[0]);
        return true;
    }

    dispose(): void {
        this.drawn?.dispose();
    }
}
const filtered = (kind: "plane" | "array" | "volume", { texels, width, height, depth }: Table, ...wraps: Wrap[]) =>
    new Texture(kind, [texels], [width, height, depth], wraps);
const wrap = (repeated?: boolean): Wrap => (repeated ? "repeat" : "clamp");
export const planeTexture = (table: Table, repeated = true) => filtered("plane", table, wrap(repeated));
export const arrayTexture = (table: Table, repeated = false) => filtered("array", table, wrap(repeated));
export const volumeTexture = (table: Table, { s, r }: { s?: boolean; r?: boolean }) => filtered("volume", table, wrap(s), "clamp", wrap(r));
export const mipmapTexture = (levels: { width: number; height: number; data: Uint16Array }[], nearest: boolean, wraps: readonly Wrap[]) =>
    new Texture("plane", levels.map(({ data }) => data), [levels[0].width, levels[0].height, 1], wraps, nearest);
export const MOST_STORED = 1024 * 2048;
export function storageTexture(vectors: Float32Array): Texture {
    const rows = Math.max(1, Math.ceil(vectors.length / 4096));
    const padded = new Float32Array(4096 * rows);
    padded.set(vectors);
    return new Texture("plane", [padded], [1024, rows, 1], [], true);
}
export const takeContent = (to: Texture, from: Texture): boolean => to.take(from);

export type GrooveTexture = BaseTexture;
export async function grooveImage(texture: BaseTexture): Promise<GrooveImage> {
    await new Promise<void>((ready) => BaseTexture.WhenAllReady([texture], ready));
    const bytes = await texture.readPixels();
    const { width, height } = texture.getSize();
    if (!(bytes instanceof Uint8Array && bytes.length === 4 * width * height)) throw new Error("grooveTexture: expected a texture of RGBA bytes");
    const wrap = (mode: number) => (Object.keys(WRAPS) as Wrap[]).find((name) => WRAPS[name] === mode)!;
    const { m } = texture.getTextureMatrix();
    const nearest = texture.samplingMode === Constants.TEXTURE_NEAREST_SAMPLINGMODE ||
        (texture.samplingMode >= Constants.TEXTURE_NEAREST_NEAREST_MIPNEAREST && texture.samplingMode <= Constants.TEXTURE_NEAREST_NEAREST_MIPLINEAR);
    return { bytes, width, height, wraps: [wrap(texture.wrapU), wrap(texture.wrapV)], nearest, uv: texture.coordinatesIndex === 0 ? "uv" : "uv2",
        uvLinear: new Vector4(m[0], m[1], m[4], m[5]), uvOffset: new Vector2(m[8], m[9]) };
}

export type Grooves = "tangent" | "radial";
/** Babylon's mesh; the others are what three's objects can be beside it. */
export type Object3D = Mesh & { readonly type?: string; isBatchedMesh?: boolean; maxInstanceCount?: number; morphTexture?: object };
export type BufferGeometry = Mesh;
export type Scene = { readonly environmentIntensity: number; readonly probe: Matrix3 };
export type InstancedMesh = Object3D;
export type BatchedMesh = Object3D & { maxInstanceCount: number };

/** By columns, as GLSL's and three's. */
const linear = ({ m }: Matrix): number[] => [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => m[i]);
const apply = (m: Matrix3, { x, y, z }: Vector): Vector =>
    new Vector(m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z);

/**
 * From Babylon's world to the space of the panorama, which is right-handed with the middle of the picture at +x: where
 * Babylon's reflections show what HDRCubeTexture has loaded.
 */
export function toProbe(scene: BabylonScene, environment: BaseTexture | null): Matrix3 {
    const r = linear((environment?.getReflectionTextureMatrix() ?? Matrix.IdentityReadOnly) as Matrix);
    const invertZ = (environment as { invertZ?: boolean } | null)?.invertZ ?? false;
    const z = scene.useRightHandedSystem === invertZ ? 1 : -1;
    return new Matrix3().fromArray(Float32Array.from([0, 3, 6].flatMap((i) => [z * r[i + 2], r[i + 1], r[i]])));
}
export const probeFromWorld = ({ probe }: Scene): Matrix3 => probe;

export const groovesOf = (mesh: Mesh): Grooves => (mesh.isVerticesDataPresent("tangent") ? "tangent" : "radial");

export function coordinatesOf(mesh: Mesh, uv: string): (vertex: number) => [number, number] {
    const data = mesh.getVerticesData(uv) ?? [];
    return (vertex) => [data[2 * vertex] ?? 0, data[2 * vertex + 1] ?? 0];
}

/** To the world: of thin instances, or of a mesh followed by those that createInstance() has made of it. */
const worldsOf = (mesh: Mesh): Matrix[] =>
    mesh.hasThinInstances ? mesh.thinInstanceGetWorldMatrices().map((own) => own.multiply(mesh.getWorldMatrix()))
        : [mesh, ...mesh.instances].map((one) => one.getWorldMatrix());

/** Each instance's vertices are a part. */
export function partsOf(mesh: Mesh, _: Mesh): { instance: number; first: number; count: number }[] {
    return worldsOf(mesh).map((_, instance) => ({ instance, first: 0, count: mesh.getTotalVertices() }));
}

export function poseOf(mesh: Mesh, _: Mesh, probe: Matrix3): Float32Array {
    return Float32Array.from([...probe, ...worldsOf(mesh).flatMap(linear)]);
}

/** Numbers that change whenever poseOf() or planeNormal() does under the same probe; null for instances, which tell of no change. */
export const poseKey = (mesh: Mesh, _: Mesh): number[] | null =>
    mesh.hasThinInstances || mesh.instances.length > 0 ? null : linear(mesh.getWorldMatrix());

const flat = new WeakMap<Mesh, Vector | null>();
/** The normal that all vertices have, to 1e-3; null for curved meshes. Looked for once for a mesh. */
function flatNormal(mesh: Mesh): Vector | null {
    if (!flat.has(mesh)) {
        const normals = mesh.getVerticesData("normal") ?? [];
        const first = Vector.FromArray(normals).normalize();
        let alike = normals.length > 0;
        for (let i = 3; alike && i < normals.length; i += 3) alike = Vector.Distance(Vector.FromArray(normals, i).normalize(), first) < 1e-3;
        flat.set(mesh, alike ? first : null);
    }
    return flat.get(mesh)!;
}

const normalMatrix = (world: Matrix): Matrix => Matrix.Transpose(Matrix.Invert(world));

/** The normal in the probe that all of a mesh has, its instances included, to `tolerance`; else null. */
export function planeNormal(mesh: Mesh, _: Mesh, probe: Matrix3, tolerance: number): Vector3 | null {
    const normal = flatNormal(mesh);
    const all = normal && worldsOf(mesh).map((world) => apply(probe, Vector.TransformNormal(normal, normalMatrix(world)).normalize()));
    return all && all.every((one) => Vector.Distance(one, all[0]) <= tolerance) ? new Vector3(...all[0].asArray()) : null;
}

/** Unit normals and grating vectors of all vertices, part after part, in the probe, as surface.vert.glsl of @rowland/three computes them. */
export function frames(mesh: Mesh, _: Mesh, probe: Matrix3, grooves: Grooves, turnOf: (vertex: number) => number) {
    const [positions, ownNormals, tangents] = ["position", "normal", "tangent"].map((kind) => mesh.getVerticesData(kind)!);
    const worlds = worldsOf(mesh);
    const [normals, gratings] = [0, 0].map(() => new Float32Array(worlds.length * ownNormals.length));
    worlds.forEach((toWorld, part) => {
        const normalToWorld = normalMatrix(toWorld);
        const mirroring = toWorld.determinant() < 0 ? -1 : 1; // inverts the cross product
        for (let i = 0; i < ownNormals.length; i += 3) {
            const [p, own] = [Vector.FromArray(positions, i), Vector.FromArray(ownNormals, i)];
            const n = Vector.TransformNormal(own, normalToWorld).normalize();
            const across = grooves === "radial" ? p.subtract(own.scale(Vector.Dot(p, own))) : Vector.FromArray(tangents, (4 * i) / 3);
            const g = Vector.TransformNormal(across, toWorld);
            const turn = turnOf(i / 3);
            const h = Vector.Cross(n, g).scale(mirroring * Math.sin(turn) * (tangents ? tangents[(4 * i) / 3 + 3] : 1));
            const turned = g.scale(Math.cos(turn)).add(h);
            const at = part * ownNormals.length + i;
            apply(probe, n).toArray(normals, at);
            apply(probe, turned.subtract(n.scale(Vector.Dot(n, turned))).normalize()).toArray(gratings, at);
        }
    });
    return { normals, gratings };
}
