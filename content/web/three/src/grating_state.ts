import {
    arrayTexture, flatNormal, grooveMap, groovesOf, Matrix3, planeTexture, rotationsOf, storageTexture, takeContent, Texture,
    Vector2, Vector3, Vector4, volumeTexture, worldFrames, worldNormal, type BufferGeometry, type GrooveMap, type Grooves,
    type Object3D, type Scene,
} from "./engine.js";
import type { Efficiencies, Rowland } from "./rowland.js";
import type { MaterialTables, Pitches, PlaneMap } from "./tasks.js";

/** How the light of a probe is shaded: a map for flat meshes, a table for curved ones, or its key lights alone. */
export type Representation = "planar" | "arc" | "direct";

export interface GratingSettings {
    rowland?: Rowland;
    /** A material file's JSON, or the object of ROWLAND_materials_diffraction. */
    grating?: object;
    /**
     * Of a grating of rigorous theory. Without them a worker computes them; scalar theory shows until then.
     * Numbers: as Tasks.solve() gives them.
     */
    efficiencies?: Efficiencies | Float32Array;
    /** By default "tangent" for meshes with tangents, else "radial". */
    grooves?: Grooves;
    /** By default "planar" for flat meshes, else "arc". */
    representation?: Representation;
    /** Varies the grooves over the surface. R: rotation / π; G: half the pitch over the grating's; 0: no grating. */
    grooveTexture?: Texture;
}

/** A material that draws a GratingState, whichever renderer it is for. */
export interface GratingOwner {
    /** A value of this name is new: programs take their list of uniforms when they are compiled. */
    valueAdded(name: string): void;
    /** `values[name].value` is another object or number. An owner's textures are disposed by the state. */
    valueChanged(name: string): void;
    /** The texture `values[name].value` has other texels, of the same size. */
    contentChanged(name: string): void;
    /** Programs are compiled again. Not called before the option ROWLAND is set. */
    optionsChanged(): void;
    /** The layer beneath the grooves, of a grating whose JSON has one. */
    layerChanged(colour: [number, number, number], roughness: number): void;
}

const BANDS = 5;
/** A plane that tilts by less keeps its map. */
const STEADY = 1e-3;
/** Number of key lights that a program has room for; it is compiled again for more. */
const KEY_LIGHTS = 16;
/** Smaller relative differences of the pitch are ignored, as by runtime/groove_map.cpp. */
const SAME_PITCH = 0.01;

// material_facts() of content/web/bake/material.cpp.
const FACT = {
    lobe: 1, gaussian: 2, pits: 4, incoherent: 7, ior: 8, zeroOrder: 9, xyzToWorking: 18, mirror: 27, base: 30, colour: 33,
    roughness: 36, hasBase: 37, rotation: 38, even: 39,
};

let states = 0;

/**
 * What a material of a grating draws with: tables, light and pose, as values by the name of their uniform and options by
 * the name that the shaders test. It knows neither a shading language nor a renderer; its owner does.
 */
export class GratingState {
    readonly values: Record<string, { value: unknown }> = {};
    /** "1" for those that are merely on. Nothing is drawn before ROWLAND is one of them. */
    readonly options = new Map<string, string>();
    /** Resolves when the kernel is there; rejects for a bad material. */
    ready: Promise<void> = Promise.resolve();
    /** Resolves when the efficiencies of its theory are there; for rigorous theory, seconds after `ready`. */
    solved: Promise<void> = Promise.resolve();
    /** Resolves when the light shown is that of the current probe and plane. */
    settled: Promise<void> = Promise.resolve();
    /** What bake() was called with. */
    grating?: object;
    rowland?: Rowland;
    tables?: MaterialTables;

    private efficiencies?: Efficiencies | Float32Array; // given, or solved
    private grooves?: Grooves;
    private representation?: Representation;
    private grooveTexture?: Texture;
    private grooveMap?: GrooveMap;
    private readonly number = ++states;
    private bakes = 0;
    private lightShown = 0;
    private hasArcTable = false;
    private mapped = false; // the light of the probe is in the picture, coarsely at least
    private normalShown?: Vector3;
    private frameShown?: Float32Array;
    private seen?: { geometry: BufferGeometry; object: Object3D }; // as it was last drawn
    private busy = false;
    private leave?: () => void;

    constructor(private readonly owner: GratingOwner) {}

    /** Takes the settings, and bakes the grating if there is one. */
    configure({ rowland, grating, efficiencies, ...others }: GratingSettings): void {
        Object.assign(this, others);
        if (rowland && grating) this.bake(rowland, grating, efficiencies);
    }

