import {
    Matrix3, partsOf, planeNormal, planeTexture, poseKey, poseOf, storageTexture, takeContent, Texture, Vector2, Vector3, Vector4,
    volumeTexture, type BatchedMesh, type BufferGeometry, type InstancedMesh, type Object3D,
} from "./engine.js";
import type { PlaneMap } from "./tasks.js";

/** How the light of a probe is shaded: a map for flat meshes, a table for curved ones, or its key lights alone. */
export type Representation = "planar" | "arc" | "direct";

/** A plane that tilts by less keeps its map. */
const STEADY = 1e-3;

/** A mesh that a material is drawn on: what of the light is its own, and of which pose that is. */
export class Surface {
    /** By the name of their uniform. */
    readonly values: Record<string, unknown> = {};
    /** What `values` are for; none until the first map or table. */
    shown?: Representation;
    /** Rowland.lightVersion of `values`. */
    light = 0;
    /** Of a flat mesh, in the probe, as it was last drawn; of instances, if it is one. */
    normal: Vector3 | null = null;
    /** Of all instances together. */
    vertices = 0;
    /** Whether its instances have morphs of their own. */
    ownMorphs = false;
    /** Whether it has been drawn since its light was asked for. */
    drawn = true;
    readonly toProbe = new Matrix3();
    private asked?: { light: number; kind: Representation; normal: Vector3 | null };
    private complete = false; // its map is the full one
    private pose: Float32Array = new Float32Array();
    private key: readonly number[] | null = null; // of the pose that it was last drawn in
    private stands?: boolean; // whether that is `pose`

    constructor(readonly object: Object3D, readonly geometry: BufferGeometry) {}

    /** It is about to be drawn. `toProbe`: from the world. True if its representation may be another one. */
    see(toProbe: Matrix3): boolean {
        this.drawn = true;
        const { object, geometry, key, normal, vertices, ownMorphs } = this;
        this.key = poseKey(object, geometry);
        if (this.key?.length === key?.length && this.key?.every((x, i) => x === key![i]) && toProbe.equals(this.toProbe)) return false;
        this.stands = undefined;
        this.toProbe.copy(toProbe);
        this.normal = planeNormal(object, geometry, this.toProbe, STEADY);
        this.vertices = partsOf(object, geometry).reduce((sum, { count }) => sum + count, 0);
        this.ownMorphs = Boolean((object as Partial<InstancedMesh>).morphTexture);
        return !this.normal !== !normal || this.vertices !== vertices || this.ownMorphs !== ownMorphs;
    }

    /** Its light is asked for, as it stands. */
    ask(light: number, kind: Representation): void {
        this.drawn = false;
        this.asked = { light, kind, normal: kind === "planar" ? this.normal : null };
        this.complete = false;
        this.pose = poseOf(this.object, this.geometry, this.toProbe);
        this.stands = undefined;
    }

    forget(): void {
        this.asked = undefined;
    }

    isSettled(light: number, kind: Representation): boolean {
        const { asked, pose } = this;
        if (!asked || asked.light !== light || asked.kind !== kind) return false;
        if (kind === "direct") return true;
        if (asked.normal) return this.normal !== null && this.normal.distanceTo(asked.normal) < STEADY;
        const isNear = (now: Float32Array) => now.length === pose.length && pose.every((x, i) => Math.abs(x - now[i]) < STEADY);
        return (this.stands ??= isNear(poseOf(this.object, this.geometry, this.toProbe)));
    }

    /** Its values, which are a map or a table, are there. */
    show(kind: Representation, light: number, complete = true): void {
        this.shown = kind;
        this.light = light;
        this.complete = complete;
    }

    /** Whether its map is that of the other's plane under the same light. */
    facesAs({ asked }: Surface): boolean {
        return this.complete && this.shown === "planar" && this.asked?.normal !== null && asked?.normal !== null && this.light === asked!.light &&
            this.asked?.light === asked!.light && this.asked.normal.distanceTo(asked!.normal) < STEADY;
    }

    /** `shared`: whether another surface shows this texture. True if the old texture has got the new one's texels. */
    set(name: string, value: unknown, shared: (texture: Texture) => boolean): boolean {
        const old = this.values[name];
        if (old instanceof Texture && value instanceof Texture && !shared(old) && takeContent(old, value)) return true;
        this.values[name] = value;
        return false;
    }
}

/** Of a map, as planar_map.glsl reads it. */
export function planeValues({ e1, e2, axes, pitch, halfTurn, table }: PlaneMap): Record<string, unknown> {
    const values: Record<string, unknown> = { planar_e1: new Vector3(...e1), planar_e2: new Vector3(...e2), map_scale: table.scale };
    if (axes) return { ...values, lobe_map: volumeTexture(table, { r: !halfTurn }), lobe_map_axes: new Vector4(...axes) };
    values.planar_map = pitch ? volumeTexture(table, { s: true }) : planeTexture(table);
    if (pitch) values.pitch_scale_bias = new Vector2(...pitch);
    values.planar_map_half_texel = new Vector2(0.5 / table.width, 0.5 / table.height);
    return values;
}

/** Of products, as surface.vert.glsl finds those of a vertex of an instance. */
export function productValues({ object, geometry }: Surface, products: Float32Array): Record<string, unknown> {
    const values: Record<string, unknown> = { vertex_products: storageTexture(products), products_stride: partsOf(object, geometry)[0]?.count ?? 0 };
    if ((object as Partial<BatchedMesh>).isBatchedMesh) {
        const firsts = new Float32Array(4 * (object as BatchedMesh).maxInstanceCount);
        let before = 0;
        for (const { instance, first, count } of partsOf(object, geometry)) {
            firsts[4 * instance] = before - first;
            before += count;
        }
        values.products_first = storageTexture(firsts);
    }
    return values;
}
