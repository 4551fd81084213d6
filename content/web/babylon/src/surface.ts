import { Matrix } from "@babylonjs/core/Maths/math.vector.js";
import type { BaseTexture } from "@babylonjs/core/Materials/Textures/baseTexture.js";
import type { AbstractMesh } from "@babylonjs/core/Meshes/abstractMesh.js";
import type { Scene } from "@babylonjs/core/scene.js";
import type { Surface } from "../../three/src/grating_state.js";

/** Which way g, across the grooves, points on a mesh: along its tangents, or away from its origin as on a disc. */
export type Grooves = "tangent" | "radial";

type Vector = [number, number, number];
/** By columns. */
type Matrix3 = readonly number[];

const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (a: Vector, t: number, b: Vector): Vector => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];
const unit = (a: Vector): Vector => sum([0, 0, 0], 1 / Math.sqrt(dot(a, a)), a);
const column = (m: Matrix3, i: number): Vector => [m[3 * i], m[3 * i + 1], m[3 * i + 2]];
const apply = (m: Matrix3, [x, y, z]: Vector): Vector => sum(sum(sum([0, 0, 0], x, column(m, 0)), y, column(m, 1)), z, column(m, 2));
const linear = (m: { readonly m: ArrayLike<number> }): Matrix3 => [0, 1, 2, 4, 5, 6, 8, 9, 10].map((i) => m.m[i]);
const at = (data: ArrayLike<number>, vertex: number, size = 3): Vector => [data[size * vertex], data[size * vertex + 1], data[size * vertex + 2]];

/**
 * From Babylon's world to the space of the panorama, which is right-handed with the middle of the picture at +x: where
 * Babylon's reflections show a panorama that HDRCubeTexture has loaded.
 */
export function toProbe(scene: Scene, environment: BaseTexture | null): Matrix3 {
    const rotation = linear(environment?.getReflectionTextureMatrix() ?? Matrix.IdentityReadOnly);
    const invertZ = (environment as { invertZ?: boolean } | null)?.invertZ ?? false;
    const z = scene.useRightHandedSystem === invertZ ? 1 : -1;
    return [0, 1, 2].flatMap((i) => [z * rotation[3 * i + 2], rotation[3 * i + 1], rotation[3 * i]]);
}

/** A mesh in the panorama's space, as surface.vert.glsl has it. */
export class MeshSurface implements Surface {
    private readonly flat: Vector | null;

    constructor(private readonly mesh: AbstractMesh, private readonly grooves: Grooves, private readonly probe: () => Matrix3) {
        const normals = mesh.getVerticesData("normal") ?? [];
        const first = unit(at(normals, 0));
        let flat = normals.length > 0;
        for (let i = 1; flat && i < normals.length / 3; ++i) flat = Math.hypot(...sum(unit(at(normals, i)), -1, first)) < 1e-3;
        this.flat = flat ? first : null;
    }

    private get transform() {
        const world = linear(this.mesh.getWorldMatrix());
        const columns = [0, 1, 2].map((i) => column(world, i)) as [Vector, Vector, Vector];
        const cofactors = [cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])];
        // A mirroring transform inverts cross products.
        const hand = dot(columns[0], cofactors[0]) < 0 ? -1 : 1;
        return { world, hand, normals: cofactors.flatMap((v) => v.map((x) => hand * x)), probe: this.probe() };
    }

    get pose(): Matrix3 {
        const { world, probe } = this.transform;
        return [0, 1, 2].flatMap((i) => apply(probe, column(world, i)));
    }

    get normal(): Vector | null {
        const { normals, probe } = this.transform;
        return this.flat && unit(apply(probe, apply(normals, this.flat)));
    }

    frames(turn: number): { normals: Float32Array; gratings: Float32Array } {
        const { world, hand, normals, probe } = this.transform;
        const [positions, ownNormals, tangents] = ["position", "normal", "tangent"].map((kind) => this.mesh.getVerticesData(kind)!);
        const frames = { normals: new Float32Array(ownNormals.length), gratings: new Float32Array(ownNormals.length) };
        for (let i = 0; i < ownNormals.length / 3; ++i) {
            const [p, own] = [at(positions, i), at(ownNormals, i)];
            const n = unit(apply(normals, own));
            const g = apply(world, this.grooves === "radial" ? sum(p, -dot(p, own), own) : at(tangents, i, 4));
            const h = cross(n, g);
            const w = hand * (tangents ? tangents[4 * i + 3] : 1);
            const turned = sum(sum([0, 0, 0], Math.cos(turn), g), w * Math.sin(turn), h);
            frames.normals.set(apply(probe, n), 3 * i);
            frames.gratings.set(apply(probe, unit(sum(turned, -dot(turned, n), n))), 3 * i);
        }
        return frames;
    }
}
