/** What the worker computes, and the tables that it returns. */

import { facetsOf, grooveMoments, type GrooveLevels, type GrooveMoments } from "./groove_moments.js";
import { packRgb, toHalf, type Halves } from "./half.js";
import { BakeModule } from "./module.js";

/** The texels of a texture, RGBA halves. */
export interface Table extends Halves {
    readonly width: number;
    readonly height: number;
    readonly depth: number;
}

/** What a material is baked from. */
export interface Source {
    readonly json: string;
    readonly efficiencies: Float32Array; // as efficiency_grid() of content/web/bake/material.cpp takes them, or empty
    readonly version: number; // another for each source
}

export interface MaterialTables {
    readonly facts: Float32Array;
    readonly relief: Float32Array; // for solve(); its first number is 0 where nothing is left to solve
    readonly kernel: Table; // three layers of `views` each
    readonly views: number;
    readonly kernelUniforms: Float32Array; // scale_bias, rows, reach, kernel_views of shaders/kernel.glsl
}

export interface PlaneMap {
    readonly e1: number[];
    readonly e2: number[];
    readonly axes: number[] | null; // lobe_map_axes of a volume
    readonly halfTurn: boolean;
    readonly pitch: number[] | null; // scale and bias of a volume of pitches
    readonly table: Table;
}

export interface ArcTables {
    readonly mapping: number;
    readonly weights: Table;
    readonly layers: number;
    readonly pitch: number[]; // scale and bias of a table over pitches
}

/** A film for a table. */
export interface FilmSource {
    readonly json: string; // of a film material file
    readonly thinnest_nm: number; // a texture varies the thickness from here to the film's; -1: none does
    readonly smoothest: number; // and so the roughness
    readonly base: readonly number[]; // reflectance at normal incidence in place of the file's base; [-1, -1, -1]: the file's
}

export interface FilmTable {
    readonly path: [number, number, number, number]; // film_path of film_lookup.glsl
    readonly axes: [number, number, number, number];
    readonly byRoughness: boolean; // rows are roughnesses
    readonly error: number; // the largest, of the largest reflectance at that angle
    readonly table: Table;
}

/** Map sizes: a coarse map is shown first, then the full one. */
export type Detail = "coarse" | "full";

/** The smallest and the largest pitch of a groove texture, over the material's. */
export type Pitches = readonly [number, number];

const MOST_TEXELS = 2048;
const FACTS = 40; // those of the relief follow
const SIZES = {
    coarse: { flat: 64, azimuths: 64, g: 64, h: 32, pitched: 32, step: 1.1 },
    full: { flat: 256, azimuths: 176, g: 64, h: 64, pitched: 128, step: 1.03 }, // step: of pitches
};
const TABLE_STEP = 1.045; // of pitches: runtime/groove_map.cpp
export const RANK = 12;
/** Key lights: direction, flux, concentration. */
export const KEY_LIGHT_NUMBERS = 7;

const nodesOf = ([smallest, largest]: Pitches, step: number) => 2 + Math.floor(Math.log(largest / smallest) / Math.log(step));

function table(width: number, height: number, depth: number, rgb: Float32Array): Table {
    return { width, height, depth, ...packRgb(rgb) };
}

type ModuleName = "bake" | "keys" | "arc" | "reference" | "solve" | "film" | "sparkle";
export type Fetch = (name: ModuleName) => Promise<BufferSource>;

/** The tasks of one worker. Materials, by number, and one probe are kept in the modules' memory. */
export class Tasks {
    private readonly modules = new Map<string, Promise<BakeModule>>();
    private readonly baked = new Map<number, number>();
    private readonly arcs = new Map<number, { of: string; arc: number }>();
    private probe = 0;
    private image = 0; // the probe's, in the module of the reference

    constructor(private readonly fetch: Fetch) {}

    private module(name: ModuleName): Promise<BakeModule> {
        let module = this.modules.get(name);
        if (!module) this.modules.set(name, (module = this.fetch(name).then((bytes) => BakeModule.load(bytes))));
        return module;
    }

    private static read(module: BakeModule, { json, efficiencies }: Source): number {
        const text = new TextEncoder().encode(json);
        const inputs = [module.put(text), module.putFloats(efficiencies)];
        const material = module.call("read_material", inputs[0], text.length, inputs[1], efficiencies.length);
        for (const input of inputs) module.call("give_back", input);
        return material;
    }

