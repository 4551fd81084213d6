import type { GrooveMoments } from "./groove_moments.js";
import { TaskWorker } from "./task_worker.js";
import type { ArcTables, Detail, FilmSource, FilmTable, MaterialTables, Pitches, PlaneMap, Source, Tasks } from "./tasks.js";

/** An equirectangular picture: RGB, linear Rec.709, row 0 at the top. */
export interface Panorama {
    readonly texels: Float32Array;
    readonly width: number;
    readonly height: number;
}

/**
 * Fractions of the light that orders take, of a grating of rigorous theory: `material.efficiencies` of a document of
 * `rowland-cook export`, with `values` taken from its file of arrays.
 */
export interface Efficiencies {
    readonly orders: readonly number[];
    /** The first wavelength, and the step to the next. */
    readonly begin_nm: number;
    readonly step_nm: number;
    /** v_g at the nodes. */
    readonly views: readonly number[];
    /** [orders, wavelengths, views] */
    readonly values: Float32Array;
}

/** As content/web/bake/material.cpp reads them. */
const numbersOf = ({ orders, begin_nm, step_nm, views, values }: Efficiencies) =>
    Float32Array.from([begin_nm, step_nm, views.length, orders.length, ...orders, ...values]);

/** Kinds of work. Each has a worker, so that work of seconds does not delay maps. */
type Work = "maps" | "keys" | "tables" | "truth" | "efficiencies";

/** The workers that bake materials and light. One Rowland for a page. */
export class Rowland {
    private readonly workers = new Map<Work, TaskWorker>();
    private readonly sources = new Map<number, Source>();
    private versions = 0;
    private lastSolve: Promise<unknown> = Promise.resolve();
    private lastProbe: Promise<unknown> = Promise.resolve();
    private lastFit: Promise<unknown> = Promise.resolve();
    private rest?: { light: number; sh: Promise<Float32Array> }; // without the key lights
    private keys: Float32Array = new Float32Array();
    private referenceImage?: { light: number; sent: Promise<void> };
    /** Called when the picture changes and is to be drawn again. */
    onUpdate: () => void = () => {};
    /** Called when the workers have no tasks left. */
    onIdle: () => void = () => {};
    /** Called with the error for which a material or its light could not be baked. */
    onError: (error: Error) => void = (error) => console.error(error);
    /** Increases when the light changes. */
    lightVersion = 0;
    /** Whether the light's key lights are still to be found. */
    preview = false;
    private newestLight = 0;
    private readonly materials = new Set<() => void>();

    constructor(private readonly startWorker = () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" })) {
        if (typeof Worker !== "undefined") this.worker("maps"); // while the page loads its light; not on a server
    }

    private worker(work: Work): TaskWorker {
        const worker = this.workers.get(work) ?? new TaskWorker(this.startWorker(), () => this.busy || this.onIdle());
        this.workers.set(work, worker);
        return worker;
    }

    /**
     * Sets the light. Its bright parts become `keyLights` sharp lights. Until they are found, in about a second, coarse
     * maps show all of the light; with "later", until setKeyLights(). The texels move to a worker.
     */
    async setProbe({ texels, width, height }: Panorama, { keyLights = 16 }: { keyLights?: number | "later" } = {}): Promise<void> {
        const light = ++this.newestLight;
        // One after the other: of probes that follow each other fast the last is shown, and none waits in the worker.
        const isNewest = () => light === this.newestLight;
        const sent = this.lastProbe.then(() => (isNewest() ? this.worker("maps").run("light", [texels, width, height], [texels]) : null));
        this.lastProbe = sent.catch(() => {});
        await sent;
        if (!isNewest()) return;
        this.show(new Float32Array(), keyLights !== 0);
        if (typeof keyLights === "number" && keyLights > 0) await this.setKeyLights(keyLights);
    }

    /**
     * Takes bright parts out of the light as sharp lights: at most this many, found in about a second, or those of an
     * earlier fitKeyLights() under the same light.
     */
    async setKeyLights(keyLights: number | Float32Array): Promise<void> {
        const light = this.newestLight;
        const keys = typeof keyLights === "number" ? await this.fitNewest(light, keyLights) : keyLights;
        if (!keys || light !== this.newestLight) return;
        await this.worker("maps").run("useKeyLights", [keys]);
        if (light === this.newestLight) this.show(keys, false);
    }

    private fitNewest(light: number, count: number): Promise<Float32Array | null> {
        const fitted = this.lastFit.then(() => (light === this.newestLight ? this.fitKeyLights(count) : null));
        this.lastFit = fitted.catch(() => {});
        return fitted;
    }

