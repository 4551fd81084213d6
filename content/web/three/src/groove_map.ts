import { mipmapTexture, Vector2, Vector4, type Texture } from "./engine.js";
import { mostOf } from "./groove_moments.js";
import type { Rowland } from "./rowland.js";

export type Wrap = "clamp" | "repeat" | "mirror";

/** A groove texture's texels: R is the rotation / π, G half the pitch over the material's; 0: no grating. */
export interface GrooveImage {
    /** RGBA, bytes or 16 bits, the row at v = 0 first. */
    readonly bytes: Uint8Array | Uint16Array;
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
    readonly image: GrooveImage;
    /** Mean area of a facet, of a texture that sparkles. */
    readonly facetTexels?: number;
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
        (Math.PI / mostOf(bytes)) * bytes[4 * (wrapped(row, height, wraps[1]) * width + wrapped(column, width, wraps[0]))];
    if (nearest) return red(Math.floor(u * width), Math.floor(v * height));
    const [left, below] = [u * width - 0.5, v * height - 0.5];
    const [column, row] = [Math.floor(left), Math.floor(below)];
    const inRow = (at: number) => red(column, at) + (left - column) * (red(column + 1, at) - red(column, at));
    return inRow(row) + (below - row) * (inRow(row + 1) - inRow(row));
}

/** `even`: whether the material's kernel is; `sparkle`: pixels show some of the facets that they cover. */
export async function grooveMap(image: GrooveImage, even: boolean, sparkle: boolean, rowland: Rowland): Promise<GrooveMap> {
    const { bytes, width, height } = image;
    const nearest = sparkle || image.nearest;
    const { levels, ...found } = await rowland.grooveMoments(bytes, width, height, even, sparkle ? "facets" : nearest ? "one" : "means");
    const texture = (of: "moments" | "rest") =>
        mipmapTexture(levels.map(({ width, height, [of]: data }) => ({ width, height, data: data as Uint16Array<ArrayBuffer> })), nearest, image.wraps);
    return { ...found, image, moments: texture("moments"), rest: texture("rest") };
}
