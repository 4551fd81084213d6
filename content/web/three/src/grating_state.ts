import type { Efficiencies, Rowland } from "./rowland.js";
import type { MaterialTables, PlaneMap, Table } from "./tasks.js";

/** How the light of a probe is shaded: a map for flat meshes, a table for curved ones, or its key lights alone. */
export type Representation = "planar" | "arc" | "direct";

/** A texture of halves, filtered; clamped but for the axes that repeat. `kind`: its sampler. */
export interface TableTexture {
    readonly kind: "2d" | "array" | "3d";
    readonly table: Table;
    readonly repeats: string; // of "s" and "r"
}
/** STORAGE of dialect.glsl: vec4s in rows of 1024 texels, read unfiltered. */
export interface VectorTexture {
    readonly kind: "vectors";
    readonly vectors: Float32Array;
}
export type Value = number | ArrayLike<number> | TableTexture | VectorTexture;

/** A mesh as it is drawn, in the space of the probe. */
export interface Surface {
    /** The normal that all vertices have; null for curved meshes. */
    readonly normal: readonly number[] | null;
    /** Numbers that change with the pose. */
    readonly pose: ArrayLike<number>;
    /** Normals and grating vectors of all vertices. `turn`: radians from the tangent toward the bitangent. */
    frames(turn: number): { normals: Float32Array; gratings: Float32Array };
}

const BANDS = 5;
/** A plane that tilts by less keeps its map. */
const STEADY = 1e-3;
/** Number of key lights that a program has room for; it is compiled again for more. */
const KEY_LIGHTS = 16;

// material_facts() of content/web/bake/material.cpp.
const FACT = {
    lobe: 1, gaussian: 2, pits: 4, incoherent: 7, ior: 8, zeroOrder: 9, xyzToWorking: 18, mirror: 27, base: 30, colour: 33,
    roughness: 36, hasBase: 37, rotation: 38, even: 39,
};

let states = 0;

export class GratingState {
    ready: Promise<void> = Promise.resolve();
    solved: Promise<void> = Promise.resolve();
    settled: Promise<void> = Promise.resolve();
    readonly values = new Map<string, Value>();
    readonly options = new Map<string, string | undefined>();
    representation?: Representation;
    efficiencies?: Efficiencies | Float32Array;
    readonly number = ++states;
    private bakes = 0;
    tables?: MaterialTables;
    private lightShown = 0;
    private hasArcTable = false;
    private mapped = false;
    private normalShown?: readonly number[];
    private frameShown?: Float32Array;
    private seen?: Surface;
    private busy = false;
    leave?: () => void;

    constructor(readonly rowland: Rowland, private readonly onValue: (name: string) => void, private readonly onOptions: () => void,
        private readonly onBase: (colour: number[], roughness: number) => void) {}

    bake(grating: object, efficiencies?: Efficiencies | Float32Array): void {
        const { rowland } = this;
        this.efficiencies = efficiencies;
        this.ready = rowland.material(this.number, grating, efficiencies).then((tables) => this.setKernel(tables));
        const bake = ++this.bakes;
        this.solved = this.ready.then(() => this.solve(grating, () => bake === this.bakes));
        this.solved.catch((error: Error) => rowland.onError(error));
        this.leave ??= rowland.follow(() => this.follow());
    }

    private async solve(grating: object, isCurrent: () => boolean): Promise<void> {
        const { relief } = this.tables!;
        if (relief[0] === 0 || !isCurrent()) return;
        const efficiencies = await this.rowland.solve(relief, isCurrent);
        if (!efficiencies || !isCurrent()) return;
        this.efficiencies = efficiencies;
        this.setKernel(await this.rowland.material(this.number, grating, efficiencies));
    }

    set(name: string, value: Value): void {
        this.values.set(name, value);
        this.onValue(name);
    }

    define(name: string, value: string | undefined): void {
        if (this.options.get(name) === value) return;
        this.options.set(name, value);
        if (this.options.get("ROWLAND")) this.onOptions();
    }

    flag(name: string, on: boolean): void {
        this.define(name, on ? "1" : undefined);
    }

    private setKernel(tables: MaterialTables): void {
        const { facts, kernel, views, kernelUniforms } = tables;
        const part = (at: number, count: number) => facts.slice(at, at + count);
        this.tables = tables;
        this.lightShown = 0;
        this.hasArcTable = this.mapped = false;
        this.normalShown = this.frameShown = undefined;
        this.set("kernel_table", { kind: views > 1 ? "3d" : "array", table: kernel, repeats: "" });
        const scale = kernelUniforms.slice(0, 4);
        scale[3] *= kernel.scale;
        this.set("kernel_scale_bias", scale);
        this.set("kernel_rows", kernelUniforms.slice(4, 6));
        this.set("kernel_reach", kernelUniforms.slice(6, 8));
        this.set("kernel_views", kernelUniforms.slice(8, 11));
        this.set("lobe_gaussian", part(FACT.gaussian, 2));
        this.set("pit_length_over_wavelength", part(FACT.pits, 3));
        this.set("incoherent", facts[FACT.incoherent]);
        this.set("cover_square", facts[FACT.ior] ** 2);
        this.set("zero_order", part(FACT.zeroOrder, 9));
        this.set("xyz_to_working", part(FACT.xyzToWorking, 9));
        this.set("mirror_weight", part(FACT.mirror, 3));
        this.set("base_weight", part(FACT.base, 3));
        const turn = facts[FACT.rotation];
        this.set("groove_turn", [Math.cos(turn), Math.sin(turn)]);
        this.set("light_scale", 1);
        if (facts[FACT.hasBase] === 1) this.onBase([...part(FACT.colour, 3)], facts[FACT.roughness]);
        this.flag("LOBE_GAUSSIAN", facts[FACT.lobe] === 1);
        this.flag("LOBE_PITS", facts[FACT.lobe] === 2);
        this.flag("KERNEL_VIEWS", views > 1);
        this.flag("COVER", facts[FACT.ior] > 0);
        this.flag("ZERO_ORDER", part(FACT.zeroOrder, 9).some((x) => x !== 0));
        if (!this.values.has("key_lobe_count")) this.setLight(new Float32Array());
        if (!this.rowland.hasLight) this.flag("ROWLAND", true); // else with the first map or table
        this.follow();
        if (this.options.get("ROWLAND")) this.rowland.onUpdate();
    }

