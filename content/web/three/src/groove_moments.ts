import { fromHalf, toHalf } from "./half.js";

/** A level of the textures that grooves.glsl reads: moments as halves, and what these round off. */
export interface MomentLevel {
    readonly width: number;
    readonly height: number;
    readonly moments: Uint16Array; // RGBA
    readonly rest: Uint16Array;
}

/** What a texture's levels below the first hold: there are none, or each holds means of the one above, or one facet of four. */
export type GrooveLevels = "one" | "means" | "facets";

/** The moments of a groove texture, and its smallest and largest pitch, over the material's. */
export interface GrooveMoments {
    readonly smallest: number;
    readonly largest: number;
    readonly gaps: boolean;
    readonly levels: MomentLevel[];
    /** Mean area of a facet, where levels hold facets. */
    readonly facetTexels?: number;
}

interface Level {
    width: number;
    height: number;
    data: Float32Array; // RGBA
}

/** A level of half the width and height, rounded down: linear between the centres of texels. */
function halved({ width, height, data }: Level): Level {
    const to = { width: Math.max(1, width >> 1), height: Math.max(1, height >> 1) };
    const half = new Float32Array(4 * to.width * to.height);
    const between = (i: number, count: number, from: number) => {
        const at = Math.max(((i + 0.5) * from) / count - 0.5, 0);
        const low = Math.floor(at);
        return { low, high: Math.min(low + 1, from - 1), weight: at - low };
    };
    const columns = Array.from({ length: to.width }, (_, column) => between(column, to.width, width));
    for (let row = 0, at = 0; row < to.height; ++row) {
        const y = between(row, to.height, height);
        for (const x of columns)
            for (let c = 0; c < 4; ++c, ++at) {
                const [a, b] = [data[4 * (y.low * width + x.low) + c], data[4 * (y.high * width + x.low) + c]];
                const low = a + x.weight * (data[4 * (y.low * width + x.high) + c] - a);
                half[at] = low + y.weight * (b + x.weight * (data[4 * (y.high * width + x.high) + c] - b) - low);
            }
    }
    return { ...to, data: half };
}

/** The value of a texel that stands for 1: of bytes, or of 16 bits. */
export const mostOf = (texels: ArrayLike<number>) => (texels instanceof Uint16Array ? 65535 : 255);

function momentsOf(bytes: ArrayLike<number>, even: boolean, gaps: boolean, smallest: number): Float32Array {
    const moments = new Float32Array(bytes.length);
    const most = mostOf(bytes);
    for (let i = 0; i < bytes.length; i += 4) {
        const green = bytes[i + 1];
        moments[i] = moments[i + 1] = 0.5;
        if (green === 0) continue;
        const angle = ((even ? 2 : 1) * Math.PI * bytes[i]) / most;
        const inverse = smallest / ((2 * green) / most);
        moments[i] += 0.5 * Math.cos(angle);
        moments[i + 1] += 0.5 * Math.sin(angle);
        moments[i + 2] = inverse;
        moments[i + 3] = gaps ? 1 : inverse * inverse;
    }
    return moments;
}

function halves({ width, height, data }: Level): MomentLevel {
    const moments = new Uint16Array(data.length);
    const rest = new Uint16Array(data.length);
    for (let i = 0; i < data.length; ++i) {
        moments[i] = toHalf(data[i]);
        rest[i] = toHalf(data[i] - fromHalf(moments[i]));
    }
    return { width, height, moments, rest };
}

/** The moments of modules/diffraction/runtime/groove_map.h, of RGBA, bytes or 16 bits, the row at v = 0 first. */
export function grooveMoments(bytes: ArrayLike<number>, width: number, height: number, even: boolean, mipmaps: boolean): GrooveMoments {
    const greens = new Set<number>();
    for (let i = 1; i < bytes.length; i += 4) greens.add(bytes[i]);
    const gaps = greens.delete(0);
    const factors = [...greens].map((green) => (2 * green) / mostOf(bytes)).sort((a, b) => a - b);
    const [smallest = 1, largest = 1] = [factors[0], factors[factors.length - 1]];
    const levels: Level[] = [{ width, height, data: momentsOf(bytes, even, gaps, smallest) }];
    for (let last = levels[0]; mipmaps && last.width * last.height > 1; levels.push(last)) last = halved(last);
    return { smallest, largest, gaps, levels: levels.map(halves) };
}

/** From the numbers of facet_levels(), content/web/bake/sparkle.cpp. */
export function facetsOf(numbers: Float32Array, width: number, height: number): GrooveMoments {
    const [smallest, largest, gaps, facetTexels] = numbers;
    const levels: MomentLevel[] = [];
    for (let at = 4; at < numbers.length; width = Math.max(1, width >> 1), height = Math.max(1, height >> 1))
        levels.push(halves({ width, height, data: numbers.subarray(at, (at += 4 * width * height)) }));
    return { smallest, largest, gaps: gaps === 1, levels, facetTexels };
}
