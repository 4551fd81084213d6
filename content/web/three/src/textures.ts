import {
    ClampToEdgeWrapping, Data3DTexture, DataArrayTexture, DataTexture, FloatType, HalfFloatType, LinearFilter,
    NearestFilter, RepeatWrapping, RGBAFormat, type Texture,
} from "three";
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

export function planeTexture(table: Table): DataTexture {
    const texture = filtered(new DataTexture(texels(table), table.width, table.height));
    texture.wrapS = RepeatWrapping;
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
