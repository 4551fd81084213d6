// Films of the page against `rowland-trade evaluate`, which ROWLAND_TRADE names.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import * as plain from "../dist/index.js";
import * as nodes from "../dist/webgpu.js";
import { chromium, resultOf } from "./browser.mjs";
import { CASES, expected, trade, worstOf } from "./film_cases.mjs";

const missing = !chromium() ? "needs Chromium" : !trade ? "needs ROWLAND_TRADE, the program rowland-trade" : false;

const BETWEEN_RENDERERS = 1e-3;

test("films equal rowland-trade evaluate", { skip: missing }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-film-"));
    try {
        const { results, error } = await resultOf("test/module.html?film_driver.js", { cases: CASES }, { webgpu: true });
        assert.equal(error, undefined);
        for (const renderer of ["WebGPURenderer on WebGL 2", "WebGPURenderer on WebGPU"])
            await t.test(renderer, { skip: renderer in results ? false : "this Chromium offers no WebGPU adapter" }, () => {});
        for (const [i, one] of CASES.entries())
            await t.test(one.name, () => {
                for (const [method, tolerance] of Object.entries(one.tolerances)) {
                    const reference = expected(folder, one, method);
                    for (const [renderer, shown] of Object.entries(results)) {
                        const { worst, at } = worstOf(shown[i], reference);
                        t.diagnostic(`${one.name}, ${method}, ${renderer}: ${worst.toExponential(2)} of the largest component, at view ${at}: ` +
                            `${shown[i][at]} for ${reference[at]}`);
                        assert.ok(worst < tolerance, `${method}, ${renderer}: ${worst}`);
                        const apart = worstOf(shown[i], results.WebGLRenderer[i]).worst;
                        assert.ok(apart < BETWEEN_RENDERERS, `${renderer}: ${apart} off WebGLRenderer`);
                    }
                }
            });
    } finally {
        rmSync(folder, { recursive: true });
    }
});

test("materials of a glTF are gratings and films, whatever other extensions they have", async () => {
    const silent = () => ({ postMessage() {}, addEventListener() {}, set onmessage(_) {}, terminate() {} });
    const rowland = new plain.Rowland(silent);
    const grating = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 130 } }, metal: "Al" };
    const beside = { KHR_materials_ior: { ior: 1.4 }, KHR_materials_clearcoat: { clearcoatFactor: 0.5 } };
    const materials = [{ extensions: { ...beside, ROWLAND_materials_diffraction: grating } },
        { extensions: { ...beside, KHR_materials_iridescence: { iridescenceFactor: 0.7, iridescenceIor: 2 } } }];
    for (const { GratingExtension, FilmExtension, kind } of [{ ...plain, kind: "" }, { ...nodes, kind: "Node" }]) {
        const loader = new GLTFLoader().register((parser) => new GratingExtension(parser, rowland)).register((parser) => new FilmExtension(parser, rowland));
        const { parser } = await loader.parseAsync(JSON.stringify({ asset: { version: "2.0" }, materials }), "");
        const [grating, film] = await Promise.all([0, 1].map((i) => parser.getDependency("material", i)));
        assert.ok(grating.isGratingMaterial && grating.clearcoat === 0.5 && grating.ior === 1.4);
        assert.equal(grating.constructor.name, `Grating${kind}Material`);
        assert.ok(film.isFilmMaterial && film.ior === 1.4 && film.iridescence === 0.7);
        assert.equal(film.constructor.name, `Film${kind}Material`);
        assert.deepEqual(film.film.film, { ior: 2, thickness_nm: 400 });
    }
});
