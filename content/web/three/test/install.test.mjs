// The package as npm packs it, in a fresh folder: the README's lines show a disc.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { chromium, packageFolder, resultOf, withDrivers } from "./browser.mjs";

const missing = !chromium() ? "needs Chromium" : !existsSync(packageFolder + "dist/bake.wasm") ? "needs dist: npm run build" : false;

test("the examples are the README's", () => {
    const lines = [...readFileSync(packageFolder + "README.md", "utf8").matchAll(/```js\n(.*?)```/gs)].map(([, text]) => text);
    for (const name of ["disc.js", "webgpu.js"]) assert.ok(lines.includes(readFileSync(packageFolder + "examples/" + name, "utf8")), name);
});

test("the packed file, installed in a fresh folder, shows a disc", { skip: missing }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), "rowland-install-"));
    const npm = (from, ...words) => execFileSync("npm", words, { cwd: from, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
    try {
        const [{ filename, size }] = JSON.parse(npm(packageFolder, "pack", "--json", "--ignore-scripts", "--pack-destination", folder));
        npm(folder, "init", "--yes");
        // three is the copy beside the package, so that no network is needed.
        npm(folder, "install", "--offline", "--no-audit", "--install-links", packageFolder + "node_modules/three", "./" + filename);
        t.diagnostic(`${size} bytes packed`);
        // The second on WebGL 2, which WebGPURenderer takes here: no canvas of WebGPU can be read without a GPU.
        for (const example of ["disc", "webgpu"]) {
            for (const name of [example + ".html", example + ".js"]) copyFileSync(packageFolder + "examples/" + name, join(folder, name));
            const { text, files } = withDrivers(readFileSync(join(folder, example + ".html"), "utf8"), "picture_driver.js", "disc_driver.js");
            writeFileSync(join(folder, "watched.html"), text);
            const requests = [];
            const result = await resultOf("watched.html", {}, { folder, files, requests, size: "320,240", seconds: 400 });
            if (process.env.PICTURES) writeFileSync(join(process.env.PICTURES, example + ".png"), Buffer.from(result.url.split(",")[1], "base64"));
            t.diagnostic(`${example}: colours of ${result.colour}`);
            assert.deepEqual(result.errors, [], example);
            assert.equal(requests.some((path) => path.endsWith("three.webgpu.js")), example === "webgpu");
            assert.equal(requests.some((path) => path.endsWith("three.module.js")), example === "disc");
        }
    } finally {
        rmSync(folder, { recursive: true });
    }
});
