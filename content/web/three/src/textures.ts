import {
    ClampToEdgeWrapping, Data3DTexture, DataArrayTexture, DataTexture, FloatType, HalfFloatType, LinearFilter, LinearMipmapLinearFilter,
    MirroredRepeatWrapping, NearestFilter, NearestMipmapNearestFilter, RepeatWrapping, RGBAFormat, Vector2, Vector4, type BufferGeometry, type Texture,
} from "three";
import type { GrooveImage, Wrap } from "./groove_map.js";
import type { Table } from "./tasks.js";

function filtered<Kind extends Texture>(texture: Kind): Kind {
    texture.format = RGBAFormat;
    texture.type = HalfFloatType;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

const texels = (table: Table) => table.texels as Uint16Array<ArrayBuffer>;

export function planeTexture(table: Table, repeated = true): DataTexture {
    const texture = filtered(new DataTexture(texels(table), table.width, table.height));
    texture.wrapS = repeated ? RepeatWrapping : ClampToEdgeWrapping;
    return texture;
}

export function arrayTexture(table: Table, repeated = false): DataArrayTexture {
    const texture = filtered(new DataArrayTexture(texels(table), table.width, table.height, table.depth));
    if (repeated) texture.wrapS = RepeatWrapping;
    return texture;
}

export function volumeTexture(table: Table, repeated: { s?: boolean; r?: boolean }): Data3DTexture {
    const texture = filtered(new Data3DTexture(texels(table), table.width, table.height, table.depth));
    texture.wrapS = repeated.s ? RepeatWrapping : ClampToEdgeWrapping;
    texture.wrapR = repeated.r ? RepeatWrapping : ClampToEdgeWrapping;
    return texture;
}

const WRAPPINGS = { clamp: ClampToEdgeWrapping, repeat: RepeatWrapping, mirror: MirroredRepeatWrapping };

/** Of halves, with its levels, the largest first. */
export function mipmapTexture(levels: { width: number; height: number; data: Uint16Array<ArrayBuffer> }[], nearest: boolean, wraps: readonly [Wrap, Wrap]): Texture {
    const [{ data, width, height }] = levels;
    const texture = filtered(new DataTexture(data, width, height));
    if (levels.length > 1) texture.mipmaps = levels as never;
    [texture.wrapS, texture.wrapT] = wraps.map((wrap) => WRAPPINGS[wrap]);
    texture.magFilter = nearest ? NearestFilter : LinearFilter;
    texture.minFilter = nearest ? NearestMipmapNearestFilter : LinearMipmapLinearFilter;
    return texture;
}

/** RGBA, bytes or 16 bits, the row at v = 0 first. */
function bytesOf(texture: Texture): Uint8Array | Uint16Array {
    const image = texture.image as { data?: Uint8Array | Uint16Array | Uint8ClampedArray; width: number; height: number };
    const { width, height } = image;
    let { data } = image;
    if (!data) {
        const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
        context.drawImage(image as never, 0, 0);
        data = context.getImageData(0, 0, width, height).data;
    }
    if (data.length !== 4 * width * height) throw new Error("grooveTexture: expected a texture of RGBA bytes");
    if (!texture.flipY) return data as Uint8Array;
    const flipped = (data as Uint8Array).slice();
    for (let row = 0; row < height; ++row)
        for (let i = 0; i < 4 * width; ++i) flipped[4 * width * row + i] = data[4 * width * (height - 1 - row) + i];
    return flipped;
}

export async function grooveImage(texture: Texture): Promise<GrooveImage> {
    const { width, height } = texture.image as { width: number; height: number };
    const wrap = (wrapping: number) => (["clamp", "repeat", "mirror"] as const).find((name) => WRAPPINGS[name] === wrapping)!;
    texture.updateMatrix();
    const m = texture.matrix.elements; // by columns
    return {
        bytes: bytesOf(texture), width, height, wraps: [wrap(texture.wrapS), wrap(texture.wrapT)], nearest: texture.magFilter === NearestFilter,
        uv: texture.channel === 0 ? "uv" : "uv1", uvLinear: new Vector4(m[0], m[1], m[3], m[4]), uvOffset: new Vector2(m[6], m[7]),
    };
}

/** Texture coordinates of a vertex. */
export function coordinatesOf(geometry: BufferGeometry, uv: string): (vertex: number) => [number, number] {
    const attribute = geometry.getAttribute(uv);
    return (vertex) => (attribute ? [attribute.getX(vertex), attribute.getY(vertex)] : [0, 0]);
}

/** Vectors that a storage texture holds: its rows are the 2048 that every WebGL 2 has. */
export const MOST_STORED = 1024 * 2048;

/** STORAGE of dialect.glsl: vec4s in rows of 1024 texels, read unfiltered. */
export function storageTexture(vectors: Float32Array): DataTexture {
    const rows = Math.max(1, Math.ceil(vectors.length / 4096));
    const padded = new Float32Array(4096 * rows);
    padded.set(vectors);
    const texture = new DataTexture(padded, 1024, rows, RGBAFormat, FloatType);
    texture.magFilter = NearestFilter;
    texture.minFilter = NearestFilter;
    texture.needsUpdate = true;
    return texture;
}

/** Moves the texels of `from` into a texture of the same kind and size; false if they differ in that. */
export function takeContent(to: Texture, from: Texture): boolean {
    const [own, other] = [to.image, from.image] as { width: number; height: number; depth?: number; data: object }[];
    const alike = (["constructor", "format", "type", "wrapS", "wrapT", "magFilter", "minFilter"] as const).every((key) => to[key] === from[key]) &&
        (to as Data3DTexture).wrapR === (from as Data3DTexture).wrapR && own.width === other.width && own.height === other.height &&
        own.depth === other.depth && to.mipmaps!.length === 0 && from.mipmaps!.length === 0;
    if (!alike) return false;
    own.data = other.data;
    to.needsUpdate = true;
    return true;
}
