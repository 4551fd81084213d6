import assert from "node:assert/strict";
import test from "node:test";
import { DataUtils } from "three";
import { packRgb, toHalf } from "../dist/half.js";

test("halves are the nearest", () => {
    for (let i = 0; i < 63488; ++i) {
        if ((i & 0x7c00) === 0x7c00) continue; // infinite, or no number
        const x = DataUtils.fromHalfFloat(i);
        assert.equal(DataUtils.fromHalfFloat(toHalf(x)), x);
        const spacing = Math.max(Math.abs(x) * 2 ** -11, 2 ** -25);
        assert.ok(Math.abs(DataUtils.fromHalfFloat(toHalf(x * 1.0002)) - x * 1.0002) <= spacing * 1.001);
    }
    assert.equal(DataUtils.fromHalfFloat(toHalf(1e9)), 65504);
});

test("packed texels are the values over their scale", () => {
    const { texels, scale } = packRgb(Float32Array.of(1, -3000, 0.5, 6, 7, 8));
    assert.equal(scale, 3000);
    const value = (i) => scale * DataUtils.fromHalfFloat(texels[i]);
    [1, -3000, 0.5, 0, 6, 7, 8, 0].forEach((x, i) => assert.ok(Math.abs(value(i) - x) <= Math.abs(x) / 2000));
});
