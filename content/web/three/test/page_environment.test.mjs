// The light for three's reflections, as the page's worker filters it, beside the integral. SITE is the folder of the page.
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { pathToFileURL } from "node:url";
import { packageFolder } from "./browser.mjs";

const site = process.env.SITE ?? packageFolder + "../site";
const built = existsSync(join(site, "environment.js"));

/** A lamp in a room that is not the same on any two sides. */
function panorama(width) {
    const height = width / 2;
    const texels = new Float32Array(3 * width * height);
    for (let row = 0; row < height; ++row)
        for (let column = 0; column < width; ++column) {
            const [u, v] = [(column + 0.5) / width, (row + 0.5) / height];
            const lamp = u > 0.3 && u < 0.4 && v > 0.2 && v < 0.3 ? 12 : 0;
            texels.set([0.1 + lamp, v < 0.5 ? 0.3 : 0.1, 0.2 + 0.1 * Math.cos(2 * Math.PI * u)], 3 * (row * width + column));
        }
    return { texels, width, height };
}

/** The mean over a hemisphere, by GGX seen along the normal and the cosine. */
function integral({ texels, width, height }, [x, y, z], roughness) {
    const alpha2 = roughness ** 4;
    const sum = [0, 0, 0];
    let weights = 0;
    for (let row = 0; row < height; ++row) {
        const up = Math.PI * (0.5 - (row + 0.5) / height);
        for (let column = 0; column < width; ++column) {
            const around = 2 * Math.PI * ((column + 0.5) / width - 0.5);
            const cosine = (x * Math.cos(around) + z * Math.sin(around)) * Math.cos(up) + y * Math.sin(up);
            if (cosine <= 0) continue;
            const weight = (cosine * Math.cos(up)) / (((1 + cosine) / 2) * (alpha2 - 1) + 1) ** 2;
            weights += weight;
            for (let c = 0; c < 3; ++c) sum[c] += weight * texels[3 * (row * width + column) + c];
        }
    }
    return sum.map((value) => value / weights);
}

const numberOf = (half) => (half < 1024 ? half * 2 ** -24 : (1024 + (half & 1023)) * 2 ** ((half >> 10) - 25));
// Directions of the middles of faces, which three mirrors in x.
const AXES = [[-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

test("ReflectionsAreTheIntegralOverTheLobe", { skip: built ? false : `needs the page in ${site}` }, async () => {
    const { filtered } = await import(pathToFileURL(join(site, "environment.js")));
    const light = panorama(256);
    const { size, levels } = filtered(light);
    assert.equal(size, 256);
    assert.equal(levels.length, 6);
    for (let level = 1; level < 6; ++level)
        AXES.forEach((axis, face) => {
            const side = size >> level;
            const expected = integral(light, axis, 1 - Math.sqrt(1 - level / 5));
            // Between the four texels in the middle.
            const corners = [[-1, -1], [-1, 0], [0, -1], [0, 0]].map(([i, j]) => 4 * ((side / 2 + i) * side + side / 2 + j));
            const found = [0, 1, 2].map((c) => corners.reduce((sum, at) => sum + numberOf(levels[level][face][at + c]) / 4, 0));
            // 3 % of what most directions see, and .6 % of the lamp: its edge falls between samples.
            found.forEach((value, c) =>
                assert.ok(Math.abs(value - expected[c]) < 0.03 * expected[c] + (c === 0 ? 0.07 : 0.003), `level ${level}, face ${face}: ${found}, the integral ${expected}`));
        });
});
