/** Textures of half floats, which every WebGL 2 filters. */

const bits = new Uint32Array(1);
const value = new Float32Array(bits.buffer);

/** Bits of the nearest half float; beyond ±65504, of the nearest finite one. */
export function toHalf(x: number): number {
    value[0] = Math.max(-65504, Math.min(65504, x));
    const whole = bits[0];
    const sign = (whole >>> 16) & 0x8000;
    const exponent = ((whole >>> 23) & 0xff) - 112;
    if (exponent <= 0) {
        // Below the least normal half: a multiple of 2^-24.
        return sign | Math.round(Math.abs(value[0]) * 16777216);
    }
    const rounded = (exponent << 10) + (((whole & 0x7fffff) + 0xfff + ((whole >>> 13) & 1)) >>> 13);
    return sign | rounded;
}

/** Of a finite half of at least 0. */
export function fromHalf(half: number): number {
    const exponent = half >>> 10;
    return exponent === 0 ? half * 2 ** -24 : (1024 + (half & 1023)) * 2 ** (exponent - 25);
}

export interface Halves {
    readonly texels: Uint16Array; // RGBA
    readonly scale: number; // of the stored values
}

/** RGB floats as RGBA halves, divided by the largest magnitude. */
export function packRgb(floats: Float32Array): Halves {
    let scale = 1e-30;
    for (const x of floats) scale = Math.max(scale, Math.abs(x));
    const texels = new Uint16Array((floats.length / 3) * 4);
    for (let i = 0, j = 0; i < floats.length; i += 3, j += 4) {
        texels[j] = toHalf(floats[i] / scale);
        texels[j + 1] = toHalf(floats[i + 1] / scale);
        texels[j + 2] = toHalf(floats[i + 2] / scale);
    }
    return { texels, scale };
}
