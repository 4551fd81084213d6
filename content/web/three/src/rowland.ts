import { DataUtils, FloatType, HalfFloatType, type DataTexture, type Texture } from "three";
import type { ArcTables, Detail, MaterialTables, PlaneMap } from "./tasks.js";

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

/** The worker that bakes materials and light. One for a page. */
export class Rowland {
    private readonly worker: Worker;
    private readonly waiting = new Map<number, { resolve: (result: never) => void; reject: (error: Error) => void }>();
    private next = 1;
    /** Called when a picture would be another than before: draw. */
    onUpdate: () => void = () => {};
    /** Called with what a material or its light could not be baked for. */
    onError: (error: Error) => void = (error) => console.error(error);
    /** Rises with each probe. */
    lightVersion = 0;

    constructor(worker: Worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" })) {
        this.worker = worker;
        worker.onmessage = ({ data }) => {
            const waiting = this.waiting.get(data.id);
            this.waiting.delete(data.id);
            if (data.error === undefined) waiting?.resolve(data.result as never);
            else waiting?.reject(new Error(data.error));
        };
        worker.onerror = (event) => {
            const error = new Error(event.message || "the worker of @rowland/three did not start");
            for (const waiting of this.waiting.values()) waiting.reject(error);
            this.waiting.clear();
        };
    }

    private run<Result>(task: string, args: unknown[], transfer: Transferable[] = []): Promise<Result> {
        const id = this.next++;
        return new Promise<Result>((resolve, reject) => {
            this.waiting.set(id, { resolve: resolve as (result: never) => void, reject });
            this.worker.postMessage({ id, task, args }, transfer);
        });
    }

    /** Sets the light: an equirectangular texture of floats or halves. Its bright parts become `keyLights` sharp lights. */
    async setProbe(texture: Texture, { keyLights = 16 }: { keyLights?: number } = {}): Promise<void> {
        const { texels, width, height } = texelsOf(texture);
        await this.run("light", [texels, width, height, keyLights], [texels.buffer as ArrayBuffer]);
        this.lightVersion += 1;
        this.onUpdate();
    }

    /** Whether the worker has tasks left. */
    get busy(): boolean {
        return this.waiting.size > 0;
    }

    /** @internal */
    material(id: number, json: object): Promise<MaterialTables> {
        return this.run("material", [id, JSON.stringify(json)]);
    }
    /** @internal */
    keyLobes(): Promise<Float32Array> {
        return this.run("keyLobes", []);
    }
    /** @internal */
    plane(id: number, normal: number[], flatLobe: boolean, detail: Detail): Promise<PlaneMap> {
        return this.run("plane", [id, normal, flatLobe, detail]);
    }
    /** @internal */
    arc(id: number, bands: number): Promise<ArcTables> {
        return this.run("arc", [id, bands]);
    }
    /** @internal */
    products(id: number, bands: number, normals: Float32Array, gratings: Float32Array): Promise<Float32Array> {
        return this.run("products", [id, bands, normals, gratings], [normals.buffer, gratings.buffer] as ArrayBuffer[]);
    }
    /** @internal */
    reference(id: number, points: Float32Array): Promise<Float32Array> {
        return this.run("reference", [id, points], [points.buffer as ArrayBuffer]);
    }

    dispose(): void {
        this.worker.terminate();
    }
}
