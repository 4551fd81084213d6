// What Babylon draws: against `rowland-trade evaluate`, against three and against its own mirrors. ROWLAND_TRADE
// names the program, ROWLAND_DATA the test data; pictures go into the folder PICTURES.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { fileURLToPath } from "node:url";
import { CASES, evaluate, texelsOf, trade } from "../../three/test/accuracy_cases.mjs";
import { chromium, resultOf } from "../../three/test/browser.mjs";
import { CASES as FILMS, expected as expectedOfFilm, worstOf } from "../../three/test/film_cases.mjs";

const here = fileURLToPath(new URL("..", import.meta.url));
const probe = join(process.env.ROWLAND_DATA ?? "../../../../shared", "probes/venice_sunset_256.hdr");
const missing = !chromium() ? "needs Chromium" : !existsSync(here + "dist/shared/bake.wasm") ? "needs dist: npm run build"
    : !trade ? "needs ROWLAND_TRADE, the program rowland-trade" : !existsSync(probe) && `needs ${probe}`;

const named = (name) => CASES.find((one) => one.name === name);
const LAMP = { name: "direct, a lamp", lamp: { direction: [0.2, 0.9, -0.4], flux: [2, 3, 1] } };
const cases = [
    ...["planar", "arc", "direct, lobe and cover"].map((name) => ({ ...named(name), hand: "left" })),
    ...["direct", "arc, lobe and cover"].map((name) => ({ ...named(name), hand: "left", three: true })),
    { ...named("direct"), ...LAMP, hand: "left", three: true },
    { ...named("arc"), hand: "right" },
    ...["planar, groove texture", "direct, groove texture", "arc, groove texture"].map((name) => ({ ...named(name), hand: "left", three: true })),
    // Its program; what pixels that cover many facets show is tested with three, whose GLSL is the same.
    { ...named("direct, groove texture"), name: "direct, groove texture that sparkles", hand: "left", three: true, sparkle: true },
].map((one) => (one.grooves ? { ...one, texels: texelsOf(one) } : one));
const mirrors = ["left", "right"].flatMap((hand) => [0, 1.1].map((rotation) =>
    ({ ...named("direct"), frames: named("direct").frames.slice(0, 20), hand, rotation })));

/** Of the page with this folder's script, which lies where its workers do. */
async function resultOfPage(task) {
    const folder = mkdtempSync(join(tmpdir(), "rowland-babylon-"));
    try {
        await createRequire(import.meta.url)("esbuild").build({ entryPoints: [here + "test/page.js"], bundle: true, format: "esm",
            outfile: join(folder, "page.js"), alias: { "@rowland/babylon": here + "dist/index.js" }, logLevel: "error" });
        writeFileSync(join(folder, "page.html"), readFileSync(here + "examples/disc.html", "utf8")
            .replace('<script type="module" src="disc.js">', '<script src="picture_driver.js"></script>\n<script type="module" src="dist/shared/page.js">'));
        return await resultOf("page.html", task, { folder: here, seconds: 500, size: "480,400", files: { "/page.html": join(folder, "page.html"),
            "/dist/shared/page.js": join(folder, "page.js"), "/light.hdr": probe, "/picture_driver.js": here + "../three/test/picture_driver.js" } });
    } finally {
        rmSync(folder, { recursive: true });
    }
}

// Off three, films at 100 views: three's mirror has the light that microfacets reflect twice as well, and Babylon's table of
// the lobes' albedo is another: 1.1e-3 and 5.4e-3 measured.
const OFF_THREE = { "soap film, a lamp": 2e-3, "anodised aluminium, rough": 8e-3 };

/** The largest difference of two lists of colours. */
const worst = (some, others) => Math.max(...some.flat().map((x, i) => Math.abs(x - others.flat()[i])));
const largest = (colours) => Math.max(...colours.flat().map(Math.abs));
/** Of the bytes of two pictures, and the mean of the second's colours. */
function meanDifference(some, others) {
    const mean = (values) => values.reduce((sum, x) => sum + x, 0) / values.length;
    return { error: mean(some.map((x, i) => Math.abs(x - others[i]))), level: mean(others.filter((_, i) => i % 4 < 3)) };
}

test("the example is the README's", () => {
    const [, lines] = /```js\n(.*?)```/s.exec(readFileSync(here + "README.md", "utf8"));
    assert.equal(readFileSync(here + "examples/disc.js", "utf8"), lines);
});

