import { CubeTexture, DataTexture, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, LinearSRGBColorSpace, RGBAFormat } from "three";
import type { Panorama } from "@rowland/three";
import { TaskWorker } from "../three/src/task_worker.js";
import type { Levels } from "./environment.js";

/** The worker that filters the light for scene.environment. */
export class Reflections {
    private readonly worker = new TaskWorker(new Worker(new URL("./environment.js", import.meta.url), { type: "module" }), () => {});

    async of({ texels, width, height }: Panorama): Promise<CubeTexture> {
        const { size, levels } = await this.worker.run<Levels>("filtered", [texels, width, height]);
        const cubes = levels.map((faces, level) => filteredCube(faces, size >> level));
        // three counts a cube's mip levels without the first, but those of a PMREM with it: one that is never read evens that out.
        const last = filteredCube(levels[levels.length - 1].map(() => new Uint16Array(64)), 4);
        cubes[0].mipmaps = [...cubes.slice(1), last] as never;
        return Object.assign(cubes[0], { isPMREMTexture: true });
    }
}

function filteredCube(faces: Uint16Array[], size: number): CubeTexture {
    const texture = new CubeTexture(faces.map((data) => new DataTexture(data as Uint16Array<ArrayBuffer>, size, size)) as never);
    texture.format = RGBAFormat;
    texture.type = HalfFloatType;
    texture.colorSpace = LinearSRGBColorSpace;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.generateMipmaps = false;
    texture.needsUpdate = true;
    return texture;
}