    /** Bakes a material. One of rigorous theory without its efficiencies is baked by scalar theory. */
    async material(id: number, source: Source): Promise<MaterialTables> {
        const bake = await this.module("bake");
        const material = Tasks.read(bake, source);
        if (this.baked.has(id)) bake.call("release_material", this.baked.get(id)!);
        this.baked.set(id, material);
        const texture = bake.numbers("kernel_texture", material, MOST_TEXELS);
        const facts = bake.numbers("material_facts", material);
        return {
            facts: facts.slice(0, FACTS),
            relief: facts.slice(FACTS),
            kernel: table(texture[0], texture[1], 3 * texture[2], texture.subarray(14)),
            views: texture[2],
            kernelUniforms: texture.slice(3, 14),
        };
    }

    /** Frees what of a material is kept in this worker. */
    async release(id: number): Promise<void> {
        if (this.baked.has(id)) (await this.module("bake")).call("release_material", this.baked.get(id)!);
        this.baked.delete(id);
        if (this.arcs.has(id)) (await this.module("arc")).call("release_arc", this.arcs.get(id)!.arc);
        this.arcs.delete(id);
    }

    /** The efficiencies of MaterialTables.relief, by Maxwell's equations. Takes seconds. */
    async solve(relief: Float32Array): Promise<Float32Array> {
        return (await this.module("solve")).numbers("solve", ...relief);
    }

    /** Sets the probe. `texels`: RGB, linear Rec.709, row 0 at the top. */
    async light(texels: Float32Array, width: number, height: number): Promise<void> {
        const bake = await this.module("bake");
        if (this.probe !== 0) bake.call("release_probe", this.probe);
        this.probe = bake.call("read_probe", bake.putFloats(texels), width, height);
    }

    /** Key lights for the brightest parts of an image. `probe`: of probeTexels(). Takes about a second. */
    async fitKeyLights(probe: Float32Array, count: number): Promise<Float32Array> {
        const keys = await this.module("keys");
        return keys.numbers("fit_key_lights", keys.putFloats(probe.subarray(2)), probe[0], probe[1], count);
    }

    /** Takes key lights out of the probe's light. */
    async useKeyLights(keys: Float32Array): Promise<void> {
        const bake = await this.module("bake");
        const address = bake.putFloats(keys);
        bake.call("use_key_lights", this.probe, address, keys.length / KEY_LIGHT_NUMBERS);
        bake.call("give_back", address);
    }

    /** The numbers of the key lights: KeyLobe of shaders/light_blocks.h. */
    async keyLobes(): Promise<Float32Array> {
        return (await this.module("bake")).numbers("key_lobes", this.probe);
    }

    /** Width, height, then the probe's RGB texels. */
    async probeTexels(): Promise<Float32Array> {
        return (await this.module("bake")).numbers("probe_texels", this.probe);
    }

    /** The map of a plane. `normal`: in the world; `pitches`: null for the material's alone. */
    async plane(id: number, normal: number[], flatLobe: boolean, pitches: Pitches | null, detail: Detail): Promise<PlaneMap> {
        const bake = await this.module("bake");
        const material = this.baked.get(id)!;
        const [x, y, z] = normal;
        const size = SIZES[detail];
        if (flatLobe) {
            const views = pitches ? size.pitched : size.flat;
            const [smallest, largest] = pitches ?? [1, 1];
            const depth = pitches ? nodesOf(pitches, size.step) : 1;
            const map = bake.numbers("planar_map", material, this.probe, x, y, z, views, smallest, largest, depth);
            return {
                e1: [...map.subarray(0, 3)],
                e2: [...map.subarray(3, 6)],
                axes: null,
                halfTurn: false,
                pitch: pitches ? [...map.subarray(6, 8)] : null,
                table: table(2 * views, views, depth, map.subarray(8)),
            };
        }
        const map = bake.numbers("lobe_map", material, this.probe, x, y, z, size.azimuths, size.g, size.h);
        return {
            e1: [...map.subarray(0, 3)],
            e2: [...map.subarray(3, 6)],
            axes: [...map.subarray(6, 10)],
            halfTurn: map[13] === 1,
            pitch: null,
            table: table(map[10], map[11], map[12], map.subarray(14)),
        };
    }