    /** What configure() needs to give another material the same grating. */
    get settings(): GratingSettings {
        const { rowland, grating, efficiencies, grooves, representation, grooveTexture } = this;
        return { rowland, grating, efficiencies, grooves, representation, grooveTexture };
    }

    /** Sets the grating, also another one on the same mesh, as sliders do. */
    bake(rowland: Rowland, grating: object, efficiencies?: Efficiencies | Float32Array): void {
        this.rowland = rowland;
        this.grating = grating;
        this.efficiencies = efficiencies;
        this.ready = rowland.material(this.number, grating, efficiencies).then((tables) => this.setKernel(tables));
        const bake = ++this.bakes;
        this.solved = this.ready.then(() => this.solve(grating, () => bake === this.bakes));
        this.solved.catch((error: Error) => rowland.onError(error));
        this.leave ??= rowland.follow(() => this.follow());
    }

    dispose(): void {
        this.leave?.();
        this.leave = undefined;
        for (const { value } of Object.values(this.values)) (value as Partial<Texture> | undefined)?.dispose?.();
    }

    private async solve(grating: object, isCurrent: () => boolean): Promise<void> {
        const { relief } = this.tables!;
        if (relief[0] === 0 || !isCurrent()) return; // there is nothing to solve
        const efficiencies = await this.rowland!.solve(relief, isCurrent);
        if (!efficiencies || !isCurrent()) return;
        this.efficiencies = efficiencies;
        this.setKernel(await this.rowland!.material(this.number, grating, efficiencies));
    }

    private set(name: string, value: unknown): void {
        const old = this.values[name];
        if (!old) {
            this.values[name] = { value };
            return this.owner.valueAdded(name);
        }
        if (old.value instanceof Texture && value instanceof Texture && takeContent(old.value, value)) return this.owner.contentChanged(name);
        (old.value as Partial<Texture> | undefined)?.dispose?.();
        old.value = value;
        this.owner.valueChanged(name);
    }

    private option(name: string, value: string | undefined): void {
        if (this.options.get(name) === value) return;
        if (value === undefined) this.options.delete(name);
        else this.options.set(name, value);
        if (this.options.has("ROWLAND")) this.owner.optionsChanged(); // each change compiles a program
    }

    private flag(name: string, on: boolean): void {
        this.option(name, on ? "1" : undefined);
    }

    private setKernel(tables: MaterialTables): void {
        const { facts, kernel, views, kernelUniforms } = tables;
        const vector = (at: number) => new Vector3().fromArray(facts, at);
        const matrix = (at: number) => new Matrix3().fromArray(facts, at);
        this.tables = tables;
        this.lightShown = 0;
        this.hasArcTable = this.mapped = false;
        this.normalShown = this.frameShown = undefined;
        this.set("kernel_table", views > 1 ? volumeTexture(kernel, {}) : arrayTexture(kernel));
        const scale = new Vector4().fromArray(kernelUniforms, 0);
        scale.w *= kernel.scale;
        this.set("kernel_scale_bias", scale);
        this.set("kernel_rows", new Vector2().fromArray(kernelUniforms, 4));
        this.set("kernel_reach", new Vector2().fromArray(kernelUniforms, 6));
        this.set("kernel_views", new Vector3().fromArray(kernelUniforms, 8));
        this.set("lobe_gaussian", new Vector2().fromArray(facts, FACT.gaussian));
        this.set("pit_length_over_wavelength", vector(FACT.pits));
        this.set("incoherent", facts[FACT.incoherent]);
        this.set("cover_square", facts[FACT.ior] ** 2);
        this.set("zero_order", matrix(FACT.zeroOrder));
        this.set("xyz_to_working", matrix(FACT.xyzToWorking));
        this.set("mirror_weight", vector(FACT.mirror));
        this.set("base_weight", vector(FACT.base));
        const turn = facts[FACT.rotation];
        this.set("groove_turn", new Vector2(Math.cos(turn), Math.sin(turn)));
        this.set("light_scale", 1);
        if (facts[FACT.hasBase] === 1)
            this.owner.layerChanged([facts[FACT.colour], facts[FACT.colour + 1], facts[FACT.colour + 2]], facts[FACT.roughness]);
        this.flag("LOBE_GAUSSIAN", facts[FACT.lobe] === 1);
        this.flag("LOBE_PITS", facts[FACT.lobe] === 2);
        this.flag("KERNEL_VIEWS", views > 1);
        this.flag("COVER", facts[FACT.ior] > 0);
        this.flag("ZERO_ORDER", facts.subarray(FACT.zeroOrder, FACT.zeroOrder + 9).some((x) => x !== 0));
        if (!this.values.key_lobes) this.setLight(new Float32Array());
        if (this.grooveTexture) this.setGrooveMap(this.grooveTexture, facts[FACT.even] === 1);
        if (!this.rowland!.hasLight) this.flag("ROWLAND", true); // else with the first map or table
        this.follow();
        if (this.options.has("ROWLAND")) this.rowland!.onUpdate();
    }

