import {
    ClampToEdgeWrapping, DataTexture, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, MirroredRepeatWrapping,
    NearestFilter, RGBAFormat, Vector2, Vector4, type BufferGeometry, type Texture, type Wrapping,
} from "three";
import type { Rowland } from "./rowland.js";

/**
 * What grooves.glsl reads of a groove texture (R: rotation / π, G: half the pitch over the material's; 0: no grating):
 * the moments of modules/diffraction/runtime/groove_map.h, as halves and what these round off.
 */
export interface GrooveMap {
    readonly moments: DataTexture;
    readonly rest: DataTexture;
    /** The smallest and the largest pitch, over the material's. */
    readonly smallest: number;
    readonly largest: number;
    readonly gaps: boolean;
    /** From the coordinates of this attribute to the texture's: the 2x2 part by columns, and the offset. */
    readonly uv: "uv" | "uv1";
    readonly uvLinear: Vector4;
    readonly uvOffset: Vector2;
    /** The grooves' rotation at texture coordinates, in radians, from the texture's largest level. */
    rotation(u: number, v: number): number;
}

/** RGBA bytes, the row at v = 0 first. */
function bytesOf(texture: Texture): { data: ArrayLike<number>; width: number; height: number } {
    const image = texture.image as { data?: Uint8Array; width: number; height: number };
    const { width, height } = image;
    let { data } = image as { data?: ArrayLike<number> };
    if (!data) {
        const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
        context.drawImage(image as never, 0, 0);
        data = context.getImageData(0, 0, width, height).data;
    }
    if (data.length !== 4 * width * height) throw new Error("grooveTexture: expected a texture of RGBA bytes");
    if (!texture.flipY) return { data, width, height };
    const flipped = new Uint8Array(data.length);
    for (let row = 0; row < height; ++row)
        for (let i = 0; i < 4 * width; ++i) flipped[4 * width * row + i] = data[4 * width * (height - 1 - row) + i];
    return { data: flipped, width, height };
}

function texture(mipmaps: { width: number; height: number; data: Uint16Array }[], nearest: boolean, like: Texture): DataTexture {
    const result = new DataTexture(mipmaps[0].data as Uint16Array<ArrayBuffer>, mipmaps[0].width, mipmaps[0].height, RGBAFormat, HalfFloatType);
    if (mipmaps.length > 1) result.mipmaps = mipmaps as never;
    result.wrapS = like.wrapS;
    result.wrapT = like.wrapT;
    result.magFilter = nearest ? NearestFilter : LinearFilter;
    result.minFilter = nearest ? NearestFilter : LinearMipmapLinearFilter;
    result.needsUpdate = true;
    return result;
}

/** The column or row of an image after wrapping. */
function wrapped(index: number, size: number, wrap: Wrapping): number {
    if (wrap === ClampToEdgeWrapping) return Math.min(Math.max(index, 0), size - 1);
    const period = wrap === MirroredRepeatWrapping ? 2 * size : size;
    const within = ((index % period) + period) % period;
    return within < size ? within : period - 1 - within;
}

function rotationAt({ bytes, width, height, nearest, like }: { bytes: ArrayLike<number>; width: number; height: number; nearest: boolean; like: Texture },
    u: number, v: number): number {
    const red = (column: number, row: number) =>
        (Math.PI / 255) * bytes[4 * (wrapped(row, height, like.wrapT) * width + wrapped(column, width, like.wrapS))];
    if (nearest) return red(Math.floor(u * width), Math.floor(v * height));
    const [x, y] = [u * width - 0.5, v * height - 0.5];
    const [column, row] = [Math.floor(x), Math.floor(y)];
    const inRow = (at: number) => red(column, at) + (x - column) * (red(column + 1, at) - red(column, at));
    return inRow(row) + (y - row) * (inRow(row + 1) - inRow(row));
}

/** The rotation of a groove texture at each vertex. `texture`: gives the texture coordinates and their transform. */
export function rotationsOf({ rotation }: GrooveMap, texture: Texture, geometry: BufferGeometry): number[] {
    const coordinates = geometry.getAttribute(texture.channel === 0 ? "uv" : "uv1");
    const at = new Vector2();
    texture.updateMatrix();
    return Array.from({ length: geometry.getAttribute("position").count }, (_, vertex) => {
        if (coordinates) at.fromBufferAttribute(coordinates as never, vertex);
        else at.set(0, 0);
        at.applyMatrix3(texture.matrix);
        return rotation(at.x, at.y);
    });
}

/** `even`: whether the material's kernel is; `sparkle`: a pixel shows the grooves of one texel. */
export async function grooveMap(from: Texture, even: boolean, sparkle: boolean, rowland: Rowland): Promise<GrooveMap> {
    const { data: bytes, width, height } = bytesOf(from);
    const nearest = sparkle || from.magFilter === NearestFilter;
    const { smallest, largest, gaps, levels } = await rowland.grooveMoments(bytes, width, height, even, !nearest);
    from.updateMatrix();
    const m = from.matrix.elements; // by columns
    return {
        moments: texture(levels.map(({ moments, ...size }) => ({ ...size, data: moments })), nearest, from),
        rest: texture(levels.map(({ rest, ...size }) => ({ ...size, data: rest })), nearest, from),
        smallest,
        largest,
        gaps,
        uv: from.channel === 0 ? "uv" : "uv1",
        uvLinear: new Vector4(m[0], m[1], m[3], m[4]),
        uvOffset: new Vector2(m[6], m[7]),
        rotation: (u, v) => rotationAt({ bytes, width, height, nearest: from.magFilter === NearestFilter, like: from }, u, v),
    };
}
