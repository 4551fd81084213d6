import {
    arrayTexture, coordinatesOf, frames, grooveImage, groovesOf, Matrix3, MOST_STORED, probeFromWorld, storageTexture, takeContent, Texture,
    Vector2, Vector3, Vector4, volumeTexture, type BufferGeometry, type Grooves, type GrooveTexture, type Object3D, type Scene,
} from "./engine.js";
import { grooveMap, rotationAt, type GrooveImage, type GrooveMap } from "./groove_map.js";
import type { Efficiencies, Rowland } from "./rowland.js";
import { planeValues, productValues, Surface, type Representation } from "./surface.js";
import { RANK, type MaterialTables, type Pitches } from "./tasks.js";

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
    grooveTexture?: GrooveTexture;
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
    /** Loads what its programs need for the option GROOVE_SPARKLE, which few gratings have. */
    loadSparkle?(): Promise<void>;
    /** The layer beneath the grooves, of a grating whose JSON has one. */
    layerChanged(colour: [number, number, number], roughness: number): void;
}

const BANDS = 5;
/** Number of key lights that a program has room for; it is compiled again for more. */
const KEY_LIGHTS = 16;
/** Vertices of a mesh and its instances whose products a texture holds. */
const MOST_VERTICES = Math.floor((4 * MOST_STORED) / (3 * RANK));
/** Meshes that keep their light; of more, those that were drawn last. */
const SURFACES = 256;
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
    private grooveTexture?: GrooveTexture;
    private grooveMap?: GrooveMap;
    private readonly number = ++states;
    private bakes = 0;
    private hasArcTable = false;
    private arcPitch: Record<string, unknown> = {};
    private disposed = false;
    private readonly surfaces = new Map<Object3D, Surface>(); // the last drawn at the end
    private keyLobes?: { light: number; values: Promise<Record<string, unknown>> };
    private busy = false;
    private readonly told = new Set<string>();
    private leave?: () => void;

    constructor(private readonly owner: GratingOwner) {}

    /** Takes the settings, and bakes the grating if there is one. */
    configure({ rowland, grating, efficiencies, ...others }: GratingSettings): void {
        Object.assign(this, others, grating && { grating });
        this.knownKind = undefined;
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
        const image = this.grooveTexture && grooveImage(this.grooveTexture);
        this.ready = Promise.all([rowland.material(this.number, grating, efficiencies), image])
            .then(([tables, image]) => this.take(tables, image, () => !this.disposed));
        const bake = ++this.bakes;
        this.solved = this.ready.then(() => this.solve(grating, () => bake === this.bakes));
        this.solved.catch((error: Error) => rowland.onError(error));
        this.disposed = false;
        this.leave ??= rowland.follow(() => this.follow());
    }

    /** Releases what textures and workers hold. As three's materials it can be drawn after that, and is baked again. */
    dispose(): void {
        this.leave?.();
        this.leave = undefined;
        this.disposed = true;
        this.bakes += 1; // a solve that is under way is of no use
        this.tables = undefined;
        this.surfaces.clear();
        for (const { value } of Object.values(this.values)) if (value instanceof Texture) value.dispose();
        this.sweep();
        this.rowland?.release(this.number);
    }

    private async solve(grating: object, isCurrent: () => boolean): Promise<void> {
        if (!isCurrent()) return;
        const { relief } = this.tables!;
        if (relief[0] === 0) return; // there is nothing to solve
        const efficiencies = await this.rowland!.solve(relief, isCurrent);
        if (!efficiencies || !isCurrent()) return;
        this.efficiencies = efficiencies;
        await this.take(await this.rowland!.material(this.number, grating, efficiencies), this.grooveMap?.image, isCurrent);
    }

    /** Sets the kernel, with the groove texture's moments for it. */
    private async take(tables: MaterialTables, image: GrooveImage | undefined, isCurrent: () => boolean): Promise<void> {
        const sparkle = (this.grating as { grooveTexture?: { sparkle?: boolean } }).grooveTexture?.sparkle ?? false;
        if (image && sparkle) await this.owner.loadSparkle?.();
        const map = image && (await grooveMap(image, tables.facts[FACT.even] === 1, sparkle, this.rowland!));
        if (isCurrent()) this.setKernel(tables, map);
    }

    private put(name: string, value: unknown): void {
        const old = this.values[name];
        if (!old) {
            this.values[name] = { value };
            this.owner.valueAdded(name);
        } else if (old.value !== value) {
            old.value = value;
            this.owner.valueChanged(name);
        }
    }

    /** Sets what all meshes share. */
    private set(name: string, value: unknown): void {
        const old = this.values[name]?.value;
        if (old instanceof Texture && value instanceof Texture && takeContent(old, value)) return this.owner.contentChanged(name);
        if (old instanceof Texture) old.dispose();
        this.put(name, value);
    }

    /** Sets what is a mesh's own. */
    private give(surface: Surface, values: Record<string, unknown>): void {
        const shared = (texture: Texture) =>
            [...this.surfaces.values()].some((other) => other !== surface && Object.values(other.values).includes(texture));
        for (const [name, value] of Object.entries(values))
            if (surface.set(name, value, shared)) this.owner.contentChanged(name);
        this.sweep();
    }

    private readonly textures = new Set<Texture>(); // that surfaces have

    /** Disposes textures that no mesh shows any more. */
    private sweep(): void {
        const used = new Set([...this.surfaces.values()].flatMap(({ values }) => Object.values(values)).filter((value) => value instanceof Texture));
        for (const texture of this.textures) if (!used.has(texture)) texture.dispose();
        this.textures.clear();
        for (const texture of used) this.textures.add(texture);
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

    private setKernel(tables: MaterialTables, map?: GrooveMap): void {
        const { facts, kernel, views, kernelUniforms } = tables;
        const vector = (at: number) => new Vector3().fromArray(facts, at);
        const matrix = (at: number) => new Matrix3().fromArray(facts, at);
        this.tables = tables;
        this.hasArcTable = false;
        for (const surface of this.surfaces.values()) surface.forget();
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
        if (facts[FACT.hasBase] === 1)
            this.owner.layerChanged([facts[FACT.colour], facts[FACT.colour + 1], facts[FACT.colour + 2]], facts[FACT.roughness]);
        this.flag("LOBE_GAUSSIAN", facts[FACT.lobe] === 1);
        this.flag("LOBE_PITS", facts[FACT.lobe] === 2);
        this.flag("KERNEL_VIEWS", views > 1);
        this.flag("COVER", facts[FACT.ior] > 0);
        this.flag("ZERO_ORDER", facts.subarray(FACT.zeroOrder, FACT.zeroOrder + 9).some((x) => x !== 0));
        for (const [name, value] of Object.entries(this.lightValues(new Float32Array()))) if (!this.values[name]) this.put(name, value);
        if (map) this.setGrooveMap(map, facts[FACT.even] === 1);
        if (!this.rowland!.hasLight) this.flag("ROWLAND", true); // else with the first map or table
        this.follow();
        if (this.options.has("ROWLAND")) this.rowland!.onUpdate();
    }

    private setGrooveMap(map: GrooveMap, even: boolean): void {
        this.grooveMap = map;
        if (this.pitches && !this.flatLobe && this.representation !== "direct")
            throw new Error(`grooveTexture: pitches of ${map.smallest.toPrecision(3)} to ${map.largest.toPrecision(3)} times pitch_nm ` +
                'with a groove_lobe that is not flat; expected the flat groove_lobe or the representation "direct"');
        this.set("groove_map", map.moments);
        this.set("groove_map_rest", map.rest);
        this.set("groove_uv_linear", map.image.uvLinear);
        this.set("groove_uv_offset", map.image.uvOffset);
        this.set("groove_pitch", map.smallest);
        if (map.facetTexels) this.set("facet_texels", map.facetTexels);
        this.flag("GROOVE_SPARKLE", map.facetTexels !== undefined);
        this.option("ROWLAND_GROOVE_UV", map.image.uv);
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

    private lightValues(keyLobes: Float32Array): Record<string, unknown> {
        const count = keyLobes.length / 28;
        const room = Math.max(count, KEY_LIGHTS);
        this.option("ROWLAND_MAXIMUM_KEY_LOBES", String(room));
        const names = ["direction", "flux", "moments", "turns", "mean", "variance", "height"];
        return {
            key_lobe_count: new Vector4(count),
            key_lobes: Array.from({ length: room }, (_, light) => Object.fromEntries(names.map((name, i) =>
                [name, light < count ? new Vector4().fromArray(keyLobes, 28 * light + 4 * i) : new Vector4()]))),
        };
    }

    private get flatLobe(): boolean {
        return this.tables!.facts[FACT.lobe] === 0;
    }

    private knownKind?: Representation; // while no surface changes in what it depends on

    /** How all meshes of the material are shaded, as they have one program: flat ones by a table where one is curved. */
    private get kind(): Representation {
        return (this.knownKind ??= this.findKind());
    }

    private findKind(): Representation {
        if (this.representation === "direct") return "direct";
        const surfaces = [...this.surfaces.values()];
        const large = surfaces.find(({ ownMorphs, vertices }) => vertices > MOST_VERTICES || ownMorphs);
        // A flat mesh has a map even under a groove texture: a table's products are per vertex and would miss the texture.
        if (this.representation !== "arc" && surfaces.every(({ normal }) => normal)) return "planar";
        if (!large) return "arc";
        this.tell(`GratingMaterial on "${large.object.name || large.object.type}": ` + (large.ownMorphs
            ? "instances with morphs of their own have no table of light"
            : `${large.vertices} vertices of instances, of which a table holds ${MOST_VERTICES}`) +
            '; it shows bright lights alone. Use fewer vertices or several meshes, or the representation "direct"');
        return "direct";
    }

    /** Tells the page, once. */
    tell(message: string): void {
        if (!this.told.has(message)) this.rowland!.onError(new Error(message));
        this.told.add(message);
    }

    private showAs(kind: Representation, pitches: boolean): void {
        this.flag("PITCH_AXIS", pitches);
        this.flag("ROWLAND_PLANAR", kind === "planar");
        this.flag("ROWLAND_ARC", kind === "arc");
        this.flag("ROWLAND", true);
    }

    private async showPlane(surface: Surface, light: Record<string, unknown>, isCurrent: () => boolean): Promise<void> {
        const rowland = this.rowland!;
        const normal = surface.normal!;
        const { lightVersion } = rowland;
        // Meshes that face one way share a map.
        const alike = [...this.surfaces.values()].find((other) => other !== surface && other.facesAs(surface));
        if (alike) {
            this.give(surface, alike.values);
            surface.show("planar", alike.light);
            return rowland.onUpdate();
        }
        const details = rowland.preview ? (["coarse"] as const) : (["coarse", "full"] as const);
        for (const detail of details) {
            const map = await rowland.plane(this.number, [normal.x, normal.y, normal.z], this.flatLobe, this.pitches, detail);
            if (!isCurrent()) return;
            this.give(surface, { ...light, ...planeValues(map) });
            surface.show("planar", lightVersion, detail === details[details.length - 1]);
            this.flag("LOBE_MAP", map.axes !== null);
            this.flag("HALF_TURN", map.halfTurn);
            this.showAs("planar", map.pitch !== null);
            rowland.onUpdate();
            if (!surface.isSettled(rowland.lightVersion, "planar")) return surface.forget(); // the full map is for the next light or pose
        }
    }

    private async showArc(surface: Surface, light: Record<string, unknown>, isCurrent: () => boolean): Promise<void> {
        const rowland = this.rowland!;
        const { object, geometry, toProbe } = surface;
        const { lightVersion } = rowland;
        const pitches = this.pitches;
        const turn = this.rotation;
        const image = this.grooveMap?.image;
        const coordinates = image && coordinatesOf(geometry, image.uv);
        const turnOf = (vertex: number) => turn + (coordinates ? rotationAt(image, ...coordinates(vertex)) : 0);
        const { normals, gratings } = frames(object, geometry, toProbe, this.groovesOf(geometry), turnOf);
        if (!this.hasArcTable) {
            const arc = await rowland.arc(this.number, BANDS, pitches);
            if (!isCurrent()) return;
            this.hasArcTable = true;
            this.set("packed_table", arrayTexture(arc.weights, arc.mapping === 0));
            this.set("table_range", storageTexture(Float32Array.from({ length: 8 * arc.layers }, (_, i) => (i % 8 < 4 ? 1 : 0))));
            this.arcPitch = pitches ? { pitch_scale_bias: new Vector2(...arc.pitch) } : {};
            this.option("VIEW_MAPPING", String(arc.mapping));
            this.option("TABLE_COLUMNS", String(arc.weights.width));
            this.option("TABLE_ROWS", String(arc.weights.height));
            this.option("LAYERS", String(arc.layers));
        }
        const products = await rowland.products(this.number, BANDS, pitches, normals, gratings);
        if (!isCurrent()) return;
        this.give(surface, { ...light, ...this.arcPitch, ...productValues(surface, products) });
        surface.show("arc", lightVersion);
        this.showAs("arc", pitches !== null);
        rowland.onUpdate();
    }

    /** Updates a mesh's map or table for the light and the pose, and the key lights together with it. */
    private async settle(surface: Surface, kind: Representation): Promise<void> {
        const rowland = this.rowland!;
        const { tables } = this;
        const isCurrent = () => tables !== undefined && tables === this.tables; // not of the grating before
        surface.ask(rowland.lightVersion, kind);
        if (this.keyLobes?.light !== rowland.lightVersion)
            this.keyLobes = { light: rowland.lightVersion, values: rowland.keyLobes().then((numbers) => this.lightValues(numbers)) };
        const light = await this.keyLobes.values;
        if (!isCurrent()) return;
        if (kind === "planar") return this.showPlane(surface, light, isCurrent);
        if (kind === "arc" && rowland.preview) return; // a table waits for the key lights
        if (kind === "arc") return this.showArc(surface, light, isCurrent);
        this.give(surface, light);
        surface.show("direct", rowland.lightVersion);
        this.showAs("direct", this.pitches !== null);
        rowland.onUpdate();
    }

    /** Asks for what the picture lacks, once the material has been drawn: for one mesh after the other. */
    private follow(): void {
        if (!this.tables || this.busy || this.surfaces.size === 0 || this.rowland!.lightVersion === 0) return;
        const { kind } = this;
        const waiting = [...this.surfaces.values()].filter((surface) => surface.drawn && !surface.isSettled(this.rowland!.lightVersion, kind));
        if (waiting.length === 0) return;
        this.busy = true;
        const settleAll = async () => {
            for (const surface of waiting)
                if (this.surfaces.has(surface.object)) await this.settle(surface, kind).catch((error: Error) => this.rowland!.onError(error));
        };
        this.settled = settleAll().finally(() => {
            this.busy = false;
            this.follow();
        });
    }

    private surfaceOf(object: Object3D, geometry: BufferGeometry): Surface {
        let surface = this.surfaces.get(object);
        if (surface?.geometry !== geometry) {
            surface = new Surface(object, geometry);
            this.knownKind = undefined;
        }
        this.surfaces.delete(object);
        this.surfaces.set(object, surface);
        if (this.surfaces.size > SURFACES) this.surfaces.delete(this.surfaces.keys().next().value!);
        return surface;
    }

    /** To be called before the owner's material is drawn on an object: sets the values that are the object's. */
    see(scene: Scene, geometry: BufferGeometry, object: Object3D): void {
        if (this.disposed && this.rowland) this.bake(this.rowland, this.grating!, this.efficiencies);
        const surface = this.surfaceOf(object, geometry);
        if (surface.see(probeFromWorld(scene))) this.knownKind = undefined;
        if (!this.tables) return;
        if (!surface.isSettled(this.rowland!.lightVersion, this.kind)) this.follow();
        for (const [name, value] of Object.entries(surface.values)) this.put(name, value);
        const current = this.options.has("ROWLAND_ARC") ? "arc" : this.options.has("ROWLAND_PLANAR") ? "planar" : "direct";
        this.put("light_scale", surface.shown === current ? scene.environmentIntensity ?? 1 : 0);
        this.put("radial_grooves", this.groovesOf(geometry) === "radial" ? 1 : 0);
        if (!(this.values.probe_from_world?.value as Matrix3 | undefined)?.equals(surface.toProbe)) this.put("probe_from_world", surface.toProbe.clone());
    }

    /** Says once that a renderer cannot draw the owner, and what it can. */
    refuse(renderer: string, owner: string, remedy: string): void {
        const message = `${renderer} cannot draw ${owner}; expected ${remedy}`;
        if (this.rowland) return this.tell(message);
        if (!this.told.has(message)) console.error(new Error(message));
        this.told.add(message);
    }

    /** Whether reference() shows its grooves: not those of a texture, which vary within a pixel. */
    get hasReference(): boolean {
        return this.grooveTexture === undefined;
    }

    /** Whether the picture has the light of the probe; maps are coarse at first. */
    get lit(): boolean {
        return [...this.surfaces.values()].some(({ light }) => light > 0 && light === this.rowland!.lightVersion);
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

    /** From the world, as the object was last drawn in. */
    probeOf(object: Object3D): Matrix3 {
        return this.surfaces.get(object)?.toProbe ?? new Matrix3();
    }

    /** Texture look-ups per pixel for the light of the probe without its key lights. */
    get price(): { map: number } {
        return { map: this.options.has("ROWLAND_ARC") ? Number(this.options.get("LAYERS")) : this.representation === "direct" ? 0 : 1 };
    }
}