    private setGrooveMap(texture: Texture, even: boolean): void {
        const sparkle = (this.grating as { grooveTexture?: { sparkle?: boolean } }).grooveTexture?.sparkle ?? false;
        const map = (this.grooveMap = grooveMap(texture, even, sparkle));
        if (this.pitches && !this.flatLobe && this.representation !== "direct")
            throw new Error(`grooveTexture: pitches of ${map.smallest.toPrecision(3)} to ${map.largest.toPrecision(3)} times pitch_nm ` +
                'with a groove_lobe that is not flat; expected the flat groove_lobe or the representation "direct"');
        this.set("groove_map", map.moments);
        this.set("groove_map_rest", map.rest);
        this.set("groove_uv_linear", map.uvLinear);
        this.set("groove_uv_offset", map.uvOffset);
        this.set("groove_pitch", map.smallest);
        this.option("ROWLAND_GROOVE_UV", map.uv);
        this.flag("GROOVE_GAPS", map.gaps);
        this.flag("GROOVES_EVEN", even);
    }

    /** Of a groove texture, if it varies them; else null. */
    private get pitches(): Pitches | null {
        if (!this.grooveMap) return null;
        const { smallest, largest } = this.grooveMap;
        const varies = smallest < 1 - SAME_PITCH || largest > 1 + SAME_PITCH;
        return varies ? [Math.min(smallest, largest * (1 - SAME_PITCH)), largest] : null;
    }

    private setLight(keyLobes: Float32Array): void {
        const count = keyLobes.length / 28;
        const room = Math.max(count, KEY_LIGHTS);
        this.option("ROWLAND_MAXIMUM_KEY_LOBES", String(room));
        const names = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
        this.set("key_lobe_count", new Vector4(count));
        this.set("key_lobes", Array.from({ length: room }, (_, light) => Object.fromEntries(names.map((name, i) =>
            [name, light < count ? new Vector4().fromArray(keyLobes, 28 * light + 4 * i) : new Vector4()]))));
    }

    private setPlane({ e1, e2, axes, halfTurn, pitch, table }: PlaneMap): void {
        this.set("planar_e1", new Vector3(...e1));
        this.set("planar_e2", new Vector3(...e2));
        this.set("map_scale", table.scale);
        if (axes) {
            this.set("lobe_map", volumeTexture(table, { r: !halfTurn }));
            this.set("lobe_map_axes", new Vector4(...axes));
        } else {
            this.set("planar_map", pitch ? volumeTexture(table, { s: true }) : planeTexture(table));
            if (pitch) this.set("pitch_scale_bias", new Vector2(...pitch));
            this.set("planar_map_half_texel", new Vector2(0.5 / table.width, 0.5 / table.height));
        }
        this.flag("LOBE_MAP", axes !== null);
        this.flag("HALF_TURN", halfTurn);
        this.flag("PITCH_AXIS", pitch !== null);
        this.flag("ROWLAND_PLANAR", true);
    }

    private get flatLobe(): boolean {
        return this.tables!.facts[FACT.lobe] === 0;
    }

    /** `show`: called just before the first map is shown. */
    private async showPlane(normal: Vector3, show: () => void): Promise<void> {
        const rowland = this.rowland!;
        this.normalShown = normal;
        const details = rowland.preview ? (["coarse"] as const) : (["coarse", "full"] as const);
        for (const detail of details) {
            const map = await rowland.plane(this.number, normal.toArray(), this.flatLobe, this.pitches, detail);
            if (detail === "coarse") show();
            this.setPlane(map);
            rowland.onUpdate();
        }
    }

