// Rigorous theory without a browser: workers are Tasks of this process. ROWLAND_TRADE: the program, beside rowland-cook.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import test from "node:test";
import { packageFolder } from "./browser.mjs";

const built = existsSync(packageFolder + "dist/solve.wasm");
const skip = built ? false : "needs dist: npm run build";
const { GratingMaterial, Rowland } = built ? await import("../dist/index.js") : {};
const { Tasks } = built ? await import("../dist/tasks.js") : {};

const trade = process.env.ROWLAND_TRADE;

const grating = { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 130 }, orders: [-2, -1, 1, 2] };
const SCALAR = { grating, metal: "Al" };
const RIGOROUS = { grating: { ...grating, theory: "rigorous" }, metal: "Al" };

/** A Rowland, and the modules and tasks that it has asked for. */
function rowlandHere() {
    const [modules, tasks] = [[], []];
    const start = () => {
        const own = new Tasks(async (name) => {
            modules.push(name);
            return readFileSync(`${packageFolder}dist/${name}.wasm`);
        });
        let last = Promise.resolve();
        const worker = {
            postMessage({ id, task, args }) {
                tasks.push(task);
                last = last.then(() => own[task](...args)).then((result) => worker.onmessage({ data: { id, result } }),
                    (error) => worker.onmessage({ data: { id, error: error.message } }));
            },
        };
        return worker;
    };
    const rowland = new Rowland(start);
    rowland.onError = () => {};
    return { rowland, modules, tasks };
}

const texels = (material) => material.state.tables.kernel.texels;
const sees = (material) => material.state.tables.views > 1;

test("scalar theory shows until rigorous theory is solved", { skip }, async (t) => {
    const { rowland, modules } = rowlandHere();
    const scalar = new GratingMaterial({ rowland, grating: SCALAR });
    await scalar.solved;
    assert.deepEqual(modules, ["bake"]);
    assert.equal(sees(scalar), false);

    const rigorous = new GratingMaterial({ rowland, grating: RIGOROUS });
    await rigorous.ready;
    assert.deepEqual(texels(rigorous), texels(scalar));
    const begin = performance.now();
    await rigorous.solved;
    t.diagnostic(`solved in ${Math.round(performance.now() - begin)} ms`);
    assert.ok(sees(rigorous));
    const copy = rigorous.clone();
    await copy.ready;
    assert.deepEqual(texels(copy), texels(rigorous));
    assert.deepEqual(modules, ["bake", "solve"]);
});

test("the efficiencies of a document take the place of a solve", { skip: skip || (trade ? false : "needs ROWLAND_TRADE") }, async () => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-rigorous-"));
    try {
        writeFileSync(join(folder, "material.json"), JSON.stringify(RIGOROUS));
        execFileSync(join(dirname(trade), "rowland-cook"), ["export", "material.json", "-o", "out.json"], { cwd: folder });
        const { material } = JSON.parse(readFileSync(join(folder, "out.json")));
        const { offset, shape } = material.efficiencies.values;
        const bytes = readFileSync(join(folder, "out.bin"));
        const values = Float32Array.from({ length: shape[0] * shape[1] * shape[2] }, (_, i) => bytes.readFloatLE(offset + 4 * i));

        const { rowland, modules } = rowlandHere();
        const given = new GratingMaterial({ rowland, grating: RIGOROUS, efficiencies: { ...material.efficiencies, values } });
        await given.solved;
        assert.ok(sees(given));
        assert.deepEqual(modules, ["bake"]);

        const numbers = await new Tasks(async (name) => readFileSync(`${packageFolder}dist/${name}.wasm`)).solve([1, 1600, 130, 0.35, 1, 0]);
        const solved = numbers.subarray(numbers.length - values.length);
        const worst = solved.reduce((largest, x, i) => Math.max(largest, Math.abs(x - values[i])), 0);
        assert.ok(worst < 1e-5, `${worst}: by the same solver in another compiler's rounding`);
    } finally {
        rmSync(folder, { recursive: true });
    }
});

test("of gratings that follow each other fast the last is solved", { skip }, async () => {
    const { rowland, tasks } = rowlandHere();
    const deeper = (depth_nm) => ({ ...RIGOROUS, grating: { ...RIGOROUS.grating, pitch_nm: 700, profile: { type: "sinusoidal", depth_nm } } });
    const material = new GratingMaterial({ rowland, grating: deeper(50) });
    for (const depth_nm of [60, 70, 80]) material.bake(rowland, deeper(depth_nm));
    await material.solved;
    assert.ok(sees(material));
    assert.equal(tasks.filter((task) => task === "solve").length, 1);
    assert.equal(tasks.filter((task) => task === "material").length, 5);
});

test("what rigorous theory cannot have is refused", { skip }, async () => {
    const { rowland } = rowlandHere();
    const refused = (material, efficiencies, words) => assert.rejects(new GratingMaterial({ rowland, grating: material, efficiencies }).ready, words);
    const efficiencies = { orders: [0, 1], begin_nm: 380, step_nm: 10, views: Array(65).fill(0), values: new Float32Array(2 * 41 * 65) };
    const slit = { grating: { pitch_nm: 1600, profile: { type: "slit", width_nm: 800 }, theory: "rigorous" }, metal: "Al" };
    await refused(slit, undefined, /theory: "rigorous" with profile "slit"; expected lamellar/);
    await refused({ ...RIGOROUS, metal: undefined }, undefined, /"rigorous" without a metal/);
    const scalar = { ...SCALAR, grating: { ...SCALAR.grating, theory: "scalar" } };
    await refused(scalar, efficiencies, /theory: efficiencies beside scalar theory; expected "theory": "rigorous"/);
    await refused(RIGOROUS, { ...efficiencies, step_nm: 5 }, /efficiencies: 65 views of wavelengths from 380 nm in steps of 5 nm; expected/);
    await refused(RIGOROUS, { ...efficiencies, orders: [1, 0] }, /ascending/);
    await refused(RIGOROUS, { ...efficiencies, values: new Float32Array(7) }, /7 values of 2 orders; expected 5330/);
    await refused(RIGOROUS, { ...efficiencies, values: new Float32Array(5330).fill(NaN) }, /a value of NaN/);
});