    private setLight(keyLobes: Float32Array): void {
        const count = keyLobes.length / 28;
        this.define("ROWLAND_MAXIMUM_KEY_LOBES", String(Math.max(count, KEY_LIGHTS)));
        this.set("key_lobe_count", [count, count, count, count]);
        const names = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
        for (let light = 0; light < count; ++light)
            names.forEach((name, i) => this.set(`key_lobes[${light}].${name}`, keyLobes.slice(28 * light + 4 * i, 28 * light + 4 * i + 4)));
    }

    private setPlane({ e1, e2, axes, halfTurn, pitch, table }: PlaneMap): void {
        this.set("planar_e1", e1);
        this.set("planar_e2", e2);
        this.set("map_scale", table.scale);
        if (axes) {
            this.set("lobe_map", { kind: "3d", table, repeats: halfTurn ? "" : "r" });
            this.set("lobe_map_axes", axes);
        } else {
            this.set("planar_map", { kind: pitch ? "3d" : "2d", table, repeats: "s" });
            if (pitch) this.set("pitch_scale_bias", pitch);
            this.set("planar_map_half_texel", [0.5 / table.width, 0.5 / table.height]);
        }
        this.flag("LOBE_MAP", axes !== null);
        this.flag("HALF_TURN", halfTurn);
        this.flag("PITCH_AXIS", pitch !== null);
        this.flag("ROWLAND_PLANAR", true);
    }

    private get flatLobe(): boolean {
        return this.tables!.facts[FACT.lobe] === 0;
    }

    private async showPlane(normal: readonly number[], show: () => void): Promise<void> {
        const { rowland } = this;
        this.normalShown = normal;
        const details = rowland.preview ? (["coarse"] as const) : (["coarse", "full"] as const);
        for (const detail of details) {
            const map = await rowland.plane(this.number, [...normal], this.flatLobe, null, detail);
            if (detail === "coarse") show();
            this.setPlane(map);
            rowland.onUpdate();
        }
    }

    private async showArc(surface: Surface, show: () => void): Promise<void> {
        const { rowland } = this;
        this.frameShown = Float32Array.from(surface.pose);
        const { normals, gratings } = surface.frames(this.tables!.facts[FACT.rotation]);
        if (!this.hasArcTable) {
            const { tables } = this;
            const arc = await rowland.arc(this.number, BANDS, null);
            if (tables !== this.tables) return; // of the grating before
            this.hasArcTable = true;
            this.set("packed_table", { kind: "array", table: arc.weights, repeats: arc.mapping === 0 ? "s" : "" });
            this.set("table_range", { kind: "vectors", vectors: Float32Array.from({ length: 8 * arc.layers }, (_, i) => (i % 8 < 4 ? 1 : 0)) });
            this.define("VIEW_MAPPING", String(arc.mapping));
            this.define("TABLE_COLUMNS", String(arc.weights.width));
            this.define("TABLE_ROWS", String(arc.weights.height));
            this.define("LAYERS", String(arc.layers));
        }
        const products = await rowland.products(this.number, BANDS, null, normals, gratings);
        show();
        this.set("vertex_products", { kind: "vectors", vectors: products });
        this.flag("ROWLAND_ARC", true);
        rowland.onUpdate();
    }

    private async settle(surface: Surface): Promise<void> {
        const { rowland } = this;
        let keyLobes: Float32Array | undefined;
        if (this.lightShown !== rowland.lightVersion) {
            this.lightShown = rowland.lightVersion;
            this.mapped = false;
            this.normalShown = this.frameShown = undefined;
            keyLobes = await rowland.keyLobes();
        }
        const show = () => {
            if (keyLobes) this.setLight(keyLobes);
            this.flag("ROWLAND", true);
            this.mapped = true;
        };
        const { normal } = surface;
        const kind = this.representation ?? (normal ? "planar" : "arc");
        if (kind === "planar" && normal) return this.showPlane(normal, show);
        if (kind !== "direct" && rowland.preview) return; // a table waits for the key lights
        if (kind !== "direct") return this.showArc(surface, show);
        show();
        rowland.onUpdate();
    }

    private isSettled({ normal, pose }: Surface): boolean {
        const near = (a: ArrayLike<number>, b: ArrayLike<number>) => Array.from(a).every((x, i) => Math.abs(x - b[i]) < STEADY);
        if (this.lightShown !== this.rowland.lightVersion) return false;
        if (this.normalShown) return normal !== null && near(normal, this.normalShown);
        if (this.frameShown) return near(this.frameShown, pose);
        return true;
    }

    private follow(): void {
        if (!this.tables || !this.seen || this.busy || this.rowland.lightVersion === 0 || this.isSettled(this.seen)) return;
        this.busy = true;
        this.settled = this.settle(this.seen).catch((error: Error) => this.rowland.onError(error)).finally(() => {
            this.busy = false;
            this.follow();
        });
    }

    see(surface: Surface): void {
        this.seen = surface;
        this.follow();
    }
}