    /** At most `count` sharp lights in the probe: seven numbers each, to be kept beside a panorama. */
    async fitKeyLights(count: number): Promise<Float32Array> {
        const probe = await this.worker("maps").run<Float32Array>("probeTexels", []);
        return this.worker("keys").run("fitKeyLights", [probe, count], [probe]);
    }

    private show(keys: Float32Array, preview: boolean): void {
        this.keys = keys;
        this.preview = preview;
        this.lightVersion += 1;
        for (const follow of this.materials) follow();
    }

    /** Whether a light has been set, or is on its way. */
    get hasLight(): boolean {
        return this.newestLight > 0;
    }

    /** @internal Calls `change` at each change of the light, until the returned function is called. */
    follow(change: () => void): () => void {
        this.materials.add(change);
        return () => this.materials.delete(change);
    }

    /** Whether the workers have tasks left. */
    get busy(): boolean {
        return [...this.workers.values()].some(({ busy }) => busy);
    }

    /** @internal */
    material(id: number, material: object, efficiencies?: Efficiencies | Float32Array): Promise<MaterialTables> {
        const numbers = efficiencies instanceof Float32Array ? efficiencies : efficiencies ? numbersOf(efficiencies) : new Float32Array();
        const source = { json: JSON.stringify(material), efficiencies: numbers, version: ++this.versions };
        this.sources.set(id, source);
        return this.worker("maps").run("material", [id, source]);
    }
    /** @internal Frees what the workers keep of a material. */
    release(id: number): void {
        this.sources.delete(id);
        for (const work of ["maps", "tables"] as const) void this.workers.get(work)?.run("release", [id]).catch(() => {});
    }
    /** @internal Efficiencies for material(), one solve after the other; null if they are not wanted any more when it is their turn. */
    solve(relief: Float32Array, areWanted: () => boolean): Promise<Float32Array | null> {
        const solved = this.lastSolve.then(() => (areWanted() ? this.worker("efficiencies").run<Float32Array>("solve", [relief]) : null));
        this.lastSolve = solved.catch(() => {});
        return solved;
    }
    /** @internal */
    keyLobes(): Promise<Float32Array> {
        return this.worker("maps").run("keyLobes", []);
    }
    /** @internal */
    plane(id: number, normal: number[], flatLobe: boolean, pitches: Pitches | null, detail: Detail): Promise<PlaneMap> {
        return this.worker("maps").run("plane", [id, normal, flatLobe, pitches, detail]);
    }

    /** @internal */
    grooveMoments(...of: Parameters<Tasks["grooveMoments"]>): Promise<GrooveMoments> {
        return this.worker("tables").run("grooveMoments", of);
    }

    /** @internal */
    filmTable(film: FilmSource): Promise<FilmTable> {
        return this.worker("tables").run("film", [film]);
    }

    /** @internal */
    arc(id: number, bands: number, pitches: Pitches | null): Promise<ArcTables> {
        return this.worker("tables").run("arc", [id, this.sources.get(id), bands, pitches]);
    }
    /** @internal */
    async products(id: number, bands: number, pitches: Pitches | null, normals: Float32Array, gratings: Float32Array): Promise<Float32Array> {
        if (this.rest?.light !== this.lightVersion) this.rest = { light: this.lightVersion, sh: this.restSh(bands) };
        const sh = await this.rest.sh;
        return this.worker("tables").run("products", [id, this.sources.get(id), bands, pitches, sh, normals, gratings], [normals, gratings]);
    }

    private async restSh(bands: number): Promise<Float32Array> {
        const keys = this.keys;
        const probe = await this.worker("maps").run<Float32Array>("probeTexels", []);
        return this.worker("tables").run("restSh", [probe, keys, bands], [probe]);
    }
    /** @internal */
    async reference(id: number, points: Float32Array): Promise<Float32Array> {
        if (this.lightVersion === 0) throw new Error("reference() needs a probe: call setProbe() before it");
        if (this.referenceImage?.light !== this.lightVersion)
            this.referenceImage = { light: this.lightVersion, sent: this.sendImage() };
        await this.referenceImage.sent;
        return this.worker("truth").run("reference", [this.sources.get(id), points], [points]);
    }

    private async sendImage(): Promise<void> {
        const texels = await this.worker("maps").run<Float32Array>("probeTexels", []);
        await this.worker("truth").run("referenceImage", [texels], [texels]);
    }

    dispose(): void {
        for (const worker of this.workers.values()) worker.dispose();
    }
}