    private async arcOf(id: number, source: Source, bands: number, pitches: Pitches | null): Promise<[BakeModule, number]> {
        const module = await this.module("arc");
        const kept = this.arcs.get(id);
        const of = `${source.version} ${pitches}`;
        if (kept?.of === of) return [module, kept.arc];
        if (kept) module.call("release_arc", kept.arc);
        this.arcs.delete(id);
        const material = Tasks.read(module, source);
        const [smallest, largest] = pitches ?? [1, 1];
        const arc = module.call("bake_arc", material, bands, RANK, smallest, largest, pitches ? nodesOf(pitches, TABLE_STEP) : 1);
        module.call("release_material", material);
        this.arcs.set(id, { of, arc });
        return [module, arc];
    }

    async arc(id: number, source: Source, bands: number, pitches: Pitches | null): Promise<ArcTables> {
        const [module, arc] = await this.arcOf(id, source, bands, pitches);
        const numbers = module.numbers("arc_weights", arc);
        const [mapping, width, height, layers] = numbers;
        const weights = numbers.subarray(6);
        return {
            mapping,
            layers,
            pitch: [...numbers.subarray(4, 6)],
            weights: { width, height, depth: layers, texels: Uint16Array.from(weights, toHalf), scale: 1 },
        };
    }

    /** Raw SH of the light without its key lights. `probe`: of probeTexels(). */
    async restSh(probe: Float32Array, keys: Float32Array, bands: number): Promise<Float32Array> {
        const module = await this.module("arc");
        const address = module.putFloats(keys);
        const sh = module.numbers("rest_sh", module.putFloats(probe.subarray(2)), probe[0], probe[1], address, keys.length / KEY_LIGHT_NUMBERS, bands);
        module.call("give_back", address);
        return sh;
    }

    /** The products of arc: 3 · layers vec4s for each vertex. `sh`: of restSh(). */
    async products(
        id: number, source: Source, bands: number, pitches: Pitches | null, sh: Float32Array, normals: Float32Array, gratings: Float32Array,
    ): Promise<Float32Array> {
        const [module, arc] = await this.arcOf(id, source, bands, pitches);
        const inputs = [sh, normals, gratings].map((floats) => module.putFloats(floats));
        const products = module.numbers("arc_products", arc, ...inputs, normals.length / 3);
        for (const input of inputs) module.call("give_back", input);
        return products;
    }

    async grooveMoments(texels: Uint8Array | Uint16Array, width: number, height: number, even: boolean, levels: GrooveLevels): Promise<GrooveMoments> {
        if (levels !== "facets") return grooveMoments(texels, width, height, even, levels === "means");
        const module = await this.module("sparkle");
        const address = module.put(new Uint8Array(texels.buffer, texels.byteOffset, texels.byteLength));
        return facetsOf(module.numbers("facet_levels", address, width, height, texels.BYTES_PER_ELEMENT, Number(even)), width, height);
    }

    async film({ json, thinnest_nm, smoothest, base }: FilmSource): Promise<FilmTable> {
        const module = await this.module("film");
        const text = new TextEncoder().encode(json);
        const address = module.put(text);
        const numbers = module.numbers("film_table", address, text.length, thinnest_nm, smoothest, ...base);
        module.call("give_back", address);
        const [width, height] = numbers.subarray(10);
        return {
            path: [...numbers.subarray(0, 4)] as FilmTable["path"],
            axes: [...numbers.subarray(4, 8)] as FilmTable["axes"],
            byRoughness: numbers[8] === 1,
            error: numbers[9],
            table: { width, height, depth: 1, texels: Uint16Array.from(numbers.subarray(12), toHalf), scale: 1 },
        };
    }

    /** Sets the light of reference(). `probe`: of probeTexels(). */
    async referenceImage(probe: Float32Array): Promise<void> {
        const module = await this.module("reference");
        if (this.image !== 0) module.call("release_image", this.image);
        this.image = module.call("read_image", module.putFloats(probe.subarray(2)), probe[0], probe[1]);
    }

    /** Radiance of points of pointFrame(): the sum over wavelengths, along arcs of the image's texels. */
    async reference(source: Source, points: Float32Array): Promise<Float32Array> {
        const module = await this.module("reference");
        const material = Tasks.read(module, source);
        const address = module.putFloats(points);
        const radiance = module.numbers("reference_radiance", material, this.image, address, points.length / 9);
        module.call("give_back", address);
        module.call("release_material", material);
        return radiance;
    }
}
