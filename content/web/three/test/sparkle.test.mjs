// Foil that sparkles: its levels, and pixels of each of three's renderers, against a slow equivalent of sparkle.glsl.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import test from "node:test";
import { chromium, packageFolder, resultOf } from "./browser.mjs";
import { CASES, CORNER, DIRECTIONS, EDGE_CASE, edgePicture, facetTexels, levelsOf, pictureOf, redOf, smoothOf, textureOf } from "./sparkle_cases.mjs";

const built = existsSync(packageFolder + "dist/sparkle.wasm");
const missing = built ? false : "needs dist: npm run build";
const GREEN = 32768;

test("levels hold one facet of four", { skip: missing }, async () => {
    const { Tasks } = await import("../dist/tasks.js");
    const { fromHalf } = await import("../dist/half.js");
    const tasks = new Tasks(async (name) => readFileSync(`${packageFolder}dist/${name}.wasm`));
    for (const gaps of [false, true]) {
        const { width, height, texels } = textureOf({ gaps });
        const rgba = new Uint16Array(4 * width * height);
        for (let i = 0; i < width * height; ++i) rgba.set([texels[2 * i], texels[2 * i + 1], 0, 65535], 4 * i);
        const found = await tasks.grooveMoments(rgba, width, height, true, "facets");
        assert.equal(found.gaps, gaps);
        assert.ok(Math.abs(found.facetTexels - facetTexels(gaps)) < 1e-5 * found.facetTexels, `${found.facetTexels} for ${facetTexels(gaps)}`);
        const expected = levelsOf(gaps);
        assert.deepEqual(found.levels.map(({ width, height }) => [width, height]), expected.map(({ width, height }) => [width, height]));
        const signed = (half) => (half & 0x8000 ? -fromHalf(half & 0x7fff) : fromHalf(half));
        found.levels.forEach(({ moments, rest }, level) =>
            expected[level].texels.forEach(({ direction, coverage }, i) => {
                const angle = (2 * Math.PI * redOf(direction)) / 65535;
                const wanted = coverage === 0 ? [0.5, 0.5, 0, 0]
                    : [0.5 + 0.5 * coverage * Math.cos(angle), 0.5 + 0.5 * coverage * Math.sin(angle), coverage, coverage];
                wanted.forEach((x, c) => {
                    const value = fromHalf(moments[4 * i + c]) + signed(rest[4 * i + c]);
                    assert.ok(Math.abs(value - x) < 5e-5, `level ${level}, texel ${i}, ${c}: ${value} for ${x}`); // 16 bits, rounded at each level
                });
            }));
    }
});

// The angle within a range is rounded with the moments; 1.7e-3 measured.
const TOLERANCE = 4e-3;

test("pixels are those of the slow equivalent, and their mean that of smooth foil", { skip: missing || (chromium() ? false : "needs Chromium") }, async (t) => {
    const reds = Array.from({ length: DIRECTIONS }, (_, direction) => redOf(direction));
    const { results, edges, errors, error, loaded } = await resultOf("test/module.html?sparkle_page.js",
        { corner: CORNER, edge: EDGE_CASE, cases: CASES.map((one) => ({ ...one, reds, green: GREEN, texture: textureOf(one) })) }, { webgpu: true, seconds: 900 });
    assert.equal(error, undefined);
    assert.deepEqual(errors, []);
    assert.ok(loaded.includes("/dist/generated/sparkle.js"), loaded.join());
    for (const [i, one] of CASES.entries())
        await t.test(one.name, () => {
            const { shown, pictures } = results[i];
            const brightest = Math.max(...shown.flat());
            const smooth = smoothOf(one, shown);
            const luminance = (rgb) => rgb.reduce((sum, x) => sum + x, 0);
            const levels = levelsOf(one.gaps);
            for (const [d, distance] of one.distances.entries()) {
                const expected = pictureOf(one, distance, shown, levels);
                const known = expected.filter((rgb) => rgb);
                assert.ok(known.length > 0.5 * expected.length, `${known.length} of ${expected.length} pixels`);
                for (const [renderer, all] of Object.entries(pictures)) {
                    const picture = all[d];
                    const worst = Math.max(...expected.map((rgb, pixel) => (rgb ? Math.max(...rgb.map((x, c) => Math.abs(x - picture[pixel][c]))) : 0))) / brightest;
                    const mean = picture.reduce((sum, rgb) => sum + luminance(rgb), 0) / picture.length;
                    const off = mean / luminance(smooth) - 1;
                    t.diagnostic(`${one.name}, ${distance.facets} facets a pixel, ${renderer}: ${worst.toExponential(2)} of the brightest, mean ${(100 * off).toFixed(2)} % off`);
                    assert.ok(worst < TOLERANCE, `${renderer}: ${worst} of the brightest at ${distance.facets} facets`);
                    assert.ok(Math.abs(off) < 0.02, `${renderer}: a mean ${off} off at ${distance.facets} facets`);
                }
                const spread = Math.sqrt(known.reduce((sum, rgb) => sum + (luminance(rgb) / luminance(smooth) - 1) ** 2, 0) / known.length);
                t.diagnostic(`${one.name}, ${distance.facets} facets a pixel: pixels vary by ${spread.toFixed(3)} of their mean`);
                assert.ok(spread > 0.02, "it sparkles");
            }
        });
    // The mean of two facets' grooves is neither's.
    await t.test("an edge between facets shows the light of both alone", () => {
        const { shown } = results[2];
        const expected = edgePicture(shown);
        const brightest = Math.max(...shown.flat());
        assert.ok(Math.max(...expected.at(0).map((x, c) => Math.abs(x - expected.at(16)[c]))) > 0.02 * brightest, "the facets differ");
        for (const [renderer, picture] of Object.entries(edges)) {
            const worst = Math.max(...expected.map((rgb, pixel) => Math.max(...rgb.map((x, c) => Math.abs(x - picture[pixel][c]))))) / brightest;
            t.diagnostic(`an edge, ${renderer}: ${worst.toExponential(2)} of the brightest`);
            assert.ok(worst < TOLERANCE, `${renderer}: ${worst} of the brightest`);
        }
    });
});