test("points have the radiance of the reference and of three", { skip: missing }, async (t) => {
    const { errors, results, mirrored, byThree, films, times } = await resultOfPage({ part: "points", cases, mirrors, films: FILMS });
    t.diagnostic(JSON.stringify(times));
    assert.deepEqual(errors, []);
    const folder = mkdtempSync(join(tmpdir(), "rowland-accuracy-"));
    const expected = {};
    for (const [i, one] of cases.entries()) {
        if (!one.lamp)
            await t.test(`${one.name}, ${one.hand}-handed: pixels equal rowland-trade evaluate`, () => {
                expected[one.name] ??= evaluate(folder, probe, one);
                const error = worst(results[i], expected[one.name]) / largest(expected[one.name]);
                t.diagnostic(`${one.name}, ${one.hand}-handed: ${error.toExponential(2)} of the largest component`);
                assert.ok(error < 2e-3, String(error));
            });
        if (byThree[i])
            await t.test(`${one.name}: pixels equal three's`, () => {
                const error = worst(results[i], byThree[i]) / largest(byThree[i]);
                t.diagnostic(`${one.name}: ${error.toExponential(2)} of the largest component off three`);
                assert.ok(largest(byThree[i]) > 0 && error < 1e-3, String(error));
            });
    }
    for (const [i, one] of FILMS.entries())
        await t.test(`${one.name}: pixels equal rowland-trade evaluate and three's`, () => {
            for (const [method, tolerance] of Object.entries(one.tolerances)) {
                const { worst, at } = worstOf(films[i].babylon, expectedOfFilm(folder, one, method));
                t.diagnostic(`${one.name}, ${method}: ${worst.toExponential(2)} of the largest component, at view ${at}`);
                assert.ok(worst < tolerance, `${method}: ${worst}`);
            }
            const { worst } = worstOf(films[i].babylon.filter((_, view) => view % 5 === 0), films[i].three);
            t.diagnostic(`${one.name}: ${worst.toExponential(2)} off three`);
            assert.ok(worst < (OFF_THREE[one.name] ?? 1e-3), String(worst));
        });
    rmSync(folder, { recursive: true });

    // A texel of the panorama is .05 rad, half of one for Babylon's rounding, and the cube's texels are as wide.
    for (const [i, { hand, rotation }] of mirrors.entries())
        await t.test(`the panorama is where Babylon mirrors it: ${hand}-handed, rotated by ${rotation}`, () => {
            t.diagnostic(`${hand}-handed, rotated by ${rotation}: ${largest(mirrored[i])}`);
            assert.ok(largest(mirrored[i]) < 0.05, String(largest(mirrored[i])));
        });
});

test("scenes look as with three, and as their slow equivalents", { skip: missing }, async (t) => {
    const { errors, diffracted, compared, gltfFilm, pictures, green, times } = await resultOfPage({ part: "scenes",
        kinds: process.env.PICTURES ? ["diffracted", "whole"] : ["diffracted"] });
    t.diagnostic(JSON.stringify(times));
    assert.deepEqual(errors, []);
    if (process.env.PICTURES)
        for (const [name, url] of Object.entries(pictures))
            writeFileSync(join(process.env.PICTURES, `babylon_${name}.png`), Buffer.from(url.split(",")[1], "base64"));
    await t.test("a glTF looks as with three", () => {
        const { error, level } = meanDifference(diffracted.babylon, diffracted.three);
        t.diagnostic(`a mean difference of ${error.toFixed(3)}, of a mean of ${level.toFixed(2)}, in bytes`);
        assert.ok(level > 5 && error < 0.02 * level, `${error} of ${level}`);
    });
    await t.test("a film of a glTF is the exact one", () => {
        const { tableError, ...film } = gltfFilm;
        assert.deepEqual(film, { minimumThickness: 200, maximumThickness: 600, indexOfRefraction: 1.4, sRgb: false });
        assert.ok(tableError > 0);
    });
    for (const { name, one, slow } of compared)
        await t.test(`${name} looks as its slow equivalent`, () => {
            const { error, level } = meanDifference(one, slow);
            t.diagnostic(`${name}: a mean difference of ${error.toFixed(4)}, of a mean of ${level.toFixed(2)}, in bytes`);
            assert.ok(level > 2 && error < 0.01 * level, `${error} of ${level}`);
        });
    await t.test("the example's disc has rainbows", () => assert.ok(green >= 0.0005, `${green} of the pixels are green`));
});