    private async showArc(geometry: BufferGeometry, object: Object3D, show: () => void): Promise<void> {
        const rowland = this.rowland!;
        const pitches = this.pitches;
        this.frameShown = Float32Array.from(object.matrixWorld.elements);
        const turn = this.rotation;
        const turns = this.grooveMap && rotationsOf(this.grooveMap, this.grooveTexture!, geometry);
        const { normals, gratings } = worldFrames(geometry, object, this.groovesOf(geometry), (i) => turn + (turns?.[i] ?? 0));
        if (!this.hasArcTable) {
            const { tables } = this;
            const arc = await rowland.arc(this.number, BANDS, pitches);
            if (tables !== this.tables) return; // of the grating before
            this.hasArcTable = true;
            this.set("packed_table", arrayTexture(arc.weights, arc.mapping === 0));
            this.set("table_range", storageTexture(Float32Array.from({ length: 8 * arc.layers }, (_, i) => (i % 8 < 4 ? 1 : 0))));
            if (pitches) this.set("pitch_scale_bias", new Vector2(...arc.pitch));
            this.option("VIEW_MAPPING", String(arc.mapping));
            this.option("TABLE_COLUMNS", String(arc.weights.width));
            this.option("TABLE_ROWS", String(arc.weights.height));
            this.option("LAYERS", String(arc.layers));
        }
        const products = await rowland.products(this.number, BANDS, pitches, normals, gratings);
        show();
        this.set("vertex_products", storageTexture(products));
        this.flag("PITCH_AXIS", pitches !== null);
        this.flag("ROWLAND_ARC", true);
        rowland.onUpdate();
    }

    /** Updates the map or table for the light and the object's pose, and the key lights together with it. */
    private async settle(geometry: BufferGeometry, object: Object3D): Promise<void> {
        const rowland = this.rowland!;
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
        const flat = flatNormal(geometry);
        // A flat mesh has a map even under a groove texture: a table's products are per vertex and would miss the
        // texture.
        const kind = this.representation ?? (flat ? "planar" : "arc");
        if (kind === "planar" && flat) return this.showPlane(worldNormal(flat, object), show);
        if (kind !== "direct" && rowland.preview) return; // a table waits for the key lights
        if (kind !== "direct") return this.showArc(geometry, object, show);
        show();
        rowland.onUpdate();
    }

    private isSettled({ geometry, object }: { geometry: BufferGeometry; object: Object3D }): boolean {
        if (this.lightShown !== this.rowland!.lightVersion) return false;
        if (this.normalShown) return worldNormal(flatNormal(geometry)!, object).distanceTo(this.normalShown) < STEADY;
        if (this.frameShown) return this.frameShown.every((x, i) => Math.abs(x - object.matrixWorld.elements[i]) < STEADY);
        return true;
    }

    /** Asks for what the picture lacks, once the material has been drawn. */
    private follow(): void {
        if (!this.tables || !this.seen || this.busy || this.rowland!.lightVersion === 0 || this.isSettled(this.seen)) return;
        this.busy = true;
        const failed = (error: Error) => this.rowland!.onError(error);
        this.settled = this.settle(this.seen.geometry, this.seen.object).catch(failed).finally(() => {
            this.busy = false;
            this.follow();
        });
    }

    /** To be called before the owner's material is drawn. */
    see(scene: Scene, geometry: BufferGeometry, object: Object3D): void {
        this.seen = { geometry, object };
        if (!this.tables || !this.rowland) return;
        this.leave ??= this.rowland.follow(() => this.follow()); // also after dispose(), as three's materials
        if (this.values.light_scale.value !== scene.environmentIntensity) this.set("light_scale", scene.environmentIntensity);
        this.flag("ROWLAND_RADIAL", this.groovesOf(geometry) === "radial");
        this.follow();
    }

    /** Whether reference() shows its grooves: not those of a texture, which vary within a pixel. */
    get hasReference(): boolean {
        return this.grooveTexture === undefined;
    }

    /** Whether the picture has the light of the probe; maps are coarse at first. */
    get lit(): boolean {
        return this.mapped;
    }

    /** Draws the light that the grooves diffract, alone: to compare it with reference(). */
    get diffractionOnly(): boolean {
        return this.options.has("ROWLAND_DIFFRACTION_ONLY");
    }
    set diffractionOnly(on: boolean) {
        this.flag("ROWLAND_DIFFRACTION_ONLY", on);
    }

    /**
     * The ground truth under the probe, linear Rec.709: a sum over wavelengths along arcs of the probe's texels, without
     * tables. Nine numbers per point, as pointFrame() gives them. Takes milliseconds per point.
     */
    async reference(points: Float32Array): Promise<Float32Array> {
        await this.solved;
        return this.rowland!.reference(this.number, points);
    }

    /** Radians from the tangent toward the bitangent, of a material without a groove texture. */
    get rotation(): number {
        return this.tables!.facts[FACT.rotation];
    }

    groovesOf(geometry: BufferGeometry): Grooves {
        return this.grooves ?? groovesOf(geometry);
    }

    /** Texture look-ups per pixel for the light of the probe without its key lights. */
    get price(): { map: number } {
        return { map: this.options.has("ROWLAND_ARC") ? Number(this.options.get("LAYERS")) : this.representation === "direct" ? 0 : 1 };
    }
}
