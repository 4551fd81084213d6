import { FloatType } from "three";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { HDRLoader } from "three/examples/jsm/loaders/HDRLoader.js";
import type { Panorama } from "@rowland/three";

/** A lamp on the sphere: its direction and size in degrees, its radiance. */
interface Box {
    azimuth: number;
    height: number;
    width: number;
    tall: number;
    radiance: [number, number, number];
}

const LIGHTS: Record<string, { top: number[]; bottom: number[]; boxes: Box[] }> = {
    Studio: {
        top: [0.25, 0.26, 0.28],
        bottom: [0.06, 0.06, 0.06],
        boxes: [
            { azimuth: -40, height: 45, width: 30, tall: 18, radiance: [14, 13.5, 13] },
            { azimuth: 60, height: 30, width: 6, tall: 40, radiance: [22, 23, 25] },
            { azimuth: 170, height: 60, width: 14, tall: 14, radiance: [9, 9, 9] },
        ],
    },
    Night: {
        top: [0.012, 0.015, 0.025],
        bottom: [0.01, 0.009, 0.008],
        boxes: [
            { azimuth: -15, height: 35, width: 2, tall: 2, radiance: [900, 700, 430] },
            { azimuth: 40, height: 50, width: 2, tall: 2, radiance: [620, 640, 700] },
            { azimuth: 130, height: 25, width: 3, tall: 1.5, radiance: [500, 330, 180] },
        ],
    },
    Spotlights: {
        top: [0.2, 0.2, 0.22],
        bottom: [0.1, 0.1, 0.1],
        boxes: [
            { azimuth: -30, height: 40, width: 2.5, tall: 2.5, radiance: [420, 410, 390] },
            { azimuth: -62, height: 34, width: 2.5, tall: 2.5, radiance: [300, 300, 310] },
            { azimuth: 4, height: 52, width: 2.5, tall: 2.5, radiance: [330, 320, 300] },
            { azimuth: 32, height: 22, width: 2, tall: 2, radiance: [230, 240, 260] },
            { azimuth: -95, height: 58, width: 3, tall: 3, radiance: [250, 230, 200] },
        ],
    },
    Overcast: { top: [0.9, 0.95, 1.05], bottom: [0.2, 0.19, 0.17], boxes: [] },
};
export const LIGHT_NAMES = Object.keys(LIGHTS);

/** Of each light, by Rowland.fitKeyLights(): build.mjs. */
declare const BUILT_IN_KEY_LIGHTS: Record<string, number[]>;

export const keyLightsOf = (name: string) => Float32Array.from(BUILT_IN_KEY_LIGHTS[name]);

export function builtInLight(name: string, width = 512): Panorama {
    const height = width / 2;
    const { top, bottom, boxes } = LIGHTS[name];
    const texels = new Float32Array(3 * width * height);
    for (let row = 0; row < height; ++row) {
        const up = 180 * (0.5 - (row + 0.5) / height);
        const mix = Math.min(Math.max(0.5 + up / 30, 0), 1);
        const inHeight = boxes.filter((box) => Math.abs(up - box.height) < box.tall / 2);
        for (let column = 0; column < width; ++column) {
            const around = 360 * ((column + 0.5) / width - 0.5);
            const at = 3 * (row * width + column);
            for (let c = 0; c < 3; ++c) texels[at + c] = bottom[c] + mix * (top[c] - bottom[c]);
            for (const { azimuth, width: wide, radiance } of inHeight) {
                const turned = ((around - azimuth + 540) % 360) - 180;
                if (Math.abs(turned) * Math.cos((up * Math.PI) / 180) >= wide / 2) continue;
                for (let c = 0; c < 3; ++c) texels[at + c] += radiance[c];
            }
        }
    }
    return { texels, width, height };
}

/** A panorama that the user gives. */
export async function lightOf(file: File): Promise<Panorama> {
    const extension = file.name.slice(file.name.lastIndexOf(".")).toLowerCase();
    if (extension !== ".hdr" && extension !== ".exr") throw new Error(`${file.name}: expected a panorama, .hdr or .exr`);
    const loader = extension === ".exr" ? new EXRLoader() : new HDRLoader();
    loader.setDataType(FloatType);
    let image: { data?: ArrayLike<number>; width?: number; height?: number } | undefined;
    try {
        image = loader.parse(await file.arrayBuffer()) as unknown as typeof image;
    } catch (error) {
        throw new Error(`${file.name}: ${(error as Error).message}`);
    }
    const { data, width, height } = image ?? {};
    if (!data || !width || !height || data.length !== 4 * width * height)
        throw new Error(`${file.name}: no picture; expected a Radiance HDR or OpenEXR panorama of colours`);
    const texels = new Float32Array(3 * width * height);
    for (let row = 0; row < height; ++row) {
        const from = extension === ".hdr" ? row : height - 1 - row; // three's EXRLoader begins at the bottom
        for (let column = 0; column < width; ++column)
            for (let c = 0; c < 3; ++c) texels[3 * (row * width + column) + c] = data[4 * (from * width + column) + c];
    }
    return { texels, width, height };
}
