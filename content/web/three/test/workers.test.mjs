// What the workers keep and what waits for them, without a browser: workers are Tasks of this process.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import test from "node:test";
import { DataTexture, FloatType, RGBAFormat } from "three";
import { packageFolder } from "./browser.mjs";

const built = existsSync(packageFolder + "dist/bake.wasm");
const skip = built ? false : "needs dist: npm run build";
const { GratingMaterial, Rowland } = built ? await import("../dist/index.js") : {};
const { Tasks } = built ? await import("../dist/tasks.js") : {};

const CD = { grating: { pitch_nm: 1600, profile: { type: "lamellar", duty: 0.35, depth_nm: 130 }, theory: "scalar" }, metal: "Al" };

/** A Rowland, its workers' tasks, and the most calls that one worker has had at a time. */
function rowlandHere() {
    const workers = [];
    const calls = { most: 0, names: [] };
    const rowland = new Rowland(() => {
        const own = new Tasks(async (name) => readFileSync(`${packageFolder}dist/${name}.wasm`));
        workers.push(own);
        let waiting = 0;
        let last = Promise.resolve();
        const worker = {
            postMessage({ id, task, args }) {
                calls.most = Math.max(calls.most, ++waiting);
                calls.names.push(task);
                last = last.then(() => own[task](...args)).then((result) => ({ id, result }), (error) => ({ id, error: error.message })).then((data) => {
                    --waiting;
                    worker.onmessage({ data });
                });
            },
        };
        return worker;
    });
    const told = [];
    rowland.onError = (error) => told.push(error.message);
    return { rowland, workers, calls, told };
}

function sky(brightness) {
    const texels = new Float32Array(4 * 32 * 16).fill(0.3).fill(brightness, 4 * 32 * 10, 4 * 32 * 10 + 12);
    return new DataTexture(texels, 32, 16, RGBAFormat, FloatType);
}

test("fifty materials that are disposed leave the workers as they were", { skip }, async () => {
    const { rowland, workers } = rowlandHere();
    const once = async () => {
        const material = new GratingMaterial({ rowland, grating: CD });
        await material.solved;
        material.dispose();
        while (rowland.busy) await new Promise(setImmediate);
    };
    const bytes = async () => (await workers[0].modules.get("bake")).memory.buffer.byteLength;
    for (let i = 0; i < 5; ++i) await once();
    const before = await bytes();
    for (let i = 0; i < 50; ++i) await once();
    assert.equal(workers[0].baked.size, 0);
    assert.equal(rowland.sources.size, 0);
    assert.equal(await bytes(), before);
});

test("probes that come faster than they are baked do not wait in line, and the last is shown", { skip }, async () => {
    const { rowland, workers, calls, told } = rowlandHere();
    const probes = Array.from({ length: 20 }, (_, i) => rowland.setProbe(sky(10 + i), { keyLights: 1 }));
    await Promise.all(probes);
    assert.deepEqual(told, []);
    assert.ok(calls.most <= 3, `${calls.most} calls of one worker at a time`);
    assert.ok(calls.names.filter((name) => name === "fitKeyLights").length <= 2, String(calls.names));
    const texels = await workers[0].probeTexels();
    assert.ok(Math.abs(Math.max(...texels.subarray(2)) - 29) < 0.1, "the last probe");
});
