/** PNGs of RGB values, which the browser compresses. */

const CRC = Uint32Array.from({ length: 256 }, (_, n) => {
    for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
    return n;
});

/** Length, type, data and check sum (PNG, 5.3). */
function chunk(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(12 + data.length);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, data.length);
    for (let i = 0; i < 4; ++i) bytes[4 + i] = type.charCodeAt(i);
    bytes.set(data, 8);
    let crc = 0xffffffff;
    for (let i = 4; i < 8 + data.length; ++i) crc = CRC[(crc ^ bytes[i]) & 255] ^ (crc >>> 8);
    view.setUint32(8 + data.length, crc ^ 0xffffffff);
    return bytes;
}

/** The values as a PNG has them: each row after its filter, here the difference from the row above. */
function filtered(values: Uint8Array | Uint16Array, width: number, height: number): Uint8Array<ArrayBuffer> {
    const wide = values instanceof Uint16Array;
    const stride = 3 * width * (wide ? 2 : 1);
    const rows = new Uint8Array(height * (stride + 1));
    const bytes = new Uint8Array(stride);
    const above = new Uint8Array(stride);
    for (let row = 0, to = 0; row < height; ++row) {
        const line = values.subarray(3 * width * row, 3 * width * (row + 1));
        if (wide) line.forEach((value, i) => ((bytes[2 * i] = value >> 8), (bytes[2 * i + 1] = value)));
        else bytes.set(line);
        rows[to++] = 2; // up
        for (let i = 0; i < stride; ++i) rows[to++] = bytes[i] - above[i];
        above.set(bytes);
    }
    return rows;
}

/** RGB of 8 or of 16 bits, row 0 at the top. */
export async function encodePng(values: Uint8Array | Uint16Array, width: number, height: number): Promise<Uint8Array<ArrayBuffer>> {
    const deflated = new Blob([filtered(values, width, height)]).stream().pipeThrough(new CompressionStream("deflate"));
    const header = new Uint8Array(13);
    const view = new DataView(header.buffer);
    view.setUint32(0, width);
    view.setUint32(4, height);
    header.set([8 * values.BYTES_PER_ELEMENT, 2], 8); // RGB
    const parts = [Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10), chunk("IHDR", header),
        chunk("IDAT", new Uint8Array(await new Response(deflated).arrayBuffer())), chunk("IEND", new Uint8Array())];
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}
