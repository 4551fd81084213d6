// What pages do with three: each a row of test/pages.js, compared there with a slow and obvious equivalent.
import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { chromium, packageFolder, resultOf } from "./browser.mjs";

const built = existsSync(packageFolder + "dist/bake.wasm");
const missing = !built ? "needs dist: npm run build" : false;

/** What a row may be off, of the largest component: 1e-3 where it is not said. */
const TOLERANCES = {
    "an EffectComposer": 2.5 / 255, // bytes, through a target of halves
    "every tone mapping": 2.5 / 255,
    "an orthographic camera": 2e-2, // beside a perspective one from 2000 units away: 1.4e-2 measured
};
/** What a row tells the page, once. */
const TOLD = { "more vertices of instances than a table holds": /243100 vertices of instances, of which a table holds 233016/ };

/** three's own words when its node materials are copied. */
const COPIED = /"iridescenceThicknessRange" property has been replaced/;
const RENDERERS = process.env.RENDERER?.split(",") ?? ["WebGLRenderer", "WebGPURenderer on WebGL 2", "WebGPURenderer on WebGPU"];

const only = process.env.ROWS?.split(",");
const keep = process.env.PICTURES !== undefined;
// One visit for all that these tests ask: each renderer's rows, or why there are none.
let visited;
const visit = () => (visited ??= resultOf("test/module.html?pages.js", { renderers: RENDERERS, only, keep }, { seconds: 900, webgpu: true }));

for (const renderer of RENDERERS) test(`gratings in pages of ${renderer}`, { skip: chromium() ? missing : "needs Chromium" }, async (t) => {
    const { rows, error, ...result } = (await visit())[renderer];
    if (/no WebGPU adapter/.test(error)) return t.skip(error);
    assert.equal(error, undefined, JSON.stringify(result));
    for (const { name, found, expected, ...row } of rows) {
        if (keep && found)
            for (const [which, address] of Object.entries({ found, expected }))
                writeFileSync(join(process.env.PICTURES, `${name.replace(/\W+/g, "_")}_${which}.png`), Buffer.from(address.split(",")[1], "base64"));
        t.diagnostic(`${name}: ${JSON.stringify(row)}`);
    }
    for (const { name, difference, colour, moved, again, limits, leftOut, told, errors, before, after } of rows)
        await t.test(name, () => {
            assert.deepEqual(errors.filter((line) => !COPIED.test(line)), []);
            if (TOLD[name]) assert.match(told.join(" | "), TOLD[name]);
            else assert.deepEqual(told, []);
            assert.ok(difference < (TOLERANCES[name] ?? 1e-3), `${difference} of the largest component`);
            assert.ok(colour > 0.1, `a picture without colours: ${colour}`);
            if (moved !== undefined) assert.ok(moved > 0.05, `what the row changes is not seen: ${moved}`);
            if (again !== undefined) assert.ok(again < 1e-3, `the first canvas afterwards: ${again}`);
            assert.deepEqual(after, before);
            if (!limits) return;
            assert.ok(leftOut.includes("clearcoatMap") && !leftOut.includes("map"), `left out: ${leftOut}`);
            assert.ok(limits.samplers > 10 && limits.samplers <= 16 && limits.varyings > 10 && limits.varyings <= 15, JSON.stringify(limits));
        });
});
