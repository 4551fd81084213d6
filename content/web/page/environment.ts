/** The light for three's reflections, filtered in a worker: PMREMGenerator takes seconds of a software renderer, and blocks the page. */
import type { Panorama } from "@rowland/three";
import { toHalf } from "../three/src/half.js";

/** Faces of a cube in WebGL's order, RGBA halves, of each mip level. */
export interface Levels {
    size: number; // of a face of the first level
    levels: Uint16Array[][];
}

const [SMALLEST, LARGEST] = [256, 512];
/** The last level has faces of 8 texels and the light for roughness 1, as three's shaders expect. */
const LAST_SIZE = 8;
const GOLDEN_ANGLE = Math.PI * (3 - Math.sqrt(5));

/** RGB, face after face. */
interface Cube {
    size: number;
    texels: Float32Array;
}

/** Calls `value` with the direction of each texel, of length 1, and its index. */
function cubeOf(size: number, value: (x: number, y: number, z: number, texels: Float32Array, at: number) => void): Cube {
    const texels = new Float32Array(18 * size * size);
    for (let face = 0, at = 0; face < 6; ++face)
        for (let row = 0; row < size; ++row)
            for (let column = 0; column < size; ++column, at += 3) {
                const s = (2 * column + 1) / size - 1;
                const t = (2 * row + 1) / size - 1;
                const scale = 1 / Math.sqrt(1 + s * s + t * t);
                const along = face % 2 === 0 ? scale : -scale; // the face's axis
                if (face < 2) value(along, -t * scale, -s * along, texels, at);
                else if (face < 4) value(s * scale, along, t * along, texels, at);
                else value(s * along, -t * scale, along, texels, at);
            }
    return { size, texels };
}

/** three mirrors cube textures in x. */
function cubeOfPanorama({ texels: from, width, height }: Panorama, size: number): Cube {
    return cubeOf(size, (x, y, z, texels, at) => {
        const u = (Math.atan2(z, -x) / (2 * Math.PI) + 0.5) * width - 0.5;
        const v = Math.min(Math.max((0.5 - Math.asin(y) / Math.PI) * height - 0.5, 0), height - 1);
        const column = Math.floor(u);
        const row = Math.floor(v);
        const left = (column + width) % width;
        const right = (column + 1) % width;
        const upper = width * row;
        const lower = width * Math.min(row + 1, height - 1);
        for (let i = 0; i < 3; ++i) {
            const above = from[3 * (upper + left) + i] * (column + 1 - u) + from[3 * (upper + right) + i] * (u - column);
            const below = from[3 * (lower + left) + i] * (column + 1 - u) + from[3 * (lower + right) + i] * (u - column);
            texels[at + i] = above + (v - row) * (below - above);
        }
    });
}

function halved({ size, texels: from }: Cube): Cube {
    const half = size / 2;
    const texels = new Float32Array(18 * half * half);
    for (let row = 0, to = 0; row < 6 * half; ++row)
        for (let column = 0; column < half; ++column)
            for (let i = 0; i < 3; ++i, ++to) {
                const at = 3 * (2 * row * size + 2 * column) + i;
                texels[to] = 0.25 * (from[at] + from[at + 3] + from[at + 3 * size] + from[at + 3 * size + 3]);
            }
    return { size: half, texels };
}

/** A direction about the normal, its weight, and the level of the source whose texels are as wide as what it stands for. */
interface Sample {
    x: number;
    y: number;
    z: number;
    weight: number;
    level: number;
}

/** The weights sum to 1. */
function samplesOf(roughness: number, count: number, size: number): Sample[] {
    // GGX seen along the normal: half vectors are drawn by D cos, so that a reflected direction has the density D / 4
    // (Walter et al. 2007, eqs. 33 to 38), and light is weighted by its cosine.
    const alpha2 = roughness ** 4;
    const texel = (4 * Math.PI) / (6 * size * size);
    const samples = Array.from({ length: count }, (_, i) => {
        const u = (i + 0.5) / count;
        const cos2 = (1 - u) / (1 + (alpha2 - 1) * u);
        const density = alpha2 / (4 * Math.PI * (cos2 * (alpha2 - 1) + 1) ** 2);
        const z = 2 * cos2 - 1;
        const radius = Math.sqrt(1 - z * z);
        const level = Math.max(Math.round(0.5 * Math.log2(1 / (count * density * texel)) + 0.5), 0);
        return { x: radius * Math.cos(i * GOLDEN_ANGLE), y: radius * Math.sin(i * GOLDEN_ANGLE), z, weight: z, level };
    }).filter(({ z }) => z > 0);
    const sum = samples.reduce((all, { weight }) => all + weight, 0);
    return samples.map((sample) => ({ ...sample, weight: sample.weight / sum }));
}

