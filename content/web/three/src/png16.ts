/** PNGs of 16 bits, which browsers decode to 8. */

/** RGBA, row 0 at the top. */
export interface Picture16 {
    readonly data: Uint16Array<ArrayBuffer>;
    readonly width: number;
    readonly height: number;
}

const CHANNELS: Record<number, number> = { 0: 1, 2: 3, 4: 2, 6: 4 };

/** Paeth's predictor (PNG, 9.4), from the bytes to the left, above, and above to the left. */
function paeth(left: number, above: number, corner: number): number {
    const [a, b, c] = [Math.abs(above - corner), Math.abs(left - corner), Math.abs(left + above - 2 * corner)];
    return a <= b && a <= c ? left : b <= c ? above : corner;
}

/** Undoes the filters of rows: of `stride` bytes each and the filter before them. */
function unfilter(rows: Uint8Array, stride: number, texel: number): void {
    for (let begin = 1, above = -1; begin < rows.length; above = begin, begin += stride + 1) {
        const filter = rows[begin - 1];
        if (filter === 2 && above >= 0) for (let i = 0; i < stride; ++i) rows[begin + i] += rows[above + i];
        if (filter === 0 || filter === 2) continue;
        for (let i = 0; i < stride; ++i) {
            const left = i < texel ? 0 : rows[begin + i - texel];
            const up = above < 0 ? 0 : rows[above + i];
            const corner = i < texel || above < 0 ? 0 : rows[above + i - texel];
            rows[begin + i] += filter === 1 ? left : filter === 3 ? (left + up) >> 1 : paeth(left, up, corner);
        }
    }
}

/** The texels of a PNG of 16 bits whose rows come in order; null for another picture. Throws for a damaged one. */
export async function decodePng16(bytes: Uint8Array<ArrayBuffer>): Promise<Picture16 | null> {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < 33 || view.getUint32(0) !== 0x89504e47) return null;
    const [width, height, channels] = [view.getUint32(16), view.getUint32(20), CHANNELS[bytes[25]]];
    if (bytes[24] !== 16 || !channels || bytes[28] !== 0) return null;
    const parts: Uint8Array<ArrayBuffer>[] = [];
    for (let at = 8; at + 12 <= bytes.length; at += 12 + view.getUint32(at))
        if (view.getUint32(at + 4) === 0x49444154) parts.push(bytes.subarray(at + 8, at + 8 + view.getUint32(at))); // IDAT
    const inflated = new Blob(parts).stream().pipeThrough(new DecompressionStream("deflate"));
    const rows = new Uint8Array(await new Response(inflated).arrayBuffer());
    const stride = 2 * channels * width;
    if (rows.length !== height * (stride + 1)) throw new Error(`a PNG of ${rows.length} bytes of texels; expected ${height * (stride + 1)}`);
    unfilter(rows, stride, 2 * channels);
    const data = new Uint16Array(4 * width * height).fill(65535);
    const from = channels < 3 ? [0, 0, 0] : [0, 2, 4];
    if (channels % 2 === 0) from.push(2 * channels - 2);
    for (let row = 0, to = 0; row < height; ++row)
        for (let column = 0, at = row * (stride + 1) + 1; column < width; ++column, at += 2 * channels, to += 4)
            for (let c = 0; c < from.length; ++c) data[to + c] = (rows[at + from[c]] << 8) | rows[at + from[c] + 1];
    return { data, width, height };
}
