import { fromHalf, mipmapTexture, Vector2, Vector4, type Texture } from "./engine.js";
import { toHalf } from "./half.js";

export type Wrap = "clamp" | "repeat" | "mirror";

/** A groove texture's texels: R is the rotation / π, G half the pitch over the material's; 0: no grating. */
export interface GrooveImage {
    /** RGBA, the row at v = 0 first. */
    readonly bytes: ArrayLike<number>;
    readonly width: number;
    readonly height: number;
    readonly wraps: readonly [u: Wrap, v: Wrap];
    readonly nearest: boolean;
    /** From the coordinates of this attribute to the texture's: the 2x2 part by columns, and the offset. */
    readonly uv: string;
    readonly uvLinear: Vector4;
    readonly uvOffset: Vector2;
}

/** What grooves.glsl reads of a groove texture: the moments of modules/diffraction/runtime/groove_map.h, as halves and what these round off. */
export interface GrooveMap {
    readonly moments: Texture;
    readonly rest: Texture;
    /** The smallest and the largest pitch, over the material's. */
    readonly smallest: number;
    readonly largest: number;
    readonly gaps: boolean;
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
    for (let row = 0; row < to.height; ++row) {
        const y = between(row, to.height, height);
        for (let column = 0; column < to.width; ++column) {
            const x = between(column, to.width, width);
            for (let c = 0; c < 4; ++c) {
                const inRow = (v: number) => {
                    const left = data[4 * (v * width + x.low) + c];
                    return left + x.weight * (data[4 * (v * width + x.high) + c] - left);
                };
                const low = inRow(y.low);
                half[4 * (row * to.width + column) + c] = low + y.weight * (inRow(y.high) - low);
            }
        }
    }
    return { ...to, data: half };
}

function momentsOf(bytes: ArrayLike<number>, even: boolean, gaps: boolean, smallest: number): Float32Array {
    const moments = new Float32Array(bytes.length);
    for (let i = 0; i < bytes.length; i += 4) {
        const [red, green] = [bytes[i], bytes[i + 1]];
        moments.fill(0.5, i, i + 2);
        if (green === 0) continue;
        const angle = ((even ? 2 : 1) * Math.PI * red) / 255;
        const inverse = smallest / ((2 * green) / 255);
        moments[i] += 0.5 * Math.cos(angle);
        moments[i + 1] += 0.5 * Math.sin(angle);
        moments[i + 2] = inverse;
        moments[i + 3] = gaps ? 1 : inverse * inverse;
    }
    return moments;
}

/** The column or row of an image after wrapping. */
function wrapped(index: number, size: number, wrap: Wrap): number {
    if (wrap === "clamp") return Math.min(Math.max(index, 0), size - 1);
    const period = wrap === "mirror" ? 2 * size : size;
    const within = ((index % period) + period) % period;
    return within < size ? within : period - 1 - within;
}

/** The grooves' rotation in radians where a vertex has these coordinates, from the image's largest level. */
export function rotationAt({ bytes, width, height, wraps, nearest, uvLinear: m, uvOffset }: GrooveImage, x: number, y: number): number {
    const [u, v] = [m.x * x + m.z * y + uvOffset.x, m.y * x + m.w * y + uvOffset.y];
    const red = (column: number, row: number) =>
        (Math.PI / 255) * bytes[4 * (wrapped(row, height, wraps[1]) * width + wrapped(column, width, wraps[0]))];
    if (nearest) return red(Math.floor(u * width), Math.floor(v * height));
    const [left, below] = [u * width - 0.5, v * height - 0.5];
    const [column, row] = [Math.floor(left), Math.floor(below)];
    const inRow = (at: number) => red(column, at) + (left - column) * (red(column + 1, at) - red(column, at));
    return inRow(row) + (below - row) * (inRow(row + 1) - inRow(row));
}

/** `even`: whether the material's kernel is; `sparkle`: a pixel shows the grooves of one texel. */
export function grooveMap(image: GrooveImage, even: boolean, sparkle: boolean): GrooveMap {
    const { bytes, width, height } = image;
    const greens = new Set<number>();
    for (let i = 1; i < bytes.length; i += 4) greens.add(bytes[i]);
    const gaps = greens.delete(0);
    const factors = [...greens].map((green) => (2 * green) / 255);
    const [smallest, largest] = factors.length > 0 ? [Math.min(...factors), Math.max(...factors)] : [1, 1];
    const nearest = sparkle || image.nearest;
    const levels: Level[] = [{ width, height, data: momentsOf(bytes, even, gaps, smallest) }];
    for (let last = levels[0]; !nearest && last.width * last.height > 1; levels.push(last)) last = halved(last);
    const texture = (texel: (value: number) => number) =>
        mipmapTexture(levels.map(({ width, height, data }) => ({ width, height, data: Uint16Array.from(data, texel) })), nearest, image.wraps);
    return { moments: texture(toHalf), rest: texture((value) => toHalf(value - fromHalf(toHalf(value)))), smallest, largest, gaps };
}