/** One loop, as a call for each sample takes three times as long. */
function gather(sources: Cube[], samples: Sample[], nx: number, ny: number, nz: number, texels: Float32Array, at: number): void {
    // The frame about the normal: t is across it and z.
    const across = Math.hypot(nx, ny);
    const tx = across > 1e-6 ? -ny / across : 1;
    const ty = across > 1e-6 ? nx / across : 0;
    let [red, green, blue] = [0, 0, 0];
    for (const sample of samples) {
        const x = tx * sample.x - nz * ty * sample.y + nx * sample.z;
        const y = ty * sample.x + nz * tx * sample.y + ny * sample.z;
        const z = (nx * ty - ny * tx) * sample.y + nz * sample.z;
        const { size, texels: from } = sources[Math.min(sample.level, sources.length - 1)];
        const [ax, ay, az] = [Math.abs(x), Math.abs(y), Math.abs(z)];
        const axis = Math.max(ax, ay, az);
        const face = axis === ax ? (x > 0 ? 0 : 1) : axis === ay ? (y > 0 ? 2 : 3) : z > 0 ? 4 : 5;
        const s = face === 0 ? -z : face === 1 ? z : face === 5 ? -x : x;
        const t = face === 2 ? z : face === 3 ? -z : -y;
        // Between the centres of texels of one face.
        const u = Math.min(Math.max(((s / axis + 1) * size - 1) / 2, 0), size - 1);
        const v = Math.min(Math.max(((t / axis + 1) * size - 1) / 2, 0), size - 1);
        const column = Math.min(Math.floor(u), size - 2);
        const row = Math.min(Math.floor(v), size - 2);
        const i = 3 * ((face * size + row) * size + column);
        const j = i + 3 * size;
        const right = u - column;
        const below = sample.weight * (v - row);
        const above = sample.weight - below;
        const [a, b, c, d] = [above * (1 - right), above * right, below * (1 - right), below * right];
        red += a * from[i] + b * from[i + 3] + c * from[j] + d * from[j + 3];
        green += a * from[i + 1] + b * from[i + 4] + c * from[j + 1] + d * from[j + 4];
        blue += a * from[i + 2] + b * from[i + 5] + c * from[j + 2] + d * from[j + 5];
    }
    texels[at] = red;
    texels[at + 1] = green;
    texels[at + 2] = blue;
}

function halvesOf({ size, texels }: Cube): Uint16Array[] {
    return Array.from({ length: 6 }, (_, face) => {
        const halves = new Uint16Array(4 * size * size).fill(0x3c00); // 1
        for (let i = 3 * face * size * size, j = 0; j < halves.length; i += 3, j += 4)
            for (let c = 0; c < 3; ++c) halves[j + c] = toHalf(texels[i + c]);
        return halves;
    });
}

/** The light of a panorama that surfaces of increasing roughness reflect toward their normal. */
export function filtered(panorama: Panorama): Levels {
    const size = Math.min(Math.max(2 ** Math.floor(Math.log2(panorama.width / 4)), SMALLEST), LARGEST);
    const sources = [cubeOfPanorama(panorama, size)];
    for (let last = sources[0]; last.size > LAST_SIZE; sources.push(last)) last = halved(last);
    const levels = sources.map((source, level) => {
        if (level === 0) return halvesOf(source);
        // The roughness of a level: PMREMGenerator.lodToRoughness().
        const samples = samplesOf(1 - Math.sqrt(1 - level / (sources.length - 1)), 16 * 2 ** level, size);
        return halvesOf(cubeOf(source.size, (x, y, z, texels, at) => gather(sources, samples, x, y, z, texels, at)));
    });
    return { size, levels };
}

// In a worker, for TaskWorker; the tests take filtered() from this file as well.
globalThis.onmessage = ({ data: { id, args } }: MessageEvent) => {
    const [texels, width, height] = args;
    const result = filtered({ texels, width, height });
    postMessage({ id, result }, { transfer: result.levels.flat().map(({ buffer }) => buffer as ArrayBuffer) });
};
