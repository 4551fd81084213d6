// Groove textures of 16 bits, which browsers would decode to 8.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import test from "node:test";
import { deflateSync } from "node:zlib";
import { packageFolder } from "./browser.mjs";

const built = existsSync(packageFolder + "dist/png16.js");
const skip = built ? false : "needs dist: npm run build";
const CHANNELS = { 0: 1, 2: 3, 4: 2, 6: 4 };

/** Each filter's prediction of a byte (PNG, 9.2). */
const PREDICTED = [() => 0, (a) => a, (a, b) => b, (a, b) => (a + b) >> 1, (a, b, c) => {
    const distances = [a, b, c].map((x) => Math.abs(a + b - c - x));
    return [a, b, c][distances.indexOf(Math.min(...distances))];
}];

/** Without its check sum, which is not read. */
function chunk(type, data) {
    const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(type), data, Buffer.alloc(4)]);
    bytes.writeUInt32BE(data.length);
    return bytes;
}

/** Row i has the filter i mod 5. The data is in two parts. */
function png(values, width, height, colour, depth = 16) {
    const texel = (CHANNELS[colour] * depth) / 8;
    const stride = width * texel;
    const bytes = Buffer.alloc(height * stride);
    values.forEach((value, i) => (depth === 16 ? bytes.writeUInt16BE(value, 2 * i) : (bytes[i] = value)));
    const at = (row, i) => (row < 0 || i < 0 ? 0 : bytes[row * stride + i]);
    const rows = Buffer.alloc(height * (stride + 1));
    for (let row = 0; row < height; ++row) {
        rows[row * (stride + 1)] = row % 5;
        for (let i = 0; i < stride; ++i)
            rows[row * (stride + 1) + 1 + i] = at(row, i) - PREDICTED[row % 5](at(row, i - texel), at(row - 1, i), at(row - 1, i - texel));
    }
    const header = Buffer.from([0, 0, 0, width, 0, 0, 0, height, depth, colour, 0, 0, 0]);
    const data = deflateSync(rows);
    return new Uint8Array(Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", header), chunk("IDAT", data.subarray(0, 7)),
        chunk("IDAT", data.subarray(7)), chunk("IEND", Buffer.alloc(0))]));
}

const values = (count) => Array.from({ length: count }, (_, i) => (40503 * i + 977 * i * i) % 65536);

test("all filters and colour types of PNGs of 16 bits are decoded", { skip }, async () => {
    const { decodePng16 } = await import("../dist/png16.js");
    const [width, height] = [7, 11];
    for (const [colour, channels] of Object.entries(CHANNELS)) {
        const given = values(width * height * channels);
        const { data, ...size } = await decodePng16(png(given, width, height, Number(colour)));
        assert.deepEqual(size, { width, height });
        const expected = Array.from({ length: width * height }, (_, i) => {
            const own = given.slice(channels * i, channels * (i + 1));
            return [...(channels < 3 ? [own[0], own[0], own[0]] : own.slice(0, 3)), channels % 2 === 0 ? own[channels - 1] : 65535];
        });
        assert.deepEqual([...data], expected.flat(), `colour type ${colour}`);
    }
});

test("other pictures are the browser's, and a damaged one is refused", { skip }, async () => {
    const { decodePng16 } = await import("../dist/png16.js");
    assert.equal(await decodePng16(png(values(48), 4, 4, 2, 8)), null);
    assert.equal(await decodePng16(new TextEncoder().encode("no PNG, but as long as the header of one is")), null);
    const short = png(values(48), 4, 4, 2);
    short[23] = 5; // a row more than it has
    await assert.rejects(decodePng16(short), /a PNG of 100 bytes of texels; expected 125/);
});

test("a groove texture of 16 bits has the moments of its bytes times 257", { skip }, async () => {
    const { grooveMoments } = await import("../dist/groove_moments.js");
    const bytes = Uint8Array.from(values(4 * 8 * 8), (value) => value >> 8);
    const [narrow, wide] = [bytes, Uint16Array.from(bytes, (byte) => 257 * byte)].map((texels) => grooveMoments(texels, 8, 8, true, true));
    assert.ok(Math.abs(narrow.smallest - wide.smallest) < 1e-12 && Math.abs(narrow.largest - wide.largest) < 1e-12 && narrow.gaps === wide.gaps);
    assert.deepEqual(wide.levels.map(({ moments }) => [...moments]), narrow.levels.map(({ moments }) => [...moments]));
});
