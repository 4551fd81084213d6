import { DataUtils, FloatType, HalfFloatType, type DataTexture, type Texture } from "three";
import { TaskWorker } from "./task_worker.js";
import type { ArcTables, Detail, MaterialTables, Pitches, PlaneMap } from "./tasks.js";

/** RGB texels of a texture that three's HDR or EXR loader gives, row 0 at the top. */
export function texelsOf(texture: Texture): { texels: Float32Array; width: number; height: number } {
    const { data, width, height } = (texture as DataTexture).image as { data: ArrayLike<number>; width: number; height: number };
    if (!data || !(texture.type === FloatType || texture.type === HalfFloatType))
        throw new Error("the probe: expected an equirectangular DataTexture of floats or halves, as HDRLoader or EXRLoader gives");
    const components = data.length / (width * height);
    const texels = new Float32Array(3 * width * height);
    const number = texture.type === HalfFloatType ? DataUtils.fromHalfFloat : (x: number) => x;
    for (let row = 0; row < height; ++row) {
        // Rows of a texture that is not flipped on upload ascend.
        const from = texture.flipY ? row : height - 1 - row;
        for (let column = 0; column < width; ++column)
            for (let c = 0; c < 3; ++c)
                texels[3 * (row * width + column) + c] = number(data[components * (from * width + column) + c]);
    }
    return { texels, width, height };
}

/** In which a page asks for the coarse maps of a light, before its bright parts are looked for. */
const PREVIEW_MS = 100;

/** What has a worker of its own, so that the tables of curved meshes, of seconds, hold up neither maps nor the ground truth. */
type Work = "maps" | "tables" | "truth";

/** The workers that bake materials and light. One Rowland for a page. */
export class Rowland {
    private readonly workers = new Map<Work, TaskWorker>();
    private readonly json = new Map<number, string>();
    private rest?: { light: number; sh: Promise<Float32Array> }; // without the key lights
    private referenceImage?: { light: number; sent: Promise<void> };
    /** Called when a picture would be another than before: draw. */
    onUpdate: () => void = () => {};
    /** Called with what a material or its light could not be baked for. */
    onError: (error: Error) => void = (error) => console.error(error);
    /** Rises when the light is another. */
    lightVersion = 0;
    /** Whether its bright parts are still to be found. */
    preview = false;
    private newestLight = 0;

    constructor(private readonly startWorker = () => new Worker(new URL("./worker.js", import.meta.url), { type: "module" })) {
        this.worker("maps"); // while the page loads its light
    }

    private worker(work: Work): TaskWorker {
        const worker = this.workers.get(work) ?? new TaskWorker(this.startWorker());
        this.workers.set(work, worker);
        return worker;
    }

    /**
     * Sets the light: an equirectangular texture of floats or halves. Its bright parts become `keyLights` sharp lights;
     * until they are found, a second later, it is seen as a whole in coarse maps.
     */
    async setProbe(texture: Texture, { keyLights = 16 }: { keyLights?: number } = {}): Promise<void> {
        const { texels, width, height } = texelsOf(texture);
        const light = ++this.newestLight;
        await this.worker("maps").run("light", [texels, width, height], [texels]);
        this.show(keyLights > 0);
        if (keyLights === 0) return;
        await new Promise((resolve) => setTimeout(resolve, PREVIEW_MS));
        if (light !== this.newestLight) return;
        await this.worker("maps").run("findKeyLights", [keyLights]);
        this.show(false);
    }

    private show(preview: boolean): void {
        this.preview = preview;
        this.lightVersion += 1;
        this.onUpdate();
    }

    /** Whether the workers have tasks left. */
    get busy(): boolean {
        return [...this.workers.values()].some(({ busy }) => busy);
    }

    /** @internal */
    material(id: number, material: object): Promise<MaterialTables> {
        const json = JSON.stringify(material);
        this.json.set(id, json);
        return this.worker("maps").run("material", [id, json]);
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
    arc(id: number, bands: number): Promise<ArcTables> {
        return this.worker("tables").run("arc", [id, this.json.get(id), bands]);
    }
    /** @internal */
    async products(id: number, bands: number, normals: Float32Array, gratings: Float32Array): Promise<Float32Array> {
        if (this.rest?.light !== this.lightVersion) this.rest = { light: this.lightVersion, sh: this.restSh(bands) };
        const sh = await this.rest.sh;
        return this.worker("tables").run("products", [id, this.json.get(id), bands, sh, normals, gratings], [normals, gratings]);
    }

    private async restSh(bands: number): Promise<Float32Array> {
        const probe = await this.worker("maps").run<Float32Array>("probeTexels", []);
        const keys = await this.worker("maps").run<Float32Array>("keyLights", []);
        return this.worker("tables").run("restSh", [probe, keys, bands], [probe, keys]);
    }
    /** @internal */
    async reference(id: number, points: Float32Array): Promise<Float32Array> {
        if (this.lightVersion === 0) throw new Error("reference() needs a probe: call setProbe() before it");
        if (this.referenceImage?.light !== this.lightVersion)
            this.referenceImage = { light: this.lightVersion, sent: this.sendImage() };
        await this.referenceImage.sent;
        return this.worker("truth").run("reference", [this.json.get(id), points], [points]);
    }

    private async sendImage(): Promise<void> {
        const texels = await this.worker("maps").run<Float32Array>("probeTexels", []);
        await this.worker("truth").run("referenceImage", [texels], [texels]);
    }

    dispose(): void {
        for (const worker of this.workers.values()) worker.dispose();
    }
}
