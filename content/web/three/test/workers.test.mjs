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

/** A Rowland, and its workers' tasks. `busy`: what a worker waits for before a task of this name. */
function rowlandHere(busy = {}) {
    const workers = [];
    const calls = { most: 0, names: [] };
    const rowland = new Rowland(() => {
        const own = new Tasks(async (name) => readFileSync(`${packageFolder}dist/${name}.wasm`));
        workers.push(own);
        let waiting = 0;
        let last = Promise.resolve();
        const worker = {
            postMessage({ id, task, args }) {
                calls.most = Math.max(calls.most, ++waiting); // of one worker
                calls.names.push(task);
                last = last.then(() => busy[task]).then(() => own[task](...args))
                    .then((result) => ({ id, result }), (error) => ({ id, error: error.message }))
                    .then((data) => {
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

const pause = () => new Promise(setImmediate);

function sky(brightness) {
    const texels = new Float32Array(4 * 32 * 16).fill(0.3).fill(brightness, 4 * 32 * 10, 4 * 32 * 10 + 12);
    return new DataTexture(texels, 32, 16, RGBAFormat, FloatType);
}

test("materials that are disposed leave the workers as they were", { skip }, async () => {
    const { rowland, workers } = rowlandHere();
    const once = async () => {
        const material = new GratingMaterial({ rowland, grating: CD });
        await material.solved;
        material.dispose();
        while (rowland.busy) await pause();
    };
    for (let i = 0; i < 8; ++i) await once(); // to the size that it stays at
    const bake = await workers[0].modules.get("bake");
    const call = bake.call.bind(bake);
    let held = 0;
    bake.call = (name, ...numbers) => {
        held += name === "read_material" ? 1 : name === "release_material" ? -1 : 0;
        return call(name, ...numbers);
    };
    const bytes = () => bake.memory.buffer.byteLength;
    const before = bytes();
    for (let i = 0; i < 10; ++i) await once();
    assert.equal(held, 0);
    assert.equal(workers[0].baked.size, 0);
    assert.equal(rowland.sources.size, 0);
    assert.equal(bytes(), before);
});

test("probes that come faster than they are baked do not wait in line, and the last is shown", { skip }, async () => {
    for (const slow of ["light", "fitKeyLights"]) {
        let go;
        const { rowland, workers, calls, told } = rowlandHere({ [slow]: new Promise((resolve) => (go = resolve)) });
        const probes = [];
        for (let i = 0; i < 8; ++i) {
            probes.push(rowland.setProbe(sky(10 + i), { keyLights: 1 }));
            const shown = i + 1;
            for (let ticks = 0; ticks < 200 && (slow === "light" || rowland.lightVersion < shown); ++ticks) await pause();
        }
        go();
        await Promise.all(probes);
        assert.deepEqual(told, []);
        assert.ok(calls.most <= 2, `${calls.most} calls of one worker at a time`);
        assert.ok(calls.names.filter((name) => name === slow).length <= 2, String(calls.names));
        const texels = await workers[0].probeTexels();
        assert.ok(Math.abs(Math.max(...texels.subarray(2)) - 17) < 0.1, "the last probe");
    }
});
