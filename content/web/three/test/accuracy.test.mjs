// Pixels of each of three's renderers against `rowland-trade evaluate`. ROWLAND_TRADE names the program, ROWLAND_DATA the test data.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { DataTexture, FloatType, RGBAFormat } from "three";
import { EXRExporter, NO_COMPRESSION } from "three/examples/jsm/exporters/EXRExporter.js";
import { EXRLoader } from "three/examples/jsm/loaders/EXRLoader.js";
import { CASES, evaluate, KEY_LIGHTS, texelsOf, trade } from "./accuracy_cases.mjs";
import { chromium, resultOf } from "./browser.mjs";

const probes = join(process.env.ROWLAND_DATA ?? "../../../../shared", "probes");
const missing = !chromium() ? "needs Chromium" : !trade ? "needs ROWLAND_TRADE, the program rowland-trade"
    : !existsSync(probes) ? `needs the test data's probes in ${probes}` : false;

/** A probe that both read alike. Of the lossy compression DWAB three decodes the brightest texels .4 % lower than OpenEXR. */
async function lossless(path, folder) {
    if (!path.endsWith(".exr")) return path;
    const bytes = readFileSync(path);
    const loader = new EXRLoader().setDataType(FloatType);
    const { data, width, height } = loader.parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    const texture = new DataTexture(data.map((x) => Math.max(x, 0)), width, height, RGBAFormat, FloatType);
    const plain = join(folder, "probe.exr");
    writeFileSync(plain, await new EXRExporter().parse(texture, { type: FloatType, compression: NO_COMPRESSION }));
    return plain;
}

/** Of the points that the reference has. */
function relativeRms(shown, reference) {
    const norm = (of) => Math.sqrt(of.flat().reduce((sum, x) => sum + x * x, 0));
    return norm(reference.map((rgb, i) => rgb.map((x, c) => shown[i][c] - x))) / norm(reference);
}
// What a map and key lights are off the ground truth, and half of what scalar theory is.
const SHOWN = 0.05;

// By three's renderers, whose compilers round differently: 3e-6 measured.
const BETWEEN_RENDERERS = 1e-3;
const ON_WEBGPU = "WebGPURenderer on WebGPU";
// WebGPU draws from the top row on, and a GPU takes all differences of four pixels in their first row. WebGLRenderer's picture
// drawn upside down equals WebGPU's to 1e-6 of the brightest, and its own upright one to 2.6e-3 (measured).
const FLIPPED = "WebGLRenderer, upside down";
const RENDERERS = ["WebGLRenderer", "WebGPURenderer on WebGL 2", ON_WEBGPU];

/** The largest difference, of which point, over the largest component of `expected`. */
function worstOf(shown, expected) {
    const largest = Math.max(...expected.flat().map(Math.abs));
    const errors = expected.map((rgb, point) => Math.max(...rgb.map((x, c) => Math.abs(x - shown[point][c]))) / largest);
    const worst = Math.max(...errors);
    return { largest, worst, at: errors.indexOf(worst) };
}

// Under a wide sun and a narrow one, a key light of .0025 rad.
const TOLERANCE = 2e-3;

const NARROW = CASES.filter(({ name }) => ["planar", "direct"].includes(name));

for (const [probe, cases, renderers] of [["venice_sunset_256.hdr", CASES, RENDERERS], ["blender_city.exr", NARROW, RENDERERS.slice(0, 1)]])
    test(`pixels equal rowland-trade evaluate under ${probe}`, { skip: missing }, async (t) => {
        const folder = mkdtempSync(join(tmpdir(), "rowland-accuracy-"));
        try {
            const path = await lossless(join(probes, probe), folder);
            const { results, errors, error, refusals, keys } = await resultOf("test/module.html?points_page.js",
                { probe: "/probe/" + probe, keyLights: KEY_LIGHTS, renderers, cases: cases.map((one) => (one.grooves ? { ...one, texels: texelsOf(one) } : one)) },
                { files: { ["/probe/" + probe]: path }, webgpu: true });
            assert.equal(error, undefined);
            assert.deepEqual(errors, [], "three logs what a compiler of GLSL or WGSL refuses");
            assert.deepEqual(refusals, ["WebGPURenderer cannot draw GratingMaterial; expected GratingNodeMaterial of @rowland/three/webgpu",
                "WebGLRenderer cannot draw GratingNodeMaterial; expected GratingMaterial of @rowland/three"]);
            for (const name of renderers) await t.test(name, { skip: name in results[0] ? false : "this Chromium offers no WebGPU adapter" }, () => {});
            for (const [i, one] of cases.entries())
                await t.test(one.name, () => {
                    const { [FLIPPED]: flipped, ...drawn } = results[i];
                    const reference = one.picture ? drawn.WebGLRenderer : evaluate(folder, path, one, keys);
                    let before;
                    for (const [renderer, shown] of Object.entries(drawn)) {
                        const expected = flipped && renderer === ON_WEBGPU ? flipped : reference;
                        const { largest, worst, at } = worstOf(shown, expected);
                        t.diagnostic(`${one.name}, ${renderer}: ${worst.toExponential(2)} of the largest component, at point ${at}: ` +
                            `${shown[at]} for ${expected[at]}`);
                        assert.ok(largest > 0 && worst < (one.tolerance ?? TOLERANCE), `${renderer}: ${worst} of the largest component`);
                        const apart = worstOf(shown, flipped ? expected : before ?? shown).worst;
                        assert.ok(apart < BETWEEN_RENDERERS, `${renderer}: ${apart} off the renderer before it`);
                        before = shown;
                    }
                    if (!one.shownBy) return;
                    const off = one.shownBy.map((name) =>
                        relativeRms(results[cases.findIndex((other) => other.name === name)].WebGLRenderer, drawn.reference));
                    t.diagnostic(`${one.shownBy} are ${off.map((x) => x.toFixed(4))} (RMS) off ${one.name}`);
                    assert.ok(off[0] < SHOWN && off[1] > 2 * SHOWN, String(off));
                });
        } finally {
            rmSync(folder, { recursive: true });
        }
    });
